#include "geom/restricted_power.h"

#include <algorithm>
#include <tuple>

#include "geom/check.h"
#include "geom/scaling.h"

namespace geom {
namespace {

/// Sites are rounded from locations on the surface and may leave its box by a little.
double extent_of(const TriMesh& mesh) {
  require(mesh.num_facets() > 0, "the surface has no facet");
  return std::max(mesh.box().min().lpNorm<Eigen::Infinity>(), mesh.box().max().lpNorm<Eigen::Infinity>()) *
         (1 + 1e-9);
}

}  // namespace

RestrictedPower::RestrictedPower(const TriMesh& mesh, NeighbourSource& neighbours, CornerTypes types)
    : mesh_(mesh),
      neighbours_(neighbours),
      types_(types),
      extent_(extent_of(mesh)),
      clipper_(mesh, sites_, extent_),
      store_(mesh),
      division_(mesh, sites_, clipper_, store_),
      assembly_(mesh, clipper_) {
  if (types_ == CornerTypes::c_only) return;
  first_facet_.resize(mesh.num_vertices());
  vertex_circle_.resize(mesh.num_vertices());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (const VertexId v : mesh.facet(t))
      if (!first_facet_[v].valid()) first_facet_[v] = t;
}

// --- fragments and their circles -----------------------------------------------------------------

/// Gives fragment f (created if none) this polygon; returns the bound of its power. Corners that stay bring
/// their circles along; the circles of those that do not are the caller's to erase.
double RestrictedPower::commit(FragmentId f, FacetPolygon& polygon) {
  if (f.valid()) {
    change_.cut.push_back({polygon.owner, polygon.facet});
  } else {
    f = store_.create(polygon.owner, polygon.facet);
    change_.created.push_back({polygon.owner, polygon.facet});
  }
  register_corners(polygon);
  store_.set_corners(f, polygon.corners);
  const double max_radius2 = clipper_.bound_power(polygon);
  store_.set_max_radius2(f, max_radius2);
  return max_radius2;
}

void RestrictedPower::link(SiteId p, std::vector<SiteId>& out) const {
  out.clear();
  for (CircleId c = first_circle(p); c.valid(); c = next_circle(c, p))
    for (const SiteId s : circles_[c].sites)
      if (s.valid() && s != p) out.push_back(s);
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

void RestrictedPower::forget(FragmentId f) {
  for (const PolygonCorner& corner : store_.corners(f)) erase_circle_of(corner);
  change_.erased.push_back({store_.site(f), store_.facet(f)});
  store_.erase(f);
}

/// Each C corner is seen from three cells: the one of smallest id registers it. A B corner is registered by
/// the smaller id in the smaller facet, an A corner in the first facet of the vertex. Corners that have a
/// circle keep it.
void RestrictedPower::register_corners(FacetPolygon& polygon) {
  EdgeLabel before = polygon.corners.back().edge;
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    PolygonCorner& corner = polygon.corners[k];
    const EdgeLabel after = corner.edge;
    if (!corner.circle.valid()) {
      if (before.is_site() && after.is_site()) {
        if (polygon.owner < before.site() && polygon.owner < after.site())
          corner.circle = create_circle(polygon, k, 0);
      } else if (types_ == CornerTypes::all) {
        if (before.is_site() || after.is_site())
          register_on_edge(polygon, k);
        else
          register_at_vertex(polygon, k);
      }
    }
    before = after;
  }
}

void RestrictedPower::register_on_edge(FacetPolygon& polygon, std::size_t k) {
  const EdgeLabel before = polygon.edge_before(k), after = polygon.corners[k].edge;
  const EdgeLabel edge = before.is_site() ? after : before, site = before.is_site() ? before : after;
  const FacetId across = mesh_.across(polygon.facet, edge.edge());
  if (polygon.owner < site.site() && (!across.valid() || polygon.facet < across))
    polygon.corners[k].circle = create_circle(polygon, k, 1 + edge.edge());
}

void RestrictedPower::register_at_vertex(const FacetPolygon& polygon, std::size_t k) {
  const int i = polygon.corners[k].edge.edge();  // edges i - 1 and i meet in corner i
  const VertexId v = mesh_.facet(polygon.facet)[static_cast<std::size_t>(i)];
  CircleId& circle = vertex_circle_[v];
  if (first_facet_[v] != polygon.facet || (circle.valid() && circles_[circle].sites[0] == polygon.owner))
    return;
  if (circle.valid()) erase_circle(circle);
  circle = create_circle(polygon, k, 4 + i);
}

CircleId RestrictedPower::create_circle(const FacetPolygon& polygon, std::size_t corner, std::int32_t place) {
  EmptyCircle circle;
  circle.facet = polygon.facet;
  circle.place = place;
  circle.sites = {polygon.owner, SiteId(), SiteId()};
  std::size_t n = 1;
  for (const EdgeLabel label : {polygon.edge_before(corner), polygon.corners[corner].edge})
    if (label.is_site()) circle.sites[n++] = label.site();
  if (n == 3 && circle.sites[2] < circle.sites[1]) std::swap(circle.sites[1], circle.sites[2]);
  center_circle(circle, polygon.corners[corner].point.position);
  const CircleId c = circles_.create(circle);
  change_.circles_created.push_back(c);
  return c;
}

/// A site may come to the center: not outside of the facet's box, hence the mesh's, by rounding.
void RestrictedPower::center_circle(EmptyCircle& circle, const Vec3& corner) const {
  const Vec3 &q0 = mesh_.corner(circle.facet, 0), &q1 = mesh_.corner(circle.facet, 1),
             &q2 = mesh_.corner(circle.facet, 2);
  circle.center =
      snapped(corner.cwiseMax(q0.cwiseMin(q1).cwiseMin(q2)).cwiseMin(q0.cwiseMax(q1).cwiseMax(q2)));
  circle.radius2 = power(circle.center, sites_[circle.sites[0]]);
}

/// The id is used again only after the next update has begun, so the owner of a heap can still compare it in
/// this one.
void RestrictedPower::erase_circle(CircleId c) {
  circles_.erase(c);
  change_.circles_erased.push_back(c);
}

bool RestrictedPower::circle_before(const EmptyCircle& a, const EmptyCircle& b) {
  return std::tie(a.facet, a.place, a.sites) < std::tie(b.facet, b.place, b.sites);
}

// --- for tests -----------------------------------------------------------------------------------

std::vector<RestrictedPower::Canonical> RestrictedPower::canonical() const {
  std::vector<Canonical> result;
  std::array<PolygonCorner, 3> buffer;
  for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1))
    for (const FragmentId f : store_.of_facet(t)) {
      Canonical fragment{t, store_.site(f), {}};
      for (const PolygonCorner& corner : store_.corners(f, buffer)) fragment.labels.push_back(corner.edge);
      std::rotate(fragment.labels.begin(), std::ranges::min_element(fragment.labels), fragment.labels.end());
      result.push_back(std::move(fragment));
    }
  std::ranges::sort(result);
  return result;
}

