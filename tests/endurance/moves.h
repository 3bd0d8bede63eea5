#pragma once
// What a long run does: farthest point moves, and removals and insertions that an optimization never makes.

#include "tests/endurance/stage.h"

namespace endurance {

/// Of sites: none, smooth over the domain, random and so large that sites are hidden.
enum class Weights { none, graded, hiding };

struct Course {
  std::string name;  ///< of the files
  Place place;
  Weights weights;
  std::size_t num_sites;  ///< ids are below
};

/// Six surfaces and two tori.
std::vector<Course> courses();

/// Draws moves; every operation that was done is noted.
class MoveMaker {
 public:
  /// Keeps a reference. Every course has its own random numbers.
  MoveMaker(const Course& course, std::uint64_t seed);

  /// One farthest point move (Algorithm 1, globally or locally), or one removal or insertion anywhere.
  /// Appends each operation to `log` before it does it. Throws geom::Bug.
  void move(Stage& stage, std::vector<Operation>& log);
  geom::Rng& rng() { return rng_; }

 private:
  void apply(Stage& stage, const Operation& operation, std::vector<Operation>& log);
  void farthest_point_move(Stage& stage, std::vector<Operation>& log);
  void toggle(Stage& stage, std::vector<Operation>& log);
  geom::WeightedPoint3 weighted(const geom::Vec3& x, double area);

  const Course& course_;
  geom::Rng rng_;
  std::size_t wanted_ = 0;  ///< sites: changes now and then, from none to all
};

}  // namespace endurance
