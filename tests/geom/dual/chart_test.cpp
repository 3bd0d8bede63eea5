// What is said of a simple chart, by brute force over the facets of its sheet.

#include "geom/dual/chart.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "doctest.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/power/facet_cells.h"
#include "geom/rng.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/sheet_scene.h"
#include "tests/fixtures/weighted_points.h"

using namespace geom;

namespace {

/// A site of a chart, from the origin.
struct Site {
  Vec3 d;
  double c;
  /// The power of a location to it less that to a site at the origin.
  double at(const Vec3& y) const { return c - 2 * d.dot(y); }
};

using Triangle = std::array<Vec3, 3>;

/// A sheet about a place on a surface, and the facets in its ball, from that place.
struct Scene {
  Sheet sheet;
  Vec3 u, v, m;
  double ball;    ///< of the sheet
  double radius;  ///< what is spoken of
  std::vector<Triangle> facets;

  double x(const Vec3& y) const { return y.dot(u); }
  double y(const Vec3& y) const { return y.dot(v); }
  double z(const Vec3& y) const { return y.dot(m); }
  Vec3 from_plane(double along_u, double along_v, double along_m) const {
    return along_u * u + along_v * v + along_m * m;
  }
};

Vec3 in_triangle(const Triangle& t, Rng& rng) {
  const double s = rng.uniform(), r = rng.uniform() * (1 - s);
  return t[0] + s * (t[1] - t[0]) + r * (t[2] - t[0]);
}

struct Surface : fixtures::SheetScene {
  using SheetScene::SheetScene;

  Vec3 location(FacetId t, Rng& rng) const {
    return in_triangle({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}, rng);
  }

  std::optional<Scene> scene(Rng& rng) {
    const Vec3 origin = location(FacetId(static_cast<std::size_t>(rng.below(mesh.num_facets()))), rng);
    const double ball = mesh.diagonal() * std::pow(10, rng.uniform(-1.5, -0.6));
    const Sheet sheet = sheets.sheet_in(origin, ball);
    if (!(sheet.width > 0)) return {};
    Scene scene{sheet, sheet.u, sheet.axis.cross(sheet.u), sheet.axis, ball, 0.98 * sheet.width, {}};
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
      const Triangle corners{mesh.corner(t, 0) - origin, mesh.corner(t, 1) - origin,
                             mesh.corner(t, 2) - origin};
      if (closest_point(Vec3(0, 0, 0), corners).distance2 < ball * ball) scene.facets.push_back(corners);
    }
    return scene;
  }
};

std::deque<Surface> curved_surfaces() {
  std::deque<Surface> all;
  const auto waves = [](double x, double y) { return 0.05 * std::sin(9 * x) * std::cos(8 * y); };
  all.emplace_back(fixtures::torus(1, 0.4, {24, 14, true, true, 0.2}));
  all.emplace_back(make_shape("sphere", 6));
  all.emplace_back(fixtures::sheet(20, 1, waves, 0.2));
  all.emplace_back(fixtures::blob(6));
  for (fixtures::NamedSurface& s : fixtures::hard_surfaces())
    if (s.name == "saddle" || s.name == "steep saddle" || s.name == "frame")
      all.emplace_back(std::move(s.mesh));
  return all;
}

template <class Visit>
void for_scenes(int count, Visit visit) {
  Rng rng(11);
  for (Surface& surface : curved_surfaces())
    for (int i = 0; i < count; ++i)
      if (const std::optional<Scene> scene = surface.scene(rng)) visit(*scene, rng);
}

/// On the surface, or beside it, or above one that there is.
Site any_site(const Scene& scene, const std::vector<Site>& others, Rng& rng) {
  const double weight = scene.radius * scene.radius * rng.uniform(-0.2, 0.2);
  Vec3 d = in_triangle(scene.facets[rng.below(scene.facets.size())], rng);
  if (rng.below(3) == 0) d = 1.5 * scene.radius * fixtures::random_vector(rng);
  if (!others.empty() && rng.below(4) == 0)
    d = others[rng.below(others.size())].d +
        scene.radius * (scene.m * rng.uniform(-1, 1) + 0.3 * fixtures::random_vector(rng));
  if (others.size() > 1 && rng.below(4) == 0) {  // in line with two
    const Vec3 &a = others[0].d, &b = others[1].d;
    d = a + rng.uniform(-1.5, 2.5) * (b - a) + 0.05 * scene.radius * fixtures::random_vector(rng);
  }
  return {d, d.squaredNorm() - (rng.below(2) == 0 ? weight : 0)};
}

