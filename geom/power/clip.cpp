#include "geom/power/clip.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "geom/check.h"

namespace geom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Ends of edge e of a facet, the smaller mesh-vertex id first.
std::pair<int, int> edge_ends(const TriMesh::Facet& facet, int e) {
  const int a = e, b = e == 2 ? 0 : e + 1;
  return facet[static_cast<std::size_t>(a)] < facet[static_cast<std::size_t>(b)] ? std::pair(a, b)
                                                                                 : std::pair(b, a);
}

}  // namespace

Clipper::Clipper(const TriMesh& mesh, const Sites& sites, double extent)
    : mesh_(mesh), sites_(sites), extent_(extent) {
  Table<FacetId, Ball> balls;
  balls.reserve(mesh.num_facets());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    Box3 box;
    for (int i = 0; i < 3; ++i) box.extend(mesh.corner(t, i));
    const Vec3 center = box.center();
    double radius = 0;
    for (int i = 0; i < 3; ++i) radius = std::max(radius, (mesh.corner(t, i) - center).norm());
    balls.push_back({center, radius * (1 + 0x1p-40) + 0x1p-48 * extent});
  }
  balls_ = std::make_shared<const Table<FacetId, Ball>>(std::move(balls));
  levels_ = std::make_shared<const FacetLevels>(mesh);
}

void Clipper::start(FacetPolygon& polygon, FacetId facet, SiteId owner) const {
  polygon.facet = facet;
  polygon.owner = owner;
  polygon.corners.resize(3);
  for (int i = 0; i < 3; ++i)
    polygon.corners[static_cast<std::size_t>(i)] = {{mesh_.corner(facet, i), 0}, EdgeLabel::facet_edge(i)};
}

/// Power is convex, so its maximum is at a corner. With a the rounded distance of a corner and b = sqrt(3)
/// tolerance, (a + b)^2 <= a^2 (1 + e) + b^2 (1 + 1/e). A level counts as a coordinate.
double Clipper::bound_power(FacetId facet, SiteId site, std::span<const PolygonCorner> corners) const {
  const WeightedPoint3& owner = sites_[site];
  constexpr double e = 1e-9;
  double a2 = 0, tolerance = 0;
  const bool is_level = levels_->is_flat_at(facet, owner.level);
  for (const PolygonCorner& corner : corners) {
    const RoundedPoint& x = corner.point;
    double rise = 0;
    if (!is_level)
      rise = std::abs(levels_->at(facet, x.position) - owner.level) + levels_->off(facet, x.tolerance);
    a2 = std::max(a2, (x.position - owner.position).squaredNorm() + rise * rise);
    tolerance = std::max(tolerance, x.tolerance);
  }
  if (tolerance < infinity) return a2 * (1 + e) + 3 * tolerance * tolerance * (1 + 1 / e) - owner.weight;
  double result = -infinity;
  for (const VertexId v : mesh_.facet(facet)) result = std::max(result, power(at(v), owner));
  return result;
}

bool Clipper::beats_exactly(const CellCorner& corner, SiteId j) const {
  const auto& [facet, owner, before, after, point] = corner;
  if (before.is_site() && after.is_site())
    return beats_in_facet(corners_of(facet), ranked(owner), ranked(before.site()), ranked(after.site()),
                          ranked(j));
  if (!before.is_site() && !after.is_site())  // edges e - 1 and e meet in corner e
    return beats_at_vertex(corners_of(facet).at(static_cast<std::size_t>(after.edge())), ranked(owner),
                           ranked(j));
  const EdgeLabel edge = before.is_site() ? after : before, site = before.is_site() ? before : after;
  const auto [a, b] = edge_ends(mesh_.facet(facet), edge.edge());
  const FacetCorners q = corners_of(facet);
  return beats_on_edge(q.at(static_cast<std::size_t>(a)), q.at(static_cast<std::size_t>(b)), ranked(owner),
                       ranked(site.site()), ranked(j));
}

Clip Clipper::classify_corners(FacetId facet, SiteId owner, std::span<const PolygonCorner> corners, SiteId j,
                               const Bisector& b, std::vector<char>& beaten) const {
  beaten.resize(corners.size());
  std::size_t count = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto [f, bound] = value_at(facet, corners[k].point, b);
    const bool certain = f > bound || f < -bound;
    const bool yes = certain ? f < 0 : beats_exactly(cell_corner(facet, owner, corners, k), j);
    beaten[k] = yes;
    count += yes;
  }
  return count == 0 ? Clip::untouched : count == corners.size() ? Clip::swallowed : Clip::cut;
}

