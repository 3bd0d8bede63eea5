#pragma once
// The sites around one that moves, its neighbours left out: who else may own what it leaves, or lose
// something to it.

#include <cstdint>
#include <span>
#include <vector>

#include "geom/dual/frame.h"
#include "geom/dual/state.h"

namespace geom {

class Strangers {
 public:
  /// Keeps a reference.
  explicit Strangers(DualState& state) : state_(state) {}

  /// Nothing is known.
  void forget() { found_.clear(), radius_ = -1; }
  /// Sees to it that all who may own a location of the vacancy are known; they are that near to its center. A
  /// search finds some more, and they stay known.
  void find_heirs(const Vacancy& vacancy, double range);
  /// All who may lose something to p, whose cell is in that ball; p is in with the paper's oracle.
  void find_rivals(SiteId p, const Vec3& center, double radius);

  /// Appends those who may lose something to p, at its present place, where the power to them is more than
  /// that.
  void find_rivals_beyond(double power, SiteId p, std::vector<SiteId>& out) const;

  struct Stranger : Frame::Seen {
    SiteId site;
  };
  /// Keeps those who, somewhere in the ball, may be nearer than all sites of the frame, which are the rim and
  /// perhaps p. `first`: the number there of the one that is most likely nearer, or Frame::nobody.
  struct Ball {
    Frame::Place center;
    double radius;
    bool is_level = false;  ///< what it has of the surface has the level of the frame's origin
  };
  void keep_near(const Frame& frame, SiteId p, std::span<const SiteId> rim, const Ball& ball, int first);
  std::span<const Stranger> kept() const { return kept_; }
  /// Is the owner nearer to the point than all of them?
  bool are_beyond(const SurfacePoint& point, const WeightedPoint3& owner) const;

 private:
  bool knows(const Vec3& x, double distance) const {
    return radius_ >= 0 && ((x - center_).norm() + distance) * (1 + 1e-9) < radius_;
  }

  DualState& state_;
  std::vector<SiteId> found_;
  Vec3 center_{0, 0, 0};  ///< all sites this near are found
  double radius_ = -1;
  Vec3 around_{0, 0, 0};  ///< what was last asked for is that near to this
  double within_ = infinity;
  std::vector<Stranger> kept_;
  Table<SiteId, std::uint64_t> mark_;  ///< of the rim and p: how often keep_near() was called
  std::uint64_t calls_ = 0;
};

}  // namespace geom
