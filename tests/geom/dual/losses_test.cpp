// What is said of a site's losses, against polygons by brute force.

#include "geom/dual/losses.h"

#include <algorithm>
#include <map>
#include <set>

#include "doctest.h"
#include "geom/power/facet_cells.h"
#include "tests/fixtures/dual_scene.h"
#include "tests/oracle/restricted_dual_oracle.h"

using namespace geom;
using fixtures::Placed;
using Scene = fixtures::DualScene;

namespace {

/// The parts of a cell that a newcomer takes: facets joined across those mesh edges where it takes something.
class LossesParts {
 public:
  LossesParts(const Scene& scene, const oracle::BruteDiagram& before, SiteId s, SiteId p)
      : mesh_(scene.state.mesh), clipper_(mesh_, scene.state.sites, scene.state.extent) {
    const Bisector b = clipper_.bisector_of(s, p);
    for (const auto& [key, polygon] : before.polygons()) {
      if (polygon.owner != s) continue;
      std::vector<bool>& lost = lost_[key.first];
      for (std::size_t k = 0; k < polygon.corners.size(); ++k)
        lost.push_back(clipper_.beats_at(polygon, k, p, b));
      polygons_[key.first] = &polygon;
    }
    for (const auto& [t, lost] : lost_)
      if (std::ranges::find(lost, true) != lost.end() && !seen_.contains(t)) spread(t);
  }
  /// Of each part: does it hold a circle?
  const std::vector<bool>& have_circles() const { return have_circles_; }

 private:
  void spread(FacetId first) {
    have_circles_.push_back(false);
    std::vector<FacetId> stack{first};
    seen_.insert(first);
    while (!stack.empty()) {
      const FacetId t = stack.back();
      stack.pop_back();
      const FacetPolygon& polygon = *polygons_[t];
      const std::vector<bool>& lost = lost_[t];
      for (std::size_t k = 0; k < lost.size(); ++k) {
        const EdgeLabel edge = polygon.corners[k].edge;
        if (lost[k] && edge.is_site() && polygon.edge_before(k).is_site()) have_circles_.back() = true;
        if (edge.is_site() || (!lost[k] && !lost[next_corner(k, lost.size())])) continue;
        const FacetId across = mesh_.across(t, edge.edge());
        if (across.valid() && polygons_.contains(across) && seen_.insert(across).second)
          stack.push_back(across);
      }
    }
  }

  const TriMesh& mesh_;
  Clipper clipper_;
  std::map<FacetId, const FacetPolygon*> polygons_;
  std::map<FacetId, std::vector<bool>> lost_;  ///< at its corners
  std::set<FacetId> seen_;
  std::vector<bool> have_circles_;
};

}  // namespace

TEST_CASE("losses: each part that is said to hang together with a beaten circle does") {
  constexpr std::size_t n = 140, comers = 25;
  std::size_t said = 0, taken = 0, islands = 0;
  const auto wave = [](double x, double y) { return 0.03 * std::sin(9 * x) * std::sin(8 * y); };
  for (const TriMesh& mesh : {fixtures::sheet(9, 1, wave, 0.2), make_shape("sphere", 4),
                              fixtures::box(Vec3(1, 0.8, 0.03), 3), fixtures::comb(2, 0.05)})
    for (const fixtures::Weights weights : fixtures::all_weights) {
      const std::vector<Placed> samples = fixtures::placed_samples(mesh, n + comers, n, weights, 23);
      Scene scene(mesh, {samples.begin(), samples.begin() + n});
      const SiteId p(n);
      const oracle::BruteDiagram before(mesh, scene.state.sites, scene.present);
      for (const SiteId s : scene.present)
        if (!before.is_simple(s)) scene.state.set_shape(s, geom::CellShape::irregular);
      const FacetTree facets(mesh, facets_along_curve(mesh));
      Sheets sheets(mesh, facets, scene.state.clipper.facets());
      Losses losses(scene.state, sheets);
      for (const Placed& x : std::span(samples).subspan(n)) {
        scene.state.admit(p, x.point);
        for (const SiteId s : scene.present) {
          std::vector<CircleId> beaten;
          for (const CircleId c : scene.state.circles.of_site(s))
            if (!scene.state.lead_at(scene.state.circles[c], x.point).positive()) beaten.push_back(c);
          const bool says = losses.hang_together(s, {p, x.point, x.point}, beaten);
          if (says && !beaten.empty())
            CHECK(!losses.hang_together(s, {p, x.point, x.point}, std::span(beaten).subspan(1)));
          const LossesParts parts(scene, before, s, p);
          const auto without = std::ranges::count(parts.have_circles(), false);
          islands += static_cast<std::size_t>(without);
          said += says;
          if (!says) continue;
          taken += !parts.have_circles().empty();
          CHECK(without == 0);
        }
      }
    }
  CHECK(said > 8000);
  CHECK(taken > 300);
  CHECK(islands > 30);
}

namespace {

/// Is the one part that p takes of the first cell, which holds no circle, overlooked?
void check_island(const TriMesh& mesh, std::vector<Placed> samples, const WeightedPoint3& p) {
  Scene scene(mesh, samples);
  const SiteId s(0), comer(samples.size());
  scene.state.admit(comer, p);
  const oracle::BruteDiagram before(mesh, scene.state.sites, scene.present);
  REQUIRE(before.is_simple(s));
  REQUIRE(LossesParts(scene, before, s, comer).have_circles() == std::vector<bool>{false});
  const FacetTree facets(mesh, facets_along_curve(mesh));
  Sheets sheets(mesh, facets, scene.state.clipper.facets());
  REQUIRE(sheets.around(s, scene.state.sites[s].position, scene.state.distance_at(scene.state.reach[s], s)));
  CHECK(!Losses(scene.state, sheets).hang_together(s, {comer, p, p}, {}));
}
Placed on(double x, double y, double z) { return {{Vec3(x, y, z), 0}, FacetId()}; }

}  // namespace

// It comes above the top of a flat bump.
TEST_CASE("losses: an island in the middle of a cell is seen") {
  const TriMesh mesh = fixtures::sheet(24, 1, [](double x, double y) {
    return 0.05 * std::exp(-20 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)));
  });
  const double drop = 0.02;  // of the island's border below the top
  check_island(mesh, {on(0.5, 0.5, 0.05), on(0.1, 0.1, 0), on(0.9, 0.1, 0), on(0.1, 0.9, 0), on(0.9, 0.9, 0)},
               {Vec3(0.5, 0.5, 0.35), 0.09 + 0.6 * drop});
}

// It comes above a ridge that an edge runs across, and takes the edge's middle.
TEST_CASE("losses: an island at an edge is seen") {
  const TriMesh mesh =
      fixtures::sheet(24, 1, [](double, double y) { return 0.06 * std::exp(-30 * (y - 0.5) * (y - 0.5)); });
  check_island(mesh,
               {on(0.42, 0.5, 0.06), on(0.72, 0.5, 0.06), on(0.12, 0.5, 0.06), on(0.12, 0.1, 0),
                on(0.12, 0.9, 0), on(0.42, 0.1, 0), on(0.42, 0.9, 0), on(0.72, 0.12, 0), on(0.74, 0.9, 0)},
               {Vec3(0.47, 0.5, 0.36), 0.0925 - 0.01});
}
