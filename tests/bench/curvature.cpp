// Curvature size of meshes: 5%, median and 95% values as shares of the diagonal, and the time.
//   bench-curvature [MESH ...]     without meshes: those in the folder named by FPO_MODELS (default
//   ../shared/models) that are there

#include "fpo/surface/curvature.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "io/mesh_io.h"
#include "tests/bench/models.h"

namespace {

void measure(const std::filesystem::path& path) {
  const geom::TriMesh mesh = io::read_mesh(path);
  for (const int rings : {1, 2, 3}) {
    const auto start = std::chrono::steady_clock::now();
    const auto size = fpo::curvature_size(mesh, {.rings = rings});
    const double time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::vector<double> sorted(size.begin(), size.end());
    std::sort(sorted.begin(), sorted.end());
    const auto share = [&](std::size_t percent) {
      return sorted[sorted.size() * percent / 100] / mesh.diagonal();
    };
    std::printf("%-12s rings %d  5%% %.4f  median %.4f  95%% %.4f diagonals  %.3f s\n", path.stem().c_str(),
                rings, share(5), share(50), share(95), time);
  }
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) measure(argv[i]);
  if (argc > 1) return 0;
  for (const char* name : {"eight", "venus", "homer", "bunny", "elephant", "joint", "mask"}) {
    const std::filesystem::path path = bench::model_file(name);
    if (std::filesystem::exists(path)) measure(path);
  }
}