/// How often the axis of three sites meets the surface within the radius; none if it comes near to an edge.
std::optional<int> crossings(const Scene& scene, const Site& i, const Site& j, const Site& k) {
  int count = 0;
  for (const Triangle& t : scene.facets) {
    double a[3], b[3], lambda[3], most = 0;
    for (std::size_t n = 0; n < 3; ++n) a[n] = j.at(t[n]) - i.at(t[n]), b[n] = k.at(t[n]) - i.at(t[n]);
    for (std::size_t n = 0; n < 3; ++n) {
      const std::size_t p = (n + 1) % 3, q = (n + 2) % 3;
      lambda[n] = a[p] * b[q] - a[q] * b[p];
      most = std::max(most, std::abs(lambda[n]));
    }
    const double sign = lambda[0] + lambda[1] + lambda[2] > 0 ? 1 : -1;
    const double least = std::min({sign * lambda[0], sign * lambda[1], sign * lambda[2]});
    if (least < -1e-9 * most) continue;
    if (least < 1e-9 * most) return {};
    const Vec3 hit =
        (lambda[0] * t[0] + lambda[1] * t[1] + lambda[2] * t[2]) / (lambda[0] + lambda[1] + lambda[2]);
    count += hit.norm() <= scene.radius;
  }
  return count;
}

/// The surface above a place in the plane.
std::optional<Vec3> above(const Scene& scene, double x, double y) {
  for (const Triangle& t : scene.facets) {
    double weight[3], sum = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      const Vec3 &p = t[(n + 1) % 3], &q = t[(n + 2) % 3];
      weight[n] = (scene.x(p) - x) * (scene.y(q) - y) - (scene.y(p) - y) * (scene.x(q) - x);
      sum += weight[n];
    }
    if (!(sum > 0) || std::min({weight[0], weight[1], weight[2]}) < 0) continue;
    const Vec3 hit = (weight[0] * t[0] + weight[1] * t[1] + weight[2] * t[2]) / sum;
    if (hit.norm() <= scene.ball) return hit;
  }
  return {};
}

/// Does the lead of i over j only fall, or only grow, on lines along that direction of the plane?
bool is_monotone(const Scene& scene, const Site& i, const Site& j, const Vec2& along, Rng& rng) {
  int falls = 0, grows = 0;
  for (int line = 0; line < 4; ++line) {
    const double aside = scene.radius * rng.uniform(-0.9, 0.9);
    const double half = std::sqrt(scene.radius * scene.radius - aside * aside);
    std::optional<double> last;
    for (int step = -6; step <= 6; ++step) {
      const Vec2 at = aside * Vec2(-along.y(), along.x()) + step / 6.0 * half * along;
      const std::optional<Vec3> z = above(scene, at.x(), at.y());
      if (!z) continue;  // on an edge
      const double lead = j.at(*z) - i.at(*z);
      if (last) (lead < *last ? falls : grows) += 1;
      last = lead;
    }
  }
  return falls == 0 || grows == 0;
}

/// Where the bisector of two sites crosses edges, within the radius.
std::vector<Vec3> bisector_points(const Scene& scene, const Site& i, const Site& j) {
  std::vector<Vec3> points;
  for (const Triangle& t : scene.facets)
    for (std::size_t n = 0; n < 3; ++n) {
      const Vec3 &p = t[n], &q = t[(n + 1) % 3];
      const double at_p = j.at(p) - i.at(p), at_q = j.at(q) - i.at(q);
      if ((at_p < 0) == (at_q < 0)) continue;
      const Vec3 z = p + at_p / (at_p - at_q) * (q - p);
      if (z.norm() <= scene.radius) points.push_back(z);
    }
  return points;
}

/// Sites that make a simple chart, one after the other, and those that were refused.
struct Trial {
  Trial(const Scene& scene, int wanted, Rng& rng) {
    chart.begin(scene.sheet);
    for (int i = 0; i < wanted; ++i) {
      const Site site = any_site(scene, sites, rng);
      chart.add(site.d, site.c);
      if (chart.is_simple_with(chart.size() - 1, scene.radius)) {
        sites.push_back(site);
      } else {
        chart.take_back();
        refused.push_back(site);
      }
    }
  }
  Chart chart;
  std::vector<Site> sites, refused;
};

Vec2 direction(const Scene& scene, const Site& i, const Site& j) {
  const Vec3 e = j.d - i.d;
  return {scene.x(e), scene.y(e)};
}

}  // namespace

