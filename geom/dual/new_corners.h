#pragma once
// The corners that a cell's division has and the cell had not: where a site shows that wins something and is
// not among the heirs.

#include <span>
#include <vector>

#include "geom/dual/cell_clipper.h"
#include "geom/dual/state.h"

namespace geom {

/// One object serves many divisions.
class NewCorners {
 public:
  explicit NewCorners(const DualState& state) : state_(state), stamp_of_(state.mesh.num_vertices(), 0) {}

  /// A division begins.
  void clear();
  /// Adds a corner of a share, if it is the first of those that are one location: in shares of other sites,
  /// or on other facets.
  void add(FacetId t, SiteId owner, std::span<const PolygonCorner> share, std::size_t corner);
  /// After all of them: by owners, with a ball about a few at a time.
  void group();
  /// Is j nearer than the owner at some corner?
  bool any_beaten_by(SiteId j) const;

 private:
  /// What it takes to see that a site is not nearer there.
  struct Corner {
    CellCorner corner;
    double power, distance2;  ///< of the owner
  };
  /// Some corners of one owner, and a ball about them.
  struct Group {
    std::size_t begin, end;
    Vec3 center;
    double radius;
  };
  bool is_first(FacetId t, SiteId owner, EdgeLabel before, EdgeLabel after);
  bool is_behind(const WeightedPoint3& j, const WeightedPoint3& owner, const Group& ball) const;
  bool beats_at(SiteId j, const Corner& at) const;

  const DualState& state_;
  std::vector<Corner> corners_;
  std::vector<Group> groups_;
  Table<VertexId, std::uint32_t> stamp_of_;  ///< of the last division where it was a new corner
  std::uint32_t stamp_ = 0;
};

}  // namespace geom
