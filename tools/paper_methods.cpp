#include "tools/paper_methods.h"

#include <array>

#include "fpo/remesh_defaults.h"

namespace tools {

std::span<const PaperMethod> paper_methods() {
  using fpo::Method;
  static const std::array<PaperMethod, 5> methods = {
      {{"CVT", [](fpo::RemeshOptions& o) { fpo::use_method(o, Method::cvt); }},
       {"CPS", [](fpo::RemeshOptions& o) { fpo::use_method(o, Method::cps); }},
       {"MPS", [](fpo::RemeshOptions& o) { fpo::use_method(o, Method::mps); }},
       {"SER",
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
