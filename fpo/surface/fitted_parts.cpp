#include "fpo/surface/fitted_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "fpo/surface/halved_edges.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/scaling.h"

namespace fpo {

using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double rounding = 1e-9;  // of weights

/// A location on a facet a b c: a + x (b - a) + y (c - a).
struct Place {
  double x = 0, y = 0;
};

double cross(const Place& o, const Place& a, const Place& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

Place middle(const Place& a, const Place& b) { return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}; }

using Triangle = std::array<Place, 3>;

/// Of the corners, which sum up to 1: barycentric coordinates.
std::array<double, 3> weights(const Triangle& t, const Place& p) {
  const double whole = cross(t[0], t[1], t[2]);
  const double b = cross(t[0], p, t[2]) / whole, c = cross(t[0], t[1], p) / whole;
  return {1 - b - c, b, c};
}

/// Where positions are on a facet.
class FacetFrame {
 public:
  FacetFrame(const Vec3& a, const Vec3& b, const Vec3& c) : origin_(a) {
    const Vec3 u = b - a, v = c - a, n = u.cross(v);
    to_x_ = v.cross(n) / n.squaredNorm();
    to_y_ = n.cross(u) / n.squaredNorm();
  }
  Place place_of(const Vec3& p) const { return {to_x_.dot(p - origin_), to_y_.dot(p - origin_)}; }

 private:
  Vec3 origin_, to_x_, to_y_;
};

class Fitting {
 public:
  Fitting(const TriMesh& mesh, const Sizing& sizing, const SplitFunction& function, const FitOptions& options,
          std::span<const SurfaceSample> samples)
      : fine_(function.split),
        fine_values_(function.values),
        options_(options),
        samples_(samples),
        edges_(mesh, sizing, options.longest) {
    for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
      values_.push_back(fine_values_[v]);
    fine_h_ = fine_.h;
    if (fine_h_.empty()) fine_h_.assign(fine_.mesh.num_vertices(), sizing.at(VertexId(0)));
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
      pieces_.push_back({mesh.facet(t), {Place{0, 0}, {1, 0}, {0, 1}}, t, {}, {}, false});
    place_fine_parts(mesh);
    for (std::size_t i = 0; i < samples.size(); ++i) pieces_[samples[i].facet.index()].samples.push_back(i);
    for (Piece& piece : pieces_) judge(piece);
  }

  /// Halves the longest edge of each piece that does not fit. False if all do.
  bool refine() {
    halved_.clear();
    middles_.clear();
    for (const Piece& piece : pieces_)
      if (!piece.fits) halved_.insert(key(piece, longest_edge(piece, {0, 1, 2})));
    if (halved_.empty()) return false;
    std::vector<Piece> parts;
    for (Piece& piece : pieces_) cut(std::move(piece), parts);
    pieces_ = std::move(parts);
    return true;
  }

  std::size_t num_pieces() const { return pieces_.size(); }

  FittedParts take(bool uniform, std::span<SurfaceSample> samples) {
    for (std::size_t t = 0; t < pieces_.size(); ++t)
      for (const std::size_t i : pieces_[t].samples) samples[i].facet = FacetId(t);
    FittedParts result;
    Table<FacetId, TriMesh::Facet> facets;
    for (const Piece& piece : pieces_) {
      facets.push_back(piece.corners);
      result.surface.parents.push_back(piece.parent);
    }
    result.surface.mesh = TriMesh(edges_.take_positions(), std::move(facets));
    if (!uniform) result.surface.h = edges_.take_lengths();
    result.values = std::move(values_);
    return result;
  }

 private:
  struct Piece {
    TriMesh::Facet corners;
    Triangle at;  ///< on its parent
    FacetId parent;
    std::vector<FacetId> fine;         ///< parts that meet it
    std::vector<std::size_t> samples;  ///< in it
    bool fits;
  };

  void place_fine_parts(const TriMesh& mesh) {
    for (FacetId t(0); t.index() < fine_.mesh.num_facets(); t = FacetId(t.value + 1)) {
      const FacetId parent = fine_.parents[t];
      const FacetFrame frame(mesh.corner(parent, 0), mesh.corner(parent, 1), mesh.corner(parent, 2));
      Triangle& at = fine_at_.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) at[i] = frame.place_of(fine_.mesh.corner(t, i));
      pieces_[parent.index()].fine.push_back(t);
    }
  }

  double length2(const Piece& piece, std::size_t e) const {
    return edges_.length2(piece.corners[e], piece.corners[(e + 1) % 3]);
  }
  static std::uint64_t key(const Piece& piece, std::size_t e) {
    return edge_key(piece.corners[e], piece.corners[(e + 1) % 3]);
  }
  std::size_t longest_edge(const Piece& piece, std::vector<std::size_t> edges) const {
    return *std::ranges::max_element(
        edges, {}, [&](std::size_t e) { return std::pair(length2(piece, e), key(piece, e)); });
  }

  void judge(Piece& piece) const {
    const double excess = edges_.excess(piece.corners);  // over the longest
    piece.fits = excess <= 1 || (excess * options_.longest <= options_.largest && is_linear_on(piece));
  }