TEST_CASE("chart: in a simple one an axis of three sites meets the sheet once at most") {
  std::size_t met = 0, twice = 0;
  for_scenes(60, [&](const Scene& scene, Rng& rng) {
    const Trial trial(scene, 9, rng);
    for (std::size_t i = 0; i < trial.sites.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k)
          if (const std::optional<int> times =
                  crossings(scene, trial.sites[i], trial.sites[j], trial.sites[k])) {
            CHECK(*times <= 1);
            met += *times == 1;
          }
        for (const Site& other : trial.refused)
          twice += crossings(scene, trial.sites[i], trial.sites[j], other).value_or(0) > 1;
      }
  });
  CHECK(met > 300);
  CHECK(twice > 10);  // that is what there is to refuse
}

TEST_CASE("chart: in a simple one a bisector is crossed in one direction only") {
  std::size_t pairs = 0, refused = 0;
  for_scenes(40, [&](const Scene& scene, Rng& rng) {
    const Trial trial(scene, 7, rng);
    const auto one_way = [&](const Site& i, const Site& j) {
      return is_monotone(scene, i, j, Vec2(1, 0), rng) || is_monotone(scene, i, j, Vec2(0, 1), rng);
    };
    for (std::size_t i = 0; i < trial.sites.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Site &a = trial.sites[i], &b = trial.sites[j];
        const Vec2 e = direction(scene, a, b);
        ++pairs;
        CHECK(one_way(a, b));
        if (scene.sheet.slope * std::abs(scene.z(b.d - a.d)) < e.norm())
          CHECK(is_monotone(scene, a, b, e.normalized(), rng));
      }
    for (const Site& other : trial.refused)
      refused += std::ranges::any_of(trial.sites, [&](const Site& s) { return !one_way(s, other); });
  });
  CHECK(pairs > 1000);
  CHECK(refused > 10);
}

TEST_CASE("chart: between two locations on it a bisector is no farther than the bound") {
  std::size_t checks = 0, farther_than_ends = 0;
  for_scenes(100, [&](const Scene& scene, Rng& rng) {
    const Trial trial(scene, 7, rng);
    const auto n = trial.sites.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        if (i == j) continue;
        const Site &a = trial.sites[i], &b = trial.sites[j];
        const Vec2 e = direction(scene, a, b);
        const double turn = scene.sheet.slope * std::abs(scene.z(b.d - a.d)) / e.norm();
        if (turn > 0.999) continue;
        const std::vector<Vec3> points = bisector_points(scene, a, b);
        if (points.size() < 3) continue;
        const Vec3 from = points[rng.below(points.size())], to = points[rng.below(points.size())];
        if ((to - from).norm() < 1e-3 * scene.radius) continue;
        const double away = rng.below(2) == 0 ? 2 : 10;
        const Vec3 eye = rng.below(3) != 0 ? away * scene.radius * fixtures::random_vector(rng) : a.d;
        const double bound =
            trial.chart.farthest2(static_cast<int>(i), static_cast<int>(j), from - eye, to - eye);
        const Chart::Edge edge{static_cast<int>(i), static_cast<int>(j)};
        const double by_slope =
            farthest_on_edge(std::max((from - eye).norm(), (to - eye).norm()), (to - from).norm(),
                             trial.chart.steepest(std::span(&edge, 1)));
        const auto along = [&](const Vec3& z) { return e.x() * scene.y(z) - e.y() * scene.x(z); };
        const auto [first, last] = std::minmax({along(from), along(to)});
        const double ends2 = std::max((from - eye).squaredNorm(), (to - eye).squaredNorm());
        for (const Vec3& z : points) {
          if (along(z) < first || along(z) > last) continue;
          ++checks;
          CHECK((z - eye).squaredNorm() <= bound);
          CHECK((z - eye).norm() <= by_slope * (1 + 1e-9));
          farther_than_ends += (z - eye).squaredNorm() > (1 + 1e-4) * ends2;
        }
        if (turn < 0.5) CHECK(bound <= std::pow(std::sqrt(ends2) + 1.2 * (to - from).norm(), 2));
      }
  });
  CHECK(checks > 4000);
  CHECK(farther_than_ends > 40);
}

