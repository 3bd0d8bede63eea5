#include "fpo/remesh/return_to.h"

#include <memory>
#include <utility>

namespace fpo {

void return_to(const SplitSurface& split, RemeshResult& result) {
  for (SurfaceSample& x : result.samples) x.facet = split.parents[x.facet];
  for (CellPolygon& cell : result.cells) cell.facet = split.parents[cell.facet];
  if (!result.last_resort) return;
  RemeshResult otherwise = *result.last_resort;
  return_to(split, otherwise);
  result.last_resort = std::make_shared<const RemeshResult>(std::move(otherwise));
}

void return_to(const geom::TriMesh& surface, std::shared_ptr<const SplitSurface> cut, RemeshResult& result) {
  return_to(*cut, result);
  const auto with_sizes = [&](RemeshResult& made) {
    made.sizing.resize(surface.num_vertices());
    made.cut = cut;
  };
  with_sizes(result);
  if (!result.last_resort) return;
  RemeshResult otherwise = *result.last_resort;
  with_sizes(otherwise);
  result.last_resort = std::make_shared<const RemeshResult>(std::move(otherwise));
}

}  // namespace fpo
