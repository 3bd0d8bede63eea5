#include "fpo/remesh/extract.h"

#include <cmath>
#include <set>

#include "doctest.h"
#include "fpo/surface/surface_domain.h"
#include "geom/check.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;

namespace {

using Triangle = std::array<int, 3>;

/// The cycle from its smallest member on.
Triangle canonical(Triangle t) {
  std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  return t;
}

std::set<Triangle> triangles_of(const TriMesh& mesh) {
  std::set<Triangle> result;
  for (const TriMesh::Facet& f : mesh.facets())
    result.insert(canonical({f[0].value, f[1].value, f[2].value}));
  return result;
}

SurfaceDomain domain_at(const TriMesh& mesh, const std::vector<Vec3>& positions) {
  const geom::AabbTree tree(mesh);
  std::vector<SurfaceSample> samples;
  for (const Vec3& p : positions) samples.push_back({p, tree.closest(p).facet});
  return {mesh, samples};
}

/// Every triple of samples whose line of equal distances meets a facet where no other sample is nearer,
/// counterclockwise as seen from the facet's outside. Rounded, for samples in general position.
std::set<Triangle> triangles_by_brute_force(const TriMesh& mesh, const std::vector<Vec3>& p) {
  std::set<Triangle> result;
  const auto n = static_cast<int>(p.size());
  const auto at = [&](int i) -> const Vec3& { return p[static_cast<std::size_t>(i)]; };
  const auto check = [&](FacetId t, int i, int j, int k) {
    // x = q0 + a u + b v with |x - pi|^2 = |x - pj|^2 = |x - pk|^2.
    const Vec3 &q = mesh.corner(t, 0), u = mesh.corner(t, 1) - q, v = mesh.corner(t, 2) - q;
    Eigen::Matrix2d lhs;
    geom::Vec2 rhs;
    for (const auto& [row, other] : {std::pair(0, j), std::pair(1, k)}) {
      const Vec3 d = at(other) - at(i);
      lhs(row, 0) = 2 * d.dot(u), lhs(row, 1) = 2 * d.dot(v);
      rhs(row) = at(other).squaredNorm() - at(i).squaredNorm() - 2 * d.dot(q);
    }
    const geom::Vec2 ab = lhs.inverse() * rhs;
    if (!(ab.x() >= 0 && ab.y() >= 0 && ab.x() + ab.y() <= 1)) return;
    const Vec3 x = q + ab.x() * u + ab.y() * v;
    const double radius2 = (x - at(i)).squaredNorm();
    for (int other = 0; other < n; ++other)
      if (other != i && other != j && other != k && (x - at(other)).squaredNorm() < radius2) return;
    const bool ccw = mesh.normal(t).dot((at(j) - at(i)).cross(at(k) - at(i))) > 0;
    result.insert(canonical(ccw ? Triangle{i, j, k} : Triangle{i, k, j}));
  };
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j)
        for (int k = j + 1; k < n; ++k) check(t, i, j, k);
  return result;
}

std::vector<Vec3> both_ways(const Vec3& a, const Vec3& b, const Vec3& c) { return {a, -a, b, -b, c, -c}; }

}  // namespace

TEST_CASE("extract: six samples on a sphere give an octahedron that looks outwards") {
  const TriMesh sphere = geom::make_shape("sphere", 4);
  const SurfaceDomain domain =
      domain_at(sphere, both_ways(Vec3(.99, .01, .03), Vec3(.02, .98, .01), Vec3(.03, .02, .97)));
  const TriMesh mesh = extract(*domain.diagram(), 6);
  CHECK(mesh.num_facets() == 8);
  CHECK(mesh.num_vertices() == 6);
  for (FacetId t(0); t.index() < 8; t = FacetId(t.value + 1)) {
    const Vec3 middle = mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2);
    CHECK(mesh.normal(t).dot(middle) > 0);
    for (int i = 0; i < 3; ++i)  // no edge joins opposites
      CHECK((mesh.corner(t, i) + mesh.corner(t, (i + 1) % 3)).norm() > 1);
  }
  const geom::Topology topology = geom::topology(mesh);
  CHECK(topology.euler == 2);
  CHECK(topology.misoriented_edges == 0);
}

