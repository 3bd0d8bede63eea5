// Local feature size of meshes: smallest, median and largest value in units of the mean edge length that a
// remeshing with n samples would have, and the time. The surface points are 0.3 of that length apart.
//   bench-local_feature_size [-o FOLDER] MESH n [MESH n ...]     -o: also write coloured meshes there

#include "fpo/local_feature_size.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "fpo/surface_cover.h"
#include "io/mesh_io.h"

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// From blue (small) to red (large), evenly in the logarithm; grey where infinite.
void write_coloured(const std::string& path, const geom::TriMesh& mesh,
                    const geom::Table<geom::VertexId, double>& size, double low, double high) {
  std::ofstream out(path);
  out << "ply\nformat ascii 1.0\nelement vertex " << mesh.num_vertices()
      << "\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face "
      << mesh.num_facets() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (geom::VertexId v(0); v.index() < mesh.num_vertices(); v = geom::VertexId(v.value + 1)) {
    const double t = std::clamp(std::log(size[v] / low) / std::log(high / low), 0.0, 1.0);
    const auto ramp = [&](double top) {
      return static_cast<int>(255 * std::clamp(1.5 - std::abs(4 * t - top), 0.0, 1.0));
    };
    const geom::Vec3& x = mesh.position(v);
    out << x.x() << ' ' << x.y() << ' ' << x.z();
    if (std::isfinite(size[v])) {
      out << ' ' << ramp(3) << ' ' << ramp(2) << ' ' << ramp(1) << '\n';
    } else {
      out << " 128 128 128\n";
    }
  }
  for (const geom::TriMesh::Facet& f : mesh.facets())
    out << "3 " << f[0].value << ' ' << f[1].value << ' ' << f[2].value << '\n';
}

void measure(const std::string& path, double n, const std::string& folder) {
  const geom::TriMesh mesh = io::read_mesh(path);
  const double edge = std::sqrt(2 / std::sqrt(3) * mesh.area() / n);
  const fpo::LocalFeatureSizeOptions options{.spacing = 0.3 * edge};
  const std::size_t points = fpo::surface_cover(mesh, options.spacing, options.seed).size();
  auto start = std::chrono::steady_clock::now();
  const std::size_t poles = fpo::medial_points(mesh, options).size();
  const double pole_time = seconds_since(start);
  start = std::chrono::steady_clock::now();
  const geom::Table<geom::VertexId, double> size = fpo::local_feature_size(mesh, options);
  const double time = seconds_since(start);
  std::vector<double> sorted(size.begin(), size.end());
  std::sort(sorted.begin(), sorted.end());
  const std::string name = std::filesystem::path(path).stem().string();
  std::printf(
      "%-12s n %6.0f  points %7zu  poles %6zu  min %7.3f  median %7.3f  max %7.3f edges  "
      "%5.2f s, poles %5.2f s\n",
      name.c_str(), n, points, poles, sorted.front() / edge, sorted[sorted.size() / 2] / edge,
      sorted.back() / edge, time, pole_time);
  std::fflush(stdout);
  if (!folder.empty()) write_coloured(folder + "/" + name + ".ply", mesh, size, 0.5 * edge, 20 * edge);
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  int first = 1;
  if (argc > 2 && std::string(argv[1]) == "-o") folder = argv[2], first = 3;
  for (int i = first; i + 1 < argc; i += 2) measure(argv[i], std::atof(argv[i + 1]), folder);
}
