#include "geom/power/divided_surface.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "geom/parallel.h"

namespace geom {
namespace {

constexpr std::size_t in_batch = 128;      // facets and cells, about, that a thread divides at a time
constexpr std::size_t patience = 1 << 14;  // and that all divide before their pieces are looked at

/// The pieces of a few facets.
struct Batch {
  struct Piece {
    SiteId owner;
    std::size_t begin, end;  ///< of its corners
  };
  std::vector<std::size_t> pieces_up_to;  ///< of each facet
  std::vector<Piece> pieces;
  std::vector<PolygonCorner> corners;

  void clear() {
    pieces_up_to.clear();
    pieces.clear();
    corners.clear();
  }
  void add(std::span<const FacetPolygon> polygons) {
    for (const FacetPolygon& polygon : polygons) {
      const std::size_t begin = corners.size();
      corners.insert(corners.end(), polygon.corners.begin(), polygon.corners.end());
      pieces.push_back({polygon.owner, begin, corners.size()});
    }
    pieces_up_to.push_back(pieces.size());
  }
};

/// Divides the facets, each batch of so many on one thread.
void divide(std::span<const FacetId> facets, std::size_t facets_in_batch, std::vector<FacetCells>& lanes,
            std::vector<Batch>& batches) {
  batches.resize((facets.size() + facets_in_batch - 1) / facets_in_batch);
  std::atomic<std::size_t> next{0};
  parallel_ranges(lanes.size(), 1, static_cast<int>(lanes.size()), [&](std::size_t lane, std::size_t) {
    for (std::size_t b; (b = next.fetch_add(1)) < batches.size();) {
      batches[b].clear();
      const std::size_t begin = b * facets_in_batch, end = std::min(begin + facets_in_batch, facets.size());
      for (const FacetId t : facets.subspan(begin, end - begin)) batches[b].add(lanes[lane].divide(t));
    }
  });
}

}  // namespace

void DividedSurface::for_each(std::span<const FacetId> facets, int threads, const Visit& visit) const {
  std::vector<FacetCells> lanes(static_cast<std::size_t>(std::max(threads, 1)),
                                FacetCells(mesh, sites, clipper, search));
  std::vector<Batch> batches;
  std::vector<FacetPiece> pieces;
  const auto facets_of = [&](std::size_t facets_and_cells) {
    return std::max<std::size_t>(1, facets_and_cells * facets.size() / (facets.size() + sites.size()));
  };
  const std::size_t at_once = facets_of(patience);
  for (std::size_t first = 0; first < facets.size(); first += at_once) {
    divide(facets.subspan(first, std::min(at_once, facets.size() - first)), facets_of(in_batch), lanes,
           batches);
    std::size_t at = first;
    for (const Batch& batch : batches) {
      std::size_t i = 0;
      for (const std::size_t up_to : batch.pieces_up_to) {
        pieces.clear();
        for (; i < up_to; ++i) {
          const auto& [owner, begin, end] = batch.pieces[i];
          pieces.push_back({owner, std::span(batch.corners).subspan(begin, end - begin)});
        }
        visit(facets[at++], pieces);
      }
    }
  }
}

}  // namespace geom
