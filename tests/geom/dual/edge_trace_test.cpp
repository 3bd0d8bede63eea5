// Edges of the diagram that are followed over the facets, against those that clipping gives.

#include "geom/dual/edge_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/mirrored_dual.h"
#include "tests/oracle/restricted_dual_oracle.h"

using namespace geom;
using fixtures::MirroredDual;
using fixtures::Weights;

namespace {

/// A dual, and its diagram by brute force.
struct EdgeTraceScene {
  EdgeTraceScene(const TriMesh& mesh, std::size_t n, Weights weights)
      : dual(mesh, true, CornerTypes::c_only), samples(fixtures::placed_samples(mesh, n, n, weights, 17)) {
    dual.build(samples);
    brute = std::make_unique<oracle::BruteDiagram>(mesh, dual.sites(), dual.present());
  }
  const WeightedPoint3& site(SiteId s) const { return dual.sites()[s]; }
  /// The edge from a circle on around one of its sites, counterclockwise.
  TracedEdge edge_of(const EmptyCircle& from, SiteId left) const {
    const EmptyCircle& to = dual.dual().circle(from.beyond[from.after(from.index_of(left))]);
    return {from.facet, to.facet, from.center, to.center};
  }
  static SiteId right_of(const EmptyCircle& from, SiteId left) {
    return from.sites[from.before(from.index_of(left))];
  }
  /// How many circles two sites share.
  std::size_t num_ends(SiteId a, SiteId b) const {
    const auto of_a = dual.dual().circles_of(a);
    return static_cast<std::size_t>(
        std::ranges::count_if(of_a, [&](CircleId c) { return dual.dual().circle(c).touches(b); }));
  }
  MirroredDual dual;
  std::vector<fixtures::Placed> samples;
  std::unique_ptr<oracle::BruteDiagram> brute;
};

/// Of each pair, how far the corners on their bisector are from the first one, squared, and on which facets
/// it runs.
struct Edge {
  double far2 = 0;
  std::set<FacetId> facets;
};
std::map<std::pair<SiteId, SiteId>, Edge> bisectors(const EdgeTraceScene& scene) {
  std::map<std::pair<SiteId, SiteId>, Edge> result;
  for (const auto& [key, polygon] : scene.brute->polygons())
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
      const EdgeLabel label = polygon.corners[k].edge;
      if (!label.is_site()) continue;
      Edge& bisector = result[{polygon.owner, label.site()}];
      bisector.facets.insert(polygon.facet);
      for (const std::size_t end : {k, k + 1 == polygon.corners.size() ? 0 : k + 1}) {
        const Vec3 d = polygon.corners[end].point.position - scene.site(polygon.owner).position;
        bisector.far2 = std::max(bisector.far2, d.squaredNorm());
      }
    }
  return result;
}

/// Do they hang together, and number few enough?
bool is_one_way(const TriMesh& mesh, const std::set<FacetId>& facets) {
  std::set<FacetId> reached{*facets.begin()};
  std::vector<FacetId> stack{*facets.begin()};
  while (!stack.empty()) {
    const FacetId t = stack.back();
    stack.pop_back();
    for (int e = 0; e < 3; ++e)
      if (const FacetId across = mesh.across(t, e); facets.contains(across) && reached.insert(across).second)
        stack.push_back(across);
  }
  return reached.size() == facets.size() && facets.size() <= 30;
}

/// Twice, of what a cell has.
Vec3 area_vector(const EdgeTraceScene& scene, SiteId s) {
  Vec3 sum(0, 0, 0);
  for (const auto& [key, polygon] : scene.brute->polygons()) {
    if (key.second != s) continue;
    const std::vector<PolygonCorner>& corners = polygon.corners;
    const auto at = [&](std::size_t k) -> Vec3 { return corners[k].point.position; };
    for (std::size_t k = 2; k < corners.size(); ++k) sum += (at(k - 1) - at(0)).cross(at(k) - at(0));
  }
  return sum;
}

template <class Visit>
void edge_trace_for_scenes(Visit visit) {
  for (const TriMesh& mesh :
       {fixtures::torus(1, 0.4, {24, 14, true, true, 0.2}), make_shape("sphere", 5), fixtures::blob(6),
        fixtures::sheet(
            14, 1, [](double x, double y) { return 0.1 * std::sin(20 * x) * std::cos(19 * y); }, 0.2)})
    for (const Weights weights : fixtures::all_weights)
      for (const std::size_t n : {20u, 60u, 150u}) {
        CAPTURE(n);
        CAPTURE(static_cast<int>(weights));
        visit(EdgeTraceScene(mesh, n, weights));
      }
}

}  // namespace

TEST_CASE("edge trace: as far from its sites as the edge's corners are, and no farther") {
  std::size_t edges = 0, beyond_ends = 0;
  edge_trace_for_scenes([&](const EdgeTraceScene& scene) {
    const auto all = bisectors(scene);
    for (const CircleId c : scene.dual.circles())
      for (const SiteId left : scene.dual.dual().circle(c).sites) {
        const EmptyCircle& circle = scene.dual.dual().circle(c);
        const SiteId right = EdgeTraceScene::right_of(circle, left);
        if (!circle.beyond[circle.after(circle.index_of(left))].valid() || scene.num_ends(left, right) != 2)
          continue;
        const Edge& truth = all.at({left, right});
        const TracedEdge edge = scene.edge_of(circle, left);
        if (!is_one_way(scene.dual.dual().mesh(), truth.facets))
          continue;  // or there is another one, or it is long
        const double far2 =
            extent_of_edge(scene.dual.dual().mesh(), scene.site(left), scene.site(right), edge).far2;
        REQUIRE(far2 < infinity);
        ++edges;
        CHECK(far2 >= truth.far2 * (1 - 1e-9));
        CHECK(far2 <= truth.far2 * (1 + 1e-5));
        const double ends2 = std::max((edge.start - scene.site(left).position).squaredNorm(),
                                      (edge.end - scene.site(left).position).squaredNorm());
        beyond_ends += truth.far2 > ends2 * (1 + 1e-5);
      }
  });
  CHECK(edges > 3000);
  CHECK(beyond_ends > 50);
}