// Three places, each pair of which is no steeper than the slope: there is a surface through them.
TEST_CASE("chart: a bisector on the worst surface there may be is no farther than the bound") {
  Rng rng(13);
  std::size_t nearly = 0, nearly_by_slope = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    Sheet sheet;
    sheet.axis = fixtures::random_vector(rng).normalized();
    sheet.u = sheet.axis.unitOrthogonal();
    sheet.slope = sheet.slope_u = sheet.slope_v = rng.uniform(0.05, 0.99);
    const Vec3& m = sheet.axis;
    const Vec3 i = fixtures::random_vector(rng), j = i + fixtures::random_vector(rng), e = j - i;
    const double a = e.dot(m), flat = (e - a * m).norm();
    if (sheet.slope * std::abs(a) > 0.98 * flat) continue;
    // In the plane of the bisector: level, and up.
    const Vec3 level = m.cross(e).normalized(),
               up = level.cross(e).normalized() * (e.cross(level).dot(m) > 0 ? -1 : 1);
    const auto is_allowed = [&](const Vec3& step) {
      return std::abs(step.dot(m)) <= sheet.slope * (step - step.dot(m) * m).norm();
    };
    double steep = 0;  // the steepest path there
    for (double step = 64; step > 1e-9; step /= 2)
      if (is_allowed(level + (steep + step) * up)) steep += step;
    const double length = rng.uniform(0.1, 1), rise = length * steep * rng.uniform(-1, 1);
    const Vec3 from = fixtures::random_vector(rng), to = from + length * level + rise * up;
    Chart chart;
    chart.begin(sheet);
    chart.add(i, i.squaredNorm());
    chart.add(j, j.squaredNorm());
    const double way = 0.5 * (length + rise / steep);  // up as steeply as may be, then down
    const Vec3 top = from + way * (level + 0.9999 * steep * up);
    CHECK(is_allowed(top - from));
    // Seen from where the top is farthest off.
    const Vec3 eye =
        top - rng.uniform(1, 20) * (top - 0.5 * (from + to)) - 0.01 * fixtures::random_vector(rng);
    const double bound = chart.farthest2(0, 1, from - eye, to - eye);
    CHECK((top - eye).squaredNorm() <= bound);
    nearly += (top - eye).squaredNorm() > 0.95 * bound;
    const Chart::Edge edge{0, 1};
    const double ends = std::max((from - eye).norm(), (to - eye).norm());
    const double by_slope = farthest_on_edge(ends, (to - from).norm(), chart.steepest(std::span(&edge, 1)));
    CHECK((top - eye).norm() <= by_slope * (1 + 1e-9));
    nearly_by_slope += (top - eye).norm() - ends > 0.5 * (by_slope - ends);
  }
  CHECK(nearly > 1000);
  CHECK(nearly_by_slope > 300);
}

TEST_CASE("chart: what sites all around leave of the sheet's power, and how far off who is nearer may be") {
  std::size_t scenes = 0;
  double tightest = 0;
  for_scenes(60, [&](const Scene& scene, Rng& rng) {
    const double weight = rng.below(2) == 0 ? 0 : scene.radius * scene.radius * rng.uniform(-0.3, 0.3);
    const int n = 3 + static_cast<int>(rng.below(5));
    std::vector<Site> sites;
    double heaviest = weight;
    const double turned = rng.uniform(0, 6.3);
    for (int j = 0; j < n; ++j) {
      const double angle = turned + 2 * std::numbers::pi * (j + rng.uniform(-0.2, 0.2)) / n;
      const double far = scene.radius * rng.uniform(0.3, 1.5);
      const Vec3 d =
          scene.from_plane(far * std::cos(angle), far * std::sin(angle), far * rng.uniform(-0.3, 0.3));
      const double own = weight == 0 ? 0 : scene.radius * scene.radius * rng.uniform(-0.3, 0.3);
      sites.push_back({d, d.squaredNorm() - (own - weight)});
      heaviest = std::max(heaviest, own);
    }
    Chart chart;
    chart.begin(scene.sheet);
    for (const Site& s : sites) chart.add(s.d, s.c);
    chart.add(Vec3(0, 0, 0), 0);
    const Chart::Gain gain = chart.most_gain(n, scene.radius, weight, heaviest);
    bool surrounds = true;
    for (std::size_t j = 0; j < sites.size(); ++j) {
      const Vec3 &a = sites[j].d, &b = sites[(j + 1) % sites.size()].d;
      surrounds &= scene.x(a) * scene.y(b) - scene.y(a) * scene.x(b) > 0;
    }
    CHECK((gain.power < std::numeric_limits<double>::infinity()) == surrounds);
    CHECK((gain.range < std::numeric_limits<double>::infinity()) == surrounds);
    if (!surrounds) return;
    ++scenes;
    const auto check_at = [&](const Vec3& z) {
      if (z.norm() > scene.radius) return;
      double power = std::numeric_limits<double>::infinity();
      for (const Site& s : sites) power = std::min(power, z.squaredNorm() - weight + s.at(z));
      CHECK(power <= gain.power);
      tightest = std::max(tightest, (power + weight) / (gain.power + weight));
      if (power + heaviest > 0) CHECK(z.norm() + std::sqrt(power + heaviest) <= gain.range);
    };
    for (const Triangle& t : scene.facets) {
      for (const Vec3& corner : t) check_at(corner);
      for (int sample = 0; sample < 8; ++sample) check_at(in_triangle(t, rng));
    }
    for (int step = 0; step < 200; ++step) {  // at the border of what is spoken of
      const double angle = 0.0314 * step, far = 0.999 * scene.radius;
      if (const auto z = above(scene, far * std::cos(angle), far * std::sin(angle))) check_at(*z);
    }
  });
  CHECK(scenes > 100);
  CHECK(tightest > 0.95);
}

