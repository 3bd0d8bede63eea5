#pragma once
// The hole that a site would leave: its triangles, proven, and bounds of the power there.

#include <span>
#include <vector>

#include "geom/dual/hole_triangles.h"
#include "geom/dual/leeway_proof.h"
#include "geom/dual/surroundings.h"

namespace geom {

class Hole {
 public:
  using Triangle = HoleTriangles::Triangle;

  /// Keeps a reference.
  explicit Hole(Surroundings& around) : around_(around), triangles_(around), leeways_(around) {}

  /// Fills and proves the hole of around.p, whose rim is known; p goes out of the paper's oracle. False: not
  /// certain, and p is in again.
  bool plan();
  /// p is in the paper's oracle again.
  void cancel();
  /// Makes the bounds the least, if that can be done.
  bool make_exact();

  std::span<const Triangle> triangles() const { return triangles_.all(); }
  /// The circles that the hole would have, one a triangle.
  std::span<const EmptyCircle> circles() const { return circles_; }
  /// Bounds of the power in the cell of p, and in the hole without p.
  double reach() const { return reach_; }
  double max_radius2() const { return max_radius2_; }
  /// Was it proven on a sheet? Else its facets are traced: around.flood.
  bool is_on_sheet() const { return is_on_sheet_; }
  /// How steep its edges are, inside and to the old circles, if it is on a sheet (chart.h).
  double steepest() const { return steepest_; }
  /// What the rim has of the hole once it has it.
  void raise_reaches() const;

 private:
  bool chart_star();
  bool prove_with_leeway();
  bool prove();
  void find_edges();
  bool is_chart_simple() const;
  bool bound_on_sheet();
  bool trace();
  bool has_no_stranger();

  Surroundings& around_;
  HoleTriangles triangles_;
  LeewayProof leeways_;
  std::vector<EmptyCircle> circles_;
  double reach_ = 0, max_radius2_ = 0;
  double range_ = 0;  ///< who owns something of the hole is that near to p
  bool is_on_sheet_ = false;
  std::vector<Chart::Edge> edges_;  ///< of the division, by the places of their sites on the rim
  double steepest_ = 0;             ///< of the edges, on the sheet
  std::vector<FacetId> facets_;     // workspace
};

}  // namespace geom
