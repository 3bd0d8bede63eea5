#include "fpo/remesh/harmful_parts.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

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

constexpr double fair_angle = 30;       // degrees
constexpr double spacings_worth = 10;   // of a crease folded by 90 degrees: one angle of nothing
constexpr double least_left = 0.5;      // of all that there is to be seen
constexpr double on_curve = 1e-6;       // of the spacing
constexpr std::size_t on_features = 2;  // vertices of a triangle that curves are to blame for
constexpr double near_another = 0.7;    // in spacings: triangles between curves are good if these are farther
constexpr double least_kept = 2;        // in spacings: what fades out and is shorter is not kept

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

/// A triangle with an angle that is less than fair.
struct SmallAngle {
  double lacking;
  std::array<Vec3, 3> corners;
  Curves curves;  ///< to blame for it
};

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
      if (is_within(x, surface, features.curves[c], near_another * spacing)) fault.curves.push_back(c);
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

/// Some edges of a curve.
struct Part {
  std::size_t curve;
  std::vector<bool> edges;  ///< of the curve: is it one of them?
  double lacking = 0;       ///< in the angles that they are to blame for
};

bool overlap(const Part& a, const Part& b) {
  if (a.curve != b.curve) return false;
  for (std::size_t i = 0; i < a.edges.size(); ++i)
    if (a.edges[i] && b.edges[i]) return true;
  return false;
}

/// The parts that are to blame for angles.
class Blame {
 public:
  Blame(const TriMesh& surface, const Features& features, const SeenCurves& seen,
        std::span<const FeatureEdge> spared)
      : surface_(surface), features_(features), seen_(seen), of_edges_(features.curves.size()) {
    for (const auto& [a, b] : spared) spared_.insert(std::minmax(a, b));
  }

  /// To that of which there is the least to be seen, but for what is to blame for others already.
  void put(const SmallAngle& angle);

  const std::vector<Part>& parts() const { return parts_; }
  /// What there is to be seen of it.
  double strength(const Part& part);
  CreasePart crease(const Part& part) const;

 private:
  bool may_go(std::size_t c) const {
    return features_.curves[c].sheets == 2 && seen_.lengths[c] >= shortest_curve * seen_.spacing;
  }
  FeatureEdge edge(std::size_t c, std::size_t i) const {
    const std::vector<VertexId>& vertices = features_.curves[c].vertices;
    return {vertices[i], vertices[(i + 1) % vertices.size()]};
  }
  double length(const Part& part) const;
  bool is_spared(const Part& part) const;
  bool is_near_another(const Vec3& x, std::size_t c, const SmallAngle& angle) const;
  std::size_t nearest_edge(std::size_t c, const SmallAngle& angle) const;
  Part near_part(std::size_t c, const SmallAngle& angle) const;
  double strength_added(const Part& part);
  void absorb(Part part);

  const TriMesh& surface_;
  const Features& features_;
  const SeenCurves& seen_;
  std::set<std::pair<VertexId, VertexId>> spared_;
  std::vector<std::vector<double>> of_edges_;  ///< what there is to be seen of them, of each curve
  std::vector<Part> parts_;                    ///< that do not overlap
};

double Blame::strength(const Part& part) {
  std::vector<double>& of_edges = of_edges_[part.curve];
  if (of_edges.empty()) of_edges = seen_of_edges(surface_, features_.curves[part.curve]);
  double share = 0;
  for (std::size_t i = 0; i < part.edges.size(); ++i)
    if (part.edges[i]) share += of_edges[i];
  return share * seen_.strengths[part.curve];
}

CreasePart Blame::crease(const Part& part) const {
  CreasePart result{part.curve, {}, std::ranges::count(part.edges, false) == 0, part.lacking};
  for (std::size_t i = 0; i < part.edges.size(); ++i)
    if (part.edges[i]) result.edges.push_back(edge(part.curve, i));
  return result;
}

double Blame::length(const Part& part) const {
  double sum = 0;
  for (std::size_t i = 0; i < part.edges.size(); ++i) {
    const auto [a, b] = edge(part.curve, i);
    if (part.edges[i]) sum += (surface_.position(b) - surface_.position(a)).norm();
  }
  return sum;
}

bool Blame::is_spared(const Part& part) const {
  for (std::size_t i = 0; i < part.edges.size(); ++i) {
    const auto [a, b] = edge(part.curve, i);
    if (part.edges[i] && spared_.contains(std::minmax(a, b))) return true;
  }
  return false;
}

