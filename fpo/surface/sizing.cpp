#include "fpo/surface/sizing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <span>
#include <string>

#include "geom/check.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec2;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double max_ratio_in_patch = 1.2;
constexpr int max_patch_depth = 16;      // h is linear: past it the patch is a 65536th of its facet
constexpr double few_samples = 0x1p-10;  // in a patch, were h its least everywhere: it is not divided
constexpr double most_density = 1000;    // of the samples wanted: while s is looked for, more are not counted

std::string at_vertex(VertexId v) { return "sizing at vertex " + std::to_string(v.value + 1); }

}  // namespace

double hexagonal_spacing(double area, std::size_t n) {
  return std::sqrt(2 * area / (std::numbers::sqrt3 * static_cast<double>(n)));
}

Sizing Sizing::uniform(double h) {
  geom::require(h > 0 && std::isfinite(h), "the wanted edge length must be positive and finite");
  return Sizing(h);
}

Sizing::Sizing(const TriMesh& mesh, VertexField h) : mesh_(&mesh), at_vertices_(std::move(h)) {
  geom::require(at_vertices_.size() == mesh.num_vertices(), "the sizing must have one value per vertex");
  for (VertexId v(0); v.index() < at_vertices_.size(); v = VertexId(v.value + 1))
    geom::require(at_vertices_[v] > 0 && std::isfinite(at_vertices_[v]),
                  at_vertex(v) + " is not positive and finite");
}

Sizing Sizing::lowered(double scale, std::shared_ptr<const Spots> spots, const TriMesh& mesh) const {
  Sizing result = *this;
  result.scale_ *= scale;
  if (spots_) {
    auto all = std::make_shared<Spots>(*spots);
    all->add(*spots_);
    spots = std::move(all);
  }
  result.spots_ = std::move(spots);
  result.spotted_ = &mesh;
  return result;
}

double Sizing::at(VertexId v) const {
  const double h = is_even() ? uniform_ : at_vertices_[v];
  return spots_ ? spots_->bound(spotted_->position(v), scale_ * h) : h;
}

double Sizing::at(const SurfaceSample& x) const {
  const double h = unlowered_at(x);
  return spots_ ? spots_->bound(x.position, scale_ * h) : h;
}

double Sizing::unlowered_at(const SurfaceSample& x) const {
  if (is_even()) return uniform_;
  const TriMesh::Facet& corners = mesh_->facet(x.facet);
  const Vec3 &q0 = mesh_->position(corners[0]), &q1 = mesh_->position(corners[1]),
             &q2 = mesh_->position(corners[2]);
  const double h0 = at_vertices_[corners[0]], h1 = at_vertices_[corners[1]], h2 = at_vertices_[corners[2]];
  const Vec3 normal = (q1 - q0).cross(q2 - q0);
  const double size2 = normal.squaredNorm();
  if (!(size2 > 0)) return std::min({h0, h1, h2});
  const double u = (x.position - q0).cross(q2 - q0).dot(normal) / size2,
               v = (q1 - q0).cross(x.position - q0).dot(normal) / size2;
  return std::clamp(h0 + u * (h1 - h0) + v * (h2 - h0), std::min({h0, h1, h2}), std::max({h0, h1, h2}));
}

namespace {

struct SizedCorner {
  Vec2 at;
  double h;
};

SizedCorner middle(const SizedCorner& a, const SizedCorner& b) {
  return {(a.at + b.at) / 2, (a.h + b.h) / 2};
}

double density(double h) { return 2 / std::numbers::sqrt3 / (h * h); }

/// Visits the patches of which a patch of that area is made: cut in four at the middles of its edges until h
/// varies little, or there is hardly a sample. The visitor says whether to go on.
template <class Visit>
bool visit_patches(const std::array<SizedCorner, 3>& c, FacetId t, double area, int depth, Visit& visit) {
  const auto [least, most] = std::minmax({c[0].h, c[1].h, c[2].h});
  const SizedCorner m0 = middle(c[0], c[1]), m1 = middle(c[1], c[2]), m2 = middle(c[2], c[0]);
  if (most < max_ratio_in_patch * least || depth == max_patch_depth || area * density(least) < few_samples) {
    const double mean_density =
        2 / std::numbers::sqrt3 * (1 / (m0.h * m0.h) + 1 / (m1.h * m1.h) + 1 / (m2.h * m2.h)) / 3;
    return visit(SizedPatch{t, {c[0].at, c[1].at, c[2].at}, least, area * mean_density});
  }
  for (const std::array<SizedCorner, 3>& part :
       {std::array{c[0], m0, m2}, std::array{m0, c[1], m1}, std::array{m2, m1, c[2]}, std::array{m0, m1, m2}})
    if (!visit_patches(part, t, area / 4, depth + 1, visit)) return false;
  return true;
}

template <class Visit>
void visit_patches(const TriMesh& mesh, const Sizing& sizing, Visit visit) {
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const TriMesh::Facet& v = mesh.facet(t);
    const std::array<SizedCorner, 3> corners{SizedCorner{{0, 0}, sizing.at(v[0])},
                                             SizedCorner{{1, 0}, sizing.at(v[1])},
                                             SizedCorner{{0, 1}, sizing.at(v[2])}};
    if (!visit_patches(corners, t, mesh.area(t), 0, visit)) return;
  }
}

}  // namespace

