// The bounds of frame.h against exact numbers.

#include "geom/dual/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "doctest.h"
#include "geom/check.h"
#include "geom/dual/frame_vertices.h"
#include "geom/rng.h"
#include "tests/fixtures/loose_vertices.h"
#include "tests/fixtures/weighted_points.h"
#include "tests/oracle/rational.h"

using namespace geom;
using oracle::Rational;

namespace {

constexpr int none = Frame::none;

Rational exact_power(const Location3& z, const WeightedPoint3& p) {
  const Rational rise = Rational(z.level) - Rational(p.level);
  Rational sum = rise * rise - Rational(p.weight);
  for (int k = 0; k < 3; ++k) {
    const Rational d = Rational(z.position[k]) - Rational(p.position[k]);
    sum = sum + d * d;
  }
  return sum;
}

/// The values of the frame at some location, exactly.
struct Exact {
  Exact(const Location3& z, const WeightedPoint3& origin, const std::vector<WeightedPoint3>& sites) {
    const Rational own = exact_power(z, origin);
    for (const WeightedPoint3& s : sites) g.push_back(exact_power(z, s) - own);
  }
  Rational operator()(int i) const { return i == none ? Rational(0.0) : g[static_cast<std::size_t>(i)]; }
  std::vector<Rational> g;
};

bool within(double found, const Rational& exact, double bound) {
  if (bound == std::numeric_limits<double>::infinity()) return true;
  const Rational off = Rational(found) - exact, limit(bound);
  return (limit - off).sign() >= 0 && (limit + off).sign() >= 0;
}
bool within(const Sure& found, const Rational& exact) { return within(found.value, exact, found.bound); }
/// What is said to be certain is so.
bool agrees(const Sure& found, const Rational& exact) {
  return (!found.negative() || exact.sign() < 0) && (!found.positive() || exact.sign() > 0) &&
         found.certain() == (found.negative() || found.positive());
}

struct FrameCount {
  std::size_t values = 0, unsure = 0, unsure_nearest = 0, determinants = 0,
              unsure_determinants = 0;  // determinants: but those that vanish
};

/// Gives points levels, as far apart as they are at most; often the same.
void raise(std::vector<WeightedPoint3>& points, Rng& rng) {
  double size = 0;
  for (const WeightedPoint3& p : points) size = std::max(size, (p.position - points[0].position).norm());
  for (WeightedPoint3& p : points) p.level = rng.below(3) == 0 ? size : size * rng.uniform();
}

/// Everything a frame tells of these sites, the first the origin, at these vertices, which may have levels.
void check_frame(const std::vector<WeightedPoint3>& points, const std::vector<WeightedPoint3>& locations,
                 Rng& rng, FrameCount& count) {
  std::vector<Vec3> places;
  Table<VertexId, double> levels;
  for (const WeightedPoint3& z : locations) places.push_back(z.position), levels.push_back(z.level);
  const TriMesh mesh = fixtures::with_vertices(places).with_levels(levels);
  Frame frame;
  FrameVertices vertices(mesh, frame);
  const std::vector<WeightedPoint3> sites(points.begin() + 1, points.end());
  frame.begin(points[0]);
  for (const WeightedPoint3& s : sites) frame.add(s);
  const int n = frame.size();
  REQUIRE(n == static_cast<int>(sites.size()));
  std::vector<Exact> exact;
  std::vector<FrameVertices::Slot> slots;
  for (std::size_t v = 0; v < places.size(); ++v) {
    slots.push_back(vertices.with_signs(VertexId(v)));
    exact.emplace_back(Location3(places[v], locations[v].level), points[0], sites);
  }
  for (std::size_t v = 0; v < places.size(); ++v) {
    CHECK(vertices.with_signs(VertexId(v)) == slots[v]);
    const FrameVertices::Vertex& at = vertices[slots[v]];
    CHECK(at.id == VertexId(v));
    std::uint32_t beaten_by = 0;
    for (int i = 0; i < n; ++i) {
      CHECK(within(at.g[i], exact[v](i), at.error));
      beaten_by |= static_cast<std::uint32_t>(exact[v](i).sign() < 0) << i;
      for (int k = 0; k <= n; ++k) {
        const int j = k == n ? none : k;
        const Rational difference = exact[v](i) - exact[v](j);
        CHECK(within(at.difference(i, j), difference));
        CHECK(agrees(at.difference(i, j), difference));
      }
    }
    ++count.values;
    count.unsure += !at.sure;
    if (at.sure) CHECK(at.beaten_by == beaten_by);
    if (at.sure) CHECK(at.owned() == (beaten_by == 0));
    CHECK(at.owned() == (at.beaten_by == 0));
    if (const int least = vertices.nearest(at); least >= 0)
      for (int i = 0; i < n; ++i) CHECK((i == least || (exact[v](i) - exact[v](least)).sign() > 0));
    else
      ++count.unsure_nearest;
    const auto u = static_cast<std::size_t>(rng.below(places.size()));
    const FrameVertices::Vertex& other = vertices[slots[u]];
    for (int trial = 0; trial < 12; ++trial) {
      const auto any = [&] {
        const int k = static_cast<int>(rng.below(static_cast<std::uint64_t>(n) + 1));
        return k == n ? none : k;
      };
      const int i = any(), j = any(), k = any();
      const Rational m = (exact[u](i) - exact[u](k)) * (exact[v](j) - exact[v](k)) -
                         (exact[v](i) - exact[v](k)) * (exact[u](j) - exact[u](k));
      const Sure found = determinant(other, at, i, j, k);
      CHECK(within(found, m));
      CHECK(agrees(found, m));
      count.determinants += m.sign() != 0;
      count.unsure_determinants += m.sign() != 0 && !found.certain();
    }
  }
}

/// A location, and another one that is not more than that away. Not all sites are at one place.
void check_lead(const std::vector<WeightedPoint3>& points, const Location3& location, Rng& rng) {
  const Vec3& z = location.position;
  Frame frame;
  const std::vector<WeightedPoint3> sites(points.begin() + 1, points.end() - 1);
  const WeightedPoint3& stranger = points.back();
  frame.begin(points[0]);
  for (const WeightedPoint3& s : sites) frame.add(s);
  const double size = std::max({z.norm(), points[0].position.norm(), 1e-300});
  const double tolerance = rng.below(3) == 0 ? 0 : size * std::pow(10, rng.uniform(-16, -3));
  const Vec3 direction = fixtures::random_vector(rng).normalized();
  const Vec3 off =
      z + 0.999 * tolerance * direction;  // the true location; z, rounded, is what is known of it
  const Vec3 y = z - points[0].position;
  // The difference, too, is rounded: what counts is off from origin + y.
  const double level_off = rng.below(2) == 0 ? 0 : tolerance;
  const double known_within =
      tolerance == 0 ? 0 : tolerance + level_off + 4e-16 * (y.norm() + z.norm() + std::abs(location.level));
  const Location3 truth(tolerance == 0 ? z : off, location.level + 0.999 * rng.uniform(-1, 1) * level_off);
  const Exact exact(truth, points[0], sites);
  const Rational of_stranger = exact_power(truth, stranger) - exact_power(truth, points[0]);
  Frame::Values values;
  frame.evaluate({y, location.level - points[0].level}, known_within, values);
  std::vector<int> numbers{none};
  for (int i = 0; i < frame.size(); ++i) numbers.push_back(i);
  for (const int i : numbers) {
    const Frame::Seen seen = Frame::seen(stranger, points[0]);
    CHECK(within(frame.difference(values, seen, i), of_stranger - exact(i)));
    for (const int j : numbers) CHECK(within(values.difference(j, i), exact(j) - exact(i)));
  }
}

}  // namespace