/// Another curve that is to blame for the angle.
bool Blame::is_near_another(const Vec3& x, std::size_t c, const SmallAngle& angle) const {
  const double near = near_another * seen_.spacing;
  return std::ranges::any_of(angle.curves, [&](std::size_t other) {
    return other != c && is_within(x, surface_, features_.curves[other], near);
  });
}

std::size_t Blame::nearest_edge(std::size_t c, const SmallAngle& angle) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < features_.curves[c].facets.size(); ++i)
    for (const Vec3& x : angle.corners) {
      const double distance2 = distance2_to_edge(x, surface_, features_.curves[c], i);
      if (distance2 < least) least = distance2, nearest = i;
    }
  return nearest;
}

/// From the place nearest to the triangle as far as another is near; all if hardly anything is left.
Part Blame::near_part(std::size_t c, const SmallAngle& angle) const {
  const FeatureCurve& curve = features_.curves[c];
  const std::size_t n = curve.facets.size();
  const Part all{c, std::vector<bool>(n, true)};
  if (angle.curves.size() == 1) return all;
  Part part{c, std::vector<bool>(n, false)};
  const std::size_t nearest = nearest_edge(c, angle);
  part.edges[nearest] = true;
  const auto is_near = [&](std::size_t i) {
    return is_near_another(surface_.position(curve.vertices[i % curve.vertices.size()]), c, angle);
  };
  for (std::size_t i = nearest; (curve.loop || i + 1 < n) && !part.edges[(i + 1) % n] && is_near(i + 1);)
    part.edges[i = (i + 1) % n] = true;
  for (std::size_t i = nearest; (curve.loop || i > 0) && !part.edges[(i + n - 1) % n] && is_near(i);)
    part.edges[i = (i + n - 1) % n] = true;
  return seen_.lengths[c] - length(part) < least_kept * seen_.spacing ? all : part;
}

double Blame::strength_added(const Part& part) {
  Part added = part;
  for (const Part& old : parts_)
    for (std::size_t i = 0; old.curve == part.curve && i < added.edges.size(); ++i)
      if (old.edges[i]) added.edges[i] = false;
  return strength(added);
}

/// Those absorbed overlap no other, so what it becomes overlaps none that is left.
void Blame::absorb(Part part) {
  std::erase_if(parts_, [&](const Part& old) {
    if (!overlap(old, part)) return false;
    part.lacking += old.lacking;
    for (std::size_t i = 0; i < old.edges.size(); ++i)
      if (old.edges[i]) part.edges[i] = true;
    return true;
  });
  parts_.push_back(std::move(part));
}

void Blame::put(const SmallAngle& angle) {
  std::optional<Part> best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t c : angle.curves) {
    if (!may_go(c)) continue;
    Part part = near_part(c, angle);
    const double added = is_spared(part) ? std::numeric_limits<double>::infinity() : strength_added(part);
    if (!(added < least)) continue;
    least = added;
    best = std::move(part);
  }
  if (!best) return;
  best->lacking = angle.lacking;
  absorb(std::move(*best));
}

}  // namespace

double lacking_in_angles(const TriMesh& remesh) {
  double sum = 0;
  for (FacetId t(0); t.index() < remesh.num_facets(); t = FacetId(t.value + 1))
    sum += lacking_in(std::ranges::min(angles_of(remesh, t)));
  return sum;
}

std::vector<CreasePart> harmful_parts(const TriMesh& surface, const Features& features,
                                      const RemeshWithCurves& remesh, const HarmOptions& options) {
  CurvesOfVertices curves(surface, features, remesh, on_curve * options.spacing);
  std::vector<SmallAngle> angles = faults(surface, features, remesh, options.spacing);
  const std::vector<SmallAngle> small = small_angles(curves, remesh.mesh);
  angles.insert(angles.end(), small.begin(), small.end());
  if (angles.empty()) return {};
  const SeenCurves seen = seen_curves(surface, features, options.spacing);
  Blame blame(surface, features, seen, options.spared);
  for (const SmallAngle& angle : angles) blame.put(angle);
  std::vector<std::pair<double, const Part*>> harmful;  // with their strengths
  for (const Part& part : blame.parts()) {
    const double strength = blame.strength(part);
    if (spacings_worth * part.lacking >= strength) harmful.emplace_back(strength, &part);
  }
  std::ranges::stable_sort(harmful, {}, [](const auto& part) { return part.first / part.second->lacking; });
  const double most = (1 - least_left) * total_strength(seen);
  double lost = 0;
  std::vector<CreasePart> result;
  for (const auto& [strength, part] : harmful) {
    if (lost + strength > most) continue;
    lost += strength;
    result.push_back(blame.crease(*part));
  }
  return result;
}

}  // namespace fpo
