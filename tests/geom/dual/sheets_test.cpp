// What is said of the surface near a place: that it is a graph, and that a cell has no second component
// there.

#include "geom/dual/sheets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "doctest.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/power/facet_cells.h"
#include "geom/rng.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/placed_samples.h"
#include "tests/fixtures/sheet_scene.h"
#include "tests/fixtures/weighted_points.h"
#include "tests/oracle/restricted_dual_oracle.h"

using namespace geom;
using fixtures::Weights;
using Place = fixtures::SheetScene;

namespace {

std::array<Vec3, 3> corners(const TriMesh& mesh, FacetId t) {
  return {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
}

/// How often the line through x along the axis meets the surface within that distance of the center, which is
/// never higher than told. -1 if it comes too near to an edge to tell.
int sheets_crossings(const TriMesh& mesh, const Vec3& x, const Sheet& sheet, double radius) {
  const Vec3 &axis = sheet.axis, &center = sheet.center;
  const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
  int count = 0;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    Vec2 q[3];
    for (int i = 0; i < 3; ++i) q[i] = Vec2((mesh.corner(t, i) - x).dot(u), (mesh.corner(t, i) - x).dot(v));
    double weight[3], sum = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec2 &a = q[(i + 1) % 3], &b = q[(i + 2) % 3];
      weight[i] = a.x() * b.y() - a.y() * b.x();
      sum += weight[i];
    }
    if (sum == 0) continue;
    double least = 1;
    Vec3 hit(0, 0, 0);  // from the center: far off, places themselves are too coarse
    for (int i = 0; i < 3; ++i) {
      least = std::min(least, weight[i] / sum);
      hit += weight[i] / sum * (mesh.corner(t, i) - center);
    }
    if (least < -1e-9 || hit.norm() > radius * (1 + 1e-9)) continue;
    if (least < 1e-9) return -1;
    CHECK(std::abs(hit.dot(axis)) <= sheet.height);
    ++count;
  }
  return count;
}

/// The theorem at the head of sheets.h, by lines that are let down on the surface.
std::size_t check_graphs(Place& place, Rng& rng, int queries) {
  std::size_t graphs = 0;
  for (int query = 0; query < queries; ++query) {
    const FacetId t(static_cast<std::size_t>(rng.below(place.mesh.num_facets())));
    const auto [a, b, c] = corners(place.mesh, t);
    const double s = rng.uniform(), r = rng.uniform() * (1 - s);
    const Vec3 p = a + s * (b - a) + r * (c - a);
    const double radius = place.mesh.diagonal() * std::pow(10, rng.uniform(-2.5, -0.3));
    const Sheet sheet = place.sheets.sheet_in(p, radius);
    if (sheet.width < 0) continue;
    ++graphs;
    CHECK(sheet.center == p);
    CHECK(sheet.slope < 1);
    CHECK(sheet.axis.norm() == doctest::Approx(1));
    CHECK(sheet.u.norm() == doctest::Approx(1));
    CHECK(std::abs(sheet.u.dot(sheet.axis)) < 1e-12);
    CHECK(std::hypot(sheet.width, sheet.height) <= radius);
    const double ball = radius;
    const Vec3 across = sheet.axis.cross(sheet.u);
    for (FacetId f(0); f.index() < place.mesh.num_facets(); f = FacetId(f.value + 1)) {
      if (closest_point(sheet.center, corners(place.mesh, f)).distance2 > ball * ball) continue;
      const Vec3 n = place.mesh.normal(f).normalized();
      CHECK(n.dot(sheet.axis) * std::sqrt(1 + sheet.slope * sheet.slope) >= 1 - 1e-6);
      CHECK(std::abs(n.dot(sheet.u)) <= sheet.slope_u * n.dot(sheet.axis));
      CHECK(std::abs(n.dot(across)) <= sheet.slope_v * n.dot(sheet.axis));
      for (int e = 0; e < 3; ++e) {  // no edge without a facet beyond
        const Vec3 &from = place.mesh.corner(f, e), &to = place.mesh.corner(f, (e + 1) % 3);
        if (closest_point(sheet.center, {from, to, to}).distance2 < ball * ball * (1 - 1e-9))
          CHECK(place.mesh.across(f, e).valid());
      }
    }
    // Once above each location; the center itself is on the surface, or as near as a place is shared.
    const Vec3 u = sheet.axis.unitOrthogonal(), v = sheet.axis.cross(u);
    for (int line = 0; line < 12; ++line) {
      const double angle = 2 * std::numbers::pi * rng.uniform(),
                   far = sheet.width * 0.999 * std::sqrt(rng.uniform());
      const Vec3 x = sheet.center + far * (std::cos(angle) * u + std::sin(angle) * v);
      const int times = sheets_crossings(place.mesh, x, sheet, ball);
      CHECK((times == 1 || times == -1));
    }
  }
  return graphs;
}

