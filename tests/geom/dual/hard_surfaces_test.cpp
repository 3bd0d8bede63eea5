// The dual where the fast way meets what it must refuse: equality with brute force after every move.

#include "tests/fixtures/hard_surfaces.h"

#include "doctest.h"
#include "tests/fixtures/effort.h"
#include "tests/fixtures/mirrored_dual.h"

using namespace geom;
using fixtures::DualWalk;
using fixtures::Weights;

namespace {

void walk_on(const fixtures::NamedSurface& surface, const DualWalk::Options& options, int steps) {
  CAPTURE(surface.name);
  CAPTURE(options.num_sites);
  CAPTURE(static_cast<int>(options.weights));
  CAPTURE(options.search);
  CAPTURE(options.seed);
  DualWalk walk(surface.mesh, options);
  walk.build();
  fixtures::check_by_brute_force(walk.d);
  for (int step = 0; step < steps; ++step) {
    CAPTURE(step);
    walk.step();
    fixtures::check_by_brute_force(walk.d);
  }
}

}  // namespace

TEST_CASE("restricted dual on hard surfaces: equals brute force after every move, cells larger than facets") {
  for (const fixtures::NamedSurface& surface : fixtures::hard_surfaces())
    for (const Weights weights : fixtures::all_weights)
      walk_on(surface, {.num_sites = 12, .weights = weights, .search = weights != Weights::gentle, .seed = 3},
              fixtures::effort(15, 25));
}

TEST_CASE("restricted dual on hard surfaces: equals brute force after every move, cells and facets alike") {
  for (const fixtures::NamedSurface& surface : fixtures::hard_surfaces())
    for (const Weights weights : fixtures::all_weights)
      walk_on(surface,
              {.num_sites = 60, .weights = weights, .search = weights != Weights::none, .keeps_number = true},
              fixtures::effort(5, 15));
}

TEST_CASE("restricted dual on hard surfaces: equals brute force after every move, facets larger than cells") {
  for (const fixtures::NamedSurface& surface : fixtures::hard_surfaces())
    if (surface.mesh.num_facets() <= 130)
      walk_on(surface,
              {.num_sites = 150, .weights = Weights::none, .share_of_homes = 0.97, .keeps_number = true},
              fixtures::effort(7, 12));
}
