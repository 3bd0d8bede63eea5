#include "tests/oracle/restricted_dual_oracle.h"

#include <algorithm>
#include <limits>
#include <set>

#include "geom/check.h"
#include "geom/mesh/scaling.h"

namespace oracle {

using geom::CircleId;
using geom::CornerTypes;
using geom::EdgeLabel;
using geom::EmptyCircle;
using geom::FacetId;
using geom::FacetPolygon;
using geom::PolygonCorner;
using geom::SiteId;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The edge of t that joins the same vertices as edge e of the facet `before`, across it.
int edge_back(const geom::TriMesh& mesh, FacetId before, int e, FacetId t) {
  const auto ends = [&](FacetId f, int i) {
    const VertexId a = mesh.facet(f)[static_cast<std::size_t>(i)],
                   b = mesh.facet(f)[static_cast<std::size_t>((i + 1) % 3)];
    return std::pair(std::min(a, b), std::max(a, b));
  };
  for (int i = 0; i < 3; ++i)
    if (mesh.across(t, i) == before && ends(t, i) == ends(before, e)) return i;
  geom::ensure(false, "oracle: two facets across from each other share no edge");
  return -1;
}

std::size_t edge_labelled(const FacetPolygon& polygon, EdgeLabel label) {
  return static_cast<std::size_t>(std::ranges::find(polygon.corners, label, &PolygonCorner::edge) -
                                  polygon.corners.begin());
}

std::vector<FacetId> all_facets(const geom::TriMesh& mesh) {
  std::vector<FacetId> facets;
  for (std::size_t t = 0; t < mesh.num_facets(); ++t) facets.emplace_back(t);
  return facets;
}

std::array<SiteId, 3> ascending(SiteId a, SiteId b, SiteId c) {
  std::array<SiteId, 3> sites{a, b, c};
  std::ranges::sort(sites);
  return sites;
}

}  // namespace

FacetPolygon part_of(geom::Clipper& clipper, FacetId t, SiteId owner, std::span<const SiteId> present) {
  FacetPolygon polygon;
  clipper.start(polygon, t, owner);
  for (const SiteId j : present)
    if (j != owner && !polygon.corners.empty()) clipper.clip(polygon, j);
  return polygon;
}

BruteDiagram::BruteDiagram(const geom::TriMesh& mesh, const geom::Clipper::Sites& sites,
                           std::span<const SiteId> present)
    : BruteDiagram(mesh, sites, present, all_facets(mesh)) {}

BruteDiagram::BruteDiagram(const geom::TriMesh& mesh, const geom::Clipper::Sites& sites,
                           std::span<const SiteId> present, std::span<const FacetId> facets)
    : mesh_(mesh), sites_(sites), levels_(mesh) {
  geom::Clipper clipper(mesh, sites, geom::extent_of(mesh));
  for (const FacetId t : facets)
    for (const SiteId i : present) {
      FacetPolygon polygon = part_of(clipper, t, i, present);
      if (!polygon.corners.empty()) polygons_.emplace(std::pair(t, i), std::move(polygon));
    }
}

const FacetPolygon* BruteDiagram::find(FacetId t, SiteId owner) const {
  const auto at = polygons_.find({t, owner});
  return at == polygons_.end() ? nullptr : &at->second;
}

/// C: once for its three sites. B: by the smaller site, in the smaller facet. A: in the first facet of the
/// vertex.
bool BruteDiagram::is_registered(const FacetPolygon& polygon, std::size_t k, CornerTypes types) const {
  const EdgeLabel before = polygon.edge_before(k), after = polygon.corners[k].edge;
  if (before.is_site() && after.is_site())
    return polygon.owner < before.site() && polygon.owner < after.site();
  if (types == CornerTypes::c_only) return false;
  if (before.is_site() != after.is_site()) {
    const SiteId other = before.is_site() ? before.site() : after.site();
    const FacetId across = mesh_.across(polygon.facet, before.is_site() ? after.edge() : before.edge());
    return polygon.owner < other && (!across.valid() || polygon.facet < across);
  }
  const VertexId v = mesh_.facet(polygon.facet)[static_cast<std::size_t>(after.edge())];
  for (FacetId t(0);; t = FacetId(t.value + 1))
    if (std::ranges::find(mesh_.facet(t), v) != mesh_.facet(t).end()) return t == polygon.facet;
}