// Any place that is not higher than the slope allows.
TEST_CASE("chart: what sites all around leave on the worst surface there may be") {
  Rng rng(14);
  double tightest = 0;
  for (int draw = 0; draw < 4000; ++draw) {
    Sheet sheet;
    sheet.slope = sheet.slope_u = sheet.slope_v = rng.uniform(0, 0.99);
    const double weight = rng.uniform(-0.3, 0.3), radius = rng.uniform(0.2, 1);
    const int n = 3 + static_cast<int>(rng.below(4));
    Chart chart;
    chart.begin(sheet);
    std::vector<Site> sites;
    std::vector<double> angles;
    const double lift = rng.below(2) == 0 ? 0 : 1, turned = rng.uniform(0, 6.3);
    double heaviest = weight;
    for (int j = 0; j < n; ++j) {
      angles.push_back(turned + 2 * std::numbers::pi * (j + lift * rng.uniform(-0.1, 0.1)) / n);
      const Vec3 d(std::cos(angles.back()), std::sin(angles.back()), lift * rng.uniform(-0.9, 0.9));
      const double own = weight + lift * rng.uniform(-0.1, 0.1);
      heaviest = std::max(heaviest, own);
      sites.push_back({d, d.squaredNorm() - (own - weight)});
      chart.add(d, sites.back().c);
    }
    chart.add(Vec3(0, 0, 0), 0);
    const Chart::Gain gain = chart.most_gain(n, radius, weight, heaviest);
    REQUIRE(gain.power < std::numeric_limits<double>::infinity());
    for (std::size_t j = 0; j < sites.size(); ++j) {
      const double next = j + 1 < angles.size() ? angles[j + 1] : angles[0] + 2 * std::numbers::pi;
      const double angle = 0.5 * (angles[j] + next) + rng.uniform(-0.05, 0.05);
      for (const double height : {-sheet.slope, 0.0f, sheet.slope}) {
        const Vec3 z = radius * Vec3(std::cos(angle), std::sin(angle), height).normalized();
        double power = std::numeric_limits<double>::infinity();
        for (const Site& s : sites) power = std::min(power, z.squaredNorm() - weight + s.at(z));
        CHECK(power <= gain.power);
        tightest = std::max(tightest, (power + weight) / (gain.power + weight));
        if (power + heaviest > 0) CHECK(z.norm() + std::sqrt(power + heaviest) <= gain.range);
      }
    }
  }
  CHECK(tightest > 0.99);
}

TEST_CASE("chart: sites that do not surround the origin, or run clockwise, leave no bound") {
  Chart chart;
  Sheet flat;
  flat.width = 1;
  const auto gain = [&](std::vector<double> angles) {
    chart.begin(flat);
    for (const double a : angles) chart.add(Vec3(std::cos(a), std::sin(a), 0), 1);
    chart.add(Vec3(0, 0, 0), 0);
    return chart.most_gain(static_cast<int>(angles.size()), 0.6, 0, 0);
  };
  CHECK(gain({0, 2, 4}).power < 1.5);
  CHECK(gain({0, 1, 2}).power == std::numeric_limits<double>::infinity());
  CHECK(gain({0, 1, 2}).range == std::numeric_limits<double>::infinity());
  CHECK(gain({4, 2, 0}).power == std::numeric_limits<double>::infinity());
}

