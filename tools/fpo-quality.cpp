// fpo-quality: the measures of the paper's tables for a mesh.

#include <cstdio>

#include "geom/scaling.h"
#include "io/input_file.h"
#include "io/mesh_io.h"
#include "tools/cli.h"
#include "tools/measures.h"

namespace {

/// Complaints name the file.
tools::Measures measured(const std::filesystem::path& path, const std::filesystem::path& reference,
                         int threads) {
  const geom::TriMesh mesh = io::read_mesh(path);
  const geom::TriMesh surface = reference.empty() ? geom::TriMesh() : io::read_mesh(reference);
  const auto has_area = [](const geom::TriMesh& m) {
    return geom::scaled_to_unit_box(m, geom::factor_to_unit_box(m)).area() > 0;
  };
  geom::require(reference.empty() || has_area(surface),
                io::display_name(reference) + ": the surface has no area");
  try {
    return reference.empty() ? tools::measure(mesh) : tools::measure(mesh, surface, threads);
  } catch (const geom::InputError& error) {
    throw geom::InputError(io::display_name(path) + ": " + error.what());
  }
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
  const auto values = tools::named(measured(path, reference_path, cli.threads()));
  if (json) {
    std::printf("%s\n", tools::json(values).c_str());
    return tools::exit_done;
  }
  for (const auto& [name, value] : values) std::printf("%s %.9g\n", name.c_str(), value);
  return tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-quality", argc, argv, quality); }
