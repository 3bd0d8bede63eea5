#pragma once
// Where the surface is one sheet: the proof that a cell has no second component.
//
// Let S be the surface, p0 on it, and R such that (1) every facet that meets the ball B about p0 of radius R
// has a unit normal n with n.m >= cos(theta), tan(theta) = s < 1, for one axis m; (2) every edge that meets B
// has two facets; (3) the facets that meet B hang together by edges that meet B.
//
// Then S within B is the graph of a function over the plane normal to m. From p0 walk along S above a
// straight line: by (1) and (2) S goes on, with slope at most s, until B ends. At horizontal distance t and
// height h, |h| <= s t, and the squared distance t^2 + h^2 grows, its derivative being at least 2t (1 - s^2):
// so a walk that has left B does not come back. The walks in all directions cover a part A of S in B that is
// open (they can be turned a little) and closed in the interior of B (a limit of walks is one that stays in
// B, for distances grow). By (3) S in B is connected, so A is all of it. Let H bound the height |h| of the
// facets that meet B, as far as they lie within R of p0 horizontally; H <= s R. A walk leaves B at t^2 + h^2
// = R^2, so not before the width W = sqrt(R^2 - H^2): S in B lies once above each location within W of p0,
// horizontally.
//
// Now let p be on S at distance r from p0, and a part K of the cell of p known that has p inside: near p,
// bounded by the bisectors of sites q ("link"), all within distance r_K of p. Let z be a location of S at
// distance at most D <= W - r of p that is nearest to p of all sites. The straight horizontal line from p to
// z stays within W of p0, hence S has one path above it, from p to z. Let d = q - p, a = d.m its height and
// d_h its horizontal part, and for each q of the link g(t) = c - 2 d.(z(t) - p), c = |d|^2 - (w_q - w_p) > 0,
// the lead of p over q on the path, in direction u:
//
//     g' = -2 (d_h.u + a h'),  |h'| <= s.   If d_h.u > s|a|, the lead falls all the way: once lost it stays
//     lost. If d_h.u < -s|a|, it grows and is never lost. Between the two it falls by at most 4 s |a| r_K up
//     to the border of K.
//
// So if c > 4 s |a| r_K for every q of the link, no lead that is lost at the border of K is won back. If z
// were not in K, the path would leave K, where some q of the link takes the lead from p and keeps it up to z:
// then p is not nearest there. Hence there is no other component within D of p. (That p is inside of a K
// known by its border alone follows in the same way: the locations where p leads over the link make a set
// that no such line from p leaves twice, up to r_K.)
//
// Rounding: p is off S by the last bits; the known cell holds the location of S next to it, as c is positive
// by far. Distances and products here are computed with relative errors of some 1e-15, normals within 1e-7
// (needles, whose normals are not, make no sheet); the code asks for a millionth more than the bounds say.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "geom/mesh/facet_tree.h"
#include "geom/mesh/trimesh.h"
#include "geom/power/facet_balls.h"

namespace geom {

/// The surface in the ball about a location on it. There is one for each site: bounds are floats.
struct Sheet {
  Vec3 center{0, 0, 0};  ///< p0
  Vec3 axis{0, 0, 1};
  Vec3 u{1, 0, 0};   ///< across, the direction of most slopes
  double level = 0;  ///< of all facets of the ball; those whose levels are R away are not in it (levels.h)
  float slope = 0;   ///< s
  float slope_u = 0, slope_v = 0;  ///< the components of the gradient along u and m x u are at most that
  float height = 0;                ///< H
  float width = -1;                ///< W; negative: the surface is no sheet there

  /// Does what was said of D hold for p?
  bool covers(const Vec3& p, double distance) const {
    return width > 0 && (distance + (p - center).norm()) * (1 + 1e-6) < width;
  }
  /// A bound of R, if this is a sheet.
  double radius() const { return std::hypot(double{width}, double{height}) * (1 + 4e-6); }
  /// The largest such D, nearly.
  double distance_from(const Vec3& p) const { return double{width} / (1 + 2e-6) - (p - center).norm(); }
};

/// Sheets, made where they are asked for and kept, one for each site. Of more than most_kept sites those
/// whose ids are alike modulo that share a place: each asked for takes it, and the other's is made again when
/// that is asked for. At 300,000 sites that costs no time (`build/bench-surface cube.obj 300000 3`).
class Sheets {
 public:
  static constexpr std::size_t most_kept = 1U << 17U;  ///< some 128 bytes each

  /// Keeps references.
  Sheets(const TriMesh& mesh, const FacetTree& facets, const FacetBalls& balls);

  /// A sheet that covers that distance about the place of the site, on the surface; null if there is none, or
  /// was none when the site was nearly there. Valid until the next call.
  const Sheet* around(SiteId site, const Location3& at, double distance);
  /// The one that is kept, of that level, or null.
  const Sheet* known(SiteId site, double level) const {
    const std::size_t i = site.index() % most_kept;
    if (i >= kept_.size() || kept_[i].site != site) return nullptr;
    const Sheet& sheet = kept_[i].sheet;
    return sheet.width > 0 && sheet.level == level ? &sheet : nullptr;
  }
  void reserve(std::size_t num_sites) { kept_.reserve(std::min(num_sites, most_kept)); }
  /// Those kept are made again where they are asked for.
  void forget() { std::vector<OfSite>().swap(kept_); }
  /// Keeps one that was made elsewhere: the surface must be the same there.
  void keep(SiteId site, const Sheet& sheet);
  /// Is there surely no second component of the cell of p within the distance that the sheet covers, given
  /// its link: the differences q - p and the numbers c? `radius`: r_K.
  struct Neighbour {
    Vec3 offset;
    double lead;
  };
  static bool has_one_component(const Sheet& sheet, double radius, std::span<const Neighbour> link);
  /// What the ball of that radius about a location on the surface is, at that center.
  Sheet sheet_in(const Location3& center, double radius);

 private:
  struct OfSite {
    Sheet sheet;
    float failed = std::numeric_limits<float>::infinity();  ///< a distance for which there was none
    Eigen::Vector3f failed_at{0, 0, 0};
    float failed_level = 0;
    SiteId site;
  };
  OfSite& of_site(SiteId site);
  Sheet sheet_among_gathered(const Location3& center, double radius);
  bool keep_near(const Location3& center, double radius);
  enum class Within { no, partly, whole };
  Within compare(FacetId t, const Vec3& center, double radius) const;
  bool find_axis(Sheet& sheet) const;
  void find_slopes(Sheet& sheet, double radius);
  bool hangs_together(const Vec3& center, double radius);

  const TriMesh& mesh_;
  const FacetTree& facets_;
  const FacetBalls& balls_;
  Table<FacetId, Vec3> normal_of_;  ///< units; 0 of needles, whose normals are not known within 1e-7
  std::vector<OfSite> kept_;        ///< at the site's id, modulo most_kept
  std::vector<FacetId> gathered_, near_, stack_;  // workspaces
  std::vector<Vec3> normals_;
  std::vector<Vec2> gradients_;
  Table<FacetId, std::uint32_t> stamp_of_;
  std::uint32_t stamp_ = 0;
};

}  // namespace geom