TEST_CASE("chart: all pairs and triples at once are those one by one") {
  std::size_t simple = 0, refused = 0;
  for_scenes(60, [&](const Scene& scene, Rng& rng) {
    for (const int n : {2, 3, 5, 8}) {
      Trial trial(scene, n, rng);  // mostly fewer
      Chart& chart = trial.chart;
      if (rng.below(2) == 0) {
        const Site any = any_site(scene, trial.sites, rng);
        chart.add(any.d, any.c);
      }
      const Site middle = any_site(scene, trial.sites, rng);
      chart.add(middle.d, middle.c);
      const int count = chart.size() - 1;
      std::vector<Chart::Edge> edges;
      for (int i = 0; i < count; ++i)
        if (const int j = static_cast<int>(rng.below(static_cast<std::uint64_t>(count))); i != j)
          edges.push_back({i, j});
      bool expected = chart.meets_axes_once(count, edges, scene.radius);
      for (const auto& [a, b] : edges)
        if (!chart.meets_axis_once(a, b, count, scene.radius)) CHECK(!expected);
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < i; ++j) {
          expected &= chart.is_monotone(i, j);
          for (int k = 0; k < j; ++k) expected &= chart.meets_axis_once(i, j, k, scene.radius);
        }
      CHECK(chart.is_simple(count, edges, scene.radius) == expected);
      bool with_middle = true;
      for (int i = 0; i < count; ++i) {
        with_middle &= chart.is_monotone(i, count);
        for (int j = 0; j < i; ++j) with_middle &= chart.meets_axis_once(i, j, count, scene.radius);
      }
      CHECK(chart.is_simple_with(count, scene.radius) == with_middle);
      (expected ? simple : refused) += 1;
    }
  });
  CHECK(simple > 200);
  CHECK(refused > 100);
}

TEST_CASE("chart: a site above another one is refused where the sheet bends") {
  std::size_t scenes = 0;
  for_scenes(40, [&](const Scene& scene, Rng& rng) {
    const double least_slope = std::min(scene.sheet.slope_u, scene.sheet.slope_v);
    ++scenes;
    const Vec3 d = in_triangle(scene.facets[rng.below(scene.facets.size())], rng);
    const double height = scene.radius * rng.uniform(0.05, 1) * (rng.below(2) == 0 ? -1 : 1);
    const double angle = rng.uniform(0, 6.3), aside = 0.99 * least_slope * std::abs(height);
    const Vec3 e = d + scene.from_plane(aside * std::cos(angle), aside * std::sin(angle), height);
    Chart chart;
    chart.begin(scene.sheet);
    chart.add(d, d.squaredNorm());
    chart.add(e, e.squaredNorm());
    CHECK(!chart.is_simple_with(1, scene.radius));
    // As far aside as it is high there is no doubt.
    const Vec3 beside = d + scene.from_plane(1.5 * height, 0, height);
    chart.replace(1, beside, beside.squaredNorm());
    CHECK(chart.is_simple_with(1, scene.radius));
  });
  CHECK(scenes > 100);
}

TEST_CASE("chart: three sites in a line are refused, unless their axis is far") {
  std::size_t scenes = 0;
  for_scenes(60, [&](const Scene& scene, Rng& rng) {
    if (std::min(scene.sheet.slope_u, scene.sheet.slope_v) < 0.01) return;
    ++scenes;
    // At `tie` all three have the same power, and so they have along the line through it, aside.
    const double angle = rng.uniform(0, 6.3);
    const Vec3 along = scene.from_plane(std::cos(angle), std::sin(angle), rng.uniform(-0.1, 0.1));
    const auto is_simple = [&](const Vec3& tie) {
      Chart chart;
      chart.begin(scene.sheet);
      std::vector<Site> sites;
      for (const double t : {-1.0, 0.1, 0.9}) {
        const Vec3 d = scene.radius * (t * along + 1e-4 * scene.m * t * t);
        sites.push_back({d, 2 * d.dot(tie)});
        chart.add(d, sites.back().c);
      }
      REQUIRE(chart.is_simple_with(1, scene.radius));
      const bool result = chart.is_simple_with(2, scene.radius);
      if (result) CHECK(crossings(scene, sites[0], sites[1], sites[2]).value_or(0) == 0);
      return result;
    };
    CHECK(!is_simple(0.95 * scene.radius * rng.uniform(-1, 1) * along));
    CHECK(!is_simple(Vec3(0, 0, 0)));
    CHECK(is_simple(1.2 * scene.radius * along));
    CHECK(is_simple(-5 * scene.radius * along));
  });
  CHECK(scenes > 100);
}
