#include "fpo/remesh/sent_away.h"

#include <atomic>

#include "doctest.h"
#include "fpo/optimize.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::SiteId;
using geom::TriMesh;

namespace {

using Mending = std::size_t (*)(SurfaceDomain&, const std::function<Dual()>&, const std::atomic<bool>*,
                                Dual&);

/// Fewer faults or the same samples; the dual is that of the domain; fixed samples stay.
void check_mends_most(Mending mend) {
  std::size_t mended = 0, tried = 0;
  for (const char* name : {"plate", "paper"})
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      const TriMesh mesh = geom::make_shape(name, 6);
      const WantedType type(geom::surface_type(mesh));
      SurfaceOptions options;
      options.num_fixed = 20;
      SurfaceDomain domain(mesh, random_samples(mesh, 400, seed), options);
      OptimizeOptions few;
      few.max_iterations = 5;
      optimize(domain, few);
      const auto next_dual = [&] { return dual_of(domain, type, false); };
      Dual best = next_dual();
      const std::size_t faults = best.num_faults();
      if (faults == 0 || faults > 12) continue;
      ++tried;
      const std::vector<SurfaceSample> before = samples_of(domain);
      std::atomic<bool> interrupted = true;
      CHECK(mend(domain, next_dual, &interrupted, best) == 0);
      const std::size_t moved = mend(domain, next_dual, nullptr, best);
      CHECK(best.num_faults() <= faults);
      CHECK((moved > 0) == (best.num_faults() < faults));
      CHECK(next_dual().mesh.facets() == best.mesh.facets());
      const std::vector<SurfaceSample> after = samples_of(domain);
      REQUIRE(after.size() == before.size());
      for (std::size_t i = 0; i < after.size(); ++i)
        if (moved == 0 || i < 20) CHECK(after[i].position == before[i].position);
      mended += best.type.ok();
    }
  CHECK(tried > 4);
  CHECK(2 * mended > tried);  // all of them, in fact
}

}  // namespace

TEST_CASE("sent away: fewer faults or the same samples; the dual is that of the domain; fixed samples stay") {
  check_mends_most(send_away);
}

TEST_CASE("nudged aside: fewer faults or the same samples, and so on") { check_mends_most(nudge_aside); }
