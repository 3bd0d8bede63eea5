#include "geom/power/restricted_power.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geom/check.h"
#include "geom/power/divided_surface.h"

namespace geom {

double extent_of(const TriMesh& mesh) {
  require(mesh.num_facets() > 0, "the surface has no facet");
  double extent =
      std::max(mesh.box().min().lpNorm<Eigen::Infinity>(), mesh.box().max().lpNorm<Eigen::Infinity>());
  if (mesh.has_levels())
    for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
      extent = std::max(extent, std::abs(mesh.level(v)));
  return extent * (1 + 1e-9);
}

namespace {

/// Sites may be anywhere.
double extent_with(const TriMesh& mesh, std::span<const WeightedPoint3> points) {
  double extent = extent_of(mesh);
  for (const WeightedPoint3& point : points)
    extent = std::max({extent, point.position.lpNorm<Eigen::Infinity>(), std::abs(point.level)});
  return extent;
}

}  // namespace

RestrictedPower::RestrictedPower(const TriMesh& mesh, std::span<const WeightedPoint3> points,
                                 const NeighbourOracle& search, int threads)
    : mesh_(mesh),
      sites_(points.begin(), points.end()),
      clipper_(mesh, sites_, extent_with(mesh, points)),
      store_(mesh),
      division_(clipper_, store_) {
  ensure(!points.empty(), "restricted power diagram: of some sites");
  const std::vector<FacetId> order = facets_along_curve(mesh_);
  const DividedSurface surface{mesh_, sites_, clipper_, search};
  surface.for_each(order, threads, [&](FacetId t, std::span<const FacetPiece> pieces) {
    for (const auto& [owner, corners] : pieces) {
      polygon_.facet = t;
      polygon_.owner = owner;
      polygon_.corners.assign(corners.begin(), corners.end());
      commit(FragmentId(), polygon_);
    }
  });
}

/// Gives fragment f (created if none) this polygon.
void RestrictedPower::commit(FragmentId f, const FacetPolygon& polygon) {
  if (!f.valid()) f = store_.create(polygon.owner, polygon.facet);
  store_.set_corners(f, polygon.corners);
  store_.set_max_radius2(f, clipper_.bound_power(polygon));
}

double RestrictedPower::reach(SiteId p) const {
  double result = -std::numeric_limits<double>::infinity();
  for (const FragmentId f : store_.of_cell(p)) result = std::max(result, store_.max_radius2(f));
  return result;
}

// --- giving parts of a cell to others ------------------------------------------------------------

bool RestrictedPower::abandon(SiteId p, std::span<const FragmentId> fragments,
                              std::span<const SiteId> excluded, const NeighbourOracle& search) {
  const std::vector<FragmentId> vacated(fragments.begin(), fragments.end());
  division_.begin(p, vacated, excluded);
  if (division_.heirs().size() == 0) return false;
  do division_.divide();
  while (add_missing_heirs(p, search));
  const bool fits = !division_.misfit() && std::ranges::all_of(division_.shares(), [&](const auto& share) {
    return !share.joins.valid() || seam_of(share.joins, share.polygon, p).fits;
  });
  if (!fits) return false;
  for (const FragmentId f : vacated) store_.erase(f);
  for (auto& [joins, share] : division_.shares()) {
    if (joins.valid()) unite(joins, share, p, polygon_);
    commit(joins, joins.valid() ? polygon_ : share);
  }
  return !division_.shares().empty();
}

/// Asks the source for sites that beat the division somewhere; true if there are any, which are heirs now.
bool RestrictedPower::add_missing_heirs(SiteId p, const NeighbourOracle& source) {
  // At the corners of p's cell the power has not changed.
  const double radius2 = std::max(reach(p) + sites_[p].weight, 0.0);
  candidates_.clear();
  source.heirs({p, sites_[p].position, std::sqrt(radius2), std::max(reach(p), division_.max_radius2())},
               candidates_);
  std::ranges::sort(candidates_);
  const std::size_t known = division_.heirs().size();
  std::erase_if(candidates_, [&](SiteId j) { return !division_.heirs().is_stranger(j); });
  for (const SiteId j : candidates_)
    if (division_.is_missing(j)) division_.heirs().add(j);
  return division_.heirs().size() > known;
}

//     old fragment of k       Both are convex and share the edge between k and p, so their union (convex
//    b ___________ a          again, a fragment of the new diagram) is the old polygon with that edge
//     \_____p_____/           replaced by the rest of the share: its edges from a to b. The lines of a and
//      \  share  /            b go on across the corners where they met p, so these corners vanish.
//       \__x1___/
RestrictedPower::Seam RestrictedPower::seam_of(FragmentId old, const FacetPolygon& share, SiteId p) const {
  const EdgeLabel border = EdgeLabel::bisector(p);
  const std::span<const PolygonCorner> corners = store_.corners(old);
  const auto position = [&](std::span<const PolygonCorner> of) {
    return static_cast<std::size_t>(std::ranges::find(of, border, &PolygonCorner::edge) - of.begin());
  };
  const std::size_t n = corners.size(), q = position(corners), m = share.corners.size(),
                    g = position(share.corners);
  return {q, g,
          q < n && g < m && corners[(q + n - 1) % n].edge == share.corners[(g + 1) % m].edge &&
              corners[(q + 1) % n].edge == share.corners[(g + m - 1) % m].edge};
}

/// The union of an old fragment and a share of p's.
void RestrictedPower::unite(FragmentId old, const FacetPolygon& share, SiteId p, FacetPolygon& out) const {
  const auto [q, g, fits] = seam_of(old, share, p);
  ensure(fits, "restricted power diagram: a share does not fit its neighbour");
  const std::span<const PolygonCorner> corners = store_.corners(old);
  const std::size_t n = corners.size(), m = share.corners.size();
  out.facet = share.facet;
  out.owner = share.owner;
  out.corners.clear();
  for (std::size_t i = next_corner(next_corner(q, n), n); i != q; i = next_corner(i, n))
    out.corners.push_back(corners[i]);
  for (std::size_t i = next_corner(next_corner(g, m), m); i != g; i = next_corner(i, m))
    out.corners.push_back(share.corners[i]);
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
  for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1)) {
    ensure(!store_.of_facet(t).empty(), "restricted power diagram: a facet without owner");
    for (const FragmentId f : store_.of_facet(t)) {
      const std::span<const PolygonCorner> corners = store_.corners(f, buffer);
      ensure(corners.size() >= 3, "restricted power diagram: a polygon with fewer than three corners");
      for (const PolygonCorner& corner : corners) {
        if (!corner.edge.is_site()) continue;
        const FragmentId other = store_.find(corner.edge.site(), t);
        ensure(other.valid(), "restricted power diagram: a label names a site that has nothing in the facet");
        const auto back = std::ranges::count_if(store_.corners(other), [&](const PolygonCorner& c) {
          return c.edge == EdgeLabel::bisector(store_.site(f));
        });
        ensure(back == 1, "restricted power diagram: two cells disagree on their common edge");
      }
    }
  }
}

}  // namespace geom
