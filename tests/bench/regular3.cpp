// Microseconds of one remove + insert in the regular triangulation, on samples of three surfaces.
//   bench-regular3 [surface] [n ...]        default: all of them, 10000 100000

#include "geom/regular/regular3.h"

#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "geom/rng.h"

namespace {

using geom::Regular3;
using geom::Rng;
using geom::SiteId;
using geom::Vec3;

Vec3 sphere(Rng& rng) {
  const double z = rng.uniform(-1, 1), angle = rng.uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
  return Vec3(r * std::cos(angle), r * std::sin(angle), z).normalized();
}

/// An ellipsoid with waves: no two of its centers of curvature coincide.
Vec3 blob(Rng& rng) {
  const Vec3 u = sphere(rng);
  return (1 + 0.05 * std::sin(5 * u.x() + 4 * u.y()) + 0.05 * std::cos(6 * u.z())) *
         Vec3(0.9 * u.x(), 0.6 * u.y(), 0.4 * u.z());
}

Vec3 tilted_square(Rng& rng) {
  return rng.uniform(-0.5, 0.5) * Vec3(1, 2, -0.3).normalized() +
         rng.uniform(-0.5, 0.5) * Vec3(0.2, 0.1, 1.1).normalized();
}

Vec3 cube(Rng& rng) {
  Vec3 at(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
  at[static_cast<int>(rng.below(3))] = rng.below(2) == 0 ? -1 : 1;
  return at;
}

struct Surface {
  const char* name;
  Vec3 (*draw)(Rng&);
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Sites in random order, each hinted by a neighbour on the surface where one is known: by the simplex of a
/// coarse grid.
class HintGrid {
 public:
  explicit HintGrid(std::size_t n) : side_(static_cast<int>(std::sqrt(n / 4.0)) + 1) {
    cells_.resize(static_cast<std::size_t>(side_) * side_ * 8);
  }
  SiteId& at(const Vec3& x) {
    const auto word = [&](int axis) { return static_cast<std::uint64_t>((x[axis] + 1) / 2 * side_) + 1; };
    const std::uint64_t hash =
        word(0) * 0x9e3779b97f4a7c15u ^ word(1) * 0xc2b2ae3d27d4eb4fu ^ word(2) * 0x165667b19e3779f9u;
    return cells_[(hash >> 20) % cells_.size()];
  }

 private:
  int side_;
  std::vector<SiteId> cells_;
};

void measure(const Surface& surface, int n) {
  Rng rng(1);
  std::vector<Vec3> points(n);
  for (Vec3& p : points) p = surface.draw(rng);
  Regular3 t(geom::Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)));

  HintGrid hints(n);
  auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < n; ++i) {
    SiteId& hint = hints.at(points[i]);
    t.insert(SiteId(i), {points[i], 0.0}, hint);
    hint = SiteId(i);
  }
  const double build = seconds_since(start);
  const double per_site = static_cast<double>(t.simplices().size()) / n;

  std::vector<SiteId> link;
  const int moves = 50000;
  double removing = 0, inserting = 0;
  std::size_t star = 0, hole = 0;
  for (int k = 0; k < moves; ++k) {
    const SiteId id(static_cast<int>(rng.below(n)));
    t.link(id, link);
    const SiteId hint = link.empty() ? SiteId() : link.front();
    const auto p = t.point(id);
    start = std::chrono::steady_clock::now();
    const Regular3::Change removed = t.remove(id);
    removing += seconds_since(start);
    star += removed.destroyed.size();
    hole += removed.created.size();
    start = std::chrono::steady_clock::now();
    t.insert(id, p, hint);
    inserting += seconds_since(start);
  }
  t.check();
  std::printf(
      "%-14s %8d  build %6.2f us/site  simplices/site %5.2f  star %5.1f  hole %5.1f  remove %6.2f us  insert "
      "%6.2f us  both %6.2f us\n",
      surface.name, n, 1e6 * build / n, per_site, 1.0 * star / moves, 1.0 * hole / moves,
      1e6 * removing / moves, 1e6 * inserting / moves, 1e6 * (removing + inserting) / moves);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const Surface surfaces[] = {
      {"sphere", sphere}, {"blob", blob}, {"tilted square", tilted_square}, {"cube", cube}};
  std::vector<int> sizes;
  std::string only;
  for (int i = 1; i < argc; ++i) {
    if (std::isdigit(static_cast<unsigned char>(argv[i][0]))) {
      sizes.push_back(std::atoi(argv[i]));
    } else {
      only = argv[i];
    }
  }
  if (sizes.empty()) sizes = {10000, 100000};
  for (const int n : sizes) {
    for (const Surface& surface : surfaces) {
      if (only.empty() || only == surface.name) measure(surface, n);
    }
  }
}
