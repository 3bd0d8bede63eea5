#include "fpo/remesh/farthest_vertices.h"

#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>

#include "fpo/interruption.h"
#include "geom/indexed_heap.h"

namespace fpo {

using geom::SiteId;
using geom::VertexId;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class FarthestVertices {
 public:
  FarthestVertices(SampledSurface& surface, const geom::Table<VertexId, double>& wanted, std::size_t first)
      : surface_(surface), wanted_(wanted), first_(first) {
    const std::size_t n = surface.mesh.num_vertices();
    of_.resize(n);
    distance_.assign(n, infinity);
    for (VertexId v(0); v.index() < n; v = VertexId(v.value + 1)) {
      ways_begin_.push_back(ways_.size());
      for (const VertexId w : surface.mesh.neighbours(v))
        ways_.push_back({w, (surface.mesh.position(w) - surface.mesh.position(v)).norm()});
      if (!surface.mesh.facets_at(v).empty() && !surface.curves.are_at(v)) heap_.push(v, infinity);
    }
    ways_begin_.push_back(ways_.size());
    for (SiteId x(0); x.index() < surface.vertex_of.size(); x = SiteId(x.value + 1))
      reach(surface.vertex_of[x], x, 0);
    spread();
  }

  /// Whether any sample moved.
  bool iterate(const std::atomic<bool>* interrupted) {
    bool moved = false;
    if (heap_.empty()) return moved;
    for (SiteId x(first_); x.index() < surface_.vertex_of.size() && !fpo::interrupted(interrupted);
         x = SiteId(x.value + 1))
      moved |= move(x);
    return moved;
  }

 private:
  bool move(SiteId x) {
    const VertexId from = surface_.vertex_of[x];
    remove(x);
    const VertexId to = heap_.top().key > 0 ? heap_.top().slot : from;
    surface_.vertex_of[x] = to;
    reach(to, x, 0);
    spread();
    return to != from;
  }

  /// Its cell is divided among those around.
  void remove(SiteId x) {
    cell_.assign(1, surface_.vertex_of[x]);
    set(cell_.front(), {}, infinity);
    for (std::size_t i = 0; i < cell_.size(); ++i)
      for (const Way& way : ways(cell_[i])) {
        if (of_[way.to] != x) continue;
        set(way.to, {}, infinity);
        cell_.push_back(way.to);
      }
    for (const VertexId v : cell_)
      for (const Way& way : ways(v))
        if (of_[way.to].valid()) reach(v, of_[way.to], distance_[way.to] + way.length);
    spread();
  }

  struct Way {
    VertexId to;
    double length;
  };
  std::span<const Way> ways(VertexId v) const {
    return std::span(ways_).subspan(ways_begin_[v], ways_begin_[VertexId(v.value + 1)] - ways_begin_[v]);
  }

  void set(VertexId v, SiteId x, double distance) {
    of_[v] = x;
    distance_[v] = distance;
    if (heap_.contains(v)) heap_.update(v, distance / wanted_[v]);
  }

  /// The sites of equal distance are not told apart: the first that comes stays.
  void reach(VertexId v, SiteId x, double distance) {
    if (!(distance < distance_[v])) return;
    set(v, x, distance);
    queue_.emplace(distance, v);
  }

  void spread() {
    while (!queue_.empty()) {
      const auto [distance, v] = queue_.top();
      queue_.pop();
      if (distance > distance_[v]) continue;
      for (const Way& way : ways(v)) reach(way.to, of_[v], distance + way.length);
    }
  }

  using Reached = std::pair<double, VertexId>;
  SampledSurface& surface_;
  const geom::Table<VertexId, double>& wanted_;
  std::size_t first_;
  std::vector<Way> ways_;
  geom::Table<VertexId, std::size_t> ways_begin_;
  geom::Table<VertexId, SiteId> of_;  ///< the sample whose cell it is in
  geom::Table<VertexId, double> distance_;
  geom::IndexedHeap<VertexId, std::less<>> heap_;  ///< of where samples may go
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue_;
  std::vector<VertexId> cell_;
};

}  // namespace

std::vector<SiteId> move_to_farthest_vertices(SampledSurface& surface,
                                              const geom::Table<VertexId, double>& wanted,
                                              const FarthestVerticesOptions& options) {
  const geom::Table<SiteId, VertexId> before = surface.vertex_of;
  FarthestVertices farthest(surface, wanted, options.first);
  for (int i = 0; i < options.iterations && farthest.iterate(options.interrupted); ++i) {
  }
  std::vector<SiteId> moved;
  for (SiteId x(0); x.index() < before.size(); x = SiteId(x.value + 1))
    if (surface.vertex_of[x] != before[x]) moved.push_back(x);
  return moved;
}

}  // namespace fpo