KnownCircle BruteDiagram::known(const FacetPolygon& polygon, std::size_t k) const {
  const EdgeLabel before = polygon.edge_before(k), after = polygon.corners[k].edge;
  KnownCircle c;
  c.name.facet = polygon.facet;
  c.name.sites[0] = polygon.owner;
  if (before.is_site() && after.is_site()) {
    // Counterclockwise around the corner the polygons are those of the owner, of the site before it, of the
    // one after.
    c.name.sites = ascending(polygon.owner, before.site(), after.site());
    c.clockwise = after.site() < before.site();
  } else if (before.is_site() || after.is_site()) {
    c.name.sites[1] = before.is_site() ? before.site() : after.site();
    c.name.place = static_cast<std::int16_t>(1 + (before.is_site() ? after.edge() : before.edge()));
  } else {
    c.name.place = static_cast<std::int16_t>(4 + after.edge());
  }
  geom::Box3 box;
  for (int i = 0; i < 3; ++i) box.extend(mesh_.corner(polygon.facet, i));
  const Vec3& x = polygon.corners[k].point.position;
  const Vec3 center = geom::snapped(x.cwiseMax(box.min()).cwiseMin(box.max()));
  c.center = {center.x(), center.y(), center.z()};
  c.radius2 = power_at(polygon.facet, center, polygon.owner);
  return c;
}

double BruteDiagram::power_at(FacetId t, const Vec3& x, SiteId owner) const {
  return geom::power(geom::Location3(x, levels_.at(t, x)), sites_[owner]);
}

CircleName BruteDiagram::other_end(FacetId t, SiteId a, SiteId b, SiteId c) const {
  EdgeLabel from = EdgeLabel::bisector(c);
  for (std::size_t steps = 0; steps <= polygons_.size(); ++steps) {
    const FacetPolygon* const polygon = find(t, a);
    geom::ensure(polygon != nullptr, "oracle: an edge of the diagram ends in a facet without its cell");
    const std::size_t n = polygon->corners.size(), e = edge_labelled(*polygon, EdgeLabel::bisector(b));
    geom::ensure(e < n, "oracle: an edge of the diagram ends inside of a facet");
    const EdgeLabel one = polygon->edge_before(e), two = polygon->corners[geom::next_corner(e, n)].edge;
    geom::ensure(one == from || two == from,
                 "oracle: an edge of the diagram does not go on across a facet's edge");
    const EdgeLabel to = one == from ? two : one;
    if (to.is_site()) return {t, 0, ascending(a, b, to.site())};
    const FacetId across = mesh_.across(t, to.edge());
    if (!across.valid()) return no_circle;
    from = EdgeLabel::facet_edge(edge_back(mesh_, t, to.edge(), across));
    t = across;
  }
  geom::ensure(false, "oracle: an edge of the diagram has no end");
  return no_circle;
}

std::vector<KnownCircle> BruteDiagram::circles_on(FacetId t, CornerTypes types) const {
  std::vector<KnownCircle> result;
  for (auto at = polygons_.lower_bound({t, SiteId(0)}); at != polygons_.end() && at->first.first == t; ++at)
    for (std::size_t k = 0; k < at->second.corners.size(); ++k)
      if (is_registered(at->second, k, types)) result.push_back(known(at->second, k));
  std::ranges::sort(result);
  return result;
}

KnownDual BruteDiagram::dual(CornerTypes types) const {
  KnownDual result;
  result.reach.resize(sites_.size(), -infinity);
  for (const auto& [key, polygon] : polygons_) {
    const auto& [t, owner] = key;
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
      const double power = power_at(t, polygon.corners[k].point.position, owner);
      result.reach[owner] = std::max(result.reach[owner], power);
      if (!is_registered(polygon, k, types)) continue;
      KnownCircle c = known(polygon, k);
      const auto& [p, q, r] = c.name.sites;
      if (c.name.place == 0) c.beyond = {other_end(t, q, r, p), other_end(t, r, p, q), other_end(t, p, q, r)};
      result.circles.push_back(c);
    }
  }
  std::ranges::sort(result.circles);
  return result;
}

