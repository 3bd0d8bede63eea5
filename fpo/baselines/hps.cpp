#include "fpo/baselines/hps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "fpo/baselines/disks.h"
#include "geom/check.h"
#include "geom/rng.h"

namespace fpo {

using geom::FacetId;
using geom::Vec3;

namespace {

constexpr double least_size = 0x1p-20;  // of an active triangle, in units of the radius there

struct ActiveTriangle {
  std::array<Vec3, 3> corners;
  FacetId facet;

  Vec3 middle() const { return (corners[0] + corners[1] + corners[2]) / 3; }
  double area() const { return (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() / 2; }
  double longest_edge() const {
    return std::max({(corners[1] - corners[0]).norm(), (corners[2] - corners[1]).norm(),
                     (corners[0] - corners[2]).norm()});
  }
};

/// Active triangles by the binary order of their mass: bin e holds masses in [2^e, 2^(e+1)).
class ActiveTriangles {
 public:
  void add(const ActiveTriangle& triangle, double mass) {
    if (mass > 0) bins_[std::ilogb(mass)].push_back({triangle, mass});
  }

  /// Takes one out with a probability proportional to its mass. False if there is none.
  bool take(geom::Rng& rng, ActiveTriangle& out) {
    std::erase_if(bins_, [](const auto& bin) { return bin.second.empty(); });
    if (bins_.empty()) return false;
    for (;;) {
      std::vector<Entry>& bin = *pick_bin(rng);
      const std::size_t at = rng.below(bin.size());
      const double bound = std::ldexp(1, std::ilogb(bin[at].mass) + 1);
      if (rng.uniform() * bound > bin[at].mass) continue;  // at most half of the picks
      out = bin[at].triangle;
      bin[at] = bin.back();
      bin.pop_back();
      return true;
    }
  }

 private:
  struct Entry {
    ActiveTriangle triangle;
    double mass;
  };
  /// The large ones first: these are the likely ones.
  using Bins = std::map<int, std::vector<Entry>, std::greater<>>;

  std::vector<Entry>* pick_bin(geom::Rng& rng) {
    double total = 0;
    for (const auto& [e, bin] : bins_) total += std::ldexp(static_cast<double>(bin.size()), e);
    double left = rng.uniform() * total;
    for (auto& [e, bin] : bins_)
      if ((left -= std::ldexp(static_cast<double>(bin.size()), e)) < 0) return &bin;
    return &bins_.begin()->second;
  }

  Bins bins_;
};

class Hierarchy {
 public:
  Hierarchy(const BaselineTask& task, double radius_factor)
      : task_(task), radius_factor_(radius_factor), disks_(task.sizing, radius_factor), rng_(task.seed) {
    for (const SurfaceSample& x : task.fixed) disks_.add(x);
    const geom::TriMesh& mesh = task.surface;
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
      activate({{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}, t});
  }

  /// A dart, and the division. False if nothing is active.
  bool step() {
    ActiveTriangle triangle;
    if (!active_.take(rng_, triangle)) return false;
    throw_dart(triangle);
    if (is_covered(triangle)) return true;
    if (triangle.longest_edge() < least_size * radius_at(triangle)) {
      give_up(triangle);
      return true;
    }
    const auto& [a, b, c] = triangle.corners;
    const Vec3 ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    for (const std::array<Vec3, 3>& part :
         {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
      activate({part, triangle.facet});
    return true;
  }

  const std::vector<SurfaceSample>& samples() const { return disks_.samples(); }
  std::size_t uncovered() const { return uncovered_; }

 private:
  double h_at(const ActiveTriangle& t) const { return task_.sizing.at(SurfaceSample{t.middle(), t.facet}); }
  double radius_at(const ActiveTriangle& t) const { return radius_factor_ * h_at(t); }

  /// By the disk that is nearest to the middle in power.
  bool is_covered(const ActiveTriangle& triangle) const {
    if (disks_.samples().empty()) return false;
    const SiteId owner = disks_.tree().nearest(triangle.middle(), SiteId()).site;
    const geom::WeightedPoint3 disk = disks_.point(disks_.samples()[owner.index()]);
    return std::ranges::all_of(triangle.corners, [&](const Vec3& x) { return geom::power(x, disk) <= 0; });
  }

  void activate(const ActiveTriangle& triangle) {
    if (is_covered(triangle)) return;
    const double h = h_at(triangle);
    active_.add(triangle, triangle.area() / (h * h));
  }

  void throw_dart(const ActiveTriangle& triangle) {
    const double r = std::sqrt(rng_.uniform()), s = rng_.uniform();  // as in initial_samples.cpp
    const auto& [a, b, c] = triangle.corners;
    const SurfaceSample x{geom::snapped(Vec3(a + r * (1 - s) * (b - a) + r * s * (c - a))), triangle.facet};
    if (disks_.is_free(x.position)) disks_.add(x);
  }

  void give_up(const ActiveTriangle& triangle) {
    const SurfaceSample x{geom::snapped(triangle.middle()), triangle.facet};
    if (disks_.is_free(x.position))
      disks_.add(x);
    else
      ++uncovered_;
  }

  const BaselineTask& task_;
  double radius_factor_;
  Disks disks_;
  geom::Rng rng_;
  ActiveTriangles active_;
  std::size_t uncovered_ = 0;
};

}  // namespace

BaselineResult hierarchical_poisson_disks(const BaselineTask& task, const OptimizeOptions& options) {
  std::map<double, std::size_t> uncovered;  // of each radius tried
  BaselineResult result = search_radius(task, options, [&](double radius_factor) {
    if (task.num_inner() == 0) return std::vector<SurfaceSample>(task.fixed.begin(), task.fixed.end());
    Hierarchy hierarchy(task, radius_factor);
    while (!interrupted(options) && hierarchy.step()) {
    }
    uncovered[radius_factor] = hierarchy.uncovered();
    return hierarchy.samples();
  });
  result.reached.push_back({"uncovered_triangles", static_cast<double>(uncovered[result.radius_factor])});
  return result;
}

}  // namespace fpo
