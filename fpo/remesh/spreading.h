#pragma once
// Samples that came too close to each other are pushed apart, as little as it takes: what moves a sample for
// another reason gives its neighbours no room.

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
  void keep(SampleJournal* journal) { resampling_.keep(journal); }
  /// The closest first: a corner of its triangle is nudged to where the penalty is least; again and again
  /// until none is too close: true. About a hundred and eighty moves a triangle and round.
  bool spread();
  std::size_t moves() const { return resampling_.moves(); }

 private:
  SurfaceDomain& domain_;
  const geom::AabbTree& tree_;
  Flaws close_;
  LocalResampling resampling_;
};

}  // namespace fpo
