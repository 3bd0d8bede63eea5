#pragma once
// INPUT as the tools use it: read, and repaired as far as that is wanted.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geom/mesh/trimesh.h"
#include "tools/cli.h"

namespace tools {

/// What is done to INPUT. Neither all nor a step: what geom/repair/clean.h mends.
struct RepairArguments {
  bool none = false;             ///< --no-repair: it is taken as it is
  bool all = false;              ///< --repair
  std::optional<double> weld;    ///< --weld: a length; negative: the default
  std::optional<double> holes;   ///< --fill-holes: likewise; none given: of any length
  std::optional<double> crumbs;  ///< --drop-components: a share of the area
  bool orient = false;           ///< --orient

  bool any_step() const { return all || weld || holes || crumbs || orient; }
};

/// Declares those options.
void declare_repair(CommandLine& cli, RepairArguments& repair);
/// Refuses contradictions after parsing. Throws geom::InputError.
void check_repair(const RepairArguments& repair);

/// INPUT and what there is to say about it, in lines without an end.
struct SurfaceInput {
  geom::TriMesh mesh;
  std::vector<std::string> notes;  ///< "repaired: ..." for what was done, "warning: ..." for what is left
  std::string faults;              ///< those that matter, with the option that mends them; empty: none
  std::size_t parts = 0;           ///< facets joined by edges
};

/// The mesh of a file. Unless it is taken as it is, facets that name a vertex twice are dropped and the
/// repairs wanted are done; notes tell that in one line if no step was asked for, else in a line a step, and
/// faults that are left in another. Nothing is printed: should the input be refused, one line says why.
/// Throws geom::InputError.
SurfaceInput read_surface(const std::filesystem::path& path, const RepairArguments& repair);

/// INPUT of a tool that has no such options: cleaned, and what was done is printed at once, a line a file.
/// Throws geom::InputError.
geom::TriMesh read_cleaned(const std::filesystem::path& path);

/// Prints the notes on stderr, and forgets them and the faults, which are among them.
void print_notes(SurfaceInput& input);

}  // namespace tools