TEST_CASE(
    "frame: values, differences and determinants are within their bounds, and signs said to be sure are "
    "right") {
  Rng rng(4);
  for (const fixtures::Hardship hardship : fixtures::all_hardships) {
    CAPTURE(std::string(fixtures::name_of(hardship)));
    FrameCount count;
    for (int draw = 0; draw < 60; ++draw) {
      const int sites = 1 + static_cast<int>(rng.below(Frame::most));
      std::vector<WeightedPoint3> points = fixtures::draw(hardship, sites + 7, rng.below(4) == 0, rng);
      if (rng.below(2) == 0) raise(points, rng);
      std::vector<WeightedPoint3> places(points.begin() + sites + 1, points.end());
      places.push_back({(points[0].position + points[1].position) / 2, 0,
                        (points[0].level + points[1].level) / 2});  // as near to both, almost
      places.push_back(points[0]);
      check_frame({points.begin(), points.begin() + sites + 1}, places, rng, count);
    }
    CHECK(count.values > 300);
    if (hardship == fixtures::Hardship::none) CHECK(20 * count.unsure < count.values);
    if (hardship == fixtures::Hardship::none) CHECK(20 * count.unsure_nearest < count.values);
    if (hardship == fixtures::Hardship::none) CHECK(20 * count.unsure_determinants < count.determinants);
  }
}

