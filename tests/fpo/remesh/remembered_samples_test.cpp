#include "fpo/remesh/remembered_samples.h"

#include "doctest.h"
#include "fpo/optimize.h"
#include "fpo/remesh/dual.h"
#include "fpo/surface/initial_samples.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::SiteId;

TEST_CASE("remembered samples: places, weights and the mesh are what they were") {
  const geom::TriMesh mesh = geom::make_shape("double-torus", 16);
  const geom::SurfaceType type = geom::surface_type(mesh);
  SurfaceDomain domain(mesh, random_samples(mesh, 120, 3));
  const auto facets = [&] { return dual_of(domain, type, false).mesh.facets(); };
  const auto places_before = samples_of(domain);
  const auto facets_before = facets();
  const RememberedSamples before(domain);
  OptimizeOptions options;
  options.max_iterations = 2;
  optimize(domain, options);
  const SurfaceSample home = domain.sample(SiteId(7));
  domain.remove(SiteId(7));
  domain.insert_at(SiteId(7), home, 0.5);
  CHECK(facets() != facets_before);
  before.put_back(domain);
  CHECK(facets() == facets_before);
  for (std::size_t i = 0; i < places_before.size(); ++i) {
    CHECK(domain.sample(SiteId(i)).position == places_before[i].position);
    CHECK(domain.sample(SiteId(i)).facet == places_before[i].facet);
    CHECK(domain.weight_share(SiteId(i)) == 1);
  }
  domain.check();
}

TEST_CASE("remembered samples: those that know older ones put back what was between") {
  const geom::TriMesh mesh = geom::make_shape("sphere", 12);
  SurfaceDomain domain(mesh, random_samples(mesh, 80, 4));
  const RememberedSamples first(domain);
  const auto step = [&](std::size_t x, double share) {
    const SurfaceSample home = domain.sample(SiteId(x));
    domain.remove(SiteId(x));
    domain.insert_at(SiteId(x), share == 1 ? domain.sample(SiteId(x + 20)) : home, share);
  };
  step(3, 1);
  step(50, 0.7);
  const auto places_then = samples_of(domain);
  const RememberedSamples second(domain, &first), third(domain, &second);
  OptimizeOptions options;
  options.max_iterations = 1;
  for (const RememberedSamples* remembered : {&second, &third}) {
    optimize(domain, options);
    remembered->put_back(domain);
    for (std::size_t i = 0; i < places_then.size(); ++i) {
      CHECK(domain.sample(SiteId(i)).position == places_then[i].position);
      CHECK(domain.weight_share(SiteId(i)) == (i == 50 ? 0.7 : 1));
    }
  }
  domain.check();
}
