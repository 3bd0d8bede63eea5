// The whole restricted power diagram at once: facets are divided each by itself (facet_cells.h), by several
// threads, and their fragments entered one after the other, both along a space-filling curve: what is near in space
// is found and stored together.

#include <algorithm>
#include <atomic>

#include "geom/check.h"
#include "geom/facet_cells.h"
#include "geom/parallel.h"
#include "geom/restricted_power.h"

namespace geom {
namespace {

constexpr std::size_t in_batch = 128;      // facets and cells, about, that a thread divides at a time
constexpr std::size_t patience = 1 << 14;  // and that all divide before their fragments are entered

/// The fragments of a few facets.
struct Batch {
  struct Piece {
    FacetId facet;
    SiteId owner;
    std::size_t end;  ///< of its corners
  };
  std::vector<Piece> pieces;
  std::vector<PolygonCorner> corners;

  void add(const FacetPolygon& polygon) {
    corners.insert(corners.end(), polygon.corners.begin(), polygon.corners.end());
    pieces.push_back({polygon.facet, polygon.owner, corners.size()});
  }
};

/// Divides the facets, each batch of so many on one thread.
void divide(std::span<const FacetId> facets, std::size_t facets_in_batch, std::vector<FacetCells>& lanes,
            std::vector<Batch>& batches) {
  batches.resize((facets.size() + facets_in_batch - 1) / facets_in_batch);
  std::atomic<std::size_t> next{0};
  parallel_ranges(lanes.size(), 1, static_cast<int>(lanes.size()), [&](std::size_t lane, std::size_t) {
    for (std::size_t b; (b = next.fetch_add(1)) < batches.size();) {
      batches[b].pieces.clear();
      batches[b].corners.clear();
      const std::size_t begin = b * facets_in_batch, end = std::min(begin + facets_in_batch, facets.size());
      for (const FacetId t : facets.subspan(begin, end - begin))
        for (const FacetPolygon& polygon : lanes[lane].divide(t)) batches[b].add(polygon);
    }
  });
}

}  // namespace

const RestrictedPower::Change& RestrictedPower::build(std::span<const WeightedPoint3> points,
                                                      const NeighbourSource& search, int threads) {
  ensure(sites_.empty() && !points.empty(), "restricted power diagram: built once, of some sites");
  begin(SiteId(points.size() - 1));
  sites_.reserve(points.size());
  for (const WeightedPoint3& point : points) admit(sites_.next_id(), point);
  std::vector<FacetCells> lanes(static_cast<std::size_t>(std::max(threads, 1)),
                                FacetCells(mesh_, sites_, clipper_, search));
  std::vector<Batch> batches;
  const std::vector<FacetId> order = facets_along_curve(mesh_);
  const auto facets_of = [&](std::size_t facets_and_cells) {
    return std::max<std::size_t>(1, facets_and_cells * order.size() / (order.size() + points.size()));
  };
  const std::size_t at_once = facets_of(patience);
  for (std::size_t first = 0; first < order.size(); first += at_once) {
    divide(std::span(order).subspan(first, std::min(at_once, order.size() - first)), facets_of(in_batch),
           lanes, batches);
    for (const Batch& batch : batches) {
      std::size_t begin = 0;
      for (const Batch::Piece& piece : batch.pieces) {
        polygon_.facet = piece.facet;
        polygon_.owner = piece.owner;
        polygon_.corners.assign(batch.corners.data() + begin, batch.corners.data() + piece.end);
        begin = piece.end;
        touch_cell(piece.owner);
        reach_[piece.owner] = std::max(reach_[piece.owner], commit(FragmentId(), polygon_));
      }
    }
  }
  std::vector<Change::Piece>().swap(change_.created);
  finish();
  return change_;
}

}  // namespace geom
