#pragma once
// Proves what a leeway says (leeway.h) of a site on a sheet, from its rim.
//
// (a) and the bound of slopes: slack_chart.h. The bound of the power: where the nearest of the rim is within
// r of a location, it is within r and delta after all have moved; and who is nearer there is within that of
// it, so within the range of O. (b) is tested at a location z by |z - q|^2 - |z - r|^2, which changes by
//
//     2 delta (|z - q| + |z - r|) + 2 delta^2 <= 2 delta (2 radius + |q - O| + |r - O| + delta)
//
// at most if q and r move by delta.

#include <vector>

#include "geom/dual/slack_chart.h"
#include "geom/dual/surroundings.h"

namespace geom {

class LeewayProof {
 public:
  /// Keeps a reference.
  explicit LeewayProof(Surroundings& around) : around_(around) {}

  /// The leeway of around.p, which is regular and seen with its rim: the one that stands, or a new one. Null
  /// if there is none.
  const Leeway* find();

 private:
  bool prove(Leeway& leeway);
  bool bound_power(Leeway& leeway, const Sheet& sheet);
  bool find_watched(Leeway& leeway);

  Surroundings& around_;
  SlackChart slack_;
  Chart chart_;
  double range_ = 0;
  std::vector<SiteId> found_;  // workspaces
  std::vector<Leeway::Watched> others_;
};

}  // namespace geom
