// Small angles where no single change helps.

#include "fpo/remesh/annealed_angles.h"

#include <algorithm>

#include "doctest.h"
#include "geom/mesh/surface_type.h"
#include "tests/fixtures/spoilt_remesh.h"

using namespace fpo;
using fixtures::Spoilt;
using geom::FacetId;
using geom::TriMesh;
using geom::VertexId;

namespace {

bool same_places(const std::vector<SurfaceSample>& a, const std::vector<SurfaceSample>& b) {
  return std::ranges::equal(a, b, [](const SurfaceSample& x, const SurfaceSample& y) {
    return x.position == y.position && x.facet == y.facet;
  });
}

}  // namespace

TEST_CASE("annealed angles: fewer are small, or all is as it was; samples and vertices agree") {
  std::size_t better = 0, as_before = 0;
  for (const char* shape : {"sphere", "torus", "square"}) {
    CAPTURE(shape);
    Spoilt s(shape, 6, 0.45, 17);
    const AngleOptions angles;
    const LastAnglesTask task{s.surface, s.sizing, s.features, nullptr, angles};
    AngleEdits edits(task, s.remesh, s.samples);
    edits.rules.smallest = edits.rules.good;
    geom::Rng rng(1);
    for (const FacetId t : edits.bad()) {
      CAPTURE(t.value);
      const TriMesh before = edits.mesh().mesh();
      const std::vector<SurfaceSample> samples = s.samples;
      const std::size_t bad = edits.bad().size();
      FacetRegion all;
      for (FacetId u(0); u.index() < edits.mesh().num_facets(); u = FacetId(u.value + 1)) all.push_back(u);
      const double cosine = edits.least_cosine(all);
      if (!anneal_angles(edits, t, rng)) {
        ++as_before;
        CHECK(edits.mesh().mesh().facets() == before.facets());
        CHECK(edits.mesh().mesh().vertices() == before.vertices());
        CHECK(same_places(samples, s.samples));
        continue;
      }
      ++better;
      CHECK(edits.bad().size() <= bad);
      CHECK(edits.least_cosine(all) >= std::min(cosine, -0.5));
      CHECK(geom::topology(edits.mesh().mesh()).euler == geom::topology(s.surface).euler);
      CHECK(geom::topology(edits.mesh().mesh()).manifold());
      const geom::AabbTree tree(s.surface);
      for (std::size_t i = 0; i < s.samples.size(); ++i) {
        CHECK(edits.mesh().position(VertexId(i)) == s.samples[i].position);
        CHECK(tree.closest(s.samples[i].position).distance2 < 1e-20);
      }
    }
  }
  CHECK(better > 5);
  CHECK(as_before > 0);  // at least where there is nothing left to mend
}
