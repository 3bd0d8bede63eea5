#pragma once
// The state of the restricted dual: its empty circles, each with the three around it.
//
//        .------ b ------.        The sites a, b, c meet in the corner of their cells that is the circle's
//         \     /|\     /         center. Three edges of the diagram begin there; each ends in another
//          \   / | \   /          corner, where a fourth site meets two of them: the circle `beyond` that
//           \ /  |  \ /           edge. In the dual a circle is a triangle, and the circle beyond is the
//            a-------c            triangle across its edge.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/ids.h"
#include "geom/prefetch.h"
#include "geom/short_lists.h"
#include "geom/vec.h"

namespace geom {

/// A corner of the diagram. All fields but `beyond` are functions of the mesh and of the sites that meet
/// there, not of history. One line of the cache.
struct EmptyCircle {
  Vec3 center{0, 0, 0};
  double radius2 = 0;
  FacetId facet;                ///< it lies in; the smallest for a B or A corner
  std::array<SiteId, 3> sites;  ///< ascending; the last one none for B, the last two for A
  std::array<CircleId, 3>
      beyond{};            ///< the circle at the other end of the edge opposite to a site; none at borders
  std::int16_t place = 0;  ///< C: 0, B: 1 + facet edge, A: 4 + facet corner
  bool clockwise = false;  ///< in the facet, seen from outside, the sites run clockwise

  bool touches(SiteId p) const { return sites[0] == p || sites[1] == p || sites[2] == p; }
  bool is_triangle() const { return sites[2].valid(); }
  /// Does the edge of the diagram between a and b end here?
  bool has_side(SiteId a, SiteId b) const { return is_triangle() && touches(a) && touches(b); }
  /// Puts sites that run counterclockwise in ascending order and notes which way they run then.
  void sort_counterclockwise();
  /// The place of p among the sites.
  std::size_t index_of(SiteId p) const { return sites[0] == p ? 0 : sites[1] == p ? 1 : 2; }
  /// The place after i, counterclockwise; the place before it.
  std::size_t after(std::size_t i) const { return wrapped(i + 1 + clockwise); }
  std::size_t before(std::size_t i) const { return wrapped(i + 2 - clockwise); }
  /// The place of the circle opposite to the edge of a and b.
  std::size_t opposite(SiteId a, SiteId b) const {
    for (std::size_t i = 0; i < 2; ++i)
      if (sites[i] != a && sites[i] != b) return i;
    return 2;
  }

 private:
  static std::size_t wrapped(std::size_t i) { return i < 3 ? i : i - 3; }
};

/// The order of circles of equal radius2: by facet, place and sites.
bool circle_before(const EmptyCircle& a, const EmptyCircle& b);

/// The circles and, of each site, those that touch it. Ids never move. O(circles of a site) all, but check().
class EmptyCircles {
 public:
  std::size_t num_ids() const { return circles_.size(); }  ///< erased ones included
  std::size_t size() const { return live_; }
  const EmptyCircle& operator[](CircleId c) const { return circles_[c]; }

  CircleId create(const EmptyCircle& circle);
  /// Takes the circle off the lists. It can still be read: its id is used again only when it is recycled.
  void erase(CircleId c);
  void recycle(std::span<const CircleId> erased) { free_.insert(free_.end(), erased.begin(), erased.end()); }
  /// The same sites meet somewhere else.
  void move(CircleId c, const Vec3& center, double radius2, FacetId facet) {
    circles_[c].center = center;
    circles_[c].radius2 = radius2;
    circles_[c].facet = facet;
  }
  void set_beyond(CircleId c, std::size_t side, CircleId other) { circles_[c].beyond[side] = other; }
  void reserve(std::size_t num_sites);

  /// The circles that touch p, each once, in an order that depends on history. Valid until the next create().
  std::span<const CircleId> of_site(SiteId p) const { return of_site_[p]; }

  // These ask the memory for the list of a site, its members, a circle. No effect but on speed.
  void prefetch_list(SiteId p) const { of_site_.prefetch_list(p); }
  void prefetch_members(SiteId p) const { of_site_.prefetch_members(p); }
  void prefetch(CircleId c) const { geom::prefetch(circles_.data() + c.index()); }

  /// Verifies the lists, and that circles beyond each other agree. Throws Bug. O(all).
  void check() const;

 private:
  Table<CircleId, EmptyCircle> circles_;
  ShortLists<SiteId, CircleId> of_site_;
  std::vector<CircleId> free_;
  std::size_t live_ = 0;
};

}  // namespace geom
