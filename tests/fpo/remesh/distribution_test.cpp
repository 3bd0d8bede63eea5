#include "fpo/remesh/distribution.h"

#include <utility>
#include <vector>

#include "doctest.h"
#include "fpo/remesh/remesh_defaults.h"
#include "tests/fixtures/surfaces.h"
#include "tests/oracle/restricted_dual_oracle.h"

using namespace fpo;

namespace {

/// Lengths that differ, if they do, from 1 to 1.5.
Sizing sizing_on(const geom::TriMesh& mesh, std::size_t n, bool is_even) {
  const double spacing = hexagonal_spacing(mesh.area(), n);
  if (is_even) return Sizing::uniform(spacing);
  VertexField h;
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v)
    h.push_back(spacing * (1 + 0.5 * static_cast<double>(v) / static_cast<double>(mesh.num_vertices())));
  return Sizing(mesh, h);
}

std::vector<SiteId> all_of(const SurfaceDomain& domain) {
  std::vector<SiteId> sites;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) sites.emplace_back(i);
  return sites;
}

}  // namespace

TEST_CASE("distribution: the same samples once more are those that the optimization would lead to again") {
  const geom::TriMesh blob = fixtures::blob(10);
  constexpr std::size_t n = 120;
  for (const bool is_even : {true, false})
    for (const std::size_t tile_samples : {std::size_t{0}, std::size_t{40}}) {
      CAPTURE(is_even);
      CAPTURE(tile_samples);
      RemeshOptions options = default_options(n, SizingKind::uniform);
      options.optimize.max_iterations = 6;
      options.shortest_edge_removal = true;
      options.tile_samples = tile_samples;
      std::vector<IterationReport> told;
      options.optimize.on_iteration = [&](const IterationReport& report) { told.push_back(report); };
      const SharedSizing shared{sizing_on(blob, n, is_even), {}};
      RemeshResult first, again, same;
      const SurfaceDomain a = distributed_samples(blob, shared, nullptr, options, first);
      const std::vector<IterationReport> told_first = std::exchange(told, {});
      CHECK(told_first.size() > 1);
      for (std::size_t i = 0; i < n; ++i) first.samples.push_back(a.sample(SiteId(i)));
      const SurfaceDomain b = distributed_samples(blob, shared, nullptr, options, again);
      told.clear();
      const SurfaceDomain c = same_samples(blob, shared, first, options, same);
      CHECK(oracle::circles_of(b.dual(), all_of(b)) == oracle::circles_of(c.dual(), all_of(c)));
      for (std::size_t i = 0; i < n; ++i) {
        CHECK(c.sample(SiteId(i)).position == b.sample(SiteId(i)).position);
        CHECK(c.sample(SiteId(i)).facet == b.sample(SiteId(i)).facet);
        CHECK(c.samples().weight(SiteId(i)) == b.samples().weight(SiteId(i)));
      }
      REQUIRE(told.size() == told_first.size());
      for (std::size_t i = 0; i < told.size(); ++i) CHECK(told[i].delta == told_first[i].delta);
      CHECK(same.optimization.moves == again.optimization.moves);
      CHECK(same.optimization.last.delta == again.optimization.last.delta);
      CHECK(same.shortest_edges.moves == again.shortest_edges.moves);
    }
}
