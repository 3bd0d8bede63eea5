#include "fpo/remesh/collapsed_mesh.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "fpo/interruption.h"
#include "fpo/measure/triangle_angles.h"
#include "fpo/remesh/better_flips.h"
#include "fpo/remesh/facet_region.h"
#include "fpo/remesh/farthest_vertices.h"
#include "fpo/remesh/surface_regions.h"

namespace fpo {

using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

/// What a collapse may do to facets.
struct Bounds {
  double turned;  ///< the least cosine between normals before and after
  double angle;   ///< the least, in degrees, unless one was smaller before
};

constexpr std::array<Bounds, 4> bounds = {
    {{0.8, 5}, {0.5, 1}, {0, 0.01}, {-2, 0.01}}};  // one after the other

constexpr double fine = 0.25;              // edges, in wanted lengths, for regions to have their shape
constexpr std::size_t most_refined = 100;  // vertices for a sample

constexpr Bounds any = {-2, 0};
constexpr std::size_t most_looks = 4'000'000;  // at samples, for those that give way

class Collapses {
 public:
  Collapses(SampledSurface from, const std::atomic<bool>* interrupted)
      : regions_(surface_regions(from)),
        mesh_(std::move(from.mesh)),
        curves_(std::move(from.curves)),
        vertex_of_(std::move(from.vertex_of)),
        interrupted_(interrupted),
        facet_at_(mesh_.num_vertices()) {
    geom::Table<VertexId, char> is_sample(mesh_.num_vertices(), 0);
    for (const VertexId v : vertex_of_) is_sample[v] = 1;
    for (VertexId v(0); v.index() < mesh_.num_vertices(); v = VertexId(v.value + 1)) {
      if (mesh_.facets_at(v).empty()) continue;
      facet_at_[v] = from.parents[mesh_.facets_at(v).front()];
      if (!is_sample[v]) left_.push_back(v);
    }
    std::ranges::stable_sort(left_, std::greater<>(), [&](VertexId v) { return regions_.distance[v]; });
  }

  /// Of all vertices that are no samples, as far as they can go: first to the sample of their region, the
  /// farthest ones first, so that the remesh becomes the dual of the regions where these are disks.
  void run() {
    as_long_as_any_goes([&](VertexId v) { return withdraw(v); });
    for (const Bounds& allowed : bounds)
      as_long_as_any_goes([&](VertexId v) { return collapse(v, allowed); });
    flip_edges();
  }

  /// Of those that are left, even if facets without area come of it.
  void run_to_the_end() {
    as_long_as_any_goes([&](VertexId v) { return collapse(v, any); });
    flip_edges();
  }

  /// Vertices that are left become samples instead of others, from the first one that may.
  void exchange(std::size_t first, std::span<const double> wanted,
                std::vector<CollapsedMesh::Exchange>& done) {
    if (left_.size() * vertex_of_.size() > most_looks) return;  // nothing that exchanges would mend
    for (; !left_.empty() && !interrupted(interrupted_); left_.pop_back()) {
      SiteId x;
      for (const Bounds& allowed : bounds)
        if (x = most_crowded(first, wanted, allowed); x.valid()) break;
      if (!x.valid()) return;
      const VertexId gone = vertex_of_[x], v = left_.back();
      vertex_of_[x] = v;
      for (const Bounds& allowed : bounds)
        if (collapse(gone, allowed)) break;
      done.push_back({x, {mesh_.position(v), facet_at_[v]}});
    }
  }

  bool is_done() const { return left_.empty() && !interrupted(interrupted_); }

