#include "tests/endurance/moves.h"

#include <cmath>

#include "geom/mesh/scaling.h"

namespace endurance {

using geom::SiteId;
using geom::Vec3;

std::vector<Course> courses() {
  const auto surface = [](const char* shape, int size, bool all_corners) {
    return Place{shape, size, all_corners, {1, 1}};
  };
  return {{"sphere", surface("sphere", 3, false), Weights::none, 120},
          {"torus", surface("torus", 12, true), Weights::graded, 120},
          {"l-block", surface("l-block", 1, true), Weights::hiding, 80},
          {"thin-plate", surface("thin-plate", 3, false), Weights::graded, 100},
          {"wave-disk", surface("wave-disk", 5, true), Weights::none, 100},
          {"two-spheres", surface("two-spheres-tilted", 2, false), Weights::hiding, 100},
          {"plane", Place{"plane", 0, false, {1, 0.75}}, Weights::none, 200},
          {"plane-weighted", Place{"plane", 0, false, {1, 1}}, Weights::graded, 200}};
}

MoveMaker::MoveMaker(const Course& course, std::uint64_t seed) : course_(course), rng_(seed) {
  for (const char c : course.name) seed = 131 * seed + static_cast<unsigned char>(c);
  rng_ = geom::Rng(seed);
}

geom::WeightedPoint3 MoveMaker::weighted(const Vec3& x, double area) {
  const double spacing2 = area / static_cast<double>(course_.num_sites);
  double weight = 0;
  if (course_.weights == Weights::graded)
    weight = 0.5 * spacing2 * std::pow(1.5 + std::sin(3 * x.x() + x.y()), 2);
  if (course_.weights == Weights::hiding && rng_.below(2) == 0)
    weight = spacing2 * (rng_.below(3) == 0 ? 4 * rng_.uniform() : 1.0);
  return {x, geom::snapped(weight, 0x1p-320)};
}

void MoveMaker::apply(Stage& stage, const Operation& operation, std::vector<Operation>& log) {
  log.push_back(operation);
  if (!stage.apply(operation)) log.pop_back();
}

// Algorithm 1, line 4 to 9, but that the sample goes to the farthest point in any case: more moves so.
void MoveMaker::farthest_point_move(Stage& stage, std::vector<Operation>& log) {
  const SiteId x = stage.present()[rng_.below(stage.present().size())];
  const geom::WeightedPoint3 old = stage.point(x);
  const std::size_t before = stage.present().size();
  apply(stage, {false, x, {}}, log);
  if (stage.present().size() == before) return;  // refused
  Vec3 center = old.position;
  const bool found = stage.farthest(rng_.below(2) == 0, center);
  apply(stage, {true, x, found ? weighted(center, stage.area()) : old}, log);
  if (stage.present().size() < before) apply(stage, {true, x, old}, log);
}

void MoveMaker::toggle(Stage& stage, std::vector<Operation>& log) {
  const bool add = stage.present().size() < wanted_;
  SiteId s;
  if (add || stage.present().empty())
    s = SiteId(static_cast<std::size_t>(rng_.below(course_.num_sites)));
  else
    s = stage.present()[rng_.below(stage.present().size())];
  apply(stage, {add, s, weighted(stage.anywhere(rng_.below(2) == 0, rng_), stage.area())}, log);
}

void MoveMaker::move(Stage& stage, std::vector<Operation>& log) {
  if (rng_.below(1000) == 0 || wanted_ == 0)
    wanted_ = rng_.below(8) == 0 ? rng_.below(6) : course_.num_sites / 2 + rng_.below(course_.num_sites / 2);
  const bool far_off = stage.present().size() + 3 < wanted_ || stage.present().size() > wanted_ + 3;
  if (stage.present().empty() || rng_.below(4) == 0 || (far_off && rng_.below(4) != 0))
    toggle(stage, log);
  else
    farthest_point_move(stage, log);
}

}  // namespace endurance
