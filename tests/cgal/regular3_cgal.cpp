// The triangulation in space against CGAL's, as sets of tetrahedra; both have the same guards.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <functional>

#include "doctest.h"
#include "geom/regular/regular3.h"
#include "geom/rng.h"
#include "tests/cgal/exact_points.h"

namespace {

using geom::Regular3;
using geom::Rng;
using geom::SiteId;
using geom::Vec3;
using geom::WeightedPoint3;
using Tetrahedra = std::vector<Regular3::Simplex>;

template <class Kernel>
using Triangulation =
    CGAL::Regular_triangulation_3<Kernel,
                                  CGAL::Triangulation_data_structure_3<
                                      CGAL::Triangulation_vertex_base_with_info_3<
                                          SiteId, Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>,
                                      CGAL::Regular_triangulation_cell_base_3<Kernel>>>;

Tetrahedra sorted(Tetrahedra simplices) {
  for (Regular3::Simplex& simplex : simplices) std::ranges::sort(simplex);
  std::ranges::sort(simplices);
  return simplices;
}

/// What CGAL makes of the same sites and guards; `convert` turns a site into its weighted point.
template <class Kernel, class Convert>
Tetrahedra by_cgal(const Regular3& ours, std::vector<SiteId> sites, Convert convert) {
  for (int k = 0; k < geom::guard_count; ++k) sites.push_back(geom::guard(k));
  Triangulation<Kernel> theirs;
  for (const SiteId s : sites) {
    const auto v = theirs.insert(convert(ours.point(s), s));
    if (v != typename Triangulation<Kernel>::Vertex_handle()) v->info() = s;
  }
  Tetrahedra simplices;
  for (const auto& c : theirs.finite_cell_handles())
    simplices.push_back(
        {c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()});
  return sorted(std::move(simplices));
}

/// Sites that come and go.
class Walk {
 public:
  Walk(std::uint64_t seed, std::size_t most, std::function<WeightedPoint3(Rng&)> draw)
      : rng_(seed), most_(most), draw_(std::move(draw)) {}

  void step() {
    if (!present_.empty() && (present_.size() == most_ || rng_.below(5) < 2)) {
      const std::size_t k = rng_.below(present_.size());
      triangulation_.remove(present_[k]);
      free_.push_back(present_[k]);
      std::swap(present_[k], present_.back());
      present_.pop_back();
      return;
    }
    SiteId id(present_.size() + free_.size());
    if (!free_.empty()) {
      const std::size_t k = rng_.below(free_.size());
      std::swap(free_[k], free_.back());
      id = free_.back();
      free_.pop_back();
    }
    triangulation_.insert(id, draw_(rng_));
    present_.push_back(id);
  }
  const Regular3& triangulation() const { return triangulation_; }
  const std::vector<SiteId>& present() const { return present_; }

 private:
  Rng rng_;
  std::size_t most_;
  std::function<WeightedPoint3(Rng&)> draw_;
  Regular3 triangulation_{geom::Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1))};
  std::vector<SiteId> present_, free_;
};

Vec3 anywhere(Rng& rng) { return {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}; }
Vec3 on_grid(Rng& rng) {
  const auto c = [&] { return 0.5 * static_cast<double>(rng.below(5)) - 1; };
  return {c(), c(), c()};
}
/// Signed permutations of (1, 1, 2) / 4: cospherical.
Vec3 on_sphere(Rng& rng) {
  Vec3 x(0.25, 0.25, 0.25);
  x[static_cast<int>(rng.below(3))] = 0.5;
  for (double& c : x) c = rng.below(2) == 0 ? c : -c;
  return x;
}
/// On a tilted plane, rounded, and off by a few units.
Vec3 nearly_coplanar(Rng& rng) {
  const Vec3 u = Vec3(1, 2, -0.3).normalized(), v = Vec3(0.2, 0.1, 1.1).normalized();
  const auto c = [&] { return static_cast<double>(rng.below(9)) / 12 - 0.4; };
  Vec3 x = c() * u + c() * v;
  for (double& k : x) k = cgal::rounded(k) + cgal::unit * (static_cast<double>(rng.below(3)) - 1);
  return x;
}

struct Kind {
  const char* name;
  std::function<WeightedPoint3(Rng&)> draw;
};
const Kind kinds[] = {{"random",
                       [](Rng& r) {
                         return WeightedPoint3{anywhere(r), 0};
                       }},
                      {"random weights",
                       [](Rng& r) {
                         return WeightedPoint3{anywhere(r), r.uniform(-0.1, 0.6)};
                       }},
                      {"grid",
                       [](Rng& r) {
                         return WeightedPoint3{on_grid(r), 0};
                       }},
                      {"grid, tied weights",
                       [](Rng& r) {
                         return WeightedPoint3{on_grid(r), 0.25 * static_cast<double>(r.below(4))};
                       }},
                      {"cospherical",
                       [](Rng& r) {
                         return WeightedPoint3{on_sphere(r), 0};
                       }},
                      {"nearly coplanar",
                       [](Rng& r) {
                         return WeightedPoint3{nearly_coplanar(r), 0};
                       }},
                      {"few positions", [](Rng& r) {
                         const double s = static_cast<double>(r.below(4)) / 4;
                         return WeightedPoint3{Vec3(s, s * s, -s), static_cast<double>(r.below(2)) / 8};
                       }}};

}  // namespace

TEST_CASE(
    "CGAL: degenerate sites in space, perturbed in fact, after long sequences of insertions and removals") {
  for (const Kind& kind : kinds) {
    INFO(std::string(kind.name));
    Walk walk(3, 24, [&](Rng& rng) {
      WeightedPoint3 p = kind.draw(rng);
      for (double& c : p.position) c = cgal::rounded(c);
      return WeightedPoint3{p.position, cgal::rounded(p.weight)};
    });
    for (int step = 1; step <= 1200; ++step) {
      walk.step();
      if (step % 100 != 0) continue;
      const auto convert = [](const WeightedPoint3& p, SiteId s) {
        return cgal::perturbed(p, s.valid() ? s.value : 24 + (-2 - s.value));  // guards come last
      };
      REQUIRE(sorted(walk.triangulation().simplices()) ==
              by_cgal<cgal::Kernel>(walk.triangulation(), walk.present(), convert));
    }
  }
}

TEST_CASE("CGAL: many random sites in space") {
  using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
  for (const double weight : {0.0, 0.002}) {
    CAPTURE(weight);
    Walk walk(5, 8000, [&](Rng& rng) { return WeightedPoint3{anywhere(rng), rng.uniform(0, weight)}; });
    for (int step = 0; step < 60000; ++step) walk.step();
    const auto convert = [](const WeightedPoint3& p, SiteId) {
      return Epick::Weighted_point_3(Epick::Point_3(p.position.x(), p.position.y(), p.position.z()),
                                     p.weight);
    };
    CHECK(sorted(walk.triangulation().simplices()) ==
          by_cgal<Epick>(walk.triangulation(), walk.present(), convert));
  }
}