TEST_CASE("edge trace: the edges of a cell's border sweep out its area") {
  std::size_t cells = 0;
  edge_trace_for_scenes([&](const EdgeTraceScene& scene) {
    for (const SiteId s : scene.dual.present()) {
      if (!scene.brute->is_simple(s)) continue;
      Vec3 sum(0, 0, 0);
      double size2 = 0;
      for (const CircleId c : scene.dual.dual().circles_of(s)) {
        const EmptyCircle& circle = scene.dual.dual().circle(c);
        const TracedEdge::Extent extent =
            extent_of_edge(scene.dual.dual().mesh(), scene.site(s),
                           scene.site(EdgeTraceScene::right_of(circle, s)), scene.edge_of(circle, s));
        sum += extent.twice_area;
        size2 = std::max(size2, extent.far2);
      }
      if (size2 == infinity) continue;  // a long edge
      ++cells;
      CHECK((sum - area_vector(scene, s)).norm() <= 1e-9 * size2);
    }
  });
  CHECK(cells > 1000);
}

TEST_CASE(
    "edge trace: facets that are turned round on the way, borders and ends that are not met leave it open") {
  const TriMesh sphere = make_shape("sphere", 6), turned = fixtures::with_facets_turned(sphere);
  const EdgeTraceScene scene(sphere, 30, Weights::none);
  const auto all = bisectors(scene);
  const TriMesh open = fixtures::sheet(12, 1, [](double x, double) { return 0.1 * x * x; });
  std::size_t over_turned = 0;
  for (const CircleId c : scene.dual.circles()) {
    const EmptyCircle& circle = scene.dual.dual().circle(c);
    for (const SiteId left : circle.sites) {
      const SiteId right = EdgeTraceScene::right_of(circle, left);
      const TracedEdge edge = scene.edge_of(circle, left);
      if (edge.from == edge.to || scene.num_ends(left, right) != 2) continue;
      const auto is_turned = [](FacetId t) { return t.index() % 3 == 0; };
      const std::set<FacetId>& way = all.at({left, right}).facets;
      const auto extent = [&](const TriMesh& mesh, const TracedEdge& e) {
        return extent_of_edge(mesh, scene.site(left), scene.site(right), e);
      };
      REQUIRE(extent(sphere, edge).far2 < infinity);
      const auto is_on_the_way = [&](FacetId t) { return t != edge.to && is_turned(t); };
      if (!is_turned(edge.from) && std::ranges::any_of(way, is_on_the_way)) {
        ++over_turned;
        CHECK(extent(turned, edge).far2 == infinity);
        CHECK(extent(turned, edge).twice_area == Vec3(0, 0, 0));
      }
      TracedEdge elsewhere = edge;  // to a facet that the bisector does not meet
      const auto is_met = [&](FacetId t) {
        int left_nearer = 0;
        for (int i = 0; i < 3; ++i)
          left_nearer +=
              power(sphere.corner(t, i), scene.site(left)) < power(sphere.corner(t, i), scene.site(right));
        return left_nearer > 0 && left_nearer < 3;
      };
      elsewhere.to = FacetId(0);
      while (is_met(elsewhere.to)) elsewhere.to = FacetId(elsewhere.to.value + 1);
      CHECK(extent(sphere, elsewhere).far2 == infinity);
      elsewhere = edge;  // from one
      elsewhere.from = FacetId(0);
      while (is_met(elsewhere.from)) elsewhere.from = FacetId(elsewhere.from.value + 1);
      CHECK(extent(sphere, elsewhere).far2 == infinity);
    }
  }
  CHECK(over_turned > 50);
  // To the border, in both directions, and in a facet whose corner is as near to both.
  const WeightedPoint3 a{Vec3(0.2, 0.51, 0), 0}, b{Vec3(0.83, 0.52, 0), 0};
  std::size_t outwards = 0;
  for (FacetId t(0); t.index() < open.num_facets(); t = FacetId(t.value + 1)) {
    const TracedEdge edge{t, FacetId(t.index() == 0 ? 1 : 0), open.corner(t, 0), open.corner(t, 1)};
    for (const auto& [left, right] : {std::pair(a, b), std::pair(b, a)}) {
      CHECK(extent_of_edge(open, left, right, edge).far2 == infinity);
      ++outwards;
    }
    CHECK(extent_of_edge(open, a, a, edge).far2 == infinity);
  }
  CHECK(outwards == 2 * open.num_facets());
  CHECK(extent_of_edge(open, a, b, {FacetId(5), FacetId(5), a.position, b.position}).far2 ==
        doctest::Approx((b.position - a.position).squaredNorm()).epsilon(1e-5));
}
