#include "tools/remesh_quality.h"

namespace tools {

fpo::Effort effort_of(const std::string& text) {
  if (text == "draft") return fpo::Effort::draft;
  if (text == "good") return fpo::Effort::good;
  geom::require(text == "best", "'" + text + "' is none of draft, good, best");
  return fpo::Effort::best;
}

void use_quality(RemeshArguments& a, fpo::Effort effort, double target_delta) {
  fpo::use_effort(effort, a.remesh, a.choices);
  if (target_delta >= 0) a.remesh.optimize.target_delta = target_delta;
}

}  // namespace tools
