#include "fpo/remesh/remembered_samples.h"

namespace fpo {

using geom::SiteId;

namespace {

bool is_same(const SampleState& a, const SampleState& b) {
  return a.place.position == b.place.position && a.place.facet == b.place.facet &&
         a.weight_share == b.weight_share;
}

}  // namespace

RememberedSamples::RememberedSamples(const SurfaceDomain& domain, const RememberedSamples* older)
    : older_(older && !older->older_ ? older : nullptr) {
  const std::size_t count = domain.num_samples();
  if (older_) {
    for (std::size_t i = 0; i < count; ++i)
      if (const SampleState x = state_of(domain, SiteId(i)); !is_same(x, older_->kept(i)))
        changed_.push_back({SiteId(i), x});
    return;
  }
  positions_.reserve(count);
  facets_.reserve(count);
  bool are_full = true;
  for (std::size_t i = 0; i < count; ++i) {
    const SampleState x = state_of(domain, SiteId(i));
    positions_.push_back(x.place.position);
    facets_.push_back(x.place.facet);
    are_full &= x.weight_share == 1;
  }
  if (are_full) return;
  weight_shares_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) weight_shares_.push_back(domain.weight_share(SiteId(i)));
}

SampleState RememberedSamples::kept(std::size_t i) const {
  return {{positions_[i], facets_[i]}, weight_shares_.empty() ? 1 : weight_shares_[i]};
}

std::vector<RememberedSamples::Changed> RememberedSamples::changed_in(const SurfaceDomain& domain) const {
  std::vector<Changed> changed;
  auto next = changed_.begin();
  for (std::size_t i = 0; i < domain.num_samples(); ++i) {
    const bool is_later = next != changed_.end() && next->sample == SiteId(i);
    const SampleState was = is_later ? (next++)->was : (older_ ? older_ : this)->kept(i);
    if (!is_same(state_of(domain, SiteId(i)), was)) changed.push_back({SiteId(i), was});
  }
  return changed;
}

void RememberedSamples::put_back(SurfaceDomain& domain) const {
  for (const auto& [x, was] : changed_in(domain)) fpo::put_back(domain, x, was);
}

}  // namespace fpo
