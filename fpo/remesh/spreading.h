#pragma once
// Samples that came too close to each other are pushed apart, as little as it takes: what moves a sample for
// another reason gives its neighbours no room.

#include <array>
#include <vector>

#include "fpo/remesh/flaws.h"

namespace fpo {

class Spreading {
 public:
  struct Goal {
    double delta;     ///< no sample is to be closer to another than this (normalized)
    double at_worst;  ///< and none may be closer than this on the way, or than any was at the start
  };

  /// The others must not become more on the way. Keeps references.
  Spreading(SurfaceDomain& domain, std::vector<Flaws*> others, const geom::AabbTree& tree, const Goal& goal);

  /// Of edges shorter than wanted: the sum over triangles of the squares of what they lack, in units of it.
  double penalty() { return close_.penalty(); }
  bool is_more_than(double limit) { return close_.is_more_than(limit); }  ///< the penalty
  /// What edges from x, put at a place, to its neighbours of now would lack: the squares, summed up.
  double lack(SiteId x, const SurfaceSample& place) const;
  void keep(SampleJournal* journal) { resampling_.keep(journal); }
  /// The closest first: a corner of its triangle is nudged to where the edges to its neighbours lack least,
  /// or less; again and again until none is too close: true. At most a dozen moves a triangle and round.
  bool spread();
  std::size_t moves() const { return resampling_.moves(); }

 private:
  /// The best first, by the neighbours that there are now.
  std::vector<Trial> trials(const std::array<SiteId, 3>& corners) const;

  SurfaceDomain& domain_;
  const geom::AabbTree& tree_;
  Goal goal_;
  Flaws close_;
  LocalResampling resampling_;
  mutable std::vector<SiteId> link_;  ///< scratch
};

}  // namespace fpo
