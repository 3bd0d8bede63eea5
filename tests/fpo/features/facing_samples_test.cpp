#include "fpo/features/facing_samples.h"

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/cage.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

/// Samples with their places, which are found again.
struct Placed {
  std::vector<CurveMetric> metrics;
  ChainPlaces places;
};

Placed placed(const TriMesh& mesh, const Features& features, const Sizing& sizing,
              const FeatureSamples& samples) {
  Placed result;
  for (std::size_t c = 0; c < features.curves.size(); ++c) {
    const CurveMetric& metric = result.metrics.emplace_back(mesh, features.curves[c], sizing);
    std::vector<double>& places = result.places.emplace_back();
    for (const geom::SiteId x : samples.chains[c]) {
      const CurveMetric::Nearest nearest = metric.nearest(samples.samples[x.index()].position);
      CHECK(nearest.distance2 < 1e-20);
      const bool ahead = !places.empty() && nearest.t <= places.back();
      places.push_back(nearest.t + (ahead ? metric.length() : 0));
    }
  }
  return result;
}

/// All pairs of edges and samples, without the exact predicate.
std::size_t crowded_by_brute_force(const Placed& placed, const FeatureSamples& samples) {
  std::size_t count = 0;
  const auto at = [&](geom::SiteId x) { return samples.samples[x.index()].position; };
  for (std::size_t c = 0; c < samples.chains.size(); ++c)
    for (std::size_t i = 0; i + 1 < samples.chains[c].size(); ++i) {
      const geom::SiteId a = samples.chains[c][i], b = samples.chains[c][i + 1];
      double low = placed.places[c][i], high = placed.places[c][i + 1];
      Vec3 middle;
      for (int step = 0; step < 60; ++step) {
        const double t = (low + high) / 2, length = placed.metrics[c].length();
        middle = placed.metrics[c].at(t > length ? t - length : t).position;
        ((middle - at(a)).norm() < (middle - at(b)).norm() ? low : high) = t;
      }
      bool crowded = false;
      for (std::size_t x = 0; x < samples.samples.size(); ++x)
        crowded |= x != a.index() && x != b.index() &&
                   (samples.samples[x].position - middle).norm() < (at(a) - middle).norm() * (1 - 1e-9);
      count += crowded;
    }
  return count;
}

}  // namespace

TEST_CASE("facing samples: a ball is closed, and exact where doubles are not") {
  CHECK(is_as_near({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  CHECK(is_as_near({0, 0, 0}, {1, 0, 0}, {0, 1 - 0x1p-53, 0}));
  CHECK_FALSE(is_as_near({0, 0, 0}, {1, 0, 0}, {0, 1 + 0x1p-52, 0}));
  // 2^-160 more than the square of the distance, which no rounded sum of squares sees.
  CHECK_FALSE(is_as_near({0, 0, 0}, {1, 0, 0}, {1, 0x1p-80, 0}));
  CHECK(is_as_near({0, 0, 0}, {1, 0x1p-80, 0}, {1, 0, 0}));
}

TEST_CASE("facing samples: however thin a bar is, no ball about an edge holds another sample") {
  const Sizing sizing = Sizing::uniform(0.11);
  for (const double thick : {0.5, 0.2, 0.07, 0.03, 0.011}) {
    CAPTURE(thick);
    const TriMesh bar = fixtures::box(Vec3(1, 0.37, thick), 8);
    const Features features = find_features(bar);
    const FeatureSamples samples = sample_features(bar, features, {}, sizing, {5000, 1, {}, true});
    const Placed there = placed(bar, features, sizing, samples);
    CHECK(crowded_edges(there.metrics, there.places, samples).empty());
    CHECK(crowded_by_brute_force(there, samples) == 0);
    CHECK(samples.samples.size() < 300);
  }
}

TEST_CASE("facing samples: holes beside a border, gears, threads: empty balls, and chains stay chains") {
  for (const char* name : {"hole-plate", "gear", "star", "rib", "screw", "comb"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name);
    const Features features = find_features(mesh);
    const Sizing sizing = Sizing::uniform(mesh.diagonal() / 24);
    const FeatureSamples samples = sample_features(mesh, features, {}, sizing, {5000, 1, {}, true});
    const Placed there = placed(mesh, features, sizing, samples);
    CHECK(crowded_edges(there.metrics, there.places, samples).empty());
    CHECK(crowded_by_brute_force(there, samples) == 0);
    std::vector<int> uses(samples.samples.size(), 0);
    for (std::size_t c = 0; c < samples.chains.size(); ++c)
      for (std::size_t i = features.curves[c].loop; i < samples.chains[c].size(); ++i)
        ++uses[samples.chains[c][i].index()];
    for (std::size_t x = samples.num_given; x < uses.size(); ++x) CHECK(uses[x] == 1);
  }
}

TEST_CASE("facing samples: nothing is added beyond the number that is allowed") {
  const TriMesh bar = fixtures::box(Vec3(1, 0.37, 0.02), 8);
  const Features features = find_features(bar);
  const std::size_t least = least_number_of_samples(bar, features, {});
  for (std::size_t most = least; most < least + 40; most += 7)
    CHECK(sample_features(bar, features, {}, Sizing::uniform(0.11), {most, 1, {}, true}).samples.size() <=
          most);
}

TEST_CASE("facing samples: on bars all samples that there are find a place where no ball is") {
  const TriMesh bars = fixtures::cage(3, 0.05);
  const Features features = find_features(bars);
  for (const std::size_t most : {700u, 900u, 1000u}) {
    CAPTURE(most);
    const Sizing sizing = Sizing::uniform(hexagonal_spacing(bars.area(), most));
    const FeatureSamples samples = sample_features(bars, features, {}, sizing, {most, 1, {}, true});
    const Placed there = placed(bars, features, sizing, samples);
    CHECK(crowded_edges(there.metrics, there.places, samples).empty());
    CHECK(crowded_by_brute_force(there, samples) == 0);
    CHECK(samples.samples.size() <= most);
    CHECK(samples.samples.size() > most - most / 50);
  }
}
