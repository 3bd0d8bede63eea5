#pragma once
// The sites that a cell, or a part of it, is divided among if its owner is not there (cell_division.h).

#include <span>
#include <vector>

#include "geom/power/clip.h"

namespace geom {

/// One object serves many divisions.
class CellHeirs {
 public:
  using Heir = std::size_t;  ///< a place among them

  /// Keeps a reference.
  explicit CellHeirs(Clipper& clipper) : clipper_(clipper) {}

  /// Starts anew, without heirs. Neither p nor who is excluded is a stranger.
  void begin(SiteId p, std::span<const SiteId> excluded);
  void add(SiteId k);
  /// Neither an heir nor p nor excluded?
  bool is_stranger(SiteId j) const { return j.index() >= known_stamp_.size() || known_stamp_[j] != stamp_; }

  SiteId p() const { return p_; }
  std::span<const SiteId> sites() const { return sites_; }
  std::size_t size() const { return sites_.size(); }
  SiteId operator[](Heir k) const { return sites_[k]; }
  /// Prepares the bisectors of all pairs that there are now.
  void pair_up();
  /// Of owner k and h.
  const Bisector& bisector(Heir k, Heir h) const { return bisectors_[k * sites_.size() + h]; }

 private:
  void know(SiteId s);

  Clipper& clipper_;
  SiteId p_;
  std::vector<SiteId> sites_;
  Table<SiteId, std::uint32_t> known_stamp_;
  std::uint32_t stamp_ = 0;
  std::vector<Bisector> bisectors_;  ///< row k, column h
};

}  // namespace geom
