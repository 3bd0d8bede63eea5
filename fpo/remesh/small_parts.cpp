#include "fpo/remesh/small_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;

namespace {

constexpr std::array<std::size_t, 3> bodies = {8, 6, 5};  // samples that make one: as many as can be spared
constexpr std::size_t corners_of_a_triangle = 3, corners_of_a_solid = 4;
constexpr double between_spots = 0.6;  // wanted lengths
constexpr double steep = 1;            // gradation around: no edge leads from there to another component

double area_of_sample(double h) { return std::sqrt(0.75) * h * h; }

Vec3 centroid(const TriMesh& mesh, FacetId t) {
  return (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
}

/// The samples that the sizing calls for there, or some number above the most.
double demand(const TriMesh& mesh, const Sizing& sizing, const std::vector<FacetId>& part, double most) {
  double sum = 0;
  for (const FacetId t : part) {
    sum += mesh.area(t) / area_of_sample(sizing.at({centroid(mesh, t), t}));
    if (sum > most) break;
  }
  return sum;
}

std::vector<std::vector<FacetId>> facets_by_part(const geom::SurfaceType& type) {
  std::vector<std::vector<FacetId>> parts(type.parts.size());
  for (FacetId t(0); t.index() < type.part_of.size(); t = FacetId(t.value + 1))
    parts[type.part_of[t]].push_back(t);
  return parts;
}

}  // namespace

std::vector<Spot> spots_of_body(const TriMesh& mesh, const std::vector<FacetId>& part,
                                std::size_t num_samples) {
  double area = 0;
  for (const FacetId t : part) area += mesh.area(t);
  if (!(area > 0)) return {};
  const double wanted = hexagonal_spacing(area, num_samples), near = between_spots * wanted;
  std::vector<Spot> spots;
  for (const FacetId t : part) {
    const Vec3 at = centroid(mesh, t);
    const auto is_near = [&](const Spot& s) { return (s.at - at).squaredNorm() < near * near; };
    if (std::ranges::none_of(spots, is_near)) spots.push_back({at, wanted, steep, near});
  }
  return spots;
}

SmallParts::SmallParts(const TriMesh& mesh) : mesh_(mesh) {
  geom::SurfaceType type = geom::surface_type(mesh);
  if (type.parts.size() < 2) return;
  parts_ = facets_by_part(type);
  part_of_ = std::move(type.part_of);
  types_ = std::move(type.parts);
}

std::vector<bool> SmallParts::have_bodies(std::span<const SurfaceSample> fixed) const {
  std::vector<std::size_t> count(parts_.size(), 0);
  for (const SurfaceSample& x : fixed)
    if (!parts_.empty()) ++count[part_of_[x.facet]];
  std::vector<bool> result;
  for (std::size_t p = 0; p < parts_.size(); ++p)
    result.push_back(count[p] >= (types_[p].border_loops > 0 ? corners_of_a_triangle : corners_of_a_solid));
  return result;
}

namespace {

/// Samples that parts have and are to have.
struct Plan {
  std::size_t body = 0, num_parts = 0;  ///< so many, the first so many
  double extra = 0;
};

/// For parts that call for so many, descending: all have as many as possible, or the first as few as is.
Plan plan_for(const std::vector<double>& demands, double most) {
  Plan plan;
  for (const std::size_t body : bodies) {
    plan = {body, 0, 0};
    for (const double now : demands) {
      const double more = std::max(static_cast<double>(body) - now, 0.0);
      if (plan.extra + more > most) break;
      plan.extra += more;
      ++plan.num_parts;
    }
    if (plan.num_parts == demands.size()) break;
  }
  return plan;
}

}  // namespace

std::optional<Sizing> SmallParts::room(const Sizing& sizing, std::size_t n, double most_scale,
                                       std::span<const SurfaceSample> fixed) const {
  constexpr auto enough = static_cast<double>(bodies.front());
  std::vector<std::pair<double, const std::vector<FacetId>*>> small;
  const std::vector<bool> has_body = have_bodies(fixed);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const double now = has_body[p] ? 0 : demand(mesh_, sizing, parts_[p], enough);
    if (now > 0 && now < enough) small.emplace_back(now, &parts_[p]);
  }
  std::ranges::stable_sort(small, std::greater<>(), [](const auto& part) { return part.first; });
  std::vector<double> demands;
  demands.reserve(small.size());
  for (const auto& part : small) demands.push_back(part.first);
  const auto count = static_cast<double>(n - std::min(n, fixed.size()));
  const Plan plan = plan_for(demands, count * (1 - 1 / (most_scale * most_scale)));
  std::vector<Spot> wanted;
  for (std::size_t i = 0; i < plan.num_parts; ++i) {
    if (demands[i] >= static_cast<double>(plan.body)) continue;
    const std::vector<Spot> there = spots_of_body(mesh_, *small[i].second, plan.body);
    wanted.insert(wanted.end(), there.begin(), there.end());
  }
  auto spots = std::make_shared<Spots>();
  spots->add(wanted);
  if (spots->empty()) return {};
  return sizing.lowered(std::sqrt(count / (count - plan.extra)), spots, mesh_);
}

