#include "fpo/remesh/harmful_curves.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "fpo/features/feature_choice.h"
#include "fpo/features/weak_curves.h"
#include "fpo/measure/triangle_angles.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double fair_angle = 28;       // degrees: a crease is worth more than the two that it lacks
constexpr double spacings_worth = 10;   // of a crease folded by 90 degrees: one angle of nothing
constexpr double least_left = 0.5;      // of all that there is to be seen
constexpr double on_curve = 1e-6;       // of the spacing
constexpr std::size_t on_features = 2;  // vertices of a triangle that curves are to blame for

using Curves = std::vector<std::size_t>;  // ascending

/// Which curves a vertex of the remesh is on. One object serves all triangles.
class CurvesOfVertices {
 public:
  CurvesOfVertices(const TriMesh& surface, const Features& features, const RemeshWithCurves& remesh,
                   double reach)
      : surface_(surface), features_(features), remesh_(remesh), reach2_(reach * reach) {}

  const Curves& of(VertexId v) {
    const auto [place, is_new] = known_.try_emplace(v);
    if (is_new && v.index() < remesh_.on_features)
      for (std::size_t c = 0; c < features_.curves.size(); ++c)
        if (is_on(remesh_.mesh.position(v), features_.curves[c])) place->second.push_back(c);
    return place->second;
  }

 private:
  bool is_on(const Vec3& x, const FeatureCurve& curve) const {
    for (std::size_t i = 0; i < curve.facets.size(); ++i) {
      const Vec3& a = surface_.position(curve.vertices[i]);
      const Vec3& b = surface_.position(curve.vertices[(i + 1) % curve.vertices.size()]);
      if (geom::closest_point(x, {a, b, b}).distance2 <= reach2_) return true;
    }
    return false;
  }

  const TriMesh& surface_;
  const Features& features_;
  const RemeshWithCurves& remesh_;
  double reach2_;
  std::map<VertexId, Curves> known_;
};

bool share_any(const Curves& a, const Curves& b) {
  return std::ranges::any_of(a, [&](std::size_t c) { return std::ranges::binary_search(b, c); });
}

/// Those of the corners of a triangle that has a small angle at the first one. None if that is an angle
/// between curves, or hardly any corner is on one.
Curves curves_to_blame(CurvesOfVertices& curves, const std::array<VertexId, 3>& corners) {
  const std::array<const Curves*, 3> at{&curves.of(corners[0]), &curves.of(corners[1]),
                                        &curves.of(corners[2])};
  const auto num_on =
      static_cast<std::size_t>(std::ranges::count_if(at, [](const Curves* of) { return !of->empty(); }));
  if (num_on < on_features || (share_any(*at[0], *at[1]) && share_any(*at[0], *at[2]))) return {};
  Curves all;
  for (const Curves* of : at) all.insert(all.end(), of->begin(), of->end());
  return all;
}

double lacking_in(double angle) { return std::max(1 - angle / fair_angle, 0.0); }

/// A triangle with an angle that is less than fair.
struct SmallAngle {
  double lacking;
  Curves curves;  ///< to blame for it
};

std::vector<SmallAngle> small_angles(CurvesOfVertices& curves, const TriMesh& mesh) {
  std::vector<SmallAngle> all;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const std::array<double, 3> angles = angles_of(mesh, t);
    const auto least = static_cast<std::size_t>(std::ranges::min_element(angles) - angles.begin());
    if (!(angles[least] < fair_angle)) continue;
    const TriMesh::Facet& f = mesh.facet(t);
    Curves to_blame = curves_to_blame(curves, {f[least], f[(least + 1) % 3], f[(least + 2) % 3]});
    if (!to_blame.empty()) all.push_back({lacking_in(angles[least]), std::move(to_blame)});
  }
  return all;
}

/// What is lacking beside each curve that is the weakest to blame. What is no crease is so only where no
/// crease is, and is never given up: its strength is infinite.
std::map<std::size_t, double> lacking(const std::vector<SmallAngle>& angles, const SeenCurves& seen) {
  const auto may_go = [&](std::size_t c) { return seen.lengths[c] >= shortest_curve * seen.spacing; };
  std::map<std::size_t, double> sums;
  for (const SmallAngle& angle : angles) {
    std::optional<std::size_t> weakest;
    for (const std::size_t c : angle.curves)
      if (may_go(c) && (!weakest || seen.strengths[c] < seen.strengths[*weakest])) weakest = c;
    if (weakest) sums[*weakest] += angle.lacking;
  }
  return sums;
}

}  // namespace

double lacking_in_angles(const TriMesh& remesh) {
  double sum = 0;
  for (FacetId t(0); t.index() < remesh.num_facets(); t = FacetId(t.value + 1))
    sum += lacking_in(std::ranges::min(angles_of(remesh, t)));
  return sum;
}

std::vector<std::size_t> harmful_curves(const TriMesh& surface, const Features& features,
                                        const RemeshWithCurves& remesh, double spacing) {
  CurvesOfVertices curves(surface, features, remesh, on_curve * spacing);
  const std::vector<SmallAngle> angles = small_angles(curves, remesh.mesh);
  if (angles.empty()) return {};
  const SeenCurves seen = seen_curves(surface, features, spacing);
  const std::map<std::size_t, double> sums = lacking(angles, seen);
  std::vector<std::size_t> harmful;
  for (const auto& [c, sum] : sums)
    if (spacings_worth * sum >= seen.strengths[c]) harmful.push_back(c);
  std::ranges::stable_sort(harmful, {}, [&](std::size_t c) { return seen.strengths[c] / sums.at(c); });
  const double most = (1 - least_left) * total_strength(seen);
  double lost = 0;
  std::erase_if(harmful, [&](std::size_t c) {
    if (lost + seen.strengths[c] > most) return true;
    lost += seen.strengths[c];
    return false;
  });
  return harmful;
}

}  // namespace fpo
