#include "tools/paper_methods.h"

#include <algorithm>
#include <set>

#include "fpo/remesh/remesh_defaults.h"
#include "geom/check.h"

namespace tools {
namespace {

void remove_shortest_edges_only(fpo::RemeshOptions& o) {
  o.shortest_edge_removal = true;
  o.optimize.max_iterations = 0;
  o.optimize_angles = false;
  o.improve_fidelity = false;
}

/// The baselines, then shortest edge removal, then ours.
std::vector<PaperMethod> in_order_of_paper() {
  std::vector<PaperMethod> result;
  for (const fpo::MethodFacts& m : fpo::methods())
    if (m.distribute)
      result.push_back({m.acronym, [&m](fpo::RemeshOptions& o) { fpo::use_method(o, m.method); }});
  result.push_back({"SER", remove_shortest_edges_only});
  result.push_back({fpo::facts_of(fpo::Method::fpo).acronym, [](fpo::RemeshOptions&) {}});
  return result;
}

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

std::string all_names() {
  std::string names;
  for (const PaperMethod& m : paper_methods()) names += (names.empty() ? "" : ",") + m.name;
  return names;
}

}  // namespace

std::vector<PaperMethod> methods_named(std::string_view names) {
  std::set<std::string> wanted;
  for (std::size_t first = 0, last; first <= names.size(); first = last + 1) {
    last = std::min(names.find(',', first), names.size());
    wanted.insert(upper(names.substr(first, last - first)));
  }
  std::vector<PaperMethod> result;
  for (const PaperMethod& m : paper_methods())
    if (wanted.erase(m.name) > 0) result.push_back(m);
  if (!wanted.empty())
    throw geom::InputError("there is no method '" + *wanted.begin() + "' in " + all_names());
  return result;
}

std::span<const PaperMethod> paper_methods() {
  static const std::vector<PaperMethod> methods = in_order_of_paper();
  return methods;
}

}  // namespace tools