  TriMesh mesh() const {
    geom::Table<VertexId, VertexId> name(mesh_.num_vertices());
    geom::Table<VertexId, Vec3> positions;
    for (const VertexId v : vertex_of_) {
      name[v] = positions.next_id();
      positions.push_back(mesh_.position(v));
    }
    geom::Table<FacetId, TriMesh::Facet> facets;
    for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1)) {
      if (!mesh_.has_facet(t)) continue;
      TriMesh::Facet f = mesh_.facet(t);
      for (VertexId& v : f) v = name[v];
      std::rotate(f.begin(), std::ranges::min_element(f), f.end());
      facets.push_back(f);
    }
    std::ranges::sort(facets);
    return TriMesh(std::move(positions), std::move(facets));
  }

 private:
  template <class Go>
  void as_long_as_any_goes(Go go) {
    for (std::size_t before = left_.size() + 1; left_.size() < before && !interrupted(interrupted_);) {
      before = left_.size();
      std::erase_if(left_, [&](VertexId v) { return !interrupted(interrupted_) && go(v); });
    }
  }

  /// Within its region: to the next vertex on the way, or another one.
  bool withdraw(VertexId v) {
    const auto go = [&](VertexId w) {
      if (!may_collapse(v, w)) return false;
      mesh_.collapse(v, w);
      curves_.collapse(v, w);
      return true;
    };
    const VertexId next = regions_.next[v];
    if (next.valid() && mesh_.has_edge(v, next) && go(next)) return true;
    return std::ranges::any_of(mesh_.neighbours(v),
                               [&](VertexId w) { return regions_.of[w] == regions_.of[v] && go(w); });
  }

  /// Into the neighbour that leaves the largest smallest angle. False if none may be.
  bool collapse(VertexId v, const Bounds& allowed) {
    VertexId best;
    double most = -1;
    for (const VertexId w : mesh_.neighbours(v)) {
      if (!may_collapse(v, w)) continue;
      const double angle = angle_after(v, w, allowed);
      if (angle > most) most = angle, best = w;
    }
    if (!best.valid()) return false;
    mesh_.collapse(v, best);
    curves_.collapse(v, best);
    make_better_flips(mesh_, best, no_curves());
    return true;
  }

  /// Not if it is interrupted: with most vertices still there that would take longer than all the rest.
  void flip_edges() {
    if (!interrupted(interrupted_)) make_better_flips(mesh_, no_curves());
  }

  BetterFlips no_curves() const {
    return {[this](VertexId a, VertexId b) { return !curves_.has(a, b); }};
  }

  bool may_collapse(VertexId v, VertexId w) const {
    return curves_.may_collapse(v, w) && mesh_.can_collapse(v, w);
  }

  /// The smallest angle of facets that were at v and are at w then; -1 if one is beyond the bounds.
  double angle_after(VertexId v, VertexId w, const Bounds& allowed) const {
    double least = 180;
    for (const FacetId t : mesh_.facets_at(v)) {
      const EditedMesh::Facet& f = mesh_.facet(t);
      if (std::ranges::find(f, w) != f.end()) continue;
      std::array<Vec3, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) corners[i] = mesh_.position(f[i] == v ? w : f[i]);
      const double before = least_angle(mesh_, t), after = std::ranges::min(angles_of(corners));
      if (after < std::min(allowed.angle, before)) return -1;
      least = std::min(least, after);
      if (before < least_with_normal) continue;
      const Vec3 old = mesh_.normal(t), now = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
      if (old.dot(now) < allowed.turned * old.norm() * now.norm()) return -1;
    }
    return least;
  }

  SiteId most_crowded(std::size_t first, std::span<const double> wanted, const Bounds& allowed) const {
    SiteId best;
    double least = std::numeric_limits<double>::infinity();
    for (SiteId x(first); x.index() < vertex_of_.size(); x = SiteId(x.value + 1)) {
      const VertexId v = vertex_of_[x];
      const std::vector<VertexId> around = mesh_.neighbours(v);
      double shortest = std::numeric_limits<double>::infinity();
      for (const VertexId w : around)
        shortest = std::min(shortest, (mesh_.position(w) - mesh_.position(v)).norm() / wanted[x.index()]);
      if (shortest < least && std::ranges::any_of(around, [&](VertexId w) {
            return may_collapse(v, w) && angle_after(v, w, allowed) >= 0;
          }))
        least = shortest, best = x;
    }
    return best;
  }

  SurfaceRegions regions_;
  EditedMesh mesh_;
  CurveEdges curves_;
  geom::Table<SiteId, VertexId> vertex_of_;
  const std::atomic<bool>* interrupted_;
  geom::Table<VertexId, FacetId> facet_at_;  // of the surface
  std::vector<VertexId> left_;               // that are to go
};

SurfaceSample place_of(const SampledSurface& surface, VertexId v) {
  return {surface.mesh.position(v), surface.parents[surface.mesh.facets_at(v).front()]};
}

}  // namespace

std::optional<CollapsedMesh> collapsed_mesh(const SamplesToPut& put, std::span<const double> wanted,
                                            const std::atomic<bool>* interrupted, int iterations) {
  if (!geom::topology(put.surface).manifold()) return {};
  SampledSurface surface = sampled_surface(put);
  const std::size_t most = std::max(most_refined * put.samples.size(), surface.mesh.num_vertices());
  split_long_edges(surface, wanted, fine, most);
  const std::size_t first = put.of_features.samples.size();
  CollapsedMesh result;
  if (iterations > 0)
    for (const SiteId x : move_to_farthest_vertices(surface, graded_lengths(surface, wanted),
                                                    {first, iterations, interrupted}))
      result.exchanged.push_back({x, place_of(surface, surface.vertex_of[x])});
  Collapses collapses(std::move(surface), interrupted);
  collapses.run();
  collapses.exchange(first, wanted, result.exchanged);
  if (!collapses.is_done()) collapses.run_to_the_end();
  if (!collapses.is_done()) return {};
  result.mesh = collapses.mesh();
  return result;
}

}  // namespace fpo
