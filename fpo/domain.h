#pragma once
// What Algorithm 1 needs from a sampling domain. It never sees a coordinate.

#include <cstddef>
#include <vector>

#include "geom/check.h"
#include "geom/ids.h"

namespace fpo {

using geom::CircleId;
using geom::SiteId;

/// Where the largest empty circle is looked for: everywhere (section 2.1), or among the circles in the 2-ring
/// neighbourhood of the sample that was just removed (section 4.3, "local").
enum class Scope { global, two_ring };

/// An empty circle: the power of its center to the nearest samples, and the domain's name for it. radius2 may
/// be negative (weights), and is -infinity if there is no circle.
struct Circle {
  double radius2;
  CircleId id;
};

/// A set of n samples with the empty circles between them, under removal and insertion.
class Domain {
 public:
  virtual ~Domain() = default;

  virtual std::size_t num_samples() const = 0;

  /// A sample that stays where it is: on a feature (section 5), or the user's. It is never moved.
  virtual bool is_fixed(SiteId) const { return false; }

  /// d_x of Algorithm 1, line 4, as a power: min over j != x of |x - p_j|^2 - w_j, to be compared with
  /// Circle::radius2 (the sample's own weight is left out on both sides). +infinity if x is alone. x is in.
  virtual double separation(SiteId x) = 0;

  /// Line 5. At most one sample is out at a time.
  virtual void remove(SiteId x) = 0;
  /// Line 6: the one of the largest priority (farthest.h) in scope. A sample is out.
  virtual Circle largest_empty(Scope scope) = 0;

  /// Line 6, asked while x is out: is c farther than the place that x came from, so that r > d_x? The answer
  /// is mostly yes, and then a bound of d_x will do.
  virtual bool is_farther(const Circle& c, SiteId x) = 0;

  /// Line 7: puts the removed sample at the center of c, with the weight that the sizing gives there.
  virtual void insert_at(SiteId x, const Circle& c) = 0;
  /// Line 9: puts the removed sample back with its old position and weight.
  virtual void put_back(SiteId x) = 0;

  /// Lines 4 to 9 of Algorithm 1 for a sample that is not fixed: whether it went to a new place. A domain
  /// that knows a shorter way to the same outcome takes it.
  virtual bool move(SiteId x, Scope scope);

  /// Distance from x to the nearest other sample in units of the spacing that a hexagonal arrangement of the
  /// wanted density would have there (d_max of section 2.1 if uniform). The minimum over all x is delta, the
  /// mean mean_delta.
  virtual double normalized_spacing(SiteId x) = 0;

  /// The samples, at least, whose normalized_spacing depends on where x is. Needed by shortest edge removal
  /// (section 4.3) only; a domain that cannot tell throws geom::Bug.
  virtual void neighbours(SiteId x, std::vector<SiteId>& out);

  /// Tells that x will be moved soon: a few calls after this one. No effect but on speed: time to load what
  /// its removal will read.
  virtual void expect(SiteId) {}

  /// Verifies every invariant of the structures behind; throws geom::Bug. For tests.
  virtual void check() const {}
};

inline bool Domain::move(SiteId x, Scope scope) {
  remove(x);
  const Circle c = largest_empty(scope);
  const bool moves = is_farther(c, x);
  if (moves)
    insert_at(x, c);
  else
    put_back(x);
  return moves;
}

inline void Domain::neighbours(SiteId, std::vector<SiteId>&) {
  throw geom::Bug("this domain knows no neighbours of a sample");
}

}  // namespace fpo
