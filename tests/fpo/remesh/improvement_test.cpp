#include "fpo/remesh/improvement.h"

#include <string>

#include "doctest.h"
#include "fpo/optimize.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::TriMesh;

namespace {

struct Improved {
  RemeshResult result;
  Dual dual;
  bool is_of_domain;  ///< the dual
};

/// Of samples that are optimized a little, after that many faults were left when room was made.
Improved improved(const TriMesh& mesh, std::size_t n, std::uint64_t seed, std::size_t faults) {
  const WantedType type(geom::surface_type(mesh));
  SurfaceDomain domain(mesh, random_samples(mesh, n, seed), SurfaceOptions());
  OptimizeOptions few;
  few.max_iterations = 1;
  optimize(domain, few);
  RemeshOptions options;
  options.num_samples = n;
  const SharedSizing shared{domain.sizing(), {}};
  Improved outcome;
  outcome.result.thin_parts.faults_after = faults;
  outcome.result.thin_parts.faults_before = faults;
  outcome.dual =
      improved_dual(domain, {shared, type, nullptr, angle_options(options)}, options, outcome.result);
  outcome.is_of_domain = dual_of(domain, type, false).mesh.facets() == outcome.dual.mesh.facets();
  return outcome;
}

}  // namespace

TEST_CASE("improvement: past mending, angles wait until the type is right") {
  std::size_t at_once = 0, when_right = 0, right = 0, wrong = 0;  // of the first two: bad triangles seen
  for (const std::string name : {"plate", "narrow-torus"})        // one is mended, one loses its hole
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      CAPTURE(name);
      CAPTURE(seed);
      const std::size_t n = name == "plate" ? 400 : 60;
      const TriMesh mesh = geom::make_shape(name, 8);
      const Improved few = improved(mesh, n, seed, 20), many = improved(mesh, n, seed, 21);
      CHECK(few.is_of_domain);
      CHECK(many.is_of_domain);
      const bool is_right = many.dual.type.ok();
      ++(is_right ? right : wrong);
      if (is_right) when_right += many.result.angles.bad_before;
      if (is_right) continue;
      CHECK(many.result.angles.bad_before == 0);
      at_once += few.result.angles.bad_before;
    }
  CHECK(right > 0);
  CHECK(wrong > 0);
  CHECK(when_right > 0);
  CHECK(at_once > 0);
}
