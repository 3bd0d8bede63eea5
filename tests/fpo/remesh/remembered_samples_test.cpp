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
