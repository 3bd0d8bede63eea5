#include "tools/paper_methods.h"

#include <array>

namespace tools {

std::span<const PaperMethod> paper_methods() {
  static const std::array<PaperMethod, 2> methods = {{{"SER",
                                                       [](fpo::RemeshOptions& o) {
                                                         o.shortest_edge_removal = true;
                                                         o.optimize.max_iterations = 0;
                                                         o.optimize_angles = false;
                                                         o.improve_fidelity = false;
                                                       }},
                                                      {"FPO", [](fpo::RemeshOptions&) {}}}};
  return methods;
}

}  // namespace tools