/// The components of a cell, each with its facets, neighbours and its least and its greatest distance from
/// the site.
struct Component {
  std::set<FacetId> facets;
  std::set<SiteId> link;
  double distance = std::numeric_limits<double>::infinity(), farthest = 0;
};
std::vector<Component> components_of(const TriMesh& mesh, const oracle::BruteDiagram& brute, const Vec3& at,
                                     SiteId p) {
  std::set<FacetId> left;
  for (const auto& [key, polygon] : brute.polygons())
    if (key.second == p) left.insert(key.first);
  std::vector<Component> result;
  while (!left.empty()) {
    Component& component = result.emplace_back();
    std::vector<FacetId> stack{*left.begin()};
    left.erase(left.begin());
    while (!stack.empty()) {
      const FacetId t = stack.back();
      stack.pop_back();
      component.facets.insert(t);
      const std::vector<PolygonCorner>& polygon = brute.polygons().at({t, p}).corners;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        component.farthest = std::max(component.farthest, (polygon[k].point.position - at).norm());
        if (k >= 2) {
          const std::array<Vec3, 3> piece{polygon[0].point.position, polygon[k - 1].point.position,
                                          polygon[k].point.position};
          component.distance = std::min(component.distance, std::sqrt(closest_point(at, piece).distance2));
        }
        if (polygon[k].edge.is_site()) {
          component.link.insert(polygon[k].edge.site());
          continue;
        }
        const FacetId across = mesh.across(t, polygon[k].edge.edge());
        if (left.erase(across) > 0) stack.push_back(across);
      }
    }
  }
  return result;
}

struct SheetsCount {
  std::size_t asked = 0, said = 0, orphans = 0;
};

/// Whenever there is said to be one component within a distance, there is.
void check_components(Place& place, std::size_t n, Weights weights, std::uint64_t seed, SheetsCount& count) {
  const std::vector<fixtures::Placed> samples = fixtures::placed_samples(place.mesh, n, n, weights, seed);
  Clipper::Sites sites;
  std::vector<SiteId> present;
  for (const fixtures::Placed& x : samples) {
    present.emplace_back(sites.size());
    sites.push_back(x.point);
  }
  const oracle::BruteDiagram brute(place.mesh, sites, present);
  for (const SiteId p : present) {
    const Vec3& at = sites[p].position;
    const std::vector<Component> components = components_of(place.mesh, brute, at, p);
    const auto own = std::ranges::find_if(
        components, [&](const Component& c) { return c.facets.contains(samples[p.index()].home); });
    if (own == components.end()) continue;
    count.orphans += components.size() - 1;
    std::vector<Sheets::Neighbour> link;
    for (const SiteId q : own->link) {
      const Vec3 d = sites[q].position - at;
      link.push_back({d, d.squaredNorm() - (sites[q].weight - sites[p].weight)});
    }
    const double known = 1.0000001 * own->farthest;
    const double spacing = std::sqrt(place.mesh.area() / static_cast<double>(n));
    for (const double distance : {0.1 * spacing, 0.5 * spacing, spacing, 2 * spacing, 5 * spacing}) {
      ++count.asked;
      const Sheet* const sheet = place.sheets.around(p, at, std::max(distance, known));
      if (!sheet || !Sheets::has_one_component(*sheet, known, link)) continue;
      ++count.said;
      for (const Component& c : components)
        if (&c != &*own) CHECK(c.distance > distance);
    }
  }
}