// Where rounding is worst: places and sites close together far from the origin of coordinates, and as near to
// one site as to another one.
TEST_CASE("frame: bounds where everything nearly ties, and far away") {
  Rng rng(9);
  FrameCount count;
  for (int draw = 0; draw < 400; ++draw) {
    const double size = std::pow(10, rng.uniform(-9, 0));
    const Vec3 base(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    const int n = 2 + static_cast<int>(rng.below(Frame::most - 1));
    std::vector<WeightedPoint3> points;
    std::vector<WeightedPoint3> places;
    const Vec3 center = base + size * fixtures::random_vector(rng);
    const double radius = size * rng.uniform(0.1, 1);
    for (int i = 0; i <= n; ++i) {  // all on one sphere about a place, up to rounding
      const double more = rng.below(2) == 0 ? 0 : size * size * rng.uniform();
      const double distance = std::sqrt(radius * radius + more);
      points.push_back({center + distance * fixtures::random_vector(rng).normalized(), more});
    }
    const bool has_levels = rng.below(2) == 0;
    const double level = has_levels ? rng.uniform(-1, 1) : 0;
    for (WeightedPoint3& p : points) {  // the fourth coordinate takes from the others
      p.level = level;
      if (!has_levels || rng.below(2) == 0) continue;
      const Vec3 d = p.position - center;
      p.position = center + 0.8 * d;
      p.level += 0.6 * d.norm();
    }
    places.push_back({center, 0, level});
    for (int i = 0; i < 5; ++i) {
      Vec3 place = center;
      for (double& c : place) c = fixtures::one_ulp_off(c, rng);
      places.push_back({rng.below(2) == 0 ? place : base + size * fixtures::random_vector(rng), 0, level});
    }
    check_frame(points, places, rng, count);
  }
  CHECK(count.unsure > 100);
  CHECK(count.unsure < count.values);
}

TEST_CASE("frame: the lead at a location known within a tolerance, of sites in the frame and of strangers") {
  Rng rng(12);
  for (const fixtures::Hardship hardship : fixtures::all_hardships) {
    CAPTURE(std::string(fixtures::name_of(hardship)));
    for (int draw = 0; draw < 150; ++draw) {
      const int n = 3 + static_cast<int>(rng.below(8));
      std::vector<WeightedPoint3> points = fixtures::draw(hardship, n + 1, rng.below(4) == 0, rng);
      if (rng.below(2) == 0) raise(points, rng);
      const auto elsewhere = [&](const WeightedPoint3& s) { return s.position != points[0].position; };
      if (std::any_of(points.begin() + 1, points.begin() + n - 1, elsewhere))
        check_lead({points.begin(), points.begin() + n}, {points.back().position, points.back().level}, rng);
    }
  }
}

TEST_CASE("frame: the power of a location is that to the site, up to rounding") {
  Rng rng(2);
  Frame frame;
  for (int draw = 0; draw < 100; ++draw) {
    std::vector<WeightedPoint3> points = fixtures::draw(fixtures::Hardship::none, 9, false, rng);
    if (draw % 2 == 0) raise(points, rng);
    frame.begin(points[0]);
    for (int i = 1; i < 8; ++i) frame.add(points[static_cast<std::size_t>(i)]);
    const Location3 z(points[8].position, points[8].level);
    const Frame::Place at = frame.place_of({z.position, z.level, 0});
    CHECK(frame.power(at, none) == doctest::Approx(power(z, points[0])).epsilon(1e-12).scale(1));
    for (int i = 0; i < 7; ++i) {
      const WeightedPoint3& site = points[static_cast<std::size_t>(i) + 1];
      CHECK(frame.power(at, i) == doctest::Approx(power(z, site)).epsilon(1e-12).scale(1));
      CHECK(frame.offset(i) == Frame::seen(site, points[0]).d);
      CHECK(frame.constant(i) == Frame::seen(site, points[0]).c);
      CHECK(frame.rise(i) == Frame::seen(site, points[0]).rise);
    }
  }
}

TEST_CASE("frame: too many sites are a bug") {
  Rng rng(3);
  const std::vector<WeightedPoint3> points = fixtures::draw(fixtures::Hardship::none, 2, false, rng);
  Frame frame;
  frame.begin(points[0]);
  for (int i = 0; i < Frame::most; ++i) frame.add(points[1]);
  CHECK_THROWS_AS(frame.add(points[1]), Bug);
}

TEST_CASE("frame: who is behind others in a ball is nearest nowhere there, by exact numbers") {
  Rng rng(8);
  std::size_t behind = 0, not_behind = 0;
  for (const fixtures::Hardship hardship : fixtures::all_hardships) {
    CAPTURE(std::string(fixtures::name_of(hardship)));
    for (int draw = 0; draw < 150; ++draw) {
      const int n = 1 + static_cast<int>(rng.below(Frame::most));
      std::vector<WeightedPoint3> points = fixtures::draw(hardship, n + 2, rng.below(3) == 0, rng);
      if (rng.below(2) == 0) raise(points, rng);
      const std::vector<WeightedPoint3> sites(points.begin() + 1, points.begin() + n + 1);
      const WeightedPoint3 &origin = points.front(), &stranger = points.back();
      Frame frame;
      frame.begin(origin);
      for (const WeightedPoint3& s : sites) frame.add(s);
      const double radius = (stranger.position - origin.position).norm() * rng.uniform(0, 0.6);
      const int first =
          rng.below(2) == 0 ? Frame::nobody : static_cast<int>(rng.below(static_cast<std::uint64_t>(n)));
      const bool with_origin = rng.below(2) == 0;
      const Frame::Seen seen = Frame::seen(stranger, origin);
      const bool behind_one = frame.is_behind(seen, Vec3(0, 0, 0), radius, with_origin ? none : first);
      const bool behind_two = frame.is_behind_two(seen, Vec3(0, 0, 0), radius);
      if (!behind_one && !behind_two) {
        ++not_behind;
        continue;
      }
      ++behind;
      for (int sample = 0; sample < 12; ++sample) {
        const double turned = rng.uniform(-1.57, 1.57), far = 0.999 * radius * rng.uniform();
        const bool is_level =
            std::ranges::all_of(points, [](const WeightedPoint3& p) { return p.level == 0; });
        const Vec3 place = origin.position + far * (is_level ? 1 : std::cos(turned)) *
                                                 fixtures::random_vector(rng).normalized();
        const Location3 z(place, is_level ? 0 : origin.level + far * std::sin(turned));
        const Exact exact(z, origin, sites);
        Rational least = with_origin && !behind_two ? Rational(0.0) : exact(0);
        for (int i = 0; i < n; ++i)
          if ((exact(i) - least).sign() < 0) least = exact(i);
        CHECK((exact_power(z, stranger) - exact_power(z, origin) - least).sign() > 0);
      }
    }
  }
  CHECK(behind > 100);
  CHECK(not_behind > 100);
}

// As in a hole of six neighbours: beyond an edge of the rim, where neither end alone will do.
TEST_CASE("frame: who is behind two sites, but behind neither alone, is nearest nowhere in the ball") {
  Rng rng(9);
  std::size_t behind = 0, not_behind = 0;
  for (int draw = 0; draw < 4000; ++draw) {
    const auto at = [&](double angle, double far) -> WeightedPoint3 {
      const Vec3 d = far * Vec3(std::cos(angle), std::sin(angle), rng.uniform(-0.2, 0.2));
      return {Vec3(0.3, 0.2, 0.1) + d, rng.uniform(0, 0.1)};
    };
    const double turned = rng.uniform(0, 6.3);
    const std::vector<WeightedPoint3> sites{at(turned, 1), at(turned + rng.uniform(0.8, 1.3), 1)};
    const WeightedPoint3 origin = at(0, 0), stranger = at(turned + 0.5, rng.uniform(1.2, 2));
    Frame frame;
    frame.begin(origin);
    for (const WeightedPoint3& s : sites) frame.add(s);
    const Frame::Seen seen = Frame::seen(stranger, origin);
    const Vec3 center = 0.1 * fixtures::random_vector(rng);
    const double radius = rng.uniform(0.4, 0.8);
    if (frame.is_behind(seen, center, radius, Frame::nobody)) continue;
    if (!frame.is_behind_two(seen, center, radius)) {
      ++not_behind;
      continue;
    }
    ++behind;
    for (int sample = 0; sample < 20; ++sample) {
      const Vec3 z = origin.position + center + 0.999 * radius * fixtures::random_vector(rng).normalized();
      const Rational power = exact_power(z, stranger);
      CHECK(((power - exact_power(z, sites[0])).sign() > 0 || (power - exact_power(z, sites[1])).sign() > 0));
    }
  }
  CHECK(behind > 200);
  CHECK(not_behind > 100);
}
