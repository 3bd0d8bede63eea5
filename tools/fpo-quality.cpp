// fpo-quality: the measures of the paper's tables for a mesh.

#include <cstdio>

#include "geom/scaling.h"
#include "io/mesh_io.h"
#include "tools/cli.h"
#include "tools/measures.h"

namespace {

/// Complaints name the reference.
tools::Measures measured(const geom::TriMesh& mesh, const std::filesystem::path& reference, int threads) {
  if (reference.empty()) return tools::measure(mesh);
  const geom::TriMesh surface = io::read_mesh(reference);
  geom::require(geom::scaled_to_unit_box(surface, geom::factor_to_unit_box(surface)).area() > 0,
                reference.string() + ": the surface has no area");
  return tools::measure(mesh, surface, threads);
}

int quality(tools::CommandLine& cli) {
  std::filesystem::path reference_path;
  bool json = false;
  cli.describe("MESH",
               "Measures a triangle mesh: topology, shape of triangles, spacing, distance to a reference.");
  cli.path({.name = "reference", .value = "INPUT", .help = "the surface that MESH approximates"},
           reference_path);
  cli.flag({.name = "json", .help = "print one JSON object"}, json);
  const geom::TriMesh mesh = io::read_mesh(cli.parse(1, 1).front());
  const auto values = tools::named(measured(mesh, reference_path, cli.threads()));
  if (json) {
    std::printf("%s\n", tools::json(values).c_str());
    return tools::exit_done;
  }
  for (const auto& [name, value] : values) std::printf("%s %.9g\n", name.c_str(), value);
  return tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-quality", argc, argv, quality); }
