// The triangulation of the torus against CGAL's of nine copies of all sites in the plane.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_face_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <functional>
#include <set>

#include "doctest.h"
#include "geom/check.h"
#include "geom/regular/regular2.h"
#include "geom/rng.h"
#include "tests/cgal/exact_points.h"

namespace {

using geom::Regular2;
using geom::Rng;
using geom::SiteId;
using geom::Vec2;
using geom::WeightedPoint2;
using Triangles = std::set<Regular2::Triangle>;

struct Copy {
  SiteId site;
  bool central = false;
};
template <class Kernel>
using Triangulation = CGAL::Regular_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<
                                             Copy, Kernel, CGAL::Regular_triangulation_vertex_base_2<Kernel>>,
                                         CGAL::Regular_triangulation_face_base_2<Kernel>>>;

/// Counterclockwise, the smallest corner first.
Regular2::Triangle canonical(Regular2::Triangle t) {
  std::ranges::rotate(t, std::ranges::min_element(t));
  return t;
}
Triangles by_us(const Regular2& t) {
  Triangles all;
  for (const Regular2::Triangle& c : t.triangles()) all.insert(canonical(c));
  return all;
}

/// `weight` turns the weight of a site into that of its copies.
template <class Kernel, class Weight>
Triangles by_cgal(const Regular2& ours, const std::vector<SiteId>& sites, Weight weight) {
  using Number = typename Kernel::FT;
  Triangulation<Kernel> theirs;
  const Vec2 period = ours.torus().period();
  for (const SiteId s : sites) {
    const WeightedPoint2 p = ours.point(s);
    for (int copy = 0; copy < 9; ++copy) {
      const int i = copy % 3 - 1, j = copy / 3 - 1;  // exact in doubles (flat_torus.h)
      const typename Kernel::Point_2 at(Number(p.position.x() + i * period.x()),
                                        Number(p.position.y() + j * period.y()));
      const auto v = theirs.insert(typename Kernel::Weighted_point_2(at, weight(p.weight, s)));
      if (v != typename Triangulation<Kernel>::Vertex_handle()) v->info() = {s, i == 0 && j == 0};
    }
  }
  Triangles all;
  for (const auto& f : theirs.finite_face_handles()) {
    const Copy &a = f->vertex(0)->info(), &b = f->vertex(1)->info(), &c = f->vertex(2)->info();
    if (a.central || b.central || c.central) all.insert(canonical({a.site, b.site, c.site}));
  }
  return all;
}

struct Kind {
  const char* name;
  Vec2 period;
  std::function<WeightedPoint2(Rng&)> draw;
};
WeightedPoint2 lattice(Rng& rng, double weight) {
  return {{static_cast<double>(rng.below(8)) / 8, static_cast<double>(rng.below(8)) / 8}, weight};
}
const Kind kinds[] = {
    {"random",
     {1, 1},
     [](Rng& r) {
       return WeightedPoint2{{r.uniform(), r.uniform()}, 0};
     }},
    {"oblong, weighted",
     {1.75, 0.875},
     [](Rng& r) {
       return WeightedPoint2{{1.75 * r.uniform(), r.uniform()}, cgal::rounded(0.02 * r.uniform())};
     }},
    {"lattice", {1, 1}, [](Rng& r) { return lattice(r, 0); }},
    {"lattice, tied weights", {1, 1}, [](Rng& r) {
       return lattice(r, static_cast<double>(r.below(3)) / 128);
     }}};

/// A filled torus in which sites with ids from `fixed` on come and go.
class Walk {
 public:
  Walk(const Kind& kind, std::size_t side, std::size_t most)
      : rng_(11), draw_(kind.draw), triangulation_(kind.period, grid(kind.period, side)) {
    for (std::size_t i = 0; i < side * side; ++i) present_.emplace_back(i);
    fixed_ = present_.size();
    for (std::size_t i = fixed_; i < fixed_ + most; ++i) free_.emplace_back(i);
  }
  void step() {
    const bool removes = free_.empty() || (present_.size() > fixed_ && rng_.below(5) < 2);
    std::vector<SiteId>&from = removes ? present_ : free_, &to = removes ? free_ : present_;
    const std::size_t first = removes ? fixed_ : 0;
    const std::size_t k = first + rng_.below(from.size() - first);
    if (removes)
      triangulation_.remove(from[k]);
    else
      triangulation_.insert(from[k], draw_(rng_));
    to.push_back(from[k]);
    from.erase(from.begin() + static_cast<std::ptrdiff_t>(k));
  }
  const Regular2& triangulation() const { return triangulation_; }
  const std::vector<SiteId>& present() const { return present_; }

 private:
  static std::vector<WeightedPoint2> grid(const Vec2& period, std::size_t side) {
    std::vector<WeightedPoint2> points;
    for (std::size_t i = 0; i < side * side; ++i)
      points.push_back({{period.x() * static_cast<double>(i % side) / static_cast<double>(side),
                         period.y() * static_cast<double>(i / side) / static_cast<double>(side)},
                        0});
    return points;
  }

  Rng rng_;
  std::function<WeightedPoint2(Rng&)> draw_;
  Regular2 triangulation_;
  std::vector<SiteId> present_, free_;
  std::size_t fixed_ = 0;
};

}  // namespace

TEST_CASE("CGAL: degenerate sites on the torus, perturbed in fact, after long sequences") {
  for (const Kind& kind : kinds) {
    INFO(std::string(kind.name));
    Walk walk(kind, 6, 24);
    for (int step = 1; step <= 800; ++step) {
      walk.step();
      if (step % 200 != 0) continue;
      const auto weight = [](double w, SiteId s) -> cgal::Number {
        return cgal::Number(w) + cgal::epsilon(s.value);
      };
      REQUIRE(by_us(walk.triangulation()) ==
              by_cgal<cgal::Kernel>(walk.triangulation(), walk.present(), weight));
    }
  }
}

TEST_CASE("CGAL: many random sites on the torus") {
  using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
  for (const double weight : {0.0, 0.0004}) {
    CAPTURE(weight);
    Rng rng(3);
    std::vector<WeightedPoint2> points;
    for (int i = 0; i < 5000; ++i) points.push_back({{rng.uniform(), rng.uniform()}, weight * rng.uniform()});
    Regular2 ours(Vec2(1, 1), points);
    std::vector<SiteId> present;
    for (std::size_t i = 0; i < points.size(); ++i) {
      present.emplace_back(i);
      ours.remove(SiteId(i));
      ours.insert(SiteId(i), {{rng.uniform(), rng.uniform()}, weight * rng.uniform()});
    }
    CHECK(by_us(ours) == by_cgal<Epick>(ours, present, [](double w, SiteId) { return w; }));
  }
}
