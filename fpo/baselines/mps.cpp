#include "fpo/baselines/mps.h"

#include <algorithm>
#include <array>

#include "fpo/baselines/disks.h"
#include "fpo/surface/initial_samples.h"
#include "geom/power/restricted_power.h"
#include "geom/rng.h"

namespace fpo {

using geom::FacetId;
using geom::FragmentId;
using geom::Vec3;

namespace {

constexpr std::size_t darts_per_sample = 10;
constexpr int first_depth = 1;
constexpr int last_depth = 14;  // gaps that are smaller than a 2^-14th of their fragment get their corner

/// A part of a fragment of which at least one corner is in no disk.
struct GapTriangle {
  std::array<Vec3, 3> corners;
  FacetId facet;
};

/// Disks with their restricted power diagram.
class DiskDiagram {
 public:
  DiskDiagram(const BaselineTask& task, double radius_factor)
      : surface_(task.surface), disks_(task.sizing, radius_factor) {}

  bool is_free(const Vec3& x) const { return disks_.is_free(x); }
  void add(const SurfaceSample& x) { disks_.add(x); }
  const std::vector<SurfaceSample>& samples() const { return disks_.samples(); }

  /// Calls visit(corners, owner, facet) for each fragment with a corner that may be in no disk.
  template <class Visit>
  void for_each_gap(Visit visit) const {
    std::vector<geom::WeightedPoint3> points;
    for (const SurfaceSample& x : disks_.samples()) points.push_back(disks_.point(x));
    if (points.empty()) return;
    const geom::RestrictedPower diagram(surface_, points, disks_.tree());
    const geom::FragmentStore& fragments = diagram.fragments();
    std::array<geom::PolygonCorner, 3> buffer;
    for (FacetId t(0); t.index() < surface_.num_facets(); t = FacetId(t.value + 1))
      for (const FragmentId f : fragments.of_facet(t))
        if (fragments.max_radius2(f) > 0)
          visit(fragments.corners(f, buffer), diagram.site(fragments.site(f)), t);
  }

 private:
  const geom::TriMesh& surface_;
  Disks disks_;
};

/// Divides a triangle in four, `depth` times over, as long as the owner's disk covers it in part. What it
/// covers wholly is left out: all corners in a disk means all of the triangle.
void divide(const std::array<Vec3, 3>& c, const geom::WeightedPoint3& owner, FacetId facet, int depth,
            std::vector<GapTriangle>& out) {
  const auto num_free = std::ranges::count_if(c, [&](const Vec3& x) { return geom::power(x, owner) > 0; });
  if (num_free == 0) return;
  if (num_free == 3 || depth == 0) {
    out.push_back({c, facet});
    return;
  }
  const Vec3 m0 = (c[0] + c[1]) / 2, m1 = (c[1] + c[2]) / 2, m2 = (c[2] + c[0]) / 2;
  for (const std::array<Vec3, 3>& part :
       {std::array{c[0], m0, m2}, std::array{m0, c[1], m1}, std::array{m2, m1, c[2]}, std::array{m0, m1, m2}})
    divide(part, owner, facet, depth - 1, out);
}

std::vector<GapTriangle> gap_triangles(const DiskDiagram& disks, int depth) {
  std::vector<GapTriangle> gaps;
  disks.for_each_gap([&](auto corners, const geom::WeightedPoint3& owner, FacetId t) {
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      divide({corners[0].point.position, corners[k].point.position, corners[k + 1].point.position}, owner, t,
             depth, gaps);
  });
  return gaps;
}

/// As many darts as there are triangles, with density h^-2.
void throw_darts(DiskDiagram& disks, const std::vector<GapTriangle>& gaps, const Sizing& sizing,
                 geom::Rng& rng) {
  std::vector<double> mass_up_to;
  double total = 0;
  for (const GapTriangle& gap : gaps) {
    const auto& [a, b, c] = gap.corners;
    const double h = sizing.at(SurfaceSample{(a + b + c) / 3, gap.facet});
    mass_up_to.push_back(total += (b - a).cross(c - a).norm() / (h * h));
  }
  if (!(total > 0)) return;
  for (std::size_t dart = 0; dart < gaps.size(); ++dart) {
    const auto pick =
        std::min(std::ranges::upper_bound(mass_up_to, rng.uniform() * total), mass_up_to.end() - 1);
    const GapTriangle& gap = gaps[static_cast<std::size_t>(pick - mass_up_to.begin())];
    const double r = std::sqrt(rng.uniform()), s = rng.uniform();  // as in initial_samples.cpp
    const auto& [a, b, c] = gap.corners;
    const SurfaceSample x{geom::snapped(Vec3(a + r * (1 - s) * (b - a) + r * s * (c - a))), gap.facet};
    if (disks.is_free(x.position)) disks.add(x);
  }
}

/// Puts samples at corners of fragments until no corner is free. Each is at least as far from all others as
/// its power says.
void fill_corners(DiskDiagram& disks) {
  std::vector<SurfaceSample> free;
  do {
    free.clear();
    disks.for_each_gap([&](auto corners, const geom::WeightedPoint3& owner, FacetId t) {
      for (const geom::PolygonCorner& corner : corners) {
        const Vec3 x = geom::snapped(corner.point.position);
        if (geom::power(x, owner) > 0 && disks.is_free(x)) free.push_back({x, t});
      }
    });
    for (const SurfaceSample& x : free)
      if (disks.is_free(x.position)) disks.add(x);
  } while (!free.empty());
}

/// Each round divides the fragments once more: gaps that are still there are small parts of them.
void fill_gaps(DiskDiagram& disks, const BaselineTask& task, const OptimizeOptions& options) {
  geom::Rng rng(task.seed + 1);  // not that of the first darts
  for (int depth = first_depth; depth <= last_depth; ++depth) {
    const std::vector<GapTriangle> gaps = gap_triangles(disks, depth);
    if (gaps.empty() || interrupted(options)) return;
    throw_darts(disks, gaps, task.sizing, rng);
  }
  fill_corners(disks);
}

}  // namespace

BaselineResult maximal_poisson_disks(const BaselineTask& task, const OptimizeOptions& options) {
  const std::vector<SurfaceSample> darts = random_pool(task, darts_per_sample);
  return search_radius(task, options, [&](double radius_factor) {
    DiskDiagram disks(task, radius_factor);
    for (const SurfaceSample& x : task.fixed) disks.add(x);
    for (const SurfaceSample& x : darts) {
      if (disks.is_free(x.position)) disks.add(x);
      if (interrupted(options)) break;
    }
    if (task.num_inner() > 0) fill_gaps(disks, task, options);
    return disks.samples();
  });
}

}  // namespace fpo
