// fpo-quality: the measures of the paper's tables for a mesh.

#include <cstdio>

#include "fpo/hausdorff.h"
#include "fpo/quality.h"
#include "geom/scaling.h"
#include "io/input_file.h"
#include "io/mesh_io.h"
#include "tools/cli.h"

namespace {

/// Prints `name value` lines or one JSON object, complete when the printer goes out of scope.
class Printer {
 public:
  explicit Printer(bool json) : json_(json) {}
  Printer(const Printer&) = delete;
  Printer& operator=(const Printer&) = delete;
  ~Printer() {
    if (json_) std::printf("%s}\n", first_ ? "{" : "");
  }
  void operator()(const char* name, double value) {
    if (json_)
      std::printf("%s\"%s\": %.9g", first_ ? "{" : ", ", name, value);
    else
      std::printf("%s %.9g\n", name, value);
    first_ = false;
  }

 private:
  bool json_, first_ = true;
};

/// Complaints name the mesh: a reference that is as small or large makes no difference.
double factor_to_unit_box(const std::filesystem::path& path, const geom::TriMesh& mesh,
                          const geom::TriMesh& reference) try {
  return geom::factor_to_unit_box(mesh, reference);
} catch (const geom::InputError& error) {
  throw geom::InputError(io::display_name(path) + ": " + error.what());
}

int quality(tools::CommandLine& cli) {
  std::filesystem::path reference_path;
  bool json = false;
  cli.describe("MESH",
               "Measures a triangle mesh: topology, shape of triangles, spacing, distance to a reference.");
  cli.path({.name = "reference", .value = "INPUT", .help = "the surface that MESH approximates"},
           reference_path);
  cli.flag({.name = "json", .help = "print one JSON object"}, json);
  const std::filesystem::path path = cli.parse(1, 1).front();
  geom::TriMesh mesh = io::read_mesh(path);
  const bool compare = !reference_path.empty();
  geom::TriMesh reference = compare ? io::read_mesh(reference_path) : geom::TriMesh();
  // No measure depends on the unit of length; in this one no square under- or overflows.
  const double factor = factor_to_unit_box(path, mesh, reference);
  mesh = geom::scaled_to_unit_box(mesh, factor);
  reference = geom::scaled_to_unit_box(reference, factor);
  geom::require(!compare || reference.area() > 0, reference_path.string() + ": the surface has no area");

  const geom::Topology t = geom::topology(mesh);
  const fpo::Quality q = fpo::quality(mesh, compare ? reference.area() : mesh.area());
  fpo::SurfaceDistance d;
  if (compare) d = fpo::surface_distance(mesh, reference, cli.threads());

  Printer print(json);
  const auto count = [&](const char* name, auto value) { print(name, static_cast<double>(value)); };
  count("V", t.vertices);
  count("F", t.facets);
  count("E", t.edges);
  count("euler", t.euler);
  count("components", t.components);
  count("boundary_edges", t.boundary_edges);
  count("nonmanifold_edges", t.nonmanifold_edges);
  count("nonmanifold_vertices", t.nonmanifold_vertices);
  count("misoriented_edges", t.misoriented_edges);
  count("unreferenced_vertices", t.unreferenced_vertices);
  print("Qmin", q.q_min);
  print("Qavg", q.q_avg);
  print("theta_min", q.theta_min);
  print("theta_min_avg", q.theta_min_avg);
  print("theta_max", q.theta_max);
  print("theta_lt30_pct", q.theta_lt30_pct);
  print("V567_pct", q.v567_pct);
  print("delta", q.delta);
  print("delta_avg", q.delta_avg);
  if (compare) {
    const double percent = 100 / reference.diagonal();
    print("dH_pct", percent * d.max);
    print("dH_bound_pct", percent * d.max_bound);
    print("dRMS_pct", percent * d.rms);
  }
  return tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-quality", argc, argv, quality); }
