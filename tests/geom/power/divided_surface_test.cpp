#include "geom/power/divided_surface.h"

#include <algorithm>
#include <thread>
#include <vector>

#include "doctest.h"
#include "geom/power/restricted_power.h"
#include "geom/rng.h"
#include "geom/sites/site_tree.h"
#include "tests/fixtures/placed_samples.h"
#include "tests/fixtures/surfaces.h"
#include "tests/oracle/restricted_power_oracle.h"

using namespace geom;
using fixtures::Weights;

namespace {

struct Piece {
  FacetId facet;
  SiteId owner;
  std::vector<PolygonCorner> corners;
};

/// In the order in which they are told.
std::vector<Piece> divided(const TriMesh& mesh, const std::vector<WeightedPoint3>& points,
                           std::span<const FacetId> facets, int threads) {
  const Clipper::Sites sites(points.begin(), points.end());
  const Clipper clipper(mesh, sites, extent_of(mesh));
  SiteTree tree;
  for (std::size_t i = 0; i < points.size(); ++i) tree.insert(SiteId(i), points[i]);
  const DividedSurface surface{mesh, sites, clipper, tree};
  std::vector<Piece> result;
  std::vector<FacetId> visited;
  const std::thread::id caller = std::this_thread::get_id();
  bool on_caller = true;
  surface.for_each(facets, threads, [&](FacetId t, std::span<const FacetPiece> pieces) {
    on_caller &= std::this_thread::get_id() == caller;
    visited.push_back(t);
    for (const auto& [owner, corners] : pieces)
      result.push_back({t, owner, {corners.begin(), corners.end()}});
  });
  CHECK(on_caller);
  CHECK(std::ranges::equal(visited, facets));
  return result;
}

bool same(const std::vector<Piece>& a, const std::vector<Piece>& b) {
  const auto same_corner = [](const PolygonCorner& c, const PolygonCorner& d) {
    return c.point.position == d.point.position && c.point.tolerance == d.point.tolerance && c.edge == d.edge;
  };
  return std::ranges::equal(a, b, [&](const Piece& p, const Piece& q) {
    return p.facet == q.facet && p.owner == q.owner && std::ranges::equal(p.corners, q.corners, same_corner);
  });
}

/// Each piece is told from its edge of smallest label on.
std::vector<RestrictedPower::Canonical> divided_surface_canonical(const std::vector<Piece>& pieces) {
  std::vector<RestrictedPower::Canonical> all;
  for (const Piece& piece : pieces) {
    RestrictedPower::Canonical fragment{piece.facet, piece.owner, {}};
    for (const PolygonCorner& corner : piece.corners) fragment.labels.push_back(corner.edge);
    all.push_back(std::move(fragment));
  }
  std::ranges::sort(all);
  return all;
}

std::vector<SiteId> first_ids(std::size_t n) {
  std::vector<SiteId> ids;
  for (std::size_t i = 0; i < n; ++i) ids.emplace_back(i);
  return ids;
}

}  // namespace

TEST_CASE("divided surface: equals brute force, and any number of threads gives the same to the bit") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights kind : fixtures::all_weights)
      for (const std::size_t n : {1u, 3u, 60u}) {
        CAPTURE(surface.name);
        CAPTURE(static_cast<int>(kind));
        CAPTURE(n);
        const std::vector<WeightedPoint3> points =
            points_of(fixtures::placed_samples(surface.mesh, n, n, kind, 9));
        const std::vector<FacetId> facets = facets_along_curve(surface.mesh);
        const std::vector<Piece> pieces = divided(surface.mesh, points, facets, 1);
        const Clipper::Sites sites(points.begin(), points.end());
        CHECK(divided_surface_canonical(pieces) ==
              oracle::restricted_power_diagram(surface.mesh, sites, first_ids(n)));
        for (const int threads : {2, 5}) CHECK(same(pieces, divided(surface.mesh, points, facets, threads)));
      }
}

// More facets and cells than are divided before the first is told.
TEST_CASE("divided surface: many facets, many cells, many threads") {
  for (const auto& [k, n] :
       {std::pair(45, std::size_t{300}), {4, std::size_t{20000}}, {30, std::size_t{12000}}}) {
    const TriMesh blob = fixtures::blob(k);
    const std::vector<WeightedPoint3> points =
        points_of(fixtures::placed_samples(blob, n, n, Weights::gentle, 2));
    const std::vector<FacetId> facets = facets_along_curve(blob);
    const std::vector<Piece> pieces = divided(blob, points, facets, 1);
    CHECK(pieces.size() >= facets.size());
    for (const int threads : {2, 8}) CHECK(same(pieces, divided(blob, points, facets, threads)));
  }
}

TEST_CASE("divided surface: some facets, in any order") {
  const TriMesh blob = fixtures::blob(6);
  const std::vector<WeightedPoint3> points =
      points_of(fixtures::placed_samples(blob, 50, 50, Weights::hiding, 4));
  Rng rng(6);
  std::vector<FacetId> facets = facets_along_curve(blob);
  rng.shuffle(std::span(facets));
  facets.resize(facets.size() / 3);
  const std::vector<Piece> pieces = divided(blob, points, facets, 2);
  std::vector<RestrictedPower::Canonical> expected =
      oracle::restricted_power_diagram(blob, Clipper::Sites(points.begin(), points.end()), first_ids(50));
  std::erase_if(expected, [&](const auto& f) { return std::ranges::find(facets, f.facet) == facets.end(); });
  CHECK(divided_surface_canonical(pieces) == expected);
  CHECK(divided(blob, points, {}, 2).empty());
}
