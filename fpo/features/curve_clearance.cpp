#include "fpo/features/curve_clearance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "fpo/features/curve_pieces.h"
#include "fpo/features/point_grid.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/angles.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

namespace clearance {
constexpr double along = 0.5;        // of the way along one curve: what is farther is beside
constexpr double in_cone = 0.7;      // of the distance that curves have in the cone of a corner
constexpr double part = 0.25;        // of the distance: places on curves, and of the reach: what they look at
constexpr double off_surface = 0.1;  // of the distance: the middle of a strip
constexpr int most_halvings = 16;
}  // namespace clearance

/// One end of a curve, with the edge there.
struct CurveEnd {
  std::size_t curve;
  bool is_last;
  Vec3 direction;
};

std::map<VertexId, std::vector<CurveEnd>> ends_of(const TriMesh& mesh, const Features& features) {
  std::map<VertexId, std::vector<CurveEnd>> ends;
  for (std::size_t c = 0; c < features.curves.size(); ++c) {
    const FeatureCurve& curve = features.curves[c];
    const std::size_t n = curve.vertices.size();
    if (curve.loop || n < 2) continue;
    for (const bool is_last : {false, true}) {
      const VertexId v = curve.vertices[is_last ? n - 1 : 0], next = curve.vertices[is_last ? n - 2 : 1];
      ends[v].push_back({c, is_last, mesh.position(next) - mesh.position(v)});
    }
  }
  return ends;
}

std::vector<CurvePiece> halves(const CurvePiece& p) {
  const Vec3 m = p.middle();
  return {{p.from, m, p.curve, p.start, p.facet}, {m, p.to, p.curve, p.start + (m - p.from).norm(), p.facet}};
}

/// Ends at one vertex: from there, how far the curves are apart in units of the way along them.
struct SharedEnd {
  bool first_is_last, other_is_last;
  double cone;
};

class ClearanceSearch {
 public:
  ClearanceSearch(const TriMesh& mesh, const Features& features, double reach, std::size_t most)
      : features_(features), reach_(reach), most_(most), tree_(mesh), grid_((1 + clearance::part) * reach) {
    for (std::size_t c = 0; c < features.curves.size(); ++c)
      lengths_.push_back(cut_curve(mesh, features, c, clearance::part * reach, parts_));
    for (std::size_t i = 0; i < parts_.size(); ++i) grid_.add(parts_[i].middle(), i);
    for (const auto& [v, ends] : ends_of(mesh, features))
      for (const CurveEnd& a : ends)
        for (const CurveEnd& b : ends)
          if (a.curve != b.curve || a.is_last != b.is_last)
            shared_[{a.curve, b.curve}].push_back({a.is_last, b.is_last, cone(a, b)});
  }

  std::vector<CurveClearance> all() {
    for (std::size_t i = 0; i < parts_.size(); ++i) look_from(parts_[i], i, clearance::most_halvings);
    return std::move(result_);
  }

 private:
  struct Place {
    Vec3 at;
    double t;  ///< along the curve
  };

  static double cone(const CurveEnd& a, const CurveEnd& b) {
    const double angle = geom::angle_between(a.direction, b.direction);
    return clearance::in_cone * std::sin(std::min(angle, std::numbers::pi / 2));
  }

  /// p is in the part of that number, which is beside it.
  void look_from(const CurvePiece& p, std::size_t whole, int halvings) {
    if (result_.size() > most_) return;
    const Vec3 x = p.middle();
    const Place here{x, p.at_middle()};
    double nearest = reach_;
    Vec3 there = x;
    grid_.around(x, [&](std::size_t i) {
      if (i == whole) return;
      const CurvePiece& q = parts_[i];
      const Vec3 y = geom::closest_point(x, {q.from, q.to, q.to}).point;
      const double d = (y - x).norm();
      if (!(d < nearest) || are_beside(p.curve, here, q.curve, {y, q.start + (y - q.from).norm()})) return;
      nearest = d, there = y;
    });
    if (nearest == reach_) return;
    if (p.length() > clearance::part * nearest && halvings > 0) {
      for (const CurvePiece& half : halves(p)) look_from(half, whole, halvings - 1);
      return;
    }
    const double off2 = tree_.closest((x + there) / 2, p.facet).distance2;
    result_.push_back(
        {{x, p.facet}, p.curve, p.length(), nearest, off2 < std::pow(clearance::off_surface * nearest, 2)});
  }

  bool are_beside(std::size_t c, const Place& x, std::size_t d, const Place& y) const {
    const double distance = (y.at - x.at).norm();
    if (c == d) {
      const double between = std::abs(x.t - y.t);
      const double way = features_.curves[c].loop ? std::min(between, lengths_[c] - between) : between;
      if (distance >= clearance::along * way) return true;
    }
    const auto found = shared_.find({c, d});
    if (found == shared_.end()) return false;
    return std::ranges::any_of(found->second, [&](const SharedEnd& end) {
      const double s = end.first_is_last ? lengths_[c] - x.t : x.t,
                   t = end.other_is_last ? lengths_[d] - y.t : y.t;
      return distance >= end.cone * std::max(s, t);
    });
  }

  const Features& features_;
  double reach_;
  std::size_t most_;
  geom::AabbTree tree_;
  std::vector<CurvePiece> parts_;
  std::vector<double> lengths_;
  PointGrid grid_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<SharedEnd>> shared_;
  std::vector<CurveClearance> result_;
};

}  // namespace

std::vector<CurveCorner> curve_corners(const TriMesh& mesh, const Features& features) {
  std::vector<CurveCorner> corners;
  for (const auto& [v, ends] : ends_of(mesh, features))
    for (std::size_t i = 0; i < ends.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        corners.push_back(
            {v, ends[j].curve, ends[i].curve, geom::angle_between(ends[j].direction, ends[i].direction)});
  return corners;
}

std::vector<CurveClearance> curve_clearances(const TriMesh& mesh, const Features& features, double reach,
                                             std::size_t most) {
  if (features.curves.empty() || !(reach > 0) || !std::isfinite(reach)) return {};
  return ClearanceSearch(mesh, features, reach, most).all();
}

}  // namespace fpo
