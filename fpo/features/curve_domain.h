#pragma once
// Farthest point optimization in one dimension (paper, section 5: "1D FPO on the feature curves").

#include <vector>

#include "fpo/domain.h"
#include "fpo/features/features.h"
#include "fpo/surface/sizing.h"
#include "geom/indexed_heap.h"

namespace fpo {

/// A feature curve measured in wanted edge lengths: the distance between two places is the integral of 1/h
/// along the curve, the number of edges that the sizing calls for between them. h being linear on an edge,
/// lengths and places are in closed form.
class CurveMetric {
 public:
  /// Keeps references to mesh and curve.
  CurveMetric(const geom::TriMesh& mesh, const FeatureCurve& curve, const Sizing& sizing);

  double length() const { return up_to_.back(); }
  /// The place at distance t in [0, length()] from the first vertex. O(log m).
  SurfaceSample at(double t) const;
  /// The distance from the first vertex of the place nearest to x, and how far x is from there. O(m).
  struct Nearest {
    double t, distance2;
  };
  Nearest nearest(const geom::Vec3& x) const;

 private:
  struct Piece {
    geom::Vec3 from, to;
    double h_from, h_to;
    geom::FacetId facet;
    double share_at(double t) const;  ///< of the piece's length, t from its start
    double length_to(double share) const;
    double scale() const { return (to - from).norm(); }
  };
  std::vector<Piece> pieces_;
  std::vector<double> up_to_;  ///< length before each piece, and of all
};

/// Samples on an interval [0, length] whose ends are samples that stay, or on a loop of that length. The
/// empty circles are the gaps between neighbours: the farthest point is the middle of the largest one. Circle
/// i is the gap that follows sample i; that of id num_samples() follows the start of the interval.
class CurveDomain final : public Domain {
 public:
  /// Positions in any order within (0, length), or [0, length) of a loop; throws Bug on others, and if there
  /// is none.
  CurveDomain(double length, bool loop, std::vector<double> positions);

  std::size_t num_samples() const override { return positions_.size(); }
  double separation(SiteId x) override;
  bool is_farther(const Circle& c, SiteId) override { return c.radius2 > removed_separation_; }
  void remove(SiteId x) override;
  /// O(1); within the two-ring the gap that x has left and those next to it.
  Circle largest_empty(Scope scope) override;
  void insert_at(SiteId x, const Circle& c) override;
  void put_back(SiteId x) override;
  /// Distance to the nearest neighbour over the mean gap.
  double normalized_spacing(SiteId x) override;
  void neighbours(SiteId x, std::vector<SiteId>& out) override;
  void check() const override;

  double position(SiteId x) const { return positions_[x]; }

 private:
  // The start of an interval takes part as one more sample, num_samples(), and is its end too.
  SiteId start() const { return SiteId(positions_.size()); }
  double place(SiteId x) const { return x == start() ? 0 : positions_[x]; }
  double gap_after(SiteId x) const;
  double radius2(SiteId x) const { return gap_after(x) * gap_after(x) / 4; }
  void refresh(SiteId x);

  struct ById {
    bool operator()(CircleId a, CircleId b) const { return a < b; }
  };
  double length_;
  bool loop_;
  geom::Table<SiteId, double> positions_;
  geom::Table<SiteId, SiteId> next_, previous_;  ///< a ring
  geom::IndexedHeap<CircleId, ById> gaps_;
  double removed_separation_ = 0;  ///< separation() of the sample that is out
  SiteId before_removed_;
};

}  // namespace fpo