void SmallParts::people(const Sizing& sizing, std::size_t num_fixed,
                        std::vector<SurfaceSample>& samples) const {
  constexpr std::size_t most = 2 * bodies.front();
  Peopling peopling{mesh_, part_of_, {}, num_fixed};
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const double wanted = std::round(demand(mesh_, sizing, parts_[p], static_cast<double>(most)));
    if (wanted >= static_cast<double>(bodies.back()) && wanted < static_cast<double>(most))
      peopling.least[p] = std::min(static_cast<std::size_t>(wanted), bodies.front());
  }
  fpo::people(peopling, samples);
}

namespace {

/// A part of the surface and where samples on it are.
struct Part {
  std::vector<FacetId> facets;
  std::vector<Vec3> samples;
  std::size_t least = 0;  ///< samples

  /// The vertex that is farthest from all samples.
  SurfaceSample farthest(const TriMesh& mesh) const {
    SurfaceSample best{mesh.corner(facets.front(), 0), facets.front()};
    double most2 = -1;
    for (const FacetId t : facets)
      for (int i = 0; i < 3; ++i) {
        double least2 = std::numeric_limits<double>::infinity();
        for (const Vec3& x : samples) least2 = std::min(least2, (x - mesh.corner(t, i)).squaredNorm());
        if (least2 > most2) most2 = least2, best = {mesh.corner(t, i), t};
      }
    return best;
  }
};

}  // namespace

void people(const Peopling& what, std::vector<SurfaceSample>& samples) {
  if (what.least.empty()) return;
  std::map<std::size_t, Part> poor;
  for (const auto& [p, least] : what.least) poor[p].least = least;
  const auto is_poor = [&](FacetId t) { return poor.contains(what.part_of[t]); };
  for (FacetId t(0); t.index() < what.mesh.num_facets(); t = FacetId(t.value + 1))
    if (is_poor(t)) poor[what.part_of[t]].facets.push_back(t);
  std::map<std::size_t, std::size_t> others;  // samples that other parts have
  for (const SurfaceSample& x : samples)
    if (is_poor(x.facet))
      poor[what.part_of[x.facet]].samples.push_back(x.position);
    else
      ++others[what.part_of[x.facet]];
  const auto can_spare = [&](FacetId t) { return !is_poor(t) && others[what.part_of[t]] > bodies.front(); };
  std::size_t next = what.num_fixed;
  for (auto& [number, part] : poor)
    for (; !part.facets.empty() && part.samples.size() < part.least; ++next) {
      while (next < samples.size() && !can_spare(samples[next].facet)) ++next;
      if (next == samples.size()) return;
      --others[what.part_of[samples[next].facet]];
      samples[next] = part.farthest(what.mesh);
      part.samples.push_back(samples[next].position);
    }
}

}  // namespace fpo
