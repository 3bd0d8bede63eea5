#include "geom/clip.h"

#include "geom/check.h"
#include "geom/clip_predicates.h"

namespace geom {
namespace {

std::size_t next(std::size_t k, std::size_t n) { return k + 1 == n ? 0 : k + 1; }

/// Ends of edge e of a facet, the smaller mesh-vertex id first.
std::pair<int, int> edge_ends(const TriMesh::Facet& facet, int e) {
  const int a = e, b = e == 2 ? 0 : e + 1;
  return facet[static_cast<std::size_t>(a)] < facet[static_cast<std::size_t>(b)] ? std::pair(a, b)
                                                                                 : std::pair(b, a);
}

}  // namespace

Clipper::Clipper(const TriMesh& mesh, const Sites& sites, double extent)
    : mesh_(mesh), sites_(sites), extent_(extent) {
  balls_.reserve(mesh.num_facets());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    Box3 box;
    for (int i = 0; i < 3; ++i) box.extend(mesh.corner(t, i));
    const Vec3 center = box.center();
    double radius = 0;
    for (int i = 0; i < 3; ++i) radius = std::max(radius, (mesh.corner(t, i) - center).norm());
    balls_.push_back({center, radius * (1 + 0x1p-40) + 0x1p-48 * extent});
  }
}

void Clipper::start(FacetPolygon& polygon, FacetId facet, SiteId owner) const {
  polygon.facet = facet;
  polygon.owner = owner;
  polygon.corners.resize(3);
  for (int i = 0; i < 3; ++i)
    polygon.corners[static_cast<std::size_t>(i)] = {
        {mesh_.corner(facet, i), 0}, EdgeLabel::facet_edge(i), CircleId()};
}

bool Clipper::beats_exactly(FacetId facet, SiteId owner, std::span<const PolygonCorner> corners,
                            std::size_t k, SiteId j) const {
  const EdgeLabel before = corners[k == 0 ? corners.size() - 1 : k - 1].edge, after = corners[k].edge;
  if (before.is_site() && after.is_site()) {
    const FacetCorners q{&mesh_.corner(facet, 0), &mesh_.corner(facet, 1), &mesh_.corner(facet, 2)};
    return beats_in_facet(q, ranked(owner), ranked(before.site()), ranked(after.site()), ranked(j));
  }
  if (!before.is_site() && !after.is_site())  // edges e - 1 and e meet in corner e
    return beats_at_vertex(mesh_.corner(facet, after.edge()), ranked(owner), ranked(j));
  const EdgeLabel edge = before.is_site() ? after : before, site = before.is_site() ? before : after;
  const auto [a, b] = edge_ends(mesh_.facet(facet), edge.edge());
  return beats_on_edge(mesh_.corner(facet, a), mesh_.corner(facet, b), ranked(owner), ranked(site.site()),
                       ranked(j));
}

Clip Clipper::classify_corners(FacetId facet, SiteId owner, std::span<const PolygonCorner> corners, SiteId j,
                               const Bisector& b, std::vector<char>& beaten) const {
  beaten.resize(corners.size());
  std::size_t count = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    count += beaten[k] = beats_at(facet, owner, corners, k, j, b);
  return count == 0 ? Clip::untouched : count == corners.size() ? Clip::swallowed : Clip::cut;
}

/// Where the bisector of the owner and j meets the line of `label` in the polygon's facet.
RoundedPoint Clipper::meet(const FacetPolygon& polygon, EdgeLabel label, SiteId j, const Bisector& b) const {
  const double uncertain = 0x1p-32 * extent_;
  const Vec3 &q0 = mesh_.corner(polygon.facet, 0), &q1 = mesh_.corner(polygon.facet, 1),
             &q2 = mesh_.corner(polygon.facet, 2);
  if (!label.is_site()) {
    const auto [s, e] = edge_ends(mesh_.facet(polygon.facet), label.edge());
    const Vec3 &ps = mesh_.corner(polygon.facet, s), &pe = mesh_.corner(polygon.facet, e);
    const RoundedPoint point = corner_on_edge(ps, pe, b(ps), b(pe), b.error, extent_);
    if (point.tolerance <= uncertain) return point;
    return exact_corner_on_edge(ps, pe, ranked(polygon.owner), ranked(j), extent_);
  }
  const SiteId first = std::min(j, label.site()), second = std::max(j, label.site());
  const LinearForm fj = linear_form(b, q0, q1, q2);
  const LinearForm fk = linear_form(bisector_of(polygon.owner, label.site()), q0, q1, q2);
  const RoundedPoint point = corner_in_facet(q0, q1, q2, first == j ? fj : fk, first == j ? fk : fj, extent_);
  if (point.tolerance <= uncertain) return point;
  return exact_corner_in_facet(q0, q1, q2, ranked(polygon.owner), ranked(first), ranked(second), extent_);
}

//               beaten               The polygon is convex and the bisector a line: the beaten corners are
//            x-----------x           consecutive. `out` is the last kept corner before them, `in` the first
//           /             \          one after them.
//   --j--- m ------------- n --j--
//         /                 \        The new polygon: in ... out, then n, where the edge j starts, then m.
//       in                  out
void Clipper::cut(FacetPolygon& polygon, SiteId j, const Bisector& b, const std::vector<char>& beaten) {
  const std::vector<PolygonCorner>& old = polygon.corners;
  const std::size_t n = old.size();
  std::size_t in = 0;
  while (!(beaten[in == 0 ? n - 1 : in - 1] && !beaten[in]))
    ensure(++in < n, "clip: beaten corners are not consecutive");
  scratch_.clear();
  std::size_t k = in;
  for (; !beaten[k]; k = next(k, n)) scratch_.push_back(old[k]);
  const EdgeLabel leaving = scratch_.back().edge;  // the edge from the last kept corner into what j takes
  std::size_t last_beaten = k;
  while (beaten[next(last_beaten, n)]) last_beaten = next(last_beaten, n);
  ensure(next(last_beaten, n) == in, "clip: beaten corners are not consecutive");
  const EdgeLabel entering = old[last_beaten].edge;
  scratch_.push_back({meet(polygon, leaving, j, b), EdgeLabel::bisector(j), CircleId()});
  scratch_.push_back({meet(polygon, entering, j, b), entering, CircleId()});
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
