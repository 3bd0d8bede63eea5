// Local feature size of meshes: smallest, median and largest value in units of the mean edge length that a
// remeshing with n samples would have, and the time. The surface points are 0.3 of that length apart.
//   bench-local_feature_size [-o FOLDER] [MESH n ...]
// Without meshes: those in the folder named by FPO_MODELS (default ../shared/models) that are there. -o: also
// draw them there, from blue (1/4 of an edge length or less) over green (2) to red (16 or more).

#include "fpo/surface/local_feature_size.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "fpo/surface/surface_cover.h"
#include "io/mesh_io.h"
#include "io/mesh_picture.h"
#include "tests/bench/models.h"

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// From blue (small) over green to red (large), evenly in the logarithm; grey where infinite.
io::Colour colour(double size, double low, double high) {
  if (!std::isfinite(size)) return {128, 128, 128};
  const double t = std::clamp(std::log(size / low) / std::log(high / low), 0.0, 1.0);
  const auto ramp = [&](double top) {
    return static_cast<std::uint8_t>(255 * std::clamp(1.5 - std::abs(4 * t - top), 0.0, 1.0));
  };
  return {ramp(3), ramp(2), ramp(1)};
}

void draw(const std::string& path, const geom::TriMesh& mesh, const geom::Table<geom::VertexId, double>& size,
          double edge) {
  io::MeshPicture picture;
  picture.edge_width = 0;
  picture.back_faces = true;
  for (const geom::TriMesh::Facet& f : mesh.facets()) {
    const double mean = std::cbrt(size[f[0]] * size[f[1]] * size[f[2]]);
    picture.facet_colours.push_back(colour(mean, 0.25 * edge, 16 * edge));
  }
  io::draw_mesh(mesh, picture).save(path);
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
  if (!folder.empty()) draw(folder + "/" + name + ".svg", mesh, size, edge);
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  int first = 1;
  if (argc > 2 && std::string(argv[1]) == "-o") folder = argv[2], first = 3;
  for (int i = first; i + 1 < argc; i += 2) measure(argv[i], std::atof(argv[i + 1]), folder);
  if (first < argc) return 0;
  for (const auto& [name, n] : {std::pair("eight", 1700),
                                {"venus", 3000},
                                {"homer", 7500},
                                {"bunny", 6300},
                                {"elephant", 11300},
                                {"joint", 5000},
                                {"mask", 6000}}) {
    const std::filesystem::path path = bench::model_file(name);
    if (std::filesystem::exists(path)) measure(path.string(), n, folder);
  }
}
