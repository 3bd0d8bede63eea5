// The restricted power diagram after many moves against one clipped from nothing in rational arithmetic.

#include <algorithm>
#include <array>

#include "doctest.h"
#include "fpo/optimize.h"
#include "fpo/surface/surface_domain.h"
#include "geom/power/restricted_power.h"
#include "geom/shapes/shapes.h"
#include "tests/cgal/exact_points.h"
#include "tests/fixtures/surfaces.h"

namespace {

using cgal::Number;
using geom::EdgeLabel;
using geom::FacetId;
using geom::RestrictedPower;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;

/// Values of an affine function at the corners of a facet; also a point by its barycentric coordinates.
using Triple = std::array<Number, 3>;

Number value(const Triple& f, const Triple& at) { return f[0] * at[0] + f[1] * at[1] + f[2] * at[2]; }

Triple powers(const TriMesh& mesh, FacetId t, const geom::WeightedPoint3& p, const Number& epsilon) {
  Triple f;
  for (int i = 0; i < 3; ++i) {
    Number sum = -Number(p.weight) - epsilon;
    for (int k = 0; k < 3; ++k) {
      const Number d = Number(mesh.corner(t, i)[k]) - Number(p.position[k]);
      sum += d * d;
    }
    f[static_cast<std::size_t>(i)] = sum;
  }
  return f;
}

struct Corner {
  Triple at;
  EdgeLabel edge;  ///< that starts here
};

/// Keeps what is on the positive side of f; the new edge gets a label.
std::vector<Corner> clipped(const std::vector<Corner>& polygon, const Triple& f, EdgeLabel label) {
  std::vector<Corner> result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Corner &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const Number fa = value(f, a.at), fb = value(f, b.at);
    if (fa > 0) result.push_back(a);
    if ((fa > 0) == (fb > 0)) continue;
    const Number share = fa / (fa - fb);
    Corner middle;
    for (std::size_t i = 0; i < 3; ++i) middle.at[i] = a.at[i] + share * (b.at[i] - a.at[i]);
    middle.edge = fa > 0 ? label : a.edge;
    result.push_back(middle);
  }
  return result;
}

std::vector<RestrictedPower::Canonical> by_rationals(const fpo::SurfaceDomain& domain) {
  const TriMesh& mesh = domain.mesh();
  std::vector<Number> epsilons;
  for (std::size_t i = 0; i < domain.num_samples(); ++i)
    epsilons.push_back(cgal::epsilon(static_cast<std::int32_t>(i)));
  std::vector<RestrictedPower::Canonical> all;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    std::vector<Triple> power;
    for (std::size_t i = 0; i < domain.num_samples(); ++i)
      power.push_back(powers(mesh, t, domain.dual().site(SiteId(i)), epsilons[i]));
    for (std::size_t i = 0; i < power.size(); ++i) {
      std::vector<Corner> polygon = {{{1, 0, 0}, EdgeLabel::facet_edge(0)},
                                     {{0, 1, 0}, EdgeLabel::facet_edge(1)},
                                     {{0, 0, 1}, EdgeLabel::facet_edge(2)}};
      for (std::size_t j = 0; j < power.size() && !polygon.empty(); ++j) {
        if (j == i) continue;
        const Triple less = {power[j][0] - power[i][0], power[j][1] - power[i][1], power[j][2] - power[i][2]};
        polygon = clipped(polygon, less, EdgeLabel::bisector(SiteId(j)));
      }
      if (polygon.empty()) continue;
      RestrictedPower::Canonical fragment{t, SiteId(i), {}};
      for (const Corner& corner : polygon) fragment.labels.push_back(corner.edge);
      std::ranges::rotate(fragment.labels, std::ranges::min_element(fragment.labels));
      all.push_back(std::move(fragment));
    }
  }
  std::ranges::sort(all);
  return all;
}

/// All coordinates multiples of the unit of exact_points.h.
TriMesh rounded(const TriMesh& mesh) {
  geom::Table<geom::VertexId, Vec3> vertices;
  for (Vec3 v : mesh.vertices()) {
    for (double& c : v) c = cgal::rounded(c);
    vertices.push_back(v);
  }
  geom::Table<FacetId, TriMesh::Facet> facets;
  for (const TriMesh::Facet& f : mesh.facets()) facets.push_back(f);
  return TriMesh(std::move(vertices), std::move(facets));
}

/// Farthest point optimization, then samples at mesh vertices and middles of edges, where much ties.
void check(const TriMesh& mesh, const fpo::Sizing& sizing, fpo::Engine engine) {
  fpo::SurfaceOptions surface;
  surface.engine = engine;
  fpo::SurfaceDomain domain(mesh, sizing, fpo::random_samples(mesh, sizing, 40, 1), surface);
  fpo::OptimizeOptions options;
  options.max_iterations = 5;
  fpo::optimize(domain, options);
  CHECK(domain.diagram()->canonical() == by_rationals(domain));
  geom::Rng rng(7);
  for (int move = 0; move < 300; ++move) {
    const SiteId x(static_cast<std::size_t>(rng.below(40)));
    const FacetId t(static_cast<std::size_t>(rng.below(mesh.num_facets())));
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, static_cast<int>(rng.below(2)));
    Vec3 place = (a + b) / 2;
    for (double& c : place) c = cgal::rounded(c);
    domain.remove(x);
    domain.insert_at(x, {place, t}, 1);
  }
  CHECK(domain.diagram()->canonical() == by_rationals(domain));
}

}  // namespace

TEST_CASE("CGAL's numbers: the restricted power diagram is that of exact clipping") {
  for (const fpo::Engine engine : {fpo::Engine::search, fpo::Engine::triangulation}) {
    for (const TriMesh& mesh : {rounded(fixtures::blob(2)), fixtures::box(Vec3(1, 1, 1), 2)}) {
      check(mesh, fpo::Sizing::uniform(fpo::hexagonal_spacing(mesh.area(), 40)), engine);
      fpo::VertexField rho;
      for (const Vec3& p : mesh.vertices()) rho.push_back(1.5 + p.z());
      check(mesh, fpo::fit_sizing(mesh, rho, 40), engine);
    }
  }
}
