// The general way by itself; what it does to circles is held against brute force in restricted_dual_test.

#include "geom/dual/redivision.h"

#include <algorithm>
#include <limits>
#include <set>

#include "doctest.h"
#include "geom/rng.h"
#include "geom/sites/site_tree.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/placed_samples.h"
#include "tests/oracle/restricted_dual_oracle.h"

using namespace geom;
using fixtures::Weights;

namespace {

struct General {
  General(const TriMesh& mesh, const std::vector<fixtures::Placed>& samples, CornerTypes types)
      : state(mesh, types, nullptr), redivision(state) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      state.admit(SiteId(i), samples[i].point);
      state.search.enter(SiteId(i));
      present.insert(SiteId(i));
    }
    redivision.build(1, {}, change);
  }
  void begin() {
    state.circles.recycle(change.circles_erased);
    change = {};
  }
  std::vector<SiteId> list() const { return {present.begin(), present.end()}; }
  DualState state;
  Redivision redivision;
  DualChange change;
  std::set<SiteId> present;
};

std::vector<fixtures::NamedSurface> redivision_all_surfaces() {
  std::vector<fixtures::NamedSurface> all = fixtures::hard_surfaces();
  for (fixtures::NamedSurface& s : fixtures::surfaces()) all.push_back(std::move(s));
  return all;
}

}  // namespace

TEST_CASE("redivision: reaches are those of the cells, and plans tell what the cell has and the hole will") {
  for (const auto& surface : redivision_all_surfaces())
    for (const Weights weights : fixtures::all_weights)
      for (const CornerTypes types : {CornerTypes::c_only, CornerTypes::all}) {
        if (types == CornerTypes::all && weights != Weights::gentle) continue;
        CAPTURE(surface.name);
        CAPTURE(static_cast<int>(weights));
        General g(surface.mesh, fixtures::placed_samples(surface.mesh, 14, 14, weights, 9), types);
        const auto is_close = [](double bound, double reach) {
          return bound == reach || std::abs(bound - reach) <= 1e-7 * (std::abs(reach) + 1);
        };
        for (std::size_t i = 0; i < 14; ++i) {
          CAPTURE(i);
          const SiteId p(i);
          const WeightedPoint3 point = g.state.sites[p];
          const oracle::BruteDiagram before(surface.mesh, g.state.sites, g.list());
          for (const SiteId s : g.present)
            if (g.state.reach[s] > -infinity) CHECK(is_close(g.redivision.reach(s), before.reach(s)));
          bool has_neighbours = false;
          for (const auto& [key, polygon] : before.polygons())
            if (key.second == p)
              for (const PolygonCorner& c : polygon.corners) has_neighbours |= c.edge.is_site();
          g.begin();
          g.redivision.removal().plan(p);
          CHECK(g.redivision.removal().has_neighbours() == has_neighbours);
          const double reach = g.redivision.removal().reach(), power = g.redivision.removal().power();
          g.redivision.removal().commit(g.change);
          g.present.erase(p);
          const oracle::BruteDiagram after(surface.mesh, g.state.sites, g.list());
          CHECK(is_close(reach, before.reach(p)));
          CHECK(power >= reach);
          Clipper clipper(surface.mesh, g.state.sites, extent_of(surface.mesh));
          for (const auto& [key, polygon] : after.polygons())
            for (std::size_t k = 0; k < polygon.corners.size(); ++k)
              if (clipper.beats_at(polygon, k, p, clipper.bisector_of(polygon.owner, p))) {
                const double now =
                    geom::power(polygon.corners[k].point.position, g.state.sites[polygon.owner]);
                CHECK(power >= now - 1e-8 * (std::abs(now) + 1));
              }
          for (const SiteId s : g.present)
            CHECK(g.state.reach[s] >= after.reach(s) - 1e-8 * (std::abs(after.reach(s)) + 1));
          g.begin();
          g.redivision.insert(p, point, g.change);
          g.present.insert(p);
        }
      }
}
