#include "fpo/features/facing_curves.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "doctest.h"
#include "fpo/features/feature_samples.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

std::vector<FacingPair> pairs_of(const TriMesh& mesh, const Features& features, double spacing) {
  return facing_pairs(mesh, features, narrow_places(mesh, features, spacing));
}

/// The least angle at the ends of a curve's edges in triangles with the nearest sample of another curve: by
/// brute force over both chains.
double least_angle_across(const FeatureSamples& f, std::size_t on, std::size_t other) {
  double least = 180;
  for (std::size_t i = 0; i + 1 < f.chains[on].size(); ++i) {
    const Vec3 &a = f.samples[f.chains[on][i].index()].position,
               &b = f.samples[f.chains[on][i + 1].index()].position;
    double best = 0;
    for (const geom::SiteId x : f.chains[other]) {
      const Vec3& c = f.samples[x.index()].position;
      const auto angle = [](const Vec3& u, const Vec3& v) {
        return std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / M_PI;
      };
      best = std::max(best, std::min({angle(b - a, c - a), angle(a - b, c - b), angle(a - c, b - c)}));
    }
    least = std::min(least, best);
  }
  return least;
}

}  // namespace

TEST_CASE("facing curves: the rims of a slab in four pairs, each rim's edges all in step") {
  const TriMesh slab = fixtures::box(Vec3(1, 1, 0.05), 8), cube = fixtures::box(Vec3(1, 1, 1), 8);
  const Features features = find_features(slab);
  const std::vector<FacingPair> pairs = pairs_of(slab, features, 0.2);
  REQUIRE(pairs.size() == 4);
  std::set<double> heights;  // of those that lead
  for (const FacingPair& pair : pairs) {
    CHECK(pair.width == doctest::Approx(0.05));
    CHECK(pair.length == doctest::Approx(1));
    heights.insert(slab.position(features.curves[pair.leading].vertices[0]).z());
  }
  CHECK(heights.size() == 1);
  CHECK(pairs_of(cube, find_features(cube), 0.2).empty());
}

TEST_CASE("facing curves: around a bar of four long edges they lead and are staggered by turns") {
  const TriMesh bar = fixtures::box(Vec3(1, 0.05, 0.06), 8);
  const std::vector<FacingPair> pairs = pairs_of(bar, find_features(bar), 0.2);
  std::set<std::size_t> leading, staggered;
  for (const FacingPair& pair : pairs)
    if (pair.length > 0.5) leading.insert(pair.leading), staggered.insert(pair.staggered);
  CHECK(leading.size() == 2);
  CHECK(staggered.size() == 2);
  for (const std::size_t c : leading) CHECK(!staggered.contains(c));
}

TEST_CASE("facing curves: staggered samples give a strip half as wide as its edges good triangles") {
  for (const double width : {0.042, 0.05}) {
    const TriMesh slab = fixtures::box(Vec3(1, 1, width), 8);
    const Features features = find_features(slab);
    const double h = 0.1;
    const std::vector<FacingPair> pairs = pairs_of(slab, features, 0.2);
    REQUIRE(pairs.size() == 4);
    const FeatureSamples plain = sample_features(slab, features, {}, Sizing::uniform(h), {1000, 1});
    const FeatureSamples samples = sample_features(slab, features, {}, Sizing::uniform(h), {1000, 1, pairs});
    for (const FacingPair& pair : pairs) {
      CHECK(samples.chains[pair.staggered].size() == samples.chains[pair.leading].size() + 1);
      const double angle = std::min(least_angle_across(samples, pair.leading, pair.staggered),
                                    least_angle_across(samples, pair.staggered, pair.leading)),
                   before = least_angle_across(plain, pair.leading, pair.staggered);
      CHECK(before == doctest::Approx(std::atan(width / h) * 180 / M_PI));
      CHECK(angle > 1.4 * before);
      CHECK(angle > 33);
    }
  }
}

TEST_CASE("facing curves: where edges are as short as the strip is wide nothing changes") {
  const TriMesh slab = fixtures::box(Vec3(1, 1, 0.1), 8);
  const Features features = find_features(slab);
  const std::vector<FacingPair> pairs = pairs_of(slab, features, 0.2);
  REQUIRE(!pairs.empty());
  const FeatureSamples plain = sample_features(slab, features, {}, Sizing::uniform(0.1), {1000, 1}),
                       samples = sample_features(slab, features, {}, Sizing::uniform(0.1), {1000, 1, pairs});
  REQUIRE(plain.samples.size() == samples.samples.size());
  for (std::size_t i = 0; i < plain.samples.size(); ++i)
    CHECK(plain.samples[i].position == samples.samples[i].position);
}

TEST_CASE(
    "facing curves: samples are staggered unless that is not wanted, and it is said of how many curves") {
  const TriMesh slab = fixtures::box(Vec3(1, 1, 0.05), 8);
  const Features features = find_features(slab);
  const auto sizing = [](std::size_t) { return Sizing::uniform(0.15); };
  CurveSampling sampling{66};
  CHECK(share_sizing(slab, features, {}, sizing, sampling).features.staggered_curves == 4);
  sampling.staggered = false;
  CHECK(share_sizing(slab, features, {}, sizing, sampling).features.staggered_curves == 0);
  sampling.staggered = sampling.facing = true;
  CHECK(share_sizing(slab, features, {}, sizing, sampling).features.staggered_curves == 0);
}