double BruteDiagram::reach(SiteId p) const {
  double result = -infinity;
  for (const auto& [key, polygon] : polygons_)
    if (key.second == p)
      for (const PolygonCorner& corner : polygon.corners)
        result = std::max(result, power_at(key.first, corner.point.position, p));
  return result;
}

bool BruteDiagram::is_simple(SiteId p) const {
  std::vector<FacetId> facets;
  for (const auto& [key, polygon] : polygons_)
    if (key.second == p) facets.push_back(key.first);
  if (facets.empty()) return false;
  // Connected?
  std::set<FacetId> reached{facets.front()};
  std::vector<FacetId> stack{facets.front()};
  bool has_border = false;
  while (!stack.empty()) {
    const FacetId t = stack.back();
    stack.pop_back();
    for (const PolygonCorner& corner : find(t, p)->corners) {
      if (corner.edge.is_site()) continue;
      const FacetId across = mesh_.across(t, corner.edge.edge());
      has_border |= !across.valid();
      if (across.valid() && find(across, p) && reached.insert(across).second) stack.push_back(across);
    }
  }
  if (reached.size() < facets.size() || has_border) return false;
  // One border? Its edges are walked from one on; at a facet's edge the curve goes on across.
  std::size_t num_edges = 0, walked = 0;
  FacetId start;
  std::size_t first = 0;
  for (const FacetId t : facets)
    for (std::size_t k = 0; k < find(t, p)->corners.size(); ++k)
      if (find(t, p)->corners[k].edge.is_site()) {
        ++num_edges;
        start = t;
        first = k;
      }
  if (num_edges == 0) return false;
  bool has_corners = false;
  FacetId t = start;
  EdgeLabel at = find(t, p)->corners[first].edge;
  bool counterclockwise = true;
  const EdgeLabel first_label = at;
  do {
    if (++walked > num_edges) return false;
    const FacetPolygon& polygon = *find(t, p);
    const std::size_t n = polygon.corners.size(), k = edge_labelled(polygon, at);
    has_corners |= at != first_label;
    EdgeLabel next =
        counterclockwise ? polygon.corners[geom::next_corner(k, n)].edge : polygon.edge_before(k);
    while (!next.is_site()) {  // at once, but around a vertex on no border
      const FacetId across = mesh_.across(t, next.edge());
      const int back = edge_back(mesh_, t, next.edge(), across);
      const FacetPolygon& other = *find(across, p);
      const std::size_t i = edge_labelled(other, EdgeLabel::facet_edge(back)), m = other.corners.size();
      const bool same_sense = mesh_.facet(across)[static_cast<std::size_t>(back)] !=
                              mesh_.facet(t)[static_cast<std::size_t>(next.edge())];
      if (!same_sense) counterclockwise = !counterclockwise;
      t = across;
      next = counterclockwise ? other.corners[geom::next_corner(i, m)].edge : other.edge_before(i);
    }
    at = next;
  } while (t != start || at != first_label);
  return walked == num_edges && has_corners;
}

std::vector<KnownCircle> circles_of(const geom::RestrictedDual& dual, std::span<const SiteId> present) {
  const auto name_of = [&](CircleId id) {
    if (!id.valid()) return no_circle;
    const EmptyCircle& c = dual.circle(id);
    for (const SiteId s : c.sites)
      geom::ensure(!s.valid() || std::ranges::count(dual.circles_of(s), id) == 1,
                   "a circle is not listed at each of its sites");
    return CircleName{c.facet, c.place, c.sites};
  };
  std::vector<KnownCircle> result;
  for (const SiteId s : present)
    for (const CircleId id : dual.circles_of(s)) {
      const EmptyCircle& c = dual.circle(id);
      geom::ensure(c.touches(s), "a circle is listed at a site that it does not touch");
      if (c.sites[0] != s) continue;
      KnownCircle known{name_of(id), c.clockwise, {c.center.x(), c.center.y(), c.center.z()}, c.radius2, {}};
      for (std::size_t i = 0; i < 3; ++i) known.beyond[i] = name_of(c.beyond[i]);
      result.push_back(known);
    }
  std::ranges::sort(result);
  return result;
}

}  // namespace oracle
