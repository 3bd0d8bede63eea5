// What is said of sites that may be elsewhere: against charts of them where they are, at random and at worst.

#include "geom/dual/slack_chart.h"

#include <cmath>

#include "doctest.h"
#include "geom/dual/chart.h"
#include "geom/rng.h"
#include "tests/fixtures/effort.h"
#include "tests/fixtures/weighted_points.h"

using namespace geom;

namespace {

Sheet random_sheet(Rng& rng) {
  Sheet sheet;
  sheet.axis = fixtures::random_vector(rng).normalized();
  const Vec3 across = std::abs(sheet.axis.x()) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  sheet.u = across.cross(sheet.axis).normalized();
  sheet.slope_u = rng.uniform(0, 0.5);
  sheet.slope_v = rng.uniform(0, 0.5);
  sheet.slope = std::hypot(sheet.slope_u, sheet.slope_v);
  return sheet;
}

/// A rim around the origin, and a few beyond: about as far from each other as samples are.
std::vector<Vec3> random_sites(const Sheet& sheet, Rng& rng) {
  const Vec3 v = sheet.axis.cross(sheet.u);
  std::vector<Vec3> sites;
  const int rim = 5 + static_cast<int>(rng.below(3));
  for (int j = 0; j < rim; ++j) {
    const double angle = 6.283 * (j + rng.uniform(-0.2, 0.2)) / rim, far = rng.uniform(0.85, 1.2);
    const Vec3 along = far * (std::cos(angle) * sheet.u + std::sin(angle) * v);
    sites.push_back(along + rng.uniform(-1, 1) * 0.3 * sheet.slope * far * sheet.axis);
  }
  return sites;
}

Vec3 elsewhere(const Vec3& d, double off, Rng& rng) {
  Vec3 way = fixtures::random_vector(rng);
  if (rng.below(2) == 0) way.normalize();
  return d + off * way / std::max(1.0, way.norm());
}

Chart chart_of(const Sheet& sheet, std::span<const Vec3> sites) {
  Chart chart;
  chart.begin(sheet);
  for (const Vec3& d : sites) chart.add(d, d.squaredNorm());
  return chart;
}

}  // namespace

TEST_CASE("slack chart: simple wherever the sites are, and no steeper than said") {
  Rng rng(1);
  int simple = 0, not_simple = 0;
  for (int example = 0; example < fixtures::effort(400, 4000); ++example) {
    const Sheet sheet = random_sheet(rng);
    std::vector<Vec3> sites = random_sites(sheet, rng);
    const double off = rng.uniform(0, 0.12), own = rng.uniform(0, 0.15), radius = rng.uniform(0.5, 0.9);
    const int count = static_cast<int>(sites.size());
    SlackChart slack;
    slack.begin(sheet, radius);
    slack.add(Vec3(0, 0, 0), own);
    for (const Vec3& d : sites) slack.add(d, off);
    ++(slack.is_simple() ? simple : not_simple);
    if (!slack.is_simple()) continue;
    for (int time = 0; time < 60; ++time) {
      std::vector<Vec3> moved;
      for (const Vec3& d : sites) moved.push_back(elsewhere(d, off, rng));
      moved.push_back(elsewhere(Vec3(0, 0, 0), own, rng));
      const Chart chart = chart_of(sheet, moved);
      std::vector<Chart::Edge> edges;
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < i; ++j) edges.push_back({i, j});
      CHECK(chart.is_simple(count, edges, radius));
      CHECK(chart.is_simple_with(count, radius));
      for (int i = 0; i < count; ++i) edges.push_back({i, count});
      CHECK(chart.steepest(edges) <= slack.steepest());
    }
  }
  CHECK(simple > 100);
  CHECK(not_simple > 50);
}

TEST_CASE("slack chart: the same with one more site") {
  Rng rng(2);
  int simple = 0, not_simple = 0;
  for (int example = 0; example < fixtures::effort(400, 4000); ++example) {
    const Sheet sheet = random_sheet(rng);
    const std::vector<Vec3> sites = random_sites(sheet, rng);
    const double off = rng.uniform(0, 0.08), radius = rng.uniform(0.5, 0.9);
    SlackChart slack;
    slack.begin(sheet, radius);
    for (const Vec3& d : sites) slack.add(d, off);
    if (!slack.is_simple()) continue;
    const Vec3 more = rng.uniform(1.3, 1.9) * (sites[0] + rng.uniform() * (sites[1] - sites[0]));
    const double steepest = slack.steepest();
    const bool is_simple = slack.is_simple_with(more, off);
    CHECK(slack.size() == static_cast<int>(sites.size()));
    CHECK(slack.steepest() == steepest);
    ++(is_simple ? simple : not_simple);
    for (int time = 0; is_simple && time < 40; ++time) {
      std::vector<Vec3> moved;
      for (const Vec3& d : sites) moved.push_back(elsewhere(d, off, rng));
      moved.push_back(elsewhere(more, off, rng));
      CHECK(chart_of(sheet, moved).is_simple_with(static_cast<int>(sites.size()), radius));
    }
  }
  CHECK(simple > 50);
  CHECK(not_simple > 50);
}

TEST_CASE("slack chart: with more slack no more is simple, and three in line that may meet an axis are not") {
  Sheet sheet;
  sheet.slope = sheet.slope_u = sheet.slope_v = 0.2;
  const auto is_simple = [&](double off, double radius) {
    SlackChart slack;
    slack.begin(sheet, radius);
    slack.add(Vec3(0, 0, 0), off);
    slack.add(Vec3(1, 0, 0), off);
    slack.add(Vec3(-1, 0, 0), off);
    return slack.is_simple();
  };
  CHECK(is_simple(0, 0.7));
  CHECK(is_simple(0.05, 0.7));
  CHECK(!is_simple(0.3, 0.7));
  CHECK(!is_simple(0.05, 100));
}
