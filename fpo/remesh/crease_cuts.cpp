#include "fpo/remesh/crease_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace fpo {

using geom::TriMesh;
using geom::Vec3;

namespace {

constexpr double shortest_piece = 1.0 / 3;  // in spacings
constexpr double step = 0.05;               // likewise

/// On an edge of a curve, from a place to one of its ends.
struct Way {
  std::size_t curve;
  std::array<geom::VertexId, 2> edge;
  double from, to;  ///< shares of the edge: to is 0 or 1
};

/// The cuts for one small angle.
class CutsForAngle {
 public:
  CutsForAngle(const TriMesh& surface, const Features& features, const SmallAngle& angle, double spacing)
      : surface_(surface),
        features_(features),
        angle_(angle),
        near_edges_(surface, features, angle, spacing),
        spacing_(spacing) {}

  void add_on(std::size_t c, std::vector<EdgeCut>& cuts) const {
    const std::vector<bool> near = near_edges_.of(c);
    const std::size_t nearest = near_edges_.nearest_edge(c);
    for (std::size_t i = 0; i < near.size(); ++i) {
      const std::array<geom::VertexId, 2> edge = edge_of(features_.curves[c], i);
      if (!near[i] || length(edge) < 2 * shortest_piece * spacing_) continue;
      if (i == nearest) {
        const double from = share_nearest_to_triangle(edge);
        add({c, edge, from, 0}, cuts);
        add({c, edge, from, 1}, cuts);
      } else {
        const bool from_first = near_edges_.is_near_another(surface_.position(edge[0]), c);
        add(from_first ? Way{c, edge, 0, 1} : Way{c, edge, 1, 0}, cuts);
      }
    }
  }

 private:
  double length(const std::array<geom::VertexId, 2>& edge) const {
    return (surface_.position(edge[1]) - surface_.position(edge[0])).norm();
  }

  double share_nearest_to_triangle(const std::array<geom::VertexId, 2>& edge) const {
    const Vec3 &a = surface_.position(edge[0]), along = surface_.position(edge[1]) - a;
    double nearest = 0, least = std::numeric_limits<double>::infinity();
    for (const Vec3& x : angle_.corners) {
      const double share = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      const double distance2 = (x - a - share * along).squaredNorm();
      if (distance2 < least) least = distance2, nearest = share;
    }
    return nearest;
  }

  /// Where no other crease is near any more; if that is nowhere, or near to an end, there is no cut.
  void add(const Way& way, std::vector<EdgeCut>& cuts) const {
    const Vec3 &a = surface_.position(way.edge[0]), along = surface_.position(way.edge[1]) - a;
    const double whole = along.norm() / spacing_, most = std::abs(way.to - way.from) * whole;
    const auto share_at = [&](double gone) { return way.from + (way.to > way.from ? gone : -gone) / whole; };
    const auto is_near = [&](double gone) {
      return near_edges_.is_near_another(a + share_at(gone) * along, way.curve);
    };
    double gone = 0;
    if (!is_near(gone)) return;
    while (gone < most && is_near(gone)) gone += step;
    const double share = share_at(gone);
    if (std::min(share, 1 - share) * whole >= shortest_piece) cuts.push_back({way.edge, share});
  }

  const TriMesh& surface_;
  const Features& features_;
  const SmallAngle& angle_;
  NearEdges near_edges_;
  double spacing_;
};

/// Of cuts of one edge that are nearer to each other than pieces may be, the first ones are left.
std::vector<EdgeCut> thinned_out(const TriMesh& surface, double spacing, const std::vector<EdgeCut>& cuts) {
  std::map<std::array<geom::VertexId, 2>, std::vector<double>> shares;
  std::vector<EdgeCut> left;
  for (const EdgeCut& cut : cuts) {
    const double length = (surface.position(cut.edge[1]) - surface.position(cut.edge[0])).norm();
    const auto is_close = [&](double share) {
      return std::abs(share - cut.share) * length < shortest_piece * spacing;
    };
    if (std::ranges::any_of(shares[cut.edge], is_close)) continue;
    shares[cut.edge].push_back(cut.share);
    left.push_back(cut);
  }
  return left;
}

}  // namespace

std::vector<EdgeCut> crease_cuts(const TriMesh& surface, const Features& features,
                                 const RemeshWithCurves& remesh, double spacing) {
  std::vector<EdgeCut> cuts;
  for (const SmallAngle& angle : angles_at_curves(surface, features, remesh, spacing)) {
    if (angle.to_blame.size() < 2) continue;
    const CutsForAngle of_angle(surface, features, angle, spacing);
    for (const std::size_t c : angle.to_blame)
      if (features.curves[c].sheets == 2) of_angle.add_on(c, cuts);
  }
  return thinned_out(surface, spacing, cuts);
}

}  // namespace fpo
