// fpo-quality: the measures of the paper's tables for a mesh.

#include <cstdio>

#include "geom/mesh/scaling.h"
#include "geom/repair/diagnosis.h"
#include "io/input_file.h"
#include "io/mesh_io.h"
#include "tools/cli.h"
#include "tools/measures.h"
#include "tools/surface_input.h"

namespace {

/// Complaints name the file.
tools::Measures measured(const geom::TriMesh& mesh, const std::filesystem::path& path,
                         const std::filesystem::path& reference, int threads) {
  const geom::TriMesh surface = reference.empty() ? geom::TriMesh() : tools::read_cleaned(reference);
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

/// What the file is before anything is mended.
std::vector<std::pair<std::string, double>> faults_of(const geom::TriMesh& mesh, std::size_t repeated) {
  const geom::Diagnosis d = geom::diagnosis(mesh, true);
  const auto count = [](std::size_t value) { return static_cast<double>(value); };
  return {{"border_loops", count(d.border_lengths.size())},
          {"longest_border", d.border_lengths.empty() ? 0 : d.border_lengths.front()},
          {"holes", count(d.holes)},
          {"split_vertices", count(d.split_vertices)},
          {"duplicate_facets", count(d.duplicate_facets)},
          {"degenerate_facets", count(d.degenerate_facets + repeated)},
          {"inverted_facets", count(d.inverted_facets)},
          {"inside_out_parts", count(d.inside_out_parts)},
          {"one_sided_parts", count(d.one_sided_parts)},
          {"self_intersections", count(d.intersections->pairs)},
          {"self_intersections_all", d.intersections->all ? 1.0 : 0.0},
          {"stray_facets", count(d.stray_facets)},
          {"tiny_components", count(d.tiny_parts)},
          {"doubled_components", count(d.copies)},
          {"spikes", count(d.spikes)}};
}

int quality(tools::CommandLine& cli) {
  std::filesystem::path reference_path;
  bool json = false;
  cli.describe(
      "MESH",
      "Measures a triangle mesh: topology, shape of triangles, spacing, distance to a reference, faults.");
  cli.path({.name = "reference", .value = "INPUT", .help = "the surface that MESH approximates"},
           reference_path);
  cli.flag({.name = "json", .help = "print one JSON object"}, json);
  const std::filesystem::path path = cli.parse(1, 1).front();
  std::size_t repeated = 0;
  const geom::TriMesh mesh = io::read_mesh(path, repeated);
  auto values = tools::named(measured(mesh, path, reference_path, cli.threads()));
  const auto faults = faults_of(mesh, repeated);
  values.insert(values.end(), faults.begin(), faults.end());
  if (json) {
    std::printf("%s\n", tools::json(values).c_str());
    return tools::exit_done;
  }
  for (const auto& [name, value] : values) std::printf("%s %.9g\n", name.c_str(), value);
  return tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-quality", argc, argv, quality); }
