// Creases of parts are folded to one side, those of noise to both.

#include "fpo/features/fold_sides.h"

#include <string>

#include "doctest.h"
#include "fpo/features/feature_choice.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/spoilt.h"

using geom::TriMesh;

namespace {

fpo::FoldSides sides_of(const TriMesh& mesh) {
  fpo::FeatureOptions options;
  options.crease_angle = options.weak_crease_angle = 30;
  return fpo::fold_sides(mesh, fpo::find_features(mesh, options));
}

}  // namespace

TEST_CASE("fold sides: none are opposite on parts, however their facets are turned") {
  for (const std::string name : {"cube", "l-block", "joint"}) {
    const TriMesh mesh = geom::make_shape(name, 6);
    const fpo::FoldSides sides = sides_of(mesh);
    CAPTURE(name);
    CHECK(sides.pairs > 10);
    CHECK(sides.opposite == 0);
    CHECK(!fpo::is_noise(sides));
    geom::Rng rng(2);
    const fpo::FoldSides turned = sides_of(fixtures::with_flips(mesh, 0.3, rng));
    CHECK(turned.pairs == sides.pairs);
    CHECK(turned.opposite == 0);
  }
}

TEST_CASE("fold sides: many are opposite in noise, and its creases are dropped") {
  for (const std::string name : {"sphere", "blob"})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      geom::Rng rng(seed);
      const TriMesh mesh = fixtures::with_noise(geom::make_shape(name, 16), 0.02, rng);
      CAPTURE(name);
      CAPTURE(seed);
      CHECK(fpo::is_noise(sides_of(mesh)));
      const auto choice = fpo::choose_features(mesh, fpo::automatic_features(), {3000, mesh.diagonal() / 60});
      CHECK(choice.features.curves.empty());
    }
}
