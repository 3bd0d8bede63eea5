#pragma once
// The restricted dual, slow and obvious: all facets clipped for all sites, corners registered as state.h
// says, edges followed from facet to facet.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "geom/dual/restricted_dual.h"
#include "geom/power/restricted_power.h"

namespace oracle {

/// A circle by the labels of its corner.
struct CircleName {
  geom::FacetId facet;
  std::int16_t place = 0;
  std::array<geom::SiteId, 3> sites;
  auto operator<=>(const CircleName&) const = default;
};
inline constexpr CircleName no_circle{};

/// All that is known of a circle, ids left out.
struct KnownCircle {
  CircleName name;
  bool clockwise = false;
  std::array<double, 3> center{};
  double radius2 = 0;
  std::array<CircleName, 3> beyond{};
  auto operator<=>(const KnownCircle&) const = default;
};

/// A dual as it is, circles ascending.
struct KnownDual {
  std::vector<KnownCircle> circles;
  geom::Table<geom::SiteId, double>
      reach;  ///< of each site the most power at a corner of its cell; -infinity: no cell
};

/// The polygons of a diagram by brute force. O(F n^2).
class BruteDiagram {
 public:
  /// Of these sites among all that the table has.
  BruteDiagram(const geom::TriMesh& mesh, const geom::Clipper::Sites& sites,
               std::span<const geom::SiteId> present);
  /// On these facets alone: then neither dual() nor is_simple() can be asked.
  BruteDiagram(const geom::TriMesh& mesh, const geom::Clipper::Sites& sites,
               std::span<const geom::SiteId> present, std::span<const geom::FacetId> facets);

  KnownDual dual(geom::CornerTypes types) const;
  /// The circles of one facet, ascending, without those beyond.
  std::vector<KnownCircle> circles_on(geom::FacetId t, geom::CornerTypes types) const;
  /// -infinity: no cell.
  double reach(geom::SiteId p) const;
  /// Is the cell connected across edges of the surface, clear of the surface's borders, its own border one
  /// closed curve with circles? What the fast way calls regular.
  bool is_simple(geom::SiteId p) const;
  /// The circle at the other end of the edge between a and b that begins at the corner of a, b, c in t.
  CircleName other_end(geom::FacetId t, geom::SiteId a, geom::SiteId b, geom::SiteId c) const;

  const std::map<std::pair<geom::FacetId, geom::SiteId>, geom::FacetPolygon>& polygons() const {
    return polygons_;
  }

 private:
  KnownCircle known(const geom::FacetPolygon& polygon, std::size_t corner) const;
  bool is_registered(const geom::FacetPolygon& polygon, std::size_t corner, geom::CornerTypes types) const;
  const geom::FacetPolygon* find(geom::FacetId t, geom::SiteId owner) const;
  double power_at(geom::FacetId t, const geom::Vec3& x, geom::SiteId owner) const;

  const geom::TriMesh& mesh_;
  const geom::Clipper::Sites& sites_;
  geom::FacetLevels levels_;
  std::map<std::pair<geom::FacetId, geom::SiteId>, geom::FacetPolygon> polygons_;
};

/// The circles of a dual whose sites are these. Throws geom::Bug if one is not listed at each of its sites,
/// or one beyond is not one of them.
std::vector<KnownCircle> circles_of(const geom::RestrictedDual& dual, std::span<const geom::SiteId> present);

/// The polygon of one site on one facet, by brute force. O(n). No corners: none.
geom::FacetPolygon part_of(geom::Clipper& clipper, geom::FacetId t, geom::SiteId owner,
                           std::span<const geom::SiteId> present);

}  // namespace oracle
