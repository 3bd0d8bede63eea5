#include "tools/paper_methods.h"

#include <vector>

#include "fpo/remesh/remesh_defaults.h"

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

}  // namespace

std::span<const PaperMethod> paper_methods() {
  static const std::vector<PaperMethod> methods = in_order_of_paper();
  return methods;
}

}  // namespace tools