TriMesh moved(const TriMesh& mesh, const Vec3& by) {
  Table<VertexId, Vec3> vertices;
  for (const Vec3& p : mesh.vertices()) vertices.push_back(p + by);
  return TriMesh(std::move(vertices), mesh.facets());
}

/// Both as one mesh.
TriMesh together(const TriMesh& a, const TriMesh& b) {
  Table<VertexId, Vec3> vertices = a.vertices();
  Table<FacetId, TriMesh::Facet> facets = a.facets();
  const auto base = static_cast<std::int32_t>(vertices.size());
  for (const Vec3& p : b.vertices()) vertices.push_back(p);
  for (const TriMesh::Facet& f : b.facets())
    facets.push_back({VertexId(f[0].value + base), VertexId(f[1].value + base), VertexId(f[2].value + base)});
  return TriMesh(std::move(vertices), std::move(facets));
}

TriMesh flat(int k = 20) {
  return fixtures::sheet(
      k, 1, [](double, double) { return 0.0; }, 0.2);
}

}  // namespace

TEST_CASE("sheets: a graph is one, with the slope and the width that are told") {
  std::size_t graphs = 0;
  Rng rng(3);
  std::vector<fixtures::NamedSurface> all = fixtures::hard_surfaces();
  for (fixtures::NamedSurface& s : fixtures::surfaces()) all.push_back(std::move(s));
  for (fixtures::NamedSurface& surface : all) {
    CAPTURE(surface.name);
    Place place(std::move(surface.mesh));
    graphs += check_graphs(place, rng, 40);
  }
  CHECK(graphs > 200);
  Place sphere(make_shape("sphere", 8));
  CHECK(check_graphs(sphere, rng, 60) > 20);
}

TEST_CASE("sheets: where there is one component within a distance by the sheet, there is no other") {
  SheetsCount hard, smooth;
  for (fixtures::NamedSurface& surface : fixtures::hard_surfaces()) {
    CAPTURE(surface.name);
    Place place(std::move(surface.mesh));
    for (const Weights weights : fixtures::all_weights)
      for (const std::size_t n : {15u, 80u}) check_components(place, n, weights, n + 2, hard);
  }
  CHECK(hard.said > 300);
  CHECK(hard.orphans > 300);
  Place sphere(make_shape("sphere", 6));
  check_components(sphere, 300, Weights::none, 4, smooth);
  CHECK(2 * smooth.said > smooth.asked);
}

// The gap is less than what is asked about: a component may be on the other side.
TEST_CASE("sheets: two sheets in the ball are no graph, one alone is") {
  const Vec3 middle(0.5, 0.5, 0);
  for (const double gap : {1e-15, 1e-6, 0.01, 0.1}) {
    CAPTURE(gap);
    Place one(flat()), above(together(flat(), moved(flat(), Vec3(0, 0, gap)))),
        against(together(flat(), fixtures::with_facets_turned(moved(flat(), Vec3(0, 0, gap)))));
    CHECK(one.is_graph(middle, 0.2));
    CHECK(!above.is_graph(middle, 0.2));
    CHECK(!against.is_graph(middle, 0.2));
    if (gap >= 0.1) CHECK(above.is_graph(middle, gap / 4));
  }
  Place plate(fixtures::box(Vec3(1, 1, 0.05), 8));
  CHECK(!plate.is_graph(middle, 0.1));
  CHECK(plate.is_graph(middle, 0.02));
}

// The turns are connected, but far away.
TEST_CASE("sheets: turns of a helicoid, treads of a staircase, folds of an accordion") {
  Place helicoid(fixtures::helicoid(3, 0.1)), stairs(fixtures::staircase(8, 0.125)),
      accordion(fixtures::accordion(5, 1.0 / 32)), wide(fixtures::helicoid(3, 0.1));
  const double turn = 1.0 / 3;
  const Vec3 on_ramp(0.55, 0, 0.1);  // a whole turn up
  CHECK(AabbTree(helicoid.mesh).closest(on_ramp).distance2 < 0.01);
  CHECK(!helicoid.is_graph(on_ramp, 0.12));
  CHECK(!helicoid.is_graph(on_ramp, 0.3));
  CHECK(!helicoid.is_graph(on_ramp, turn));
  CHECK(!stairs.is_graph(Vec3(0.5, 0.3, 0.5), 0.1));
  CHECK(!accordion.is_graph(Vec3(0.5, 0.3, 0.25 + 1.5 / 32), 0.1));
}

