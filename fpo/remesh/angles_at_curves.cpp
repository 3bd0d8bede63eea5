#include "fpo/remesh/angles_at_curves.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "fpo/measure/triangle_angles.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double fair_angle = 30;       // degrees
constexpr double on_curve = 1e-6;       // of the spacing
constexpr std::size_t on_features = 2;  // vertices of a triangle that curves are to blame for

using Curves = std::vector<std::size_t>;  // ascending

/// From the edge of that number.
double distance2_to_edge(const Vec3& x, const TriMesh& mesh, const FeatureCurve& curve, std::size_t i) {
  const Vec3& a = mesh.position(curve.vertices[i]);
  const Vec3& b = mesh.position(curve.vertices[(i + 1) % curve.vertices.size()]);
  return geom::closest_point(x, {a, b, b}).distance2;
}

/// Is x so near to the curve?
bool is_within(const Vec3& x, const TriMesh& mesh, const FeatureCurve& curve, double reach) {
  for (std::size_t i = 0; i < curve.facets.size(); ++i)
    if (distance2_to_edge(x, mesh, curve, i) <= reach * reach) return true;
  return false;
}

/// Which curves a vertex of the remesh is on. One object serves all triangles.
class CurvesOfVertices {
 public:
  CurvesOfVertices(const TriMesh& surface, const Features& features, const RemeshWithCurves& remesh,
                   double reach)
      : surface_(surface), features_(features), remesh_(remesh), reach_(reach) {}

  const Curves& of(VertexId v) {
    const auto [place, is_new] = known_.try_emplace(v);
    if (is_new && v.index() < remesh_.on_features)
      for (std::size_t c = 0; c < features_.curves.size(); ++c)
        if (is_within(remesh_.mesh.position(v), surface_, features_.curves[c], reach_))
          place->second.push_back(c);
    return place->second;
  }

 private:
  const TriMesh& surface_;
  const Features& features_;
  const RemeshWithCurves& remesh_;
  double reach_;
  std::map<VertexId, Curves> known_;
};

double lacking_in(double angle) { return std::max(1 - angle / fair_angle, 0.0); }

Curves common(const Curves& a, const Curves& b) {
  Curves both;
  std::ranges::set_intersection(a, b, std::back_inserter(both));
  return both;
}

Curves joined(const Curves& a, const Curves& b) {
  Curves all;
  std::ranges::set_union(a, b, std::back_inserter(all));
  return all;
}

/// Those of the corners of a triangle that has a small angle at the first one; if that is an angle between
/// curves, these. None if hardly any corner is on one.
Curves curves_to_blame(CurvesOfVertices& curves, const std::array<VertexId, 3>& corners) {
  const std::array<const Curves*, 3> at{&curves.of(corners[0]), &curves.of(corners[1]),
                                        &curves.of(corners[2])};
  const auto num_on =
      static_cast<std::size_t>(std::ranges::count_if(at, [](const Curves* of) { return !of->empty(); }));
  if (num_on < on_features) return {};
  const Curves first = common(*at[0], *at[1]), second = common(*at[0], *at[2]);
  if (!first.empty() && !second.empty()) return joined(first, second);
  return joined(joined(*at[0], *at[1]), *at[2]);
}

/// As angles of nothing between the curves that are near.
std::vector<SmallAngle> faults(const TriMesh& surface, const Features& features,
                               const RemeshWithCurves& remesh, double spacing) {
  std::vector<SmallAngle> all;
  for (const Vec3& x : remesh.faults) {
    SmallAngle& fault = all.emplace_back(SmallAngle{1, {x, x, x}, {}});
    for (std::size_t c = 0; c < features.curves.size(); ++c)
      if (is_within(x, surface, features.curves[c], near_another_curve * spacing))
        fault.to_blame.push_back(c);
  }
  return all;
}

/// The worst first.
std::vector<SmallAngle> small_angles(CurvesOfVertices& curves, const TriMesh& mesh) {
  std::vector<SmallAngle> all;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const std::array<double, 3> angles = angles_of(mesh, t);
    const auto least = static_cast<std::size_t>(std::ranges::min_element(angles) - angles.begin());
    if (!(angles[least] < fair_angle)) continue;
    const TriMesh::Facet& f = mesh.facet(t);
    Curves to_blame = curves_to_blame(curves, {f[least], f[(least + 1) % 3], f[(least + 2) % 3]});
    if (to_blame.empty()) continue;
    all.push_back({lacking_in(angles[least]),
                   {mesh.position(f[0]), mesh.position(f[1]), mesh.position(f[2])},
                   std::move(to_blame)});
  }
  std::ranges::stable_sort(all, std::greater(), &SmallAngle::lacking);
  return all;
}

}  // namespace

std::vector<SmallAngle> angles_at_curves(const TriMesh& surface, const Features& features,
                                         const RemeshWithCurves& remesh, double spacing) {
  CurvesOfVertices curves(surface, features, remesh, on_curve * spacing);
  std::vector<SmallAngle> angles = faults(surface, features, remesh, spacing);
  const std::vector<SmallAngle> small = small_angles(curves, remesh.mesh);
  angles.insert(angles.end(), small.begin(), small.end());
  return angles;
}

double lacking_in_angles(const TriMesh& remesh) {
  double sum = 0;
  for (FacetId t(0); t.index() < remesh.num_facets(); t = FacetId(t.value + 1))
    sum += lacking_in(std::ranges::min(angles_of(remesh, t)));
  return sum;
}

std::array<VertexId, 2> edge_of(const FeatureCurve& curve, std::size_t number) {
  return {curve.vertices[number], curve.vertices[(number + 1) % curve.vertices.size()]};
}

bool NearEdges::is_near_another(const Vec3& x, std::size_t c) const {
  return std::ranges::any_of(angle_.to_blame, [&](std::size_t other) {
    return other != c && is_within(x, surface_, features_.curves[other], near_);
  });
}

std::size_t NearEdges::nearest_edge(std::size_t c) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < features_.curves[c].facets.size(); ++i)
    for (const Vec3& x : angle_.corners) {
      const double distance2 = distance2_to_edge(x, surface_, features_.curves[c], i);
      if (distance2 < least) least = distance2, nearest = i;
    }
  return nearest;
}

std::vector<bool> NearEdges::of(std::size_t c) const {
  const FeatureCurve& curve = features_.curves[c];
  const std::size_t n = curve.facets.size();
  if (angle_.to_blame.size() == 1) return std::vector<bool>(n, true);
  std::vector<bool> edges(n, false);
  const std::size_t nearest = nearest_edge(c);
  edges[nearest] = true;
  const auto is_near = [&](std::size_t i) {
    return is_near_another(surface_.position(curve.vertices[i % curve.vertices.size()]), c);
  };
  for (std::size_t i = nearest; (curve.loop || i + 1 < n) && !edges[(i + 1) % n] && is_near(i + 1);)
    edges[i = (i + 1) % n] = true;
  for (std::size_t i = nearest; (curve.loop || i > 0) && !edges[(i + n - 1) % n] && is_near(i);)
    edges[i = (i + n - 1) % n] = true;
  return edges;
}

}  // namespace fpo
