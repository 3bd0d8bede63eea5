#include "fpo/remesh/sampled_surface.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "fpo/remesh/better_flips.h"

namespace fpo {

using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double at_vertex = 1e-9;  // of the edges' length, or of a facet's area: it is rounding
constexpr double on_edge = 1e-6;    // of a facet's area: a triangle there would be of no use

class Sampler {
 public:
  explicit Sampler(const SamplesToPut& put)
      : put_(put),
        result_{EditedMesh(put.surface), {}, {}, {}},
        sample_at_(put.surface.num_vertices()),
        parts_(put.surface.num_facets()) {
    result_.vertex_of.resize(put.samples.size());
    for (FacetId t(0); t.index() < put.surface.num_facets(); t = FacetId(t.value + 1)) {
      parents().push_back(t);
      parts_[t].push_back(t);
    }
  }

  SampledSurface run() {
    for (std::size_t c = 0; c < put_.features.curves.size(); ++c) put_on_curve(c);
    for (std::size_t i = 0; i < put_.samples.size(); ++i)
      if (!is_there(SiteId(i))) put_in_facet(SiteId(i));
    return std::move(result_);
  }

 private:
  EditedMesh& mesh() { return result_.mesh; }
  geom::Table<FacetId, FacetId>& parents() { return result_.parents; }
  const Vec3& at(SiteId x) const { return put_.samples[x.index()].position; }
  bool is_there(SiteId x) const { return result_.vertex_of[x].valid(); }
  bool is_taken(VertexId v) const { return sample_at_[v].valid(); }
  void place(SiteId x, VertexId v) {
    if (v.index() >= sample_at_.size()) sample_at_.resize(v.index() + 1);
    sample_at_[v] = x;
    result_.vertex_of[x] = v;
  }

  /// How far along an edge of a curve a sample is.
  struct OnEdge {
    double share;
    SiteId x;
  };

