#pragma once
// The structures of an optimization under any insertions and removals, with everything that can be verified
// about them: their own invariants, brute force, and another one built from nothing.

#include <memory>
#include <vector>

#include "geom/rng.h"
#include "tests/endurance/replay.h"

namespace endurance {

class Stage {
 public:
  virtual ~Stage() = default;

  /// Does it. False and nothing done if it cannot be: a site that is (not) there already, or a gap too large
  /// for the torus. Throws geom::Bug.
  bool apply(const Operation& operation);
  /// The sites that are in, ascending.
  const std::vector<geom::SiteId>& present() const { return present_; }
  const geom::WeightedPoint3& point(geom::SiteId s) const { return points_[s]; }

  /// The center of the largest empty circle, or of the largest that the last change has made. False: none.
  virtual bool farthest(bool of_last_change, geom::Vec3& out) const = 0;
  /// A location of the domain: anywhere, or (`special`) where ties are likely.
  virtual geom::Vec3 anywhere(bool special, geom::Rng& rng) const = 0;
  virtual double area() const = 0;

  /// All invariants. Throws geom::Bug.
  virtual void check() const = 0;
  /// A part of the structure by trying all sites. Throws geom::Bug. O(n^2).
  virtual void check_by_brute_force(geom::Rng& rng) const = 0;
  /// The same sites in a structure of the other engine, built from nothing in the order of ids.
  virtual std::unique_ptr<Stage> rebuilt() const = 0;
  /// Throws geom::Bug unless the other, of the same sites, is the same in every combination of sites, and in
  /// every circle to the bit.
  virtual void compare(const Stage& other) const = 0;

 protected:
  virtual bool insert(geom::SiteId s, const geom::WeightedPoint3& point) = 0;
  virtual bool remove(geom::SiteId s) = 0;
  void copy_sites_to(Stage& other) const;

 private:
  geom::Table<geom::SiteId, geom::WeightedPoint3> points_;
  std::vector<geom::SiteId> present_;
};

std::unique_ptr<Stage> make_stage(const Place& place, bool search);

/// All that can be verified at once: invariants, brute force, rebuilt.
void verify(const Stage& stage, geom::Rng& rng);

/// Does all operations that can be done and verifies: at the end, or after every one. The text of the fault,
/// or nothing.
std::string fault_of(const Replay& replay, bool verify_always);

}  // namespace endurance