// bisector(p, q) and bisector(q, p) have the same bits but for the sign, so the owner does not matter on an
// edge; in a facet the forms of the smallest id with the two others serve.
RoundedPoint Clipper::corner(FacetId facet, EdgeLabel label, SiteId owner, SiteId j,
                             const Bisector& b) const {
  const double uncertain = most_tolerance();
  if (!label.is_site()) {
    const auto [s, e] = edge_ends(mesh_.facet(facet), label.edge());
    const FacetCorners q = corners_of(facet);
    const Location3 ps = q.at(static_cast<std::size_t>(s)), pe = q.at(static_cast<std::size_t>(e));
    const RoundedPoint point = corner_on_edge(ps.position, pe.position, b(ps), b(pe), b.error, extent_);
    if (point.tolerance <= uncertain) return point;
    return exact_corner_on_edge(ps, pe, ranked(std::min(owner, j)), ranked(std::max(owner, j)), extent_);
  }
  std::array<SiteId, 3> s{owner, j, label.site()};
  if (s[2] < s[1]) std::swap(s[1], s[2]);
  if (s[1] < s[0]) std::swap(s[0], s[1]);
  if (s[2] < s[1]) std::swap(s[1], s[2]);
  return meeting(facet, s);
}

RoundedPoint Clipper::corner_between(FacetId facet, SiteId owner, EdgeLabel before, EdgeLabel after) const {
  if (!before.is_site() && !after.is_site()) return {mesh_.corner(facet, after.edge()), 0};
  const EdgeLabel site = after.is_site() ? after : before, other = after.is_site() ? before : after;
  return corner(facet, other, owner, site.site(), bisector_of(owner, site.site()));
}

RoundedPoint Clipper::meeting(FacetId facet, const std::array<SiteId, 3>& s, const AxisMinors& minors) const {
  const auto [v0, v1, v2] = mesh_.facet(facet);
  const RoundedPoint point =
      corner_in_facet(mesh_.position(v0), mesh_.position(v1), mesh_.position(v2), minors, extent_);
  if (point.tolerance <= most_tolerance()) return point;
  const FacetCorners q = corners_of(facet);
  return exact_corner_in_facet(q.at(0), q.at(1), q.at(2), ranked(s[0]), ranked(s[1]), ranked(s[2]), extent_);
}

//               beaten               The polygon is convex and the bisector a line: the beaten corners are
//            x-----------x           consecutive. `last` is the last kept corner before them, `first` the
//           /             \          first one after them.
//   --j--- m ------------- n --j--
//         /                 \        The new polygon: first ... last, then n, where the edge j starts,
//     first                last      then m.
CutPlace Clipper::place_of_cut(std::span<const PolygonCorner> corners, const std::vector<char>& beaten) {
  const std::size_t n = corners.size();
  CutPlace place{};
  while (!(beaten[place.first == 0 ? n - 1 : place.first - 1] && !beaten[place.first]))
    ensure(++place.first < n, "clip: beaten corners are not consecutive");
  place.last = place.first;
  while (!beaten[next_corner(place.last, n)]) place.last = next_corner(place.last, n);
  std::size_t last_beaten = next_corner(place.last, n);
  while (beaten[next_corner(last_beaten, n)]) last_beaten = next_corner(last_beaten, n);
  ensure(next_corner(last_beaten, n) == place.first, "clip: beaten corners are not consecutive");
  place.leaving = corners[place.last].edge;
  place.entering = corners[last_beaten].edge;
  return place;
}

void Clipper::cut(std::span<const PolygonCorner> old, const CutPlace& place, SiteId j,
                  const std::array<RoundedPoint, 2>& leave_and_enter, std::vector<PolygonCorner>& out) {
  out.clear();
  for (std::size_t k = place.first;; k = next_corner(k, old.size())) {
    out.push_back(old[k]);
    if (k == place.last) break;
  }
  out.push_back({leave_and_enter[0], EdgeLabel::bisector(j)});
  out.push_back({leave_and_enter[1], place.entering});
}

void Clipper::cut(FacetPolygon& polygon, SiteId j, const Bisector& b, const std::vector<char>& beaten) {
  const CutPlace place = place_of_cut(polygon.corners, beaten);
  const auto meet = [&](EdgeLabel label) { return corner(polygon.facet, label, polygon.owner, j, b); };
  cut(polygon.corners, place, j, {meet(place.leaving), meet(place.entering)}, scratch_);
  polygon.corners.swap(scratch_);
}

Clip Clipper::clip(FacetPolygon& polygon, SiteId j, const Bisector& b) {
  const Clip outcome = classify(polygon.facet, polygon.owner, polygon.corners, j, b, beaten_);
  if (outcome == Clip::swallowed) polygon.corners.clear();
  if (outcome == Clip::cut) cut(polygon, j, b, beaten_);
  return outcome;
}

Clip Clipper::clip_beyond(FacetPolygon& polygon, SiteId j, const Bisector& b) {
  const Clip outcome = classify(polygon.facet, polygon.owner, polygon.corners, j, b, beaten_);
  if (outcome == Clip::untouched) polygon.corners.clear();
  if (outcome == Clip::cut) {
    for (char& is_beaten : beaten_) is_beaten = !is_beaten;
    cut(polygon, j, b, beaten_);
  }
  return outcome == Clip::untouched   ? Clip::swallowed
         : outcome == Clip::swallowed ? Clip::untouched
                                      : Clip::cut;
}

}  // namespace geom