  void put_on_curve(std::size_t c) {
    const std::vector<VertexId>& line = put_.features.curves[c].vertices;
    const std::size_t edges = put_.features.curves[c].loop ? line.size() : line.size() - 1;
    const auto ends = [&](std::size_t k) { return std::pair(line[k], line[(k + 1) % line.size()]); };
    for (std::size_t k = 0; k < edges; ++k) result_.curves.add(ends(k).first, ends(k).second);
    std::vector<std::vector<OnEdge>> on(edges);
    for (const SiteId x : put_.of_features.chains[c]) {
      if (is_there(x)) continue;
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity(), share = 0;
      for (std::size_t k = 0; k < edges; ++k) {
        const Vec3 &a = put_.surface.position(ends(k).first), &b = put_.surface.position(ends(k).second);
        const double s = std::clamp((at(x) - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        if (const double d = (a + s * (b - a) - at(x)).squaredNorm(); d < least)
          least = d, nearest = k, share = s;
      }
      const auto [a, b] = ends(nearest);
      if (share < at_vertex && !is_taken(a))
        place(x, a);
      else if (share > 1 - at_vertex && !is_taken(b))
        place(x, b);
      else
        on[nearest].push_back({share, x});
    }
    for (std::size_t k = 0; k < edges; ++k) {
      std::ranges::stable_sort(on[k], {}, &OnEdge::share);
      VertexId from = ends(k).first;
      for (const OnEdge& sample : on[k]) {
        if (is_there(sample.x)) continue;  // it comes twice where a loop closes
        from = put_on_edge(sample.x, from, ends(k).second);
      }
    }
  }

  VertexId put_on_edge(SiteId x, VertexId a, VertexId b) {
    const std::size_t before = mesh().num_facets();
    const VertexId v = split_edge(result_, a, b, at(x));
    for (FacetId t(before); t.index() < mesh().num_facets(); t = FacetId(t.value + 1))
      parts_[parents()[t]].push_back(t);
    place(x, v);
    flip_around(v);
    return v;
  }

  void put_in_facet(SiteId x) {
    const Where where = find(x);
    const EditedMesh::Facet f = mesh().facet(where.t);
    for (std::size_t i = 0; i < 3; ++i)
      if (where.shares[i] > 1 - at_vertex && !is_taken_at(f[i])) return place(x, f[i]);
    const std::size_t i =
        static_cast<std::size_t>(std::ranges::min_element(where.shares) - where.shares.begin());
    const VertexId a = f[(i + 1) % 3], b = f[(i + 2) % 3];
    if (where.shares[i] < on_edge && !result_.curves.has(a, b)) {
      put_on_edge(x, a, b);
      return;
    }
    const VertexId v = mesh().split(where.t, at(x));
    const FacetId facet = put_.samples[x.index()].facet;
    for (int part = 0; part < 2; ++part) {
      parts_[facet].push_back(parents().next_id());
      parents().push_back(facet);
    }
    place(x, v);
    flip_around(v);
  }
  bool is_taken_at(VertexId v) const {
    return result_.curves.are_at(v) || (v.index() < sample_at_.size() && is_taken(v));
  }

  struct Where {
    FacetId t;
    std::array<double, 3> shares;  ///< of its area, opposite to its corners; negative outside
  };

  Where shares(FacetId t, const Vec3& normal, const Vec3& x) {
    Where where{t, {}};
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = mesh().position(mesh().facet(t)[(i + 1) % 3]),
                 &b = mesh().position(mesh().facet(t)[(i + 2) % 3]);
      sum += where.shares[i] = normal.dot((a - x).cross(b - x));
    }
    if (sum > 0)
      for (double& share : where.shares) share /= sum;
    else
      where.shares.fill(-std::numeric_limits<double>::max());
    return where;
  }

  /// The part of the sample's facet that it is in: by a walk, or, where rounding leads that astray, the one
  /// that it is least outside of.
  Where find(SiteId x) {
    const FacetId facet = put_.samples[x.index()].facet;
    const Vec3 normal = put_.surface.normal(facet);
    const std::vector<FacetId>& parts = parts_[facet];
    Where here = shares(parts.back(), normal, at(x));
    for (std::size_t step = 0; step < parts.size(); ++step) {
      const std::size_t i =
          static_cast<std::size_t>(std::ranges::min_element(here.shares) - here.shares.begin());
      if (here.shares[i] >= 0) return here;
      const EditedMesh::Facet& f = mesh().facet(here.t);
      const FacetId across = mesh().beside(f[(i + 2) % 3], f[(i + 1) % 3]);
      if (!across.valid() || parents()[across] != facet) break;
      here = shares(across, normal, at(x));
    }
    Where best{parts.front(), {1.0 / 3, 1.0 / 3, 1.0 / 3}};  // if none has an area
    double most = -std::numeric_limits<double>::max();
    for (const FacetId t : parts)
      if (const Where there = shares(t, normal, at(x)); std::ranges::min(there.shares) > most)
        best = there, most = std::ranges::min(there.shares);
    return best;
  }

  void flip_around(VertexId v) {
    make_better_flips(mesh(), v, {[&](VertexId a, VertexId b) {
                        return !result_.curves.has(a, b) &&
                               parents()[mesh().beside(a, b)] == parents()[mesh().beside(b, a)];
                      }});
  }

  const SamplesToPut& put_;
  SampledSurface result_;
  geom::Table<VertexId, SiteId> sample_at_;
  geom::Table<FacetId, std::vector<FacetId>> parts_;  // of facets of the surface
};

}  // namespace

VertexId split_edge(SampledSurface& surface, VertexId a, VertexId b, const Vec3& at) {
  for (const FacetId t : surface.mesh.facets_at(a))
    if (std::ranges::find(surface.mesh.facet(t), b) != surface.mesh.facet(t).end())
      surface.parents.push_back(surface.parents[t]);
  const VertexId v = surface.mesh.split(a, b, at);
  if (surface.curves.has(a, b)) surface.curves.split(a, b, v);
  return v;
}

SampledSurface sampled_surface(const SamplesToPut& put) { return Sampler(put).run(); }

}  // namespace fpo
