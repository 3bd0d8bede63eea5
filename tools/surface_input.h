#pragma once
// INPUT as the tools use it: read, and repaired as far as that is wanted.

#include <filesystem>
#include <optional>

#include "geom/trimesh.h"
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

/// The mesh of a file. Unless it is taken as it is, facets that name a vertex twice are dropped and the repairs
/// wanted are done; what was done is told on stderr, in one line if no step was asked for, else in a line a step. Where
/// the result still has faults that matter, a warning names them, and the option that mends them. Throws
/// geom::InputError.
geom::TriMesh read_surface(const std::filesystem::path& path, const RepairArguments& repair);

}  // namespace tools
