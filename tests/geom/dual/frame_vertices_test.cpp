#include "geom/dual/frame_vertices.h"

#include <vector>

#include "doctest.h"
#include "geom/rng.h"
#include "tests/fixtures/loose_vertices.h"
#include "tests/fixtures/weighted_points.h"

using namespace geom;

TEST_CASE("frame vertices: in a frame begun anew nothing is known of before") {
  Rng rng(3);
  const std::vector<WeightedPoint3> points = fixtures::draw(fixtures::Hardship::none, 40, false, rng);
  std::vector<Vec3> places;
  for (int i = 0; i < 6; ++i) places.push_back(fixtures::random_vector(rng));
  const TriMesh mesh = fixtures::with_vertices(places);
  Frame frame;
  FrameVertices seen(mesh, frame);
  for (int round = 0; round < 20; ++round) {
    const std::size_t first = rng.below(20);
    const int n = 1 + static_cast<int>(rng.below(Frame::most));
    Frame fresh;
    FrameVertices seen_freshly(mesh, fresh);
    frame.begin(points[first]);
    seen.clear();
    fresh.begin(points[first]);
    for (int i = 0; i < n; ++i) {
      frame.add(points[first + 1 + static_cast<std::size_t>(i)]);
      fresh.add(points[first + 1 + static_cast<std::size_t>(i)]);
    }
    for (std::size_t v = places.size(); v-- > 0;) {
      const FrameVertices::Vertex &a = seen[seen.with_signs(VertexId(v))],
                                  &b = seen_freshly[seen_freshly.with_signs(VertexId(v))];
      CHECK(a.error == b.error);
      CHECK(a.beaten_by == b.beaten_by);
      CHECK(seen.nearest(a) == seen_freshly.nearest(b));
      for (int i = 0; i < n; ++i) CHECK(a.g[i] == b.g[i]);
    }
    CHECK(seen.size() == places.size());
  }
}

// Who comes late is as if it had been there from the start.
TEST_CASE("frame vertices: a site that comes later has the values there that it would have had") {
  Rng rng(6);
  for (int draw = 0; draw < 60; ++draw) {
    const int n = 2 + static_cast<int>(rng.below(Frame::most - 1));
    const std::vector<WeightedPoint3> points =
        fixtures::draw(fixtures::Hardship::none, n + 7, rng.below(2) == 0, rng);
    std::vector<Vec3> places;
    for (std::size_t i = static_cast<std::size_t>(n) + 1; i < points.size(); ++i)
      places.push_back(points[i].position);
    const TriMesh mesh = fixtures::with_vertices(places);
    Frame frame, fresh;
    FrameVertices seen(mesh, frame), seen_freshly(mesh, fresh);
    frame.begin(points[0]);
    fresh.begin(points[0]);
    for (int i = 1; i <= n; ++i) fresh.add(points[static_cast<std::size_t>(i)]);
    for (int i = 1; i < n; ++i) frame.add(points[static_cast<std::size_t>(i)]);
    for (std::size_t v = 0; v < places.size(); ++v) seen.with_signs(VertexId(v));
    frame.add(points[static_cast<std::size_t>(n)]);
    seen.follow();
    REQUIRE(frame.size() == n);
    for (std::size_t v = 0; v < places.size(); ++v) {
      const FrameVertices::Vertex &a = seen[seen.with_signs(VertexId(v))],
                                  &b = seen_freshly[seen_freshly.with_signs(VertexId(v))];
      CHECK(a.error == b.error);
      CHECK(a.beaten_by == b.beaten_by);
      CHECK(a.sure == b.sure);
      for (int i = 0; i < n; ++i) CHECK(a.g[i] == b.g[i]);
    }
  }
}
