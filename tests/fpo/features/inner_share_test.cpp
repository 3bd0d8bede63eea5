#include "fpo/features/inner_share.h"

#include <cmath>

#include "doctest.h"
#include "fpo/features/feature_choice.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/block.h"
#include "tests/fixtures/cage.h"

using namespace fpo;
using geom::TriMesh;

namespace {

Features creases(const TriMesh& mesh) { return all_features(mesh, automatic_features(), 0.1); }

double per_area(double h) { return 2 / (std::sqrt(3.0) * h * h); }

}  // namespace

TEST_CASE("inner share: what is farther than half a row from all edges of a block") {
  for (const double h : {0.05, 0.1, 0.2})
    for (const double z : {1.0, 0.5, 0.1}) {
      CAPTURE(h);
      CAPTURE(z);
      const TriMesh mesh = fixtures::block(1, 1, z);
      const double off = std::sqrt(3.0) / 2 * h;  // from both sides
      const double side = std::max(0.0, z - off);
      const double area = 2 * (1 - off) * (1 - off) + 4 * (1 - off) * side;
      const InnerShare inner(mesh, creases(mesh), Sizing::uniform(h));
      CHECK(inner.num_samples() == doctest::Approx(area * per_area(h)).epsilon(0.05));
      const InnerShare scaled(mesh, creases(mesh), Sizing::uniform(h / 3), 3);
      CHECK(scaled.num_samples() == doctest::Approx(inner.num_samples()).epsilon(1e-9));
      const InnerShare finer(mesh, creases(mesh), Sizing::uniform(h / 2));
      CHECK(finer.num_samples(2) == doctest::Approx(inner.num_samples()).epsilon(0.05));
    }
}

TEST_CASE("inner share: hardly any on bars, all where there are no curves") {
  const TriMesh bars = fixtures::cage(3, 0.05);
  CHECK(InnerShare(bars, creases(bars), Sizing::uniform(0.06)).num_samples() < 2);
  const TriMesh ball = geom::make_shape("sphere");
  CHECK(InnerShare(ball, {}, Sizing::uniform(0.1)).num_samples() ==
        doctest::Approx(ball.area() * per_area(0.1)).epsilon(1e-9));
}
