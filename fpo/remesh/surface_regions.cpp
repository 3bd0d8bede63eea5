#include "fpo/remesh/surface_regions.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace fpo {

using geom::SiteId;
using geom::VertexId;

namespace {

constexpr double gradation = 0.5;

class Regions {
 public:
  explicit Regions(const SampledSurface& surface) : surface_(surface) {
    const std::size_t n = surface.mesh.num_vertices();
    found_.of.resize(n);
    found_.next.resize(n);
    found_.distance.assign(n, std::numeric_limits<double>::infinity());
  }

  SurfaceRegions run() {
    for (SiteId x(0); x.index() < surface_.vertex_of.size(); x = SiteId(x.value + 1)) {
      const VertexId v = surface_.vertex_of[x];
      found_.of[v] = x;
      found_.distance[v] = 0;
      queue_.emplace(0, v);
    }
    const auto sources = queue_;
    spread([&](VertexId v) { return surface_.curves.beside(v); });
    queue_ = sources;
    const geom::Table<VertexId, SiteId> on_curves = found_.of;
    for (VertexId v(0); v.index() < on_curves.size(); v = VertexId(v.value + 1))
      if (on_curves[v].valid()) queue_.emplace(found_.distance[v], v);
    spread([&](VertexId v) {
      std::vector<VertexId> others = surface_.mesh.neighbours(v);
      std::erase_if(others, [&](VertexId w) { return on_curves[w].valid(); });
      return others;
    });
    return std::move(found_);
  }

 private:
  template <class Beside>
  void spread(Beside beside) {
    while (!queue_.empty()) {
      const auto [distance, v] = queue_.top();
      queue_.pop();
      if (distance > found_.distance[v]) continue;
      for (const VertexId w : beside(v)) {
        const double there = distance + (surface_.mesh.position(w) - surface_.mesh.position(v)).norm();
        if (!(there < found_.distance[w])) continue;
        found_.distance[w] = there;
        found_.of[w] = found_.of[v];
        found_.next[w] = v;
        queue_.emplace(there, w);
      }
    }
  }

  using Reached = std::pair<double, VertexId>;
  const SampledSurface& surface_;
  SurfaceRegions found_;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue_;
};

}  // namespace

SurfaceRegions surface_regions(const SampledSurface& surface) { return Regions(surface).run(); }

geom::Table<VertexId, double> graded_lengths(const SampledSurface& surface, std::span<const double> wanted) {
  geom::Table<VertexId, double> h;
  using Length = std::pair<double, VertexId>;
  std::priority_queue<Length, std::vector<Length>, std::greater<>> queue;
  for (const SiteId x : surface_regions(surface).of) {
    if (x.valid()) queue.emplace(wanted[x.index()], h.next_id());
    h.push_back(x.valid() ? wanted[x.index()] : std::numeric_limits<double>::infinity());
  }
  while (!queue.empty()) {
    const auto [length, v] = queue.top();
    queue.pop();
    if (length > h[v]) continue;
    for (const VertexId w : surface.mesh.neighbours(v)) {
      const double there = length + gradation * (surface.mesh.position(w) - surface.mesh.position(v)).norm();
      if (there < h[w]) queue.emplace(h[w] = there, w);
    }
  }
  const double greatest = std::ranges::max(wanted);
  for (double& length : h) length = std::min(length, greatest);
  return h;
}

void split_long_edges(SampledSurface& surface, std::span<const double> wanted, double most,
                      std::size_t most_vertices) {
  geom::Table<VertexId, double> h = graded_lengths(surface, wanted);
  const EditedMesh& mesh = surface.mesh;
  using Long = std::pair<double, std::pair<VertexId, VertexId>>;
  std::priority_queue<Long> edges;
  const auto look_at = [&](VertexId a, VertexId b) {
    const double ratio = (mesh.position(b) - mesh.position(a)).norm() / std::min(h[a], h[b]);
    if (ratio > most) edges.emplace(ratio, std::minmax(a, b));
  };
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
    for (const VertexId w : mesh.neighbours(v))
      if (v < w) look_at(v, w);
  while (!edges.empty() && mesh.num_vertices() < most_vertices) {
    const auto [a, b] = edges.top().second;
    edges.pop();
    if (!mesh.has_edge(a, b)) continue;
    const VertexId v = split_edge(surface, a, b, (mesh.position(a) + mesh.position(b)) / 2);
    h.push_back((h[a] + h[b]) / 2);
    for (const VertexId w : mesh.neighbours(v)) look_at(v, w);
  }
}

}  // namespace fpo
