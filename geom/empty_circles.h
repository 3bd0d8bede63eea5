#pragma once
// The empty circles of a restricted diagram as a data structure: each in the lists of the sites that it touches.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/ids.h"
#include "geom/prefetch.h"
#include "geom/vec.h"

namespace geom {

/// A registered corner. All fields are functions of the mesh and of the sites that meet there, not of
/// history.
struct EmptyCircle {
  Vec3 center;
  double radius2 = 0;
  FacetId facet;                ///< it lies in; the smallest for a B or A corner
  std::array<SiteId, 3> sites;  ///< ascending; the last one none for B, the last two for A
  std::int32_t place = 0;       ///< C: 0, B: 1 + facet edge, A: 4 + facet corner
};

/// Ids never move. O(1) all, but check().
class EmptyCircles {
 public:
  std::size_t num_ids() const { return circles_.size(); }  ///< erased ones included
  std::size_t num_free() const { return free_.size(); }
  const EmptyCircle& operator[](CircleId c) const { return circles_[c]; }

  CircleId create(const EmptyCircle& circle);
  /// Takes the circle off the lists. It can still be read: its id is used again only when it is recycled.
  void erase(CircleId c);
  void recycle(std::span<const CircleId> erased) { free_.insert(free_.end(), erased.begin(), erased.end()); }
  void move(CircleId c, const Vec3& center, double radius2) {
    circles_[c].center = center;
    circles_[c].radius2 = radius2;
  }

  /// The circles that touch p, each once, in an order that depends on history.
  CircleId first(SiteId p) const { return p.index() < first_.size() ? first_[p].circle() : CircleId(); }
  CircleId next(CircleId c, SiteId p) const { return links_[c].next[place_of(p, c)].circle(); }

  /// Asks the memory for a circle. No effect but on speed.
  void prefetch(CircleId c) const {
    geom::prefetch(circles_.data() + c.index());
    geom::prefetch(links_.data() + c.index());
  }

  /// Verifies the lists; returns the number of circles in them. Throws Bug. O(all).
  std::size_t check() const;

 private:
  /// A circle in the list of one of its sites: the circle, and the place of the site in it.
  class Spoke {
   public:
    Spoke() = default;
    Spoke(CircleId c, std::size_t place) : code_(c.value * 4 + static_cast<std::int32_t>(place)) {}
    bool valid() const { return code_ >= 0; }
    CircleId circle() const { return CircleId(code_ >> 2); }  // none stays none
    std::size_t place() const { return static_cast<std::size_t>(code_ & 3); }

   private:
    std::int32_t code_ = -1;
  };
  /// The links of a circle in the lists of its three sites.
  struct Links {
    std::array<Spoke, 3> next, previous;
  };

  void enlist(CircleId c);
  std::size_t place_of(SiteId p, CircleId c) const {  // among the circle's sites
    const auto& sites = circles_[c].sites;
    return sites[0] == p ? 0 : sites[1] == p ? 1 : 2;
  }

  Table<CircleId, EmptyCircle> circles_;
  Table<CircleId, Links> links_;
  Table<SiteId, Spoke> first_;  ///< heads of the sites' lists
  std::vector<CircleId> free_;
};

}  // namespace geom
