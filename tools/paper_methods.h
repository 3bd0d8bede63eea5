#pragma once
// The methods of the paper's table 1 that this program has.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fpo/remesh/pipeline.h"

namespace tools {

struct PaperMethod {
  std::string name;  ///< the acronym of table 1
  /// Changes fpo-remesh's default options (fpo/remesh/remesh_defaults.h) to those of the method.
  std::function<void(fpo::RemeshOptions&)> set;
};

/// All of them. A method that is added here gets its rows in all tables, and its spectra.
std::span<const PaperMethod> paper_methods();

/// Those with these names, separated by commas, in upper or lower case, in the order of all. Throws
/// geom::InputError on a name that is none.
std::vector<PaperMethod> methods_named(std::string_view names);

}  // namespace tools
