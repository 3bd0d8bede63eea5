#pragma once
// Where samples were, to go back to.

#include <map>
#include <vector>

#include "fpo/remesh/sample_state.h"

namespace fpo {

/// What samples were like when they were first noted since the last clear(). Keeps a reference.
class SampleJournal {
 public:
  explicit SampleJournal(SurfaceDomain& domain) : domain_(domain) {}

  /// Before x is moved.
  void note(SiteId x) { were_.try_emplace(x.index(), state_of(domain_, x)); }
  void clear() { were_.clear(); }
  /// Ascending.
  std::vector<SiteId> noted() const {
    std::vector<SiteId> samples;
    for (const auto& [index, was] : were_) samples.emplace_back(index);
    return samples;
  }
  /// All back to their places and weights. A removal and an insertion for each that is elsewhere.
  void undo() {
    for (const auto& [index, was] : were_) put_back(domain_, SiteId(index), was);
    clear();
  }

 private:
  SurfaceDomain& domain_;
  std::map<std::size_t, SampleState> were_;
};

}  // namespace fpo