void RestrictedPower::check() const {
  store_.check();
  std::array<PolygonCorner, 3> buffer;
  std::size_t registered = 0;
  for (SiteId s(0); s.index() < reach_.size(); s = SiteId(s.value + 1))
    for (const FragmentId f : store_.of_cell(s))
      ensure(store_.max_radius2(f) <= reach_[s],
             "restricted power diagram: a cell reaches farther than it says");
  for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1)) {
    ensure(store_.size() == 0 || !store_.of_facet(t).empty(),
           "restricted power diagram: a facet without owner");
    for (const FragmentId f : store_.of_facet(t)) {
      const std::span<const PolygonCorner> corners = store_.corners(f, buffer);
      ensure(corners.size() >= 3, "restricted power diagram: a polygon with fewer than three corners");
      for (std::size_t k = 0; k < corners.size(); ++k) {
        registered += corners[k].circle.valid();
        if (!corners[k].edge.is_site()) continue;
        const FragmentId other = store_.find(corners[k].edge.site(), t);
        ensure(other.valid(), "restricted power diagram: a label names a site that has nothing in the facet");
        const auto back = std::ranges::count_if(store_.corners(other), [&](const PolygonCorner& c) {
          return c.edge == EdgeLabel::bisector(store_.site(f));
        });
        ensure(back == 1, "restricted power diagram: two cells disagree on their common edge");
      }
    }
  }
  for (const CircleId c : vertex_circle_) registered += c.valid();
  ensure(registered + circles_.num_free() + change_.circles_erased.size() == circles_.num_ids(),
         "restricted power diagram: a circle is lost");
  ensure(circles_.check() == registered, "restricted power diagram: circles registered and listed differ");
}

}  // namespace geom
