#include "fpo/baselines/cell_moments.h"

#include "doctest.h"
#include "fpo/remesh/extract.h"
#include "fpo/surface/initial_samples.h"
#include "geom/power/restricted_power.h"
#include "geom/sites/site_tree.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;

namespace {

/// Of a triangle with density 1, by the formulas for its mass, centroid and moment of inertia.
CellMoments of_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const double area = (b - a).cross(c - a).norm() / 2;
  const Vec3 centroid = (a + b + c) / 3;
  const double inertia = area / 36 * ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
  return {area, area * (centroid - p), inertia + area * (centroid - p).squaredNorm()};
}

/// From the polygons of the diagram.
geom::Table<SiteId, CellMoments> by_polygons(const TriMesh& mesh, const std::vector<SurfaceSample>& samples) {
  geom::SiteTree tree;
  std::vector<geom::WeightedPoint3> points;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    points.push_back({samples[i].position, 0});
    tree.insert(SiteId(i), points.back());
  }
  const geom::RestrictedPower diagram(mesh, points, tree);
  geom::Table<SiteId, CellMoments> result(samples.size());
  for (const CellPolygon& cell : cell_polygons(diagram))
    for (std::size_t k = 1; k + 1 < cell.corners.size(); ++k)
      result[cell.site] += of_triangle(cell.corners[0], cell.corners[k], cell.corners[k + 1],
                                       samples[cell.site.index()].position);
  return result;
}

double energy(VoronoiMoments& moments, const std::vector<SurfaceSample>& samples) {
  double sum = 0;
  for (const CellMoments& cell : moments.of(samples)) sum += cell.second;
  return sum;
}

}  // namespace

TEST_CASE("cell moments: those of the diagram, few samples or many, twins too") {
  for (const auto& surface : fixtures::surfaces())
    for (const std::size_t n : {1, 2, 30, 400}) {
      CAPTURE(surface.name);
      CAPTURE(n);
      std::vector<SurfaceSample> samples = random_samples(surface.mesh, n, 5);
      if (n == 30) samples[7] = samples[3];
      const Sizing sizing = fixtures::even(surface.mesh, n);
      VoronoiMoments moments(surface.mesh, sizing, 1, 2);
      const auto expected = by_polygons(surface.mesh, samples);
      const auto& found = moments.of(samples);
      REQUIRE(found.size() == n);
      for (std::size_t i = 0; i < n; ++i) {
        const CellMoments &a = found[SiteId(i)], &b = expected[SiteId(i)];
        CHECK(a.mass == doctest::Approx(b.mass).epsilon(1e-9).scale(surface.mesh.area()));
        CHECK((a.first - b.first).norm() <= 1e-11);
        CHECK(a.second == doctest::Approx(b.second).epsilon(1e-9).scale(surface.mesh.area()));
      }
    }
}

TEST_CASE("cell moments: a wrong idea of the spacing costs time only; threads do not matter") {
  const TriMesh mesh = fixtures::blob(6);
  const auto samples = random_samples(mesh, 300, 2);
  const Sizing right = fixtures::even(mesh, 300), small = Sizing::uniform(1e-3), large = Sizing::uniform(10);
  VoronoiMoments reference(mesh, right, 1, 1);
  const auto expected = reference.of(samples);
  for (const Sizing* sizing : {&right, &small, &large})
    for (const int threads : {1, 2, 5}) {
      VoronoiMoments moments(mesh, *sizing, 1, threads);
      const auto& found = moments.of(samples);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        CHECK(found[SiteId(i)].mass == expected[SiteId(i)].mass);
        CHECK(found[SiteId(i)].first == expected[SiteId(i)].first);
      }
    }
}

TEST_CASE("cell moments: the energy's derivative is -2 times the first moment, with any density") {
  const TriMesh mesh = fixtures::blob(6);
  const Sizing even = fixtures::even(mesh, 150),
               varying = fixtures::graded(mesh, 0.1 / mesh.diagonal(), 0.2 / mesh.diagonal());
  for (const Sizing* sizing : {&even, &varying}) {
    VoronoiMoments moments(mesh, *sizing, 0.2, 2);
    std::vector<SurfaceSample> samples = random_samples(mesh, *sizing, 150, 8);
    const auto at = moments.of(samples);
    double scale = 0, error = 0;
    for (std::size_t i = 0; i < 15; ++i) {
      const Vec3 gradient = -2 * at[SiteId(i)].first;
      for (int axis = 0; axis < 3; ++axis) {
        constexpr double step = 1e-5;
        const SurfaceSample kept = samples[i];
        samples[i].position[axis] += step;
        const double after = energy(moments, samples);
        samples[i].position[axis] -= 2 * step;
        const double before = energy(moments, samples);
        samples[i] = kept;
        scale = std::max(scale, gradient.norm());
        error = std::max(error, std::abs((after - before) / (2 * step) - gradient[axis]));
      }
    }
    CHECK(error < (sizing->is_uniform() ? 1e-5 : 0.05) * scale);  // quadrature depends on the fragments
  }
}
