#include "geom/power/cell_corners.h"

#include <algorithm>
#include <limits>
#include <utility>

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

CellCorners::CellCorners(const TriMesh& mesh, const Sites& sites, double extent)
    : mesh_(mesh),
      sites_(sites),
      extent_(extent),
      facets_(std::make_shared<const FacetBalls>(mesh, extent)) {}

void CellCorners::start(FacetPolygon& polygon, FacetId facet, SiteId owner) const {
  polygon.facet = facet;
  polygon.owner = owner;
  polygon.corners.resize(3);
  for (int i = 0; i < 3; ++i)
    polygon.corners[static_cast<std::size_t>(i)] = {{mesh_.corner(facet, i), 0}, EdgeLabel::facet_edge(i)};
}

/// Power is convex, so its maximum is at a corner. With a the rounded distance of a corner and b = sqrt(3)
/// tolerance, (a + b)^2 <= a^2 (1 + e) + b^2 (1 + 1/e). A level counts as a coordinate.
double CellCorners::bound_power(FacetId facet, SiteId site, std::span<const PolygonCorner> corners) const {
  const WeightedPoint3& owner = sites_[site];
  constexpr double e = 1e-9;
  double a2 = 0, tolerance = 0;
  const bool is_level = levels().is_flat_at(facet, owner.level);
  for (const PolygonCorner& corner : corners) {
    const RoundedPoint& x = corner.point;
    double rise = 0;
    if (!is_level)
      rise = std::abs(levels().at(facet, x.position) - owner.level) + levels().off(facet, x.tolerance);
    a2 = std::max(a2, (x.position - owner.position).squaredNorm() + rise * rise);
    tolerance = std::max(tolerance, x.tolerance);
  }
  if (tolerance < infinity) return a2 * (1 + e) + 3 * tolerance * tolerance * (1 + 1 / e) - owner.weight;
  double result = -infinity;
  for (const VertexId v : mesh_.facet(facet)) result = std::max(result, power(at(v), owner));
  return result;
}

bool CellCorners::beats_exactly(const CellCorner& corner, SiteId j) const {
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

// bisector(p, q) and bisector(q, p) have the same bits but for the sign, so the owner does not matter on an
// edge; in a facet the forms of the smallest id with the two others serve.
RoundedPoint CellCorners::corner(FacetId facet, EdgeLabel label, SiteId owner, SiteId j,
                                 const Bisector& b) const {
  const double uncertain = most_tolerance();
  if (!label.is_site()) {
    const TriMesh::Facet& corners = mesh_.facet(facet);
    const auto [s, e] = edge_ends(corners, label.edge());
    const Location3 ps = at(corners[static_cast<std::size_t>(s)]),
                    pe = at(corners[static_cast<std::size_t>(e)]);
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

RoundedPoint CellCorners::corner_between(FacetId facet, SiteId owner, EdgeLabel before,
                                         EdgeLabel after) const {
  if (!before.is_site() && !after.is_site()) return {mesh_.corner(facet, after.edge()), 0};
  const EdgeLabel site = after.is_site() ? after : before, other = after.is_site() ? before : after;
  return corner(facet, other, owner, site.site(), bisector_of(owner, site.site()));
}

RoundedPoint CellCorners::exact_meeting(FacetId facet, const std::array<SiteId, 3>& s) const {
  const FacetCorners q = corners_of(facet);
  return exact_corner_in_facet(q.at(0), q.at(1), q.at(2), ranked(s[0]), ranked(s[1]), ranked(s[2]), extent_);
}

}  // namespace geom
