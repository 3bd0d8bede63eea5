#include "fpo/surface/weighted_samples.h"

#include <cmath>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;

TEST_CASE("weighted samples: a weight is the share of (c h)^2 at the sample's own place") {
  const geom::TriMesh mesh = fixtures::blob(4);
  const Sizing sizing = fixtures::graded(mesh, 0.05, 0.2);
  const auto places = random_samples(mesh, sizing, 30, 2);
  SurfaceOptions options;
  options.weight_factor = 0.7;
  WeightedSamples samples(sizing, places, options);
  CHECK(!samples.have_no_weights());
  for (std::size_t i = 0; i < 30; ++i) {
    const SiteId x(i);
    const double share = 0.1 * static_cast<double>(i % 11);
    samples.set_share(x, share);
    samples.put(x, places[29 - i]);
    const double full = std::pow(0.7 * sizing.at(places[29 - i]), 2);
    CHECK(samples[x].position == places[29 - i].position);
    CHECK(samples.full_weight(x) == doctest::Approx(full));
    CHECK(samples.weight(x) == doctest::Approx(share * full));
  }
  CHECK_THROWS_AS(WeightedSamples(sizing, {}, options), geom::InputError);
  CHECK_THROWS_AS(samples.set_share(SiteId(0), -0.1), geom::Bug);
}

TEST_CASE("weighted samples: where sites are followed these tell positions, and a copy stands by itself") {
  const geom::TriMesh mesh = fixtures::blob(4);
  const Sizing sizing = fixtures::graded(mesh, 0.05, 0.2);
  const auto places = random_samples(mesh, sizing, 30, 2);
  WeightedSamples samples(sizing, places, SurfaceOptions{});
  samples.set_share(SiteId(3), 0.5);
  geom::Table<SiteId, geom::WeightedPoint3> sites;
  for (std::size_t i = 0; i < 30; ++i) sites.push_back({places[i].position, samples.weight(SiteId(i))});
  samples.follow(sites);
  samples.put(SiteId(3), places[7]);
  CHECK(samples[SiteId(3)].facet == places[7].facet);
  CHECK(samples[SiteId(3)].position == places[3].position);  // it is only going to be there
  CHECK(samples.weight_at(places[7], SiteId(3)) == doctest::Approx(0.5 * samples.weight_at(places[7])));
  sites[SiteId(3)].position = places[7].position;
  CHECK(samples[SiteId(3)].position == places[7].position);
  WeightedSamples copy = samples.copy();
  sites[SiteId(3)].position = places[9].position;
  copy.put(SiteId(4), places[8]);
  CHECK(copy[SiteId(3)].position == places[7].position);
  CHECK(copy[SiteId(4)].position == places[8].position);
  CHECK(samples[SiteId(4)].facet == places[4].facet);
  CHECK(copy.share(SiteId(3)) == 0.5);
}

TEST_CASE("weighted samples: equal weights are none, and a smaller share is the same difference") {
  const geom::TriMesh mesh = fixtures::blob(4);
  for (const Sizing& sizing : {Sizing::uniform(0.3), fixtures::graded(mesh, 0.05, 0.2)}) {
    SurfaceOptions options;
    options.weighted = false;
    WeightedSamples samples(sizing, random_samples(mesh, 10, 1), options);
    CHECK(samples.have_no_weights());
    for (std::size_t i = 0; i < 10; ++i) CHECK(samples.weight(SiteId(i)) == 0);
    samples.set_share(SiteId(3), 1);
    CHECK(samples.have_no_weights());
    samples.set_share(SiteId(3), 0.6);
    CHECK(samples.weight(SiteId(3)) == doctest::Approx(-0.4 * samples.full_weight(SiteId(3))));
    samples.set_share(SiteId(3), 1);
    CHECK(samples.weight(SiteId(3)) == 0);
    CHECK(!samples.have_no_weights());
  }
}