TEST_CASE("sheets: a slope of one, an edge of a cube, a cone's tip are no graph; gentle slopes are") {
  for (const double slope : {0.1, 0.4, 0.9, 1.1, 3.0}) {
    CAPTURE(slope);
    // A roof: normals at an angle to each other of twice that of the slope.
    Place roof(fixtures::sheet(20, 1, [&](double x, double) { return slope * std::abs(x - 0.5); }));
    CHECK(roof.is_graph(Vec3(0.5, 0.5, 0), 0.1) == (slope < 1));
    if (slope > 1) continue;
    const Sheet sheet = roof.sheets.sheet_in(Vec3(0.5, 0.5, 0), 0.1);
    CHECK(sheet.slope == doctest::Approx(slope).epsilon(0.05));
    CHECK(sheet.slope_u == doctest::Approx(slope).epsilon(0.05));
    CHECK(std::abs(sheet.u.x()) > 0.99);  // the direction of most slopes
    CHECK(sheet.slope_v < 0.05);
  }
  Place cube(fixtures::box(Vec3(1, 1, 1), 10));
  CHECK(cube.is_graph(Vec3(0.5, 0.5, 0), 0.2));
  CHECK(!cube.is_graph(Vec3(0.5, 0, 0), 0.2));  // the edge
  CHECK(!cube.is_graph(Vec3(0, 0, 0), 0.2));    // the corner
  Place tip(fixtures::needle_fan(12, 2));
  CHECK(!tip.is_graph(Vec3(0, 0, 2), 0.2));
}

TEST_CASE("sheets: borders, edges of three facets, facets turned round, and needles are no graph") {
  Place sheet(flat());
  CHECK(sheet.is_graph(Vec3(0.5, 0.5, 0), 0.15));
  CHECK(!sheet.is_graph(Vec3(0.5, 0.02, 0), 0.1));
  CHECK(!sheet.is_graph(Vec3(0.5, 0.5, 0), 0.6));
  Place fins(fixtures::not_manifold());
  CHECK(!fins.is_graph(Vec3(0, 0.35, 0), 0.1));
  Place turned(fixtures::with_facets_turned(flat()));
  CHECK(!turned.is_graph(Vec3(0.5, 0.5, 0), 0.2));
  // A vertex so near to an edge that the facet between has no normal to speak of.
  Table<VertexId, Vec3> vertices = flat().vertices();
  Table<FacetId, TriMesh::Facet> facets = flat().facets();
  Place with_gap(TriMesh(vertices, [&] {
    Table<FacetId, TriMesh::Facet> fewer;
    for (FacetId t(0); t.index() < facets.size(); t = FacetId(t.value + 1))
      if (t.index() != facets.size() / 2 + 20) fewer.push_back(facets[t]);
    return fewer;
  }()));
  const Vec3 gap = [&] {
    Vec3 sum(0, 0, 0);
    for (const VertexId v : facets[FacetId(facets.size() / 2 + 20)]) sum += vertices[v] / 3;
    return sum;
  }();
  CHECK(!with_gap.is_graph(gap, 0.05));
  for (const double width : {1e-3, 1e-10, 1e-13}) {
    const auto v = [](int i) { return VertexId(i); };
    Place needle(
        TriMesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1, 0), Vec3(0.5, width, 0), Vec3(0.5, -1, 0)},
                {{v(0), v(3), v(2)}, {v(3), v(1), v(2)}, {v(0), v(1), v(3)}, {v(0), v(4), v(1)}}));
    CHECK(needle.is_graph(Vec3(0.5, 0, 0), 0.02) == (width > 1e-9));
  }
  Place without_area(fixtures::with_degenerate_facets());
  CHECK(!without_area.is_graph(Vec3(0.5, 0, 0), 0.02));
}

