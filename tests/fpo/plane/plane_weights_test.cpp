#include "fpo/plane/plane_weights.h"

#include <memory>

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"

using fpo::PlaneWeights;
using geom::SiteId;

TEST_CASE("plane weights: the length that gave a weight is told from it, whatever the share") {
  const geom::FlatTorus torus({1, 1});
  const auto sizing = fpo::named_sizing("waves5", torus);
  PlaneWeights weights(*sizing, 0.03, 0.7);
  geom::Rng rng(1);
  for (std::size_t i = 0; i < 50; ++i) {
    const SiteId x(i);
    const geom::Vec2 place(rng.uniform(), rng.uniform());
    CHECK(weights.edge_length(place) == 0.03 * sizing->rho(place));
    if (i % 5 > 0) weights.set_share(x, 0.25 * static_cast<double>(i % 5), 50);
    CHECK(weights.weight(x, place) == weights.share(x) * weights.full_weight(place));
    CHECK(weights.edge_length(x, weights.weight(x, place)) == doctest::Approx(weights.edge_length(place)));
  }
  for (const double share : {0.0, -0.5, 1.5})
    CHECK_THROWS_AS(weights.set_share(SiteId(0), share, 50), geom::Bug);
}

TEST_CASE("plane weights: uniform ones are 0") {
  const geom::FlatTorus torus({1, 1});
  const auto sizing = fpo::named_sizing("uniform", torus);
  const PlaneWeights weights(*sizing, 0.03, 0.7);
  CHECK(weights.is_uniform());
  CHECK(weights.weight(SiteId(3), {0.2, 0.7}) == 0);
  CHECK(weights.edge_length(SiteId(3), 0) == 0.03);
}
