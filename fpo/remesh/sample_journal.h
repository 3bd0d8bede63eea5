#pragma once
// Where samples were, to go back to.

#include <map>
#include <vector>

#include "fpo/surface/surface_domain.h"

namespace fpo {

/// What samples were like when they were first noted since the last clear(). Keeps a reference.
class SampleJournal {
 public:
  explicit SampleJournal(SurfaceDomain& domain) : domain_(domain) {}

  /// Before x is moved.
  void note(SiteId x) { were_.try_emplace(x.index(), Was{domain_.sample(x), domain_.weight_share(x)}); }
  void clear() { were_.clear(); }
  /// Ascending.
  std::vector<SiteId> noted() const {
    std::vector<SiteId> samples;
    for (const auto& [index, was] : were_) samples.emplace_back(index);
    return samples;
  }
  /// All back to their places and weights. A removal and an insertion for each that is elsewhere.
  void undo() {
    for (const auto& [index, was] : were_) {
      const SiteId x(index);
      if (domain_.sample(x).position == was.place.position && domain_.sample(x).facet == was.place.facet &&
          domain_.weight_share(x) == was.weight_share)
        continue;
      domain_.remove(x);
      domain_.insert_at(x, was.place, was.weight_share);
    }
    clear();
  }

 private:
  struct Was {
    SurfaceSample place;
    double weight_share;
  };

  SurfaceDomain& domain_;
  std::map<std::size_t, Was> were_;
};

}  // namespace fpo
