#pragma once
// Proves what a leeway says (leeway.h) of a site on a sheet, from its rim.
//
// (a) and the bound of slopes: slack_chart.h. The bound of the power and the range: let the nearest of the
// rim be within r of a location z before anyone has moved. Then afterwards it is within r + delta, and
// whoever is nearer to z is within |z - O| + r + delta of O: that is the range. A stranger there, or that may
// come there by its own delta, must pass (b) or is kept. (b) is tested at z by |z - q|^2 - |z - r|^2, which
// changes by
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
