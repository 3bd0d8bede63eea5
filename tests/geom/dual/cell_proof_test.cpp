// What a new cell's proof says of sites that no circle tells of, against brute force.

#include "geom/dual/cell_proof.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/mirrored_dual.h"

using namespace geom;
using fixtures::Placed;

namespace {

/// In the middle of the facet that is nearest to there, seen from above.
Placed above(const TriMesh& mesh, double x, double y, double weight) {
  Placed best;
  double least = infinity;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const Vec3 z = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
    const double far = std::hypot(z.x() - x, z.y() - y);
    if (far < least) least = far, best = {{z, weight}, t};
  }
  return best;
}

/// The highest vertex.
Placed on_top(const TriMesh& mesh, double weight) {
  Placed best{{mesh.corner(FacetId(0), 0), weight}, FacetId(0)};
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (int i = 0; i < 3; ++i)
      if (mesh.corner(t, i).z() > best.point.position.z()) best = {{mesh.corner(t, i), weight}, t};
  return best;
}

}  // namespace

//         q              q has the tip of a spike, an island in the cell of p, without any circle. A heavy x
//        /|              comes to the other side of the spike and takes the tip, too. Another one comes
//  _x___/  \__p__x_      beyond p: q keeps its tip, and does not keep x from the fast way.
TEST_CASE("cell proof: who has no circle is hidden, or not, by who comes beside it") {
  const TriMesh spike = fixtures::sheet(
      48, 1, [](double x, double y) { return std::max(0.0, 1 - 10 * std::hypot(x - 0.5, y - 0.5)); });
  std::vector<Placed> samples{above(spike, 0.62, 0.5, 0.1), on_top(spike, -0.9)};
  const SiteId p(0), q(1), x(18);
  for (int i = 0; i < 16; ++i) {  // eight around them, and eight at the border
    const double angle = 0.785398 * i + 0.03 * std::cos(3 * i), far = i < 8 ? 0.38 : 0.66;
    const auto at = [&](double d) { return std::clamp(0.5 + far * d, 0.0, 1.0); };
    samples.push_back(above(spike, at(std::cos(angle)), at(std::sin(angle)), 0.1));
  }
  struct Case {
    Placed x;
    bool keeps;
  };
  for (const auto& [newcomer, keeps] :
       {Case{above(spike, 0.75, 0.51, 0.1), true}, Case{above(spike, 0.38, 0.5, 0.15), false}}) {
    CAPTURE(keeps);
    fixtures::MirroredDual d(spike, true, CornerTypes::c_only), fresh(spike, true, CornerTypes::c_only);
    d.build(samples, 1);
    REQUIRE(d.dual().has_cell(q));
    REQUIRE(d.dual().circles_of(q).empty());
    d.insert(x, newcomer);
    CHECK(d.dual().has_cell(p));
    CHECK(d.dual().has_cell(x));
    CHECK(d.dual().has_cell(q) == keeps);
    CHECK(d.dual().ways().fast_insertions == (keeps ? 1 : 0));
    std::vector<Placed> all = samples;
    all.push_back(newcomer);
    fresh.build(all, 1);
    CHECK(fresh.known_circles() == d.known_circles());
    fixtures::check_by_brute_force(d);
  }
}
