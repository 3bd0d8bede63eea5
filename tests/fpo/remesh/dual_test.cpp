#include "fpo/remesh/dual.h"

#include <algorithm>

#include "doctest.h"
#include "fpo/optimize.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

/// A thin needle: four long sides that meet at a tip, on a square base.
TriMesh spike(double width, double height) {
  return TriMesh({Vec3(0, 0, 0), Vec3(width, 0, 0), Vec3(width, width, 0), Vec3(0, width, 0),
                  Vec3(width / 2, width / 2, height)},
                 {{VertexId(0), VertexId(2), VertexId(1)},
                  {VertexId(0), VertexId(3), VertexId(2)},
                  {VertexId(0), VertexId(1), VertexId(4)},
                  {VertexId(1), VertexId(2), VertexId(4)},
                  {VertexId(2), VertexId(3), VertexId(4)},
                  {VertexId(3), VertexId(0), VertexId(4)}});
}

}  // namespace

TEST_CASE("dual: the defects agree with the mesh's topology on rough and thin surfaces") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const SurfaceDomain domain(surface.mesh, random_samples(surface.mesh, 120, 7));
    const auto before = domain.diagram()->canonical();
    const geom::SurfaceType type = geom::surface_type(surface.mesh);
    const Dual dual = dual_of(domain, type, true);
    CHECK(domain.diagram()->canonical() == before);
    CHECK(dual.samples.size() == 120);
    CHECK(!dual.cells.empty());
    const geom::Topology t = geom::topology(dual.mesh);
    CHECK(find_defects(dual.mesh).empty() == (t.manifold() && t.unreferenced_vertices == 0));
    CHECK(dual.type.ok() == (dual.num_faults() == 0));
  }
}

TEST_CASE("dual: refinement keeps the number of samples and the diagram sound") {
  const TriMesh mesh = spike(0.12, 4);
  SurfaceDomain domain(mesh, random_samples(mesh, 40, 3));
  OptimizeOptions options;
  options.max_iterations = 5;
  optimize(domain, options);
  const geom::SurfaceType type = geom::surface_type(mesh);
  Dual dual = dual_of(domain, type, false);
  const std::size_t before = dual.defects.size();
  std::size_t least = before;
  for (int round = 0; round < 30 && !dual.defects.empty(); ++round) {
    if (refine_at(domain, dual.defects) == 0) break;
    domain.check();
    dual = dual_of(domain, type, false);
    least = std::min(least, dual.defects.size());
  }
  MESSAGE("spike: ", before, " defects, at best ", least, " after refinement");
  CHECK(domain.num_samples() == 40);
}

TEST_CASE("dual: refinement gives samples without a cell another place, and brings none where it has none") {
  const TriMesh mesh = fixtures::surfaces().front().mesh;
  SurfaceDomain domain(mesh, random_samples(mesh, 120, 3));
  OptimizeOptions options;
  options.max_iterations = 5;
  optimize(domain, options);
  const SiteId heavy(7);
  std::vector<SiteId> link;
  domain.neighbours(heavy, link);
  double far2 = 0;
  for (const SiteId y : link)
    far2 = std::max(far2, (domain.sample(y).position - domain.sample(heavy).position).squaredNorm());
  const SurfaceSample place = domain.sample(heavy);
  domain.remove(heavy);
  domain.insert_at(heavy, place, 1 + 1.1 * far2 / domain.samples().full_weight(heavy));
  const std::size_t hidden = domain.num_hidden();
  REQUIRE(hidden >= 3);
  const geom::SurfaceType type = geom::surface_type(mesh);
  const Dual dual = dual_of(domain, type, false);
  REQUIRE(dual.defects.size() >= hidden);
  CHECK(refine_at(domain, dual.defects) >= hidden);
  CHECK(domain.num_hidden() == 0);
  domain.check();
}
