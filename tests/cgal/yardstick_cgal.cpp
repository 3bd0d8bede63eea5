// How long one removal and insertion takes, ours and CGAL's on the same points, by turns. CGAL's alone also
// tells how fast this machine is beside another one where it was measured. (In the plane ours is periodic and
// gets no hint, CGAL's is not and does.)
//   build-cgal/cgal-tests --no-skip --test-suite=yardstick

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <vector>

#include "doctest.h"
#include "geom/regular/regular2.h"
#include "geom/regular/regular3.h"
#include "geom/rng.h"

namespace {

using geom::SiteId;
using geom::Vec2;
using geom::Vec3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr int turns = 7;

double microseconds_each(std::size_t n, const std::function<void()>& all) {
  const auto start = std::chrono::steady_clock::now();
  all();
  return 1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() /
         static_cast<double>(n);
}

void compare(const char* what, std::size_t n, const std::function<void()>& ours,
             const std::function<void()>& theirs) {
  std::vector<double> our_times, their_times;
  for (int turn = 0; turn < turns; ++turn) {
    our_times.push_back(microseconds_each(n, ours));
    their_times.push_back(microseconds_each(n, theirs));
  }
  std::ranges::sort(our_times);
  std::ranges::sort(their_times);
  std::printf("%-22s n %6zu  ours %7.3f (median %7.3f)  CGAL %7.3f (median %7.3f) us\n", what, n,
              our_times.front(), our_times[turns / 2], their_times.front(), their_times[turns / 2]);
}

using Plane = CGAL::Delaunay_triangulation_2<Kernel>;
using Space = CGAL::Regular_triangulation_3<Kernel>;

// Each vertex is taken out and put back where it was, the search for its place starting at a former
// neighbour.

void remove_and_insert_all(Plane& t, std::vector<Plane::Vertex_handle>& vertices) {
  for (Plane::Vertex_handle& v : vertices) {
    const Plane::Point point = v->point();
    const Plane::Vertex_handle neighbour = v->face()->vertex(Plane::ccw(v->face()->index(v)));
    t.remove(v);
    v = t.insert(point, neighbour->face());
  }
}

void remove_and_insert_all(Space& t, std::vector<Space::Vertex_handle>& vertices) {
  std::vector<Space::Vertex_handle> neighbours;
  for (Space::Vertex_handle& v : vertices) {
    const Space::Weighted_point point = v->point();
    neighbours.clear();
    t.finite_adjacent_vertices(v, std::back_inserter(neighbours));
    t.remove(v);
    v = t.insert(point, neighbours.front());
  }
}

}  // namespace

TEST_SUITE("yardstick") {
  TEST_CASE("yardstick: in the plane" * doctest::skip()) {
    for (const std::size_t n : {std::size_t{10'000}, std::size_t{100'000}}) {
      geom::Rng rng(1);
      std::vector<geom::WeightedPoint2> points(n);
      for (auto& p : points) p = {{rng.uniform(), rng.uniform()}, 0};
      geom::Regular2 ours(Vec2(1, 1), points);
      Plane theirs;
      std::vector<Plane::Vertex_handle> vertices;
      for (const auto& p : points) vertices.push_back(theirs.insert({p.position.x(), p.position.y()}));
      compare(
          "plane, unsorted", n,
          [&] {
            for (std::size_t i = 0; i < n; ++i) {
              ours.remove(SiteId(i));
              ours.insert(SiteId(i), points[i]);
            }
          },
          [&] { remove_and_insert_all(theirs, vertices); });
      CHECK(ours.triangles().size() == 2 * n);
      CHECK(theirs.number_of_vertices() == n);
    }
  }

  TEST_CASE("yardstick: on a sphere, in space" * doctest::skip()) {
    const std::size_t n = 10'000;
    geom::Rng rng(2);
    std::vector<Vec3> points;
    while (points.size() < n) {
      const Vec3 x(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
      if (x.squaredNorm() > 0.1 && x.squaredNorm() < 1) points.push_back(x.normalized());
    }
    geom::Regular3 ours(geom::Box3(Vec3(-1.1, -1.1, -1.1), Vec3(1.1, 1.1, 1.1)));
    Space theirs;
    std::vector<Space::Vertex_handle> vertices;
    for (std::size_t i = 0; i < n; ++i) {
      ours.insert(SiteId(i), {points[i], 0});
      vertices.push_back(
          theirs.insert(Kernel::Weighted_point_3({points[i].x(), points[i].y(), points[i].z()}, 0)));
    }
    std::vector<SiteId> link;
    compare(
        "sphere in space", n,
        [&] {
          for (std::size_t i = 0; i < n; ++i) {
            ours.link(SiteId(i), link);
            ours.remove(SiteId(i));
            ours.insert(SiteId(i), {points[i], 0}, link.front());
          }
        },
        [&] { remove_and_insert_all(theirs, vertices); });
    CHECK(theirs.number_of_vertices() == n);
  }
}
