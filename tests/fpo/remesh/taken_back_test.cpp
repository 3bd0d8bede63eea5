#include "fpo/remesh/taken_back.h"

#include <algorithm>
#include <atomic>

#include "doctest.h"
#include "fpo/optimize.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::SiteId;
using geom::TriMesh;

namespace {

constexpr std::size_t num_fixed = 20;

/// Moves some samples to the places of others, nearly: holes on thin parts.
void disturb(SurfaceDomain& domain, std::uint64_t seed) {
  const std::vector<SurfaceSample> places = random_samples(domain.mesh(), 100, seed + 100);
  for (std::size_t i = 0; i < places.size(); ++i)
    put_back(domain, SiteId(num_fixed + (i * 37 + seed) % (domain.num_samples() - num_fixed)),
             {places[i], 1});
}

std::size_t num_elsewhere(const SurfaceDomain& domain, const std::vector<SurfaceSample>& samples) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    count += domain.sample(SiteId(i)).position != samples[i].position;
  return count;
}

}  // namespace

TEST_CASE("taken back: a dual that was right is so again, with most of what was done elsewhere") {
  std::size_t tried = 0, restored = 0, kept = 0, done = 0;
  for (const std::size_t n : {700u, 800u, 900u})
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      const TriMesh mesh = geom::make_shape("plate", 12);
      const WantedType type(geom::surface_type(mesh));
      SurfaceOptions options;
      options.num_fixed = num_fixed;
      SurfaceDomain domain(mesh, random_samples(mesh, n, seed), options);
      OptimizeOptions few;
      few.max_iterations = 20;
      optimize(domain, few);
      const auto next_dual = [&] { return dual_of(domain, type, false); };
      if (!is_right(next_dual())) continue;
      const RememberedSamples before(domain);
      const std::vector<SurfaceSample> old = samples_of(domain);
      disturb(domain, seed);
      const std::vector<SurfaceSample> disturbed = samples_of(domain);
      Dual dual = next_dual();
      if (is_right(dual)) continue;
      ++tried;
      const std::atomic<bool> interrupted = true;
      CHECK_FALSE(take_back(domain, before, next_dual, &interrupted, dual));
      CHECK(num_elsewhere(domain, disturbed) == 0);
      const bool is_restored = take_back(domain, before, next_dual, nullptr, dual);
      CHECK(is_restored == is_right(dual));
      CHECK(next_dual().mesh.facets() == dual.mesh.facets());
      for (std::size_t i = 0; i < old.size(); ++i) {  // each is where it was or where it was put
        const geom::Vec3& at = domain.sample(SiteId(i)).position;
        CHECK((at == old[i].position || at == disturbed[i].position));
        if (i < num_fixed) CHECK(at == old[i].position);
      }
      restored += is_restored;
      kept += num_elsewhere(domain, old);
      for (std::size_t i = 0; i < old.size(); ++i) done += disturbed[i].position != old[i].position;
    }
  MESSAGE("tried " << tried << ", restored " << restored << ", kept " << kept << " of " << done);
  CHECK(tried > 3);
  CHECK(restored == tried);
  CHECK(5 * kept > 4 * done);
}