TEST_CASE("extract: of a cube's eight corners, each face is cut one way or the other, whatever the tie") {
  const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 3);
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  const TriMesh mesh = extract(*domain_at(cube, corners).diagram(), 8);
  CHECK(mesh.num_facets() == 12);
  CHECK(mesh.area() == doctest::Approx(6));
  const geom::Topology topology = geom::topology(mesh);
  CHECK(topology.manifold());
  CHECK(topology.euler == 2);
  CHECK(topology.boundary_edges == 0);
  CHECK(topology.misoriented_edges == 0);
}

TEST_CASE("extract: the triangles are those of brute force, oriented like the surface") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    std::vector<Vec3> positions;
    for (const SurfaceSample& x : random_samples(mesh, 22, 15)) positions.push_back(x.position);
    const SurfaceDomain domain = domain_at(mesh, positions);
    const TriMesh remesh = extract(*domain.diagram(), positions.size());
    CHECK(triangles_of(remesh) == triangles_by_brute_force(mesh, positions));
    CHECK(triangles_of(remesh).size() == remesh.num_facets());
    for (std::size_t i = 0; i < positions.size(); ++i)
      CHECK(remesh.position(geom::VertexId(i)) == positions[i]);
  }
}

TEST_CASE("extract: by the circles the same as by the polygons, after moves and with ties, too") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    SurfaceDomain domain(surface.mesh, random_samples(surface.mesh, 40, 11));
    for (std::size_t i = 0; i < 40; ++i) {
      if (i % 4 == 0) CHECK(extract(domain).facets() == extract(*domain.diagram(), 40).facets());
      domain.move(SiteId(i), Scope::global);
    }
  }
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 3);
  const SurfaceDomain domain = domain_at(cube, corners);
  CHECK(extract(domain).facets() == extract(*domain.diagram(), 8).facets());
  CHECK(extract(domain).vertices() == extract(*domain.diagram(), 8).vertices());
}

TEST_CASE("extract: too few samples have no triangle, and that is said") {
  const TriMesh sphere = geom::make_shape("sphere", 2);
  const SurfaceDomain domain = domain_at(sphere, {Vec3(1, 0, 0), Vec3(-1, 0, 0)});
  CHECK_THROWS_AS(extract(domain), geom::InputError);
  CHECK_THROWS_WITH_AS(extract(*domain.diagram(), 2), "2 samples are too few: their diagram has no triangle",
                       geom::InputError);
}

TEST_CASE("extract: the cells' polygons are sorted, cover the surface and forget their history") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const auto samples = random_samples(mesh, 30, 8);
    SurfaceDomain direct(mesh, samples), moved(mesh, samples);
    for (std::size_t i = 0; i < 30; i += 2) {
      moved.remove(SiteId(i));
      moved.put_back(SiteId(i));
    }
    const std::vector<CellPolygon> cells = cell_polygons(*direct.diagram()),
                                   again = cell_polygons(*moved.diagram());
    REQUIRE(cells.size() == again.size());
    double area = 0;
    bool same = true, sorted = true;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      same &= cells[i].site == again[i].site && cells[i].facet == again[i].facet &&
              cells[i].corners == again[i].corners;
      sorted &= i == 0 ||
                std::pair(cells[i - 1].site, cells[i - 1].facet) < std::pair(cells[i].site, cells[i].facet);
      Vec3 sum(0, 0, 0);
      for (std::size_t k = 2; k < cells[i].corners.size(); ++k)
        sum +=
            (cells[i].corners[k - 1] - cells[i].corners[0]).cross(cells[i].corners[k] - cells[i].corners[0]);
      area += sum.norm() / 2;
      CHECK(sum.dot(mesh.normal(cells[i].facet)) >= 0);  // counterclockwise like the facet
    }
    CHECK(same);
    CHECK(sorted);
    CHECK(area == doctest::Approx(mesh.area()).epsilon(1e-9));
  }
}
