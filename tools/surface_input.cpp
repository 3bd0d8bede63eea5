#include "tools/surface_input.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "geom/repair/clean.h"
#include "geom/repair/diagnosis.h"
#include "geom/repair/repair.h"
#include "io/input_file.h"
#include "io/mesh_io.h"
#include "tools/worded.h"

namespace tools {
namespace {

constexpr double by_default = -1;

/// What reading has dropped, in words.
std::string repeated_in_words(std::size_t repeated) {
  if (repeated == 0) return "";
  return "dropped " + std::to_string(repeated) +
         (repeated == 1 ? " facet that names a vertex twice" : " facets that name a vertex twice");
}

geom::RepairSteps steps_for(const RepairArguments& repair) {
  const geom::RepairSteps all = geom::all_steps();
  geom::RepairSteps steps = repair.all ? all : geom::RepairSteps();
  if (repair.weld) steps.weld = repair.weld;
  if (repair.holes) steps.holes = repair.holes;
  if (repair.crumbs) steps.crumbs = repair.crumbs;
  // A hole is filled between facets that agree and edges that are none of three facets.
  if (repair.orient || repair.holes) steps.orient = true;
  if (repair.weld || repair.holes) steps.split = true;
  return steps;
}

SurfaceInput cleaned(const geom::TriMesh& mesh, const std::string& name, std::size_t repeated) {
  geom::Cleaned result = geom::cleaned(mesh);
  std::string done = geom::in_words(result.done);
  if (repeated > 0) done += (done.empty() ? "" : ", ") + repeated_in_words(repeated);
  SurfaceInput input{std::move(result.mesh), {}, {}, 0};
  if (!done.empty())
    input.notes.push_back("repaired: " + name + ": " + done + " (--no-repair takes it as it is)");
  return input;
}

SurfaceInput repaired(const geom::TriMesh& mesh, const std::string& name, std::size_t repeated,
                      const RepairArguments& repair) try {
  geom::Repaired result = geom::repaired(mesh, steps_for(repair));
  SurfaceInput input{std::move(result.mesh), {}, {}, 0};
  if (repeated > 0) result.lines.insert(result.lines.begin(), repeated_in_words(repeated));
  for (const std::string& line : result.lines) input.notes.push_back("repaired: " + name + ": " + line);
  return input;
} catch (const geom::InputError& error) {
  throw geom::InputError(name + ": " + error.what());
}

/// What mends the faults.
std::string advice(const geom::Diagnosis& found, bool is_repaired) {
  const std::string weld = found.weld_tolerance > 0 ? worded("--weld=%.6g", found.weld_tolerance) : "";
  if (is_repaired)
    return " (left by --repair; " + (weld.empty() ? "--weld=TOL" : weld) + " welds within more)";
  return weld.empty() ? " (--repair mends it)" : " (--repair " + weld + " mends it)";
}

void diagnose(SurfaceInput& input, bool is_repaired) try {
  geom::Diagnosis found = geom::diagnosis(input.mesh, false);
  if (is_repaired) found.split_vertices = 0;  // repair has set them apart
  const std::string faults = geom::in_words(found);
  if (!faults.empty()) input.faults = faults + advice(found, is_repaired);
  input.parts = found.parts;
} catch (const geom::InputError&) {  // who computes with it will say so
}

SurfaceInput read(const std::filesystem::path& path, const std::string& name, const RepairArguments& repair) {
  if (repair.none) return {io::read_mesh(path), {}, {}, 0};
  std::size_t repeated = 0;
  const geom::TriMesh mesh = io::read_mesh(path, repeated);
  return repair.any_step() ? repaired(mesh, name, repeated, repair) : cleaned(mesh, name, repeated);
}

}  // namespace

void declare_repair(CommandLine& cli, RepairArguments& repair) {
  cli.group("Input");
  cli.toggle(
      {.name = "repair",
       .help = "weld, drop duplicates and crumbs, split what is no manifold, orient, close holes; without "
               "it only border edges that coincide but for rounding are welded, and facets that are "
               "repeated, doubled or without area and crumbs that hang on vertices dropped, with --no-repair "
               "nothing is done"},
      [&repair](bool wanted) {
        repair.all = wanted;
        repair.none = !wanted;
      });
  cli.custom_or_none({.name = "weld",
                      .value = "TOL",
                      .help = "weld borders nearer than TOL to one another, zip T-junctions",
                      .standard = "1e-6 diagonals, more in a soup"},
                     [&repair](const std::string& text) {
                       repair.weld = text.empty() ? by_default : parse_number(text, 0, 1e300);
                     });
  cli.custom_or_none({.name = "fill-holes",
                      .value = "LENGTH",
                      .help = "close borders of at most that length",
                      .standard = "any; with --repair half a diagonal"},
                     [&repair](const std::string& text) {
                       repair.holes = text.empty() ? 1e300 : parse_number(text, 0, 1e300);
                     });
  cli.custom({.name = "drop-components",
              .value = "SHARE",
              .help = "drop components with less than that share of the area",
              .standard = "with --repair 0.01 if open, 0.001 if closed"},
             [&repair](const std::string& text) { repair.crumbs = parse_number(text, 0, 1); });
  cli.flag({.name = "orient", .help = "turn facets so that they agree, closed parts outwards"},
           repair.orient);
}

void check_repair(const RepairArguments& repair) {
  geom::require(!repair.none || !repair.any_step(), "--no-repair excludes the steps of a repair");
}

SurfaceInput read_surface(const std::filesystem::path& path, const RepairArguments& repair) {
  const std::string name = io::display_name(path);
  SurfaceInput input = read(path, name, repair);
  diagnose(input, repair.all);
  if (!input.faults.empty()) input.notes.push_back("warning: " + name + ": " + input.faults);
  return input;
}

geom::TriMesh read_cleaned(const std::filesystem::path& path) {
  std::size_t repeated = 0;
  const geom::TriMesh mesh = io::read_mesh(path, repeated);
  geom::Cleaned result = geom::cleaned(mesh);
  std::string done = geom::in_words(result.done);
  if (repeated > 0) done += (done.empty() ? "" : ", ") + repeated_in_words(repeated);
  if (!done.empty()) std::fprintf(stderr, "repaired: %s: %s\n", io::display_name(path).c_str(), done.c_str());
  return std::move(result.mesh);
}

void print_notes(SurfaceInput& input) {
  for (const std::string& note : input.notes) std::fprintf(stderr, "%s\n", note.c_str());
  input.notes.clear();
  input.faults.clear();
}

}  // namespace tools