std::vector<SizedPatch> sized_patches(const TriMesh& mesh, const Sizing& sizing) {
  std::vector<SizedPatch> patches;
  patches.reserve(mesh.num_facets());
  visit_patches(mesh, sizing, [&](const SizedPatch& patch) {
    patches.push_back(patch);
    return true;
  });
  return patches;
}

double num_samples(const TriMesh& mesh, const Sizing& sizing, double enough) {
  double sum = 0;
  visit_patches(mesh, sizing, [&](const SizedPatch& patch) { return (sum += patch.num_samples) <= enough; });
  return sum;
}

namespace {

/// The mesh edges as lists of neighbours with distances.
class EdgeGraph {
 public:
  explicit EdgeGraph(const TriMesh& mesh) : first_(mesh.num_vertices() + 1, 0) {
    std::vector<std::array<VertexId, 2>> edges;
    for (const TriMesh::Facet& f : mesh.facets())
      for (std::size_t e = 0; e < 3; ++e) {
        edges.push_back({f[e], f[(e + 1) % 3]});
        edges.push_back({f[(e + 1) % 3], f[e]});
      }
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [a, b] : edges) {
      ++first_[a.index() + 1];
      links_.push_back({b, (mesh.position(a) - mesh.position(b)).norm()});
    }
    for (std::size_t v = 0; v + 1 < first_.size(); ++v) first_[v + 1] += first_[v];
  }

  struct Link {
    VertexId to;
    double length;
  };
  std::span<const Link> links(VertexId v) const {
    return {links_.data() + first_[v.index()], links_.data() + first_[v.index() + 1]};
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<Link> links_;
};

/// The largest field below h that grows by at most `gradation` per length.
void limit_gradation(const EdgeGraph& graph, double gradation, VertexField& h) {
  using Entry = std::pair<double, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto spread = [&](VertexId v) {
    for (const EdgeGraph::Link& link : graph.links(v)) {
      const double limit = h[v] + gradation * link.length;
      if (limit < h[link.to]) queue.emplace(h[link.to] = limit, link.to);
    }
  };
  for (std::size_t v = 0; v < h.size(); ++v) spread(VertexId(v));
  while (!queue.empty()) {
    const auto [value, v] = queue.top();
    queue.pop();
    if (value == h[v]) spread(v);
  }
}

/// A root of f between low, where f >= 0, and high, where f <= 0. Secants of slope about -2 (without limits f
/// is log s^-2 and a constant), bisection where they leave the bracket.
template <class Function>
double root_of_decreasing(const Function& f, double low, double high) {
  double x = (low + high) / 2, y = f(x), slope = -2;
  for (int step = 0; step < 100 && std::abs(y) > 1e-6 && high - low > 1e-12; ++step) {
    (y > 0 ? low : high) = x;
    double next = x - y / slope;
    if (!(next > low && next < high)) next = (low + high) / 2;
    const double y_next = f(next);
    slope = std::min((y_next - y) / (next - x), -0.1);
    x = next, y = y_next;
  }
  return x;
}

void require_usable(const VertexField& rho, const SizingLimits& limits) {
  geom::require(limits.gradation > 0 && limits.gradation <= 10, "the gradation must be in (0, 10]");
  geom::require(limits.smallest > 0 && limits.smallest <= 1 && limits.largest >= 1,
                "the limits of the sizing must enclose 1");
  for (VertexId v(0); v.index() < rho.size(); v = VertexId(v.value + 1))
    geom::require(rho[v] > 0, at_vertex(v) + " is not positive");  // NaN is not either
}

}  // namespace

Sizing graded_sizing(const TriMesh& mesh, VertexField h, double gradation) {
  geom::require(h.size() == mesh.num_vertices(), "the sizing must have one value per vertex");
  require_usable(h, {.gradation = gradation});
  limit_gradation(EdgeGraph(mesh), gradation, h);
  return Sizing(mesh, std::move(h));
}

Sizing fit_sizing(const TriMesh& mesh, const VertexField& rho, std::size_t n, const SizingLimits& limits) {
  geom::require(rho.size() == mesh.num_vertices(), "the sizing has " + std::to_string(rho.size()) +
                                                       " values, the mesh has " +
                                                       std::to_string(mesh.num_vertices()) + " vertices");
  require_usable(rho, limits);
  geom::require(n > 0 && mesh.area() > 0, "the surface has no area or no samples to size");
  const double even = hexagonal_spacing(mesh.area(), n);
  const double smallest = limits.smallest * even, largest = limits.largest * even;
  const EdgeGraph graph(mesh);
  const double samples = static_cast<double>(n);
  const auto sizing = [&](double s) {
    VertexField h = rho;
    for (double& value : h) value = std::clamp(s * value, smallest, largest);
    limit_gradation(graph, limits.gradation, h);
    return Sizing(mesh, std::move(h));
  };

  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const double r : rho) least = std::min(least, r), most = std::isfinite(r) ? std::max(most, r) : most;
  if (!std::isfinite(least)) return Sizing::uniform(even);
  return sizing(std::exp(root_of_decreasing(
      [&](double log_s) {
        return std::log(num_samples(mesh, sizing(std::exp(log_s)), most_density * samples) / samples);
      },
      std::log(smallest / most), std::log(largest / least))));
}

}  // namespace fpo