  bool is_linear_on(const Piece& piece) const {
    const auto [a, b, c] = piece.corners;
    const std::array<double, 3> corners{values_[a], values_[b], values_[c]};
    return std::ranges::all_of(piece.fine, [&](FacetId t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::array<double, 3> w = weights(piece.at, fine_at_[t][i]);
        if (!(std::ranges::min(w) > -rounding)) continue;
        const VertexId v = fine_.mesh.facet(t)[i];
        const double linear = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
        if (std::abs(linear - fine_values_[v]) > options_.tolerance * fine_h_[v]) return false;
      }
      return true;
    });
  }

  /// The function in the middle of an edge, on the part that has that inside, or nearly.
  double value_in_middle(const Piece& piece, std::size_t e) const {
    const Place place = middle(piece.at[e], piece.at[(e + 1) % 3]);
    double value = 0.5 * (values_[piece.corners[e]] + values_[piece.corners[(e + 1) % 3]]);
    double best = -std::numeric_limits<double>::infinity();
    for (const FacetId t : piece.fine) {
      const std::array<double, 3> w = weights(fine_at_[t], place);
      const double inside = std::ranges::min(w);
      if (!(inside > best)) continue;
      best = inside;
      double sum = 0, weighted = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double share = std::max(0.0, w[i]);
        sum += share;
        weighted += share * fine_values_[fine_.mesh.facet(t)[i]];
      }
      value = weighted / sum;
    }
    return value;
  }

  /// At all of its edges that are halved, the longest one first.
  void cut(Piece piece, std::vector<Piece>& parts) {
    std::vector<std::size_t> edges;
    for (std::size_t e = 0; e < 3; ++e)
      if (halved_.contains(key(piece, e))) edges.push_back(e);
    if (edges.empty()) return parts.push_back(std::move(piece));
    const std::size_t e = longest_edge(piece, edges), next = (e + 1) % 3, last = (e + 2) % 3;
    const VertexId m = middle_of(piece, e);
    const Place at = middle(piece.at[e], piece.at[next]);
    Piece one = piece_of(piece, {e, next, last}), two = one;
    one.corners[1] = two.corners[0] = m;
    one.at[1] = two.at[0] = at;
    const auto reaches = [&](FacetId t, double side) {
      return std::ranges::any_of(fine_at_[t],
                                 [&](const Place& x) { return side * cross(piece.at[last], at, x) > 0; });
    };
    const double side = cross(piece.at[last], at, piece.at[e]);
    for (const FacetId t : piece.fine) {
      if (reaches(t, side)) one.fine.push_back(t);
      if (reaches(t, -side)) two.fine.push_back(t);
    }
    for (const std::size_t i : piece.samples)
      (distance2(i, one) <= distance2(i, two) ? one : two).samples.push_back(i);
    piece = Piece();
    for (Piece* half : {&one, &two}) {
      judge(*half);
      cut(std::move(*half), parts);
    }
  }

  /// Its corners from some edge on, and nothing in it.
  static Piece piece_of(const Piece& piece, const std::array<std::size_t, 3>& order) {
    const auto& [a, b, c] = order;
    return {{piece.corners[a], piece.corners[b], piece.corners[c]},
            {piece.at[a], piece.at[b], piece.at[c]},
            piece.parent,
            {},
            {},
            false};
  }

  double distance2(std::size_t sample, const Piece& piece) const {
    const auto& [a, b, c] = piece.corners;
    const auto& at = edges_.positions();
    return geom::closest_point(samples_[sample].position, {at[a], at[b], at[c]}).distance2;
  }

  /// Of an edge that is halved, the same vertex for all pieces there.
  VertexId middle_of(const Piece& piece, std::size_t e) {
    const auto [at, is_new] = middles_.try_emplace(key(piece, e), edges_.positions().next_id());
    if (!is_new) return at->second;
    const VertexId a = piece.corners[e], b = piece.corners[(e + 1) % 3];
    edges_.middle_within(std::min(a, b), std::max(a, b));
    values_.push_back(geom::snapped(value_in_middle(piece, e), geom::coordinate_unit));
    return at->second;
  }

  const SplitSurface& fine_;
  const Table<VertexId, double>& fine_values_;
  FitOptions options_;
  std::span<const SurfaceSample> samples_;
  VertexField fine_h_;
  Table<FacetId, Triangle> fine_at_;  ///< on their parents
  HalvedEdges edges_;
  Table<VertexId, double> values_;
  std::vector<Piece> pieces_;
  std::unordered_set<std::uint64_t> halved_;             ///< edges, by their ends
  std::unordered_map<std::uint64_t, VertexId> middles_;  ///< of those
};

}  // namespace

std::optional<FittedParts> fitted_parts(const TriMesh& mesh, const Sizing& sizing,
                                        const SplitFunction& function, const FitOptions& options,
                                        std::span<SurfaceSample> samples) {
  Fitting fitting(mesh, sizing, function, options, samples);
  while (fitting.refine())
    if (fitting.num_pieces() >= function.split.mesh.num_facets()) return {};
  return fitting.take(sizing.is_uniform(), samples);
}

}  // namespace fpo
