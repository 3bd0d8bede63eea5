// Small angles that are left in a remesh.

#include "fpo/remesh/last_angles.h"

#include <algorithm>

#include "doctest.h"
#include "fpo/measure/triangle_angles.h"
#include "fpo/remesh/edited_mesh.h"
#include "fpo/remesh/recovered_edges.h"
#include "geom/mesh/aabb_tree.h"
#include "tests/fixtures/spoilt_remesh.h"

using namespace fpo;
using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

using fixtures::Spoilt;

namespace {

double smallest_angle(const TriMesh& mesh) {
  double least = 180;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    least = std::min(least,
                     std::ranges::min(angles_of({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)})));
  return least;
}

double shortest_edge(const TriMesh& mesh) {
  double least = 1e9;
  for (const TriMesh::Facet& f : mesh.facets())
    for (std::size_t i = 0; i < 3; ++i)
      least = std::min(least, (mesh.position(f[i]) - mesh.position(f[(i + 1) % 3])).norm());
  return least;
}

}  // namespace

TEST_CASE("last angles: become larger, on the surface, with as many samples and the type as it was") {
  Spoilt s("sphere", 6, 0.55);
  const double before = smallest_angle(s.remesh);
  REQUIRE(before < 25);
  const AngleOptions angles;
  const LastAngles result =
      mend_last_angles({s.surface, s.sizing, s.features, nullptr, angles}, s.remesh, s.samples);
  CHECK(result.bad_before > 5);
  CHECK(result.bad_after == 0);
  CHECK(smallest_angle(s.remesh) >= 30 - 1e-6);
  CHECK(geom::topology(s.remesh).euler == 2);
  CHECK(geom::topology(s.remesh).manifold());
  const geom::AabbTree tree(s.surface);
  REQUIRE(s.remesh.num_vertices() == s.samples.size());
  for (std::size_t i = 0; i < s.samples.size(); ++i) {
    CHECK(s.remesh.position(VertexId(i)) == s.samples[i].position);
    CHECK(tree.closest(s.samples[i].position).distance2 < 1e-20);
  }
}

TEST_CASE("last angles: others may lose what is above the goal, if no other way is left") {
  Spoilt s("torus", 6, 0.35, 13);
  const AngleOptions angles;
  REQUIRE(angles.smallest == 33);
  LastAnglesGoal goal{31};
  goal.most_attempts = 2000;
  const LastAngles result =
      mend_last_angles({s.surface, s.sizing, s.features, nullptr, angles, goal}, s.remesh, s.samples);
  CHECK(result.bad_before > 15);
  CHECK(result.bad_after == 0);  // 5 if the same were asked of all
  CHECK(smallest_angle(s.remesh) >= 31 - 1e-6);
  CHECK(geom::topology(s.remesh).euler == 0);
}

TEST_CASE("last angles: what no single change mends is annealed, at the cost of edges that are allowed") {
  for (const double crowded_edge : {0.55, 0.5}) {
    CAPTURE(crowded_edge);
    Spoilt s("torus", 6, 0.55, 17);
    const AngleOptions angles;
    const LastAnglesGoal goal{30, 0.55, crowded_edge, 2000};
    const double shortest = std::min(shortest_edge(s.remesh), crowded_edge * s.sizing.at(s.samples[0]));
    const LastAngles result =
        mend_last_angles({s.surface, s.sizing, s.features, nullptr, angles, goal}, s.remesh, s.samples);
    CHECK((result.bad_after > 0) == (crowded_edge == 0.55));
    CHECK(shortest_edge(s.remesh) >= shortest);
    CHECK(geom::topology(s.remesh).euler == 0);
    CHECK(geom::topology(s.remesh).manifold());
  }
}

TEST_CASE("last angles: samples of features without a curve to slide on stay, and so do their edges") {
  Spoilt s("sphere", 6, 0.55);
  for (std::size_t i = 0; i < s.samples.size(); ++i) s.features.samples.push_back(s.samples[i]);
  const TriMesh::Facet f = s.remesh.facet(FacetId(29));
  s.features.chains = {{SiteId(f[0].value), SiteId(f[1].value)}, {SiteId(f[1].value), SiteId(f[2].value)}};
  const TriMesh before = s.remesh;
  const AngleOptions angles;
  mend_last_angles({s.surface, s.sizing, s.features, nullptr, angles}, s.remesh, s.samples);
  CHECK(s.remesh.vertices() == before.vertices());
  CHECK(broken_edges(s.remesh, s.features).empty());
  CHECK(smallest_angle(s.remesh) >= smallest_angle(before));
}

TEST_CASE("last angles: nothing changes where none is below 30 degrees, or below what is wanted") {
  Spoilt s("sphere", 6, 0.05);
  AngleOptions angles;
  const TriMesh before = s.remesh;
  if (smallest_angle(before) < 30) angles.smallest = smallest_angle(before) - 1;
  const LastAngles result =
      mend_last_angles({s.surface, s.sizing, s.features, nullptr, angles}, s.remesh, s.samples);
  CHECK(result.bad_before == 0);
  CHECK(result.mended == 0);
  CHECK(s.remesh.facets() == before.facets());
  CHECK(s.remesh.vertices() == before.vertices());
}

TEST_CASE("last angles: a goal of longer edges and larger angles is kept to") {
  Spoilt s("sphere", 6, 0.35);
  const double before = smallest_angle(s.remesh);
  REQUIRE(before < 33);
  const TriMesh old = s.remesh;
  const AngleOptions angles;
  const LastAnglesGoal goal{33, 0.75, 0.75};
  const LastAngles result =
      mend_last_angles({s.surface, s.sizing, s.features, nullptr, angles, goal}, s.remesh, s.samples);
  CHECK(result.mended > 0);
  CHECK(result.bad_after < result.bad_before);
  CHECK(smallest_angle(s.remesh) >= before);
  for (FacetId t(0); t.index() < s.remesh.num_facets(); t = FacetId(t.value + 1))
    for (int i = 0; i < 3; ++i) {
      const VertexId v = s.remesh.facet(t)[i], w = s.remesh.facet(t)[(i + 1) % 3];
      if (s.remesh.position(v) == old.position(v) && s.remesh.position(w) == old.position(w)) continue;
      const double wanted = s.sizing.at(s.samples[v.index()]);
      CHECK((s.remesh.position(v) - s.remesh.position(w)).norm() >=
            std::min(0.75 * wanted, shortest_edge(old)));
    }
}