TEST_CASE("sheets: neighbours without a lead, and steep ones, leave it open") {
  Place sheet(flat()),
      slope(fixtures::sheet(20, 1, [](double x, double) { return 0.4 * std::abs(x - 0.5); }));
  const Vec3 middle(0.5, 0.5, 0);
  const auto says = [&](Place& place, const Vec3& offset, double lead) {
    const Sheet* const known = place.sheets.around(SiteId(0), middle, 0.1);
    REQUIRE(known);
    return Sheets::has_one_component(*known, 0.1, std::array{Sheets::Neighbour{offset, lead}});
  };
  CHECK(says(sheet, Vec3(0.1, 0, 0), 0.01));
  CHECK(!says(sheet, Vec3(0.1, 0, 0), 0));
  CHECK(!says(sheet, Vec3(0.1, 0, 0), -0.01));
  CHECK(!says(sheet, Vec3(0.1, 0, 0), 1e-12));
  CHECK(says(sheet, Vec3(0, 0, 0.1), 0.01));  // flat: no lead is won back
  CHECK(says(slope, Vec3(0.1, 0, 0), 0.01));
  CHECK(!says(slope, Vec3(0, 0, 0.1), 0.01));  // less than 4 s |a| r_K
  CHECK(says(slope, Vec3(0, 0, 0.1), 0.03));
  CHECK(!sheet.sheets.around(SiteId(1), middle, 1.0));
}

TEST_CASE("sheets: those of a site are kept, and made anew where they do not do") {
  Place sphere(make_shape("sphere", 6));
  Rng rng(5);
  const SiteId p(3);
  CHECK(!sphere.sheets.known(p, 0));
  for (int step = 0; step < 300; ++step) {
    const Vec3 x = Vec3(0.3 + rng.uniform(-0.1, 0.1), 0.5, 0.9).normalized();
    const double distance = rng.uniform(0.05, 0.25);
    const Sheet* const before = sphere.sheets.known(p, 0);
    const bool will_do = before && before->covers(x, distance);
    const Vec3 center = before ? before->center : Vec3(0, 0, 0);
    const Sheet* const sheet = sphere.sheets.around(p, x, distance);
    REQUIRE(sheet);
    CHECK(sheet->covers(x, distance));
    CHECK(sheet->center == (will_do ? center : x));
    CHECK(sphere.sheets.known(p, 0) == sheet);
    CHECK(!sphere.sheets.known(SiteId(4), 0));
  }
  // Where there is none it is not made up, and afterwards again found where there is one.
  CHECK(!sphere.sheets.around(p, Vec3(0, 0, 1), 3.0));
  CHECK(sphere.sheets.known(p, 0));  // the one that there was
  CHECK(!sphere.sheets.around(p, Vec3(0, 0, 1), 2.9));
  CHECK(sphere.sheets.around(p, Vec3(0, 0, 1), 0.1));
}

TEST_CASE("sheets: of more sites than are kept, two that share a place are never taken for each other") {
  Place sphere(make_shape("sphere", 6));
  const SiteId p(3), q(p.index() + Sheets::most_kept);
  const Vec3 x = Vec3(0.3, 0.5, 0.9).normalized(), y = -x;
  REQUIRE(sphere.sheets.around(p, x, 0.1));
  CHECK(!sphere.sheets.known(q, 0));
  const Sheet* const other = sphere.sheets.around(q, y, 0.1);
  REQUIRE(other);
  CHECK(other->center == y);
  CHECK(sphere.sheets.known(q, 0) == other);
  CHECK(!sphere.sheets.known(p, 0));
  // That there is none at a place is not held against who comes there next.
  CHECK(!sphere.sheets.around(q, x, 3.0));
  const Sheet* const again = sphere.sheets.around(p, x, 0.1);
  REQUIRE(again);
  CHECK(again->center == x);
  const Sheet kept = *again;
  sphere.sheets.keep(q, kept);
  CHECK(sphere.sheets.known(q, 0));
  CHECK(!sphere.sheets.known(p, 0));
}
