#pragma once
// Who may win something of a cell that goes, and their bisectors.

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "geom/dual/cell_clipper.h"
#include "geom/dual/state.h"

namespace geom {

/// One object serves many cells.
class VacancyHeirs {
 public:
  using Heir = std::size_t;  ///< a place among them

  explicit VacancyHeirs(const DualState& state) : state_(state) {}

  /// Those who border the cell of p; if nobody does, the nearest.
  void begin(SiteId p, const CellPieces& cell);
  void add(SiteId j);
  /// No more come for now.
  void close() { between_.assign(sites_.size() * sites_.size(), {}); }

  SiteId p() const { return p_; }
  std::size_t size() const { return sites_.size(); }
  SiteId operator[](Heir k) const { return sites_[k]; }
  /// The place of a site; size() if it is none of them.
  Heir index_of(SiteId s) const { return static_cast<Heir>(std::ranges::find(sites_, s) - sites_.begin()); }
  /// Of p and each heir.
  std::span<const Bisector> before_p() const { return before_p_; }
  const Bisector& between(Heir k, Heir h) {
    std::optional<Bisector>& b = between_[k * sites_.size() + h];
    if (!b) b = state_.clipper.bisector_of(sites_[k], sites_[h]);
    return *b;
  }

 private:
  const DualState& state_;
  SiteId p_;
  std::vector<SiteId> sites_;
  std::vector<Bisector> before_p_;
  std::vector<std::optional<Bisector>> between_;
};

}  // namespace geom
