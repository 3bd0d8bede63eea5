// Curvature size of meshes: 5%, median and 95% values as shares of the diagonal, and the time.
//   bench-curvature MESH ...

#include "fpo/curvature.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "io/mesh_io.h"

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const geom::TriMesh mesh = io::read_mesh(argv[i]);
    for (const int rings : {1, 2, 3}) {
      const auto start = std::chrono::steady_clock::now();
      const auto size = fpo::curvature_size(mesh, {.rings = rings});
      const double time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      std::vector<double> sorted(size.begin(), size.end());
      std::sort(sorted.begin(), sorted.end());
      const auto share = [&](std::size_t percent) {
        return sorted[sorted.size() * percent / 100] / mesh.diagonal();
      };
      std::printf("%-40s rings %d  5%% %.4f  median %.4f  95%% %.4f diagonals  %.3f s\n", argv[i], rings,
                  share(5), share(50), share(95), time);
    }
  }
}
