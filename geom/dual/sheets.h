#pragma once
// Where the surface is one sheet: the proof that a cell has no second component.
//
// Let S be the surface, p0 on it, and R such that (1) every facet that meets the ball B about p0 of radius R has a unit
// normal n with n.m >= cos(theta), tan(theta) = s < 1, for one axis m; (2) every edge that meets B has two facets; (3) the
// facets that meet B hang together by edges that meet B.
//
// Then S within B is the graph of a function over the plane normal to m. From p0 walk along S above a straight line:
// by (1) and (2) S goes on, with slope at most s, until B ends. At horizontal distance t and height h,
// |h| <= s t, and the squared distance t^2 + h^2 grows, its derivative being at least 2t (1 - s^2): so a walk that
// has left B does not come back. The walks in all directions cover a part A of S in B that is open (they can be
// turned a little) and closed in the interior of B (a limit of walks is one that stays in B, for distances grow). By (3)
// S in B is connected, so A is all of it. In particular S in B lies once above each location within R / sqrt(1 + s^2)
// of p0, horizontally.
//
// Now let p be on S at distance r from p0, and a cell of p be known: near p, bounded by the bisectors of sites q
// ("link"). Let z be a location of S at distance at most D <= R / sqrt(1 + s^2) - r of p that is nearest to p of all
// sites. The straight horizontal line from p to z stays within R / sqrt(1 + s^2) of p0, hence S has one path above
// it, from p to z. Let d = q - p, a = d.m its height and d_h its horizontal part, and for each q of the link
// g(t) = c - 2 d.(z(t) - p), c = |d|^2 - (w_q - w_p) > 0, the lead of p over q on the path, in direction u:
//
//     g' = -2 (d_h.u + a h'),  |h'| <= s.   If d_h.u > s|a|, the lead falls all the way: once lost it stays lost. If
//     d_h.u < -s|a|, it grows and is never lost. Between the two it falls by at most 4 s |a| D in all.
//
// So if c > 4 s |a| D for every q of the link, no lead that is lost is won back. If z were in another component of p's
// cell, the path would leave the known one, where some q of the link takes the lead from p and keeps it up to z: then
// p is not nearest there. Hence there is no other component within D of p.
//
// Rounding: p is off S by the last bits; the known cell holds the location of S next to it, as c is positive by far.
// Distances and products here are computed with relative errors of some 1e-15, normals within 1e-7 (needles, whose
// normals are not, make no sheet); the code asks for a millionth more than the bounds say.

#include <array>
#include <span>
#include <unordered_map>
#include <vector>

#include "geom/facet_tree.h"
#include "geom/trimesh.h"

namespace geom {

/// Sheets, made where they are asked for and kept: one for each cell of a grid, whose size follows the radius.
class Sheets {
 public:
  /// The surface in the ball about a location on it.
  struct Sheet {
    Vec3 center{0, 0, 0};  ///< p0
    Vec3 axis{0, 0, 1};
    double slope = 0;
    double width = -1;                   ///< R / sqrt(1 + s^2); negative: the surface is no sheet there
    std::int32_t first = -1, last = -1;  ///< of its facets, if they were asked for
  };

  /// Keeps references.
  Sheets(const TriMesh& mesh, const FacetTree& facets)
      : mesh_(mesh), facets_(facets), stamp_of_(mesh.num_facets(), 0) {}

  /// Is there surely no second component of the cell of p within `distance` of it, given its link: the differences
  /// q - p and the numbers c? p is on the surface. Amortised O(1).
  struct Neighbour {
    Vec3 offset;
    double lead;
  };
  bool has_one_component(const Vec3& p, double distance, std::span<const Neighbour> link);
  /// What is known where a ball of that radius about p is asked about.
  const Sheet& around(const Vec3& p, double distance) {
    double level_radius = 0;
    return at(p, distance, level_radius);
  }
  /// All facets that come within that distance of p, and more. Valid until the next call of any of these.
  std::span<const FacetId> facets_within(const Vec3& p, double distance);

  std::size_t num_places() const { return places_.size(); }

 private:
  struct Key {
    std::int32_t level;
    std::array<std::int32_t, 3> cell;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const {
      std::uint64_t x = static_cast<std::uint32_t>(k.level);
      for (const std::int32_t c : k.cell)
        x = (x ^ static_cast<std::uint32_t>(c)) * 0x9e3779b97f4a7c15u, x ^= x >> 29;
      return x;
    }
  };
  /// That of p and a distance, and its level's radius, which is no less.
  Sheet& at(const Vec3& p, double distance, double& level_radius);
  void make(Sheet& place, double radius);
  bool hangs_together(const Vec3& center, double radius);

  const TriMesh& mesh_;
  const FacetTree& facets_;
  int level_ = 0;
  double level_radius_ = 0;  ///< that serves the distances asked for last
  std::unordered_map<Key, Sheet, Hash> places_;
  std::vector<FacetId> lists_;
  std::vector<FacetId> near_, stack_;  // workspaces
  std::vector<Vec3> normals_;
  Table<FacetId, std::uint32_t> stamp_of_;
  std::uint32_t stamp_ = 0;
};

}  // namespace geom
