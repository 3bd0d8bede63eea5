#include "fpo/remesh/angle_edits.h"

#include <algorithm>
#include <array>
#include <limits>

#include "fpo/measure/triangle_angles.h"
#include "fpo/remesh/recovered_edges.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

namespace edits {
constexpr double rounding = 1e-9;
constexpr double least_gain = 1e-3;         // of the penalty around
constexpr double flat = 0.8, turned = 0.7;  // cosines between normals: of a flip, of a facet before and after
constexpr int flip_sweeps = 3;
constexpr double noticed = 0.01;  // degrees
}  // namespace edits

}  // namespace

AngleEdits::AngleEdits(const LastAnglesTask& task, const TriMesh& remesh, std::vector<SurfaceSample>& samples)
    : rules{std::min(task.goal.smallest, task.angles.smallest) - edits::rounding, task.angles.smallest,
            task.angles.largest, task.goal.least_edge},
      task_(task),
      samples_(samples),
      mesh_(remesh),
      places_(task),
      chains_(chain_edges(task.features)) {}

std::vector<FacetId> AngleEdits::bad() const {
  std::vector<std::pair<double, FacetId>> found;
  for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1))
    if (const double least = least_angle(mesh_, t); least < rules.good) found.emplace_back(least, t);
  std::ranges::sort(found);
  std::vector<FacetId> result;
  result.reserve(found.size());
  for (const auto& [least, t] : found) result.push_back(t);
  return result;
}

AngleScore AngleEdits::score(const FacetRegion& region) const {
  AngleScore sum;
  for (const FacetId t : region) {
    const auto [least, most] = std::ranges::minmax(angles_of(mesh_, t));
    const double beyond = std::max(rules.smallest - least, 0.0) + std::max(most - rules.largest, 0.0);
    sum.penalty += beyond * beyond;
    sum.least = std::min(sum.least, least);
    sum.bad += least < rules.good;
  }
  return sum;
}

bool AngleEdits::is_better(const AngleScore& after, const AngleScore& before) const {
  return after.penalty < (1 - edits::least_gain) * before.penalty &&
         after.least >= std::min(rules.good, before.least) && (!rules.counts || after.bad <= before.bad);
}

bool AngleEdits::is_of_curve(VertexId a, VertexId b) const {
  return std::ranges::binary_search(chains_, std::pair<VertexId, VertexId>(std::minmax(a, b)));
}

/// Along straight curves it stays what it is.
bool AngleEdits::is_stuck_between_curves(FacetId t) {
  const EditedMesh::Facet f = mesh_.facet(t);
  const std::array<double, 3> angles = angles_of(mesh_, t);
  const auto i = static_cast<std::size_t>(std::ranges::min_element(angles) - angles.begin());
  if (!is_of_curve(f[i], f[(i + 1) % 3]) || !is_of_curve(f[i], f[(i + 2) % 3])) return false;
  return std::ranges::none_of(f, [&](VertexId v) {
    return std::ranges::any_of(places(v), [&](const SurfaceSample& place) {
      const auto at = [&](VertexId w) { return w == v ? place.position : mesh_.position(w); };
      return angles_of({at(f[0]), at(f[1]), at(f[2])})[i] > angles[i] + edits::noticed;
    });
  });
}

double AngleEdits::least_cosine(const FacetRegion& region) const {
  double least = 1;
  for (const FacetId t : region) {
    const EditedMesh::Facet& f = mesh_.facet(t);
    const Vec3 normal = mesh_.normal(t).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId a = f[i], b = f[(i + 1) % 3];
      const FacetId beyond = mesh_.beside(b, a);
      if (beyond.valid() && !is_of_curve(a, b))
        least = std::min(least, normal.dot(mesh_.normal(beyond).normalized()));
    }
  }
  return least;
}

bool AngleEdits::may_flip(VertexId a, VertexId b) const {
  if (is_of_curve(a, b) || !mesh_.can_flip(a, b)) return false;
  return mesh_.normal(mesh_.beside(a, b)).normalized().dot(mesh_.normal(mesh_.beside(b, a)).normalized()) >
         edits::flat;
}

bool AngleEdits::flip(VertexId a, VertexId b) {
  if (!may_flip(a, b)) return false;
  const FacetId t = mesh_.beside(a, b), u = mesh_.beside(b, a);
  const Vec3 before = mesh_.normal(t) + mesh_.normal(u);
  const std::size_t start = mesh_.num_edits();
  mesh_.flip(a, b);
  for (const FacetId f : {t, u})
    if (!(mesh_.normal(f).dot(before) > edits::flat * mesh_.normal(f).norm() * before.norm())) {
      mesh_.undo_to(start);
      return false;
    }
  return true;
}

bool AngleEdits::move(VertexId v, const SurfaceSample& to, const FacetRegion& region) {
  const std::size_t start = mesh_.num_edits();
  if (move_and_flip(v, to, region)) return true;
  mesh_.undo_to(start);
  return false;
}

bool AngleEdits::move_and_flip(VertexId v, const SurfaceSample& to, const FacetRegion& region) {
  const double enough = std::min(shortest_edge(v), rules.least_edge * task_.sizing.at(sample(v)));
  std::vector<Vec3> before;
  for (const FacetId t : mesh_.facets_at(v)) before.push_back(mesh_.normal(t).normalized());
  mesh_.move(v, to.position);
  if (shortest_edge(v) < enough) return false;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!(mesh_.normal(mesh_.facets_at(v)[i]).normalized().dot(before[i]) > edits::turned)) return false;
  for (int sweep = 0; sweep < edits::flip_sweeps; ++sweep)
    if (!flip_around(v, region)) break;
  return shortest_edge(v) >= enough;
}

/// Edges of the facets at v, where that makes the smaller of two angles larger.
bool AngleEdits::flip_around(VertexId v, const FacetRegion& region) {
  bool flipped = false;
  for (const FacetId t : FacetRegion(mesh_.facets_at(v))) {
    const EditedMesh::Facet f = mesh_.facet(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId a = f[i], b = f[(i + 1) % 3];
      const FacetId here = mesh_.beside(a, b), there = mesh_.beside(b, a);
      if (here != t || !std::ranges::binary_search(region, there)) continue;
      const double least = std::min(least_angle(mesh_, here), least_angle(mesh_, there));
      const std::size_t start = mesh_.num_edits();
      if (least > task_.angles.smallest || !flip(a, b)) continue;
      if (std::min(least_angle(mesh_, here), least_angle(mesh_, there)) > least) {
        flipped = true;
        break;
      }
      mesh_.undo_to(start);
    }
  }
  return flipped;
}

double AngleEdits::shortest_edge(VertexId v) const {
  double least = std::numeric_limits<double>::infinity();
  for (const FacetId t : mesh_.facets_at(v))
    for (const VertexId w : mesh_.facet(t))
      if (w != v) least = std::min(least, (mesh_.position(w) - mesh_.position(v)).norm());
  return least;
}

}  // namespace fpo
