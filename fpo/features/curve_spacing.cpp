#include "fpo/features/curve_spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fpo/features/curve_pieces.h"
#include "fpo/features/length_limits.h"
#include "fpo/features/point_grid.h"
#include "geom/disjoint_sets.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double piece_length = 0.2;             // in spacings
constexpr double beside = 0.5;                   // of the way along one curve: not across
constexpr double at_corner = 0.18;               // of the distance from the corner: the sine of 10 degrees
constexpr double off_surface = 0.1;              // of the width: the middle of a strip
constexpr double most_growth = 1.35;             // of the lengths elsewhere
constexpr double smallest = 0.1, largest = 0.8;  // of the least length in narrow places, in other lengths
constexpr double least_help = 0.5;  // the length that is wanted over the least one, where that is of use
constexpr double split_slope = 0.3, split_length = 1.5;
constexpr double most_facets = 60;       // of the split surface, a sample
constexpr std::size_t most_facing = 12;  // curves that a place is asked to face: the nearest
constexpr int most_passes = 60;          // of splitting: needles never come to an end
constexpr double most_curves = 60;  // spacings of curves a sample: most strips are too narrow to be helped

class FacingCurves {
 public:
  FacingCurves(const TriMesh& mesh, const Features& features, double spacing, double longest)
      : features_(features),
        reach_(narrow_width * longest),
        tree_(mesh),
        grid_(narrow_width * longest + piece_length * spacing) {
    geom::DisjointSets joined(mesh.num_vertices());
    for (const TriMesh::Facet& f : mesh.facets())
      for (const VertexId v : {f[1], f[2]}) joined.merge(f[0].index(), v.index());
    for (std::size_t c = 0; c < features.curves.size(); ++c) {
      lengths_.push_back(cut_curve(mesh, features, c, piece_length * spacing, pieces_));
      bodies_.push_back(joined.find(features.curves[c].vertices.front().index()));
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i) grid_.add(pieces_[i].middle(), i);
  }

  /// Of each place with all curves that it faces, or with the nearest one only.
  std::vector<NarrowPlace> narrow_places(bool all) const {
    std::vector<NarrowPlace> places;
    for (const CurvePiece& p : pieces_) {
      bool nearest = true;
      for (const auto& [w, other] : widths_at(p, all)) {
        places.push_back({p.middle(), w, p.curve, other, p.length(), nearest});
        nearest = false;
      }
    }
    return places;
  }

 private:
  /// From the middle of p to the nearest piece of each curve that faces it, with that curve. Ascending. Only
  /// the nearest curves are looked at: where hundreds cross, a place would be compared with all of them.
  std::vector<std::pair<double, std::size_t>> widths_at(const CurvePiece& p, bool all) const {
    const Vec3 x = p.middle();
    std::vector<std::pair<double, std::size_t>> near;
    grid_.around(x, [&](std::size_t i) {
      const CurvePiece& q = pieces_[i];
      if (&q == &p || bodies_[q.curve] != bodies_[p.curve]) return;
      const double d = (geom::closest_point(x, {q.from, q.to, q.to}).point - x).norm();
      if (d < reach_ && d > 0 && !are_beside(p, q, d)) near.emplace_back(d, i);
    });
    std::ranges::sort(near);
    std::vector<std::pair<double, std::size_t>> result;
    std::vector<std::size_t> seen;  // curves: what of them is not nearest is beyond, or beside
    for (const auto& [d, i] : near) {
      if (std::ranges::find(seen, pieces_[i].curve) != seen.end()) continue;
      if (seen.size() == most_facing) break;
      seen.push_back(pieces_[i].curve);
      const Vec3 y = geom::closest_point(x, {pieces_[i].from, pieces_[i].to, pieces_[i].to}).point;
      if (tree_.is_nearer((x + y) / 2, std::pow(off_surface * d, 2), p.facet))
        result.emplace_back(d, pieces_[i].curve);
      if (!all && !result.empty()) break;
    }
    return result;
  }

  /// Along one curve, or at a corner of two.
  bool are_beside(const CurvePiece& p, const CurvePiece& q, double distance) const {
    const FeatureCurve &a = features_.curves[p.curve], &b = features_.curves[q.curve];
    if (p.curve == q.curve) {
      const double between = std::abs(p.at_middle() - q.at_middle()), length = lengths_[p.curve];
      const bool closes = a.loop || a.vertices.front() == a.vertices.back();
      const double way = closes ? std::min(between, length - between) : between;
      if (distance > beside * (way - q.length() / 2)) return true;
    }
    if (a.loop || b.loop) return false;
    for (const bool at_end : {false, true})
      for (const bool at_other_end : {false, true}) {
        if ((at_end ? a.vertices.back() : a.vertices.front()) !=
            (at_other_end ? b.vertices.back() : b.vertices.front()))
          continue;
        const double s = at_end ? lengths_[p.curve] - p.at_middle() : p.at_middle(),
                     t = at_other_end ? lengths_[q.curve] - q.at_middle() : q.at_middle();
        if (distance > at_corner * std::max(s, t)) return true;
      }
    return false;
  }

  const Features& features_;
  double reach_;
  geom::AabbTree tree_;
  std::vector<CurvePiece> pieces_;
  std::vector<double> lengths_;
  std::vector<std::size_t> bodies_;  // of the curves: no strip is between those of two that touch
  PointGrid grid_;
};

/// The lengths of `base` at the vertices of a surface split from its mesh.
VertexField at_split_vertices(const TriMesh& mesh, const Sizing& base, const SplitSurface& split) {
  VertexField h(split.mesh.num_vertices(), 0.0);
  for (FacetId t(0); t.index() < split.mesh.num_facets(); t = FacetId(t.value + 1))
    for (const VertexId v : split.mesh.facet(t))
      h[v] =
          v.index() < mesh.num_vertices() ? base.at(v) : base.at({split.mesh.position(v), split.parents[t]});
  for (VertexId v(0); v.index() < h.size(); v = VertexId(v.value + 1))
    if (!(h[v] > 0)) h[v] = base.at(v);  // of no facet
  return h;
}

double length_of_all(const TriMesh& mesh, const Features& features) {
  double length = 0;
  for (const FeatureCurve& curve : features.curves) length += length_of(mesh, curve);
  return length;
}

double widest(const std::vector<NarrowPlace>& places) {
  double most = 0;
  for (const NarrowPlace& place : places) most = std::max(most, place.width);
  return most;
}

bool may_have_places(const TriMesh& mesh, const Features& features, double spacing) {
  return !features.curves.empty() && length_of_all(mesh, features) <= most_curves * mesh.area() / spacing;
}

}  // namespace

std::vector<NarrowPlace> narrow_places(const TriMesh& mesh, const Features& features, double spacing) {
  if (!may_have_places(mesh, features, spacing)) return {};
  return FacingCurves(mesh, features, spacing, spacing).narrow_places(true);
}

std::vector<NarrowPlace> nearest_places(const TriMesh& mesh, const Features& features, double spacing,
                                        double longest) {
  if (!may_have_places(mesh, features, spacing)) return {};
  return FacingCurves(mesh, features, spacing, std::max(spacing, longest)).narrow_places(false);
}

/// Facets small beside the lengths at narrow places, these at least so long. Empty if they were too many.
SplitSurface split_at(const std::vector<NarrowPlace>& places, const TriMesh& mesh, double spacing,
                      double least) {
  const LengthLimits near(places, split_slope, spacing);
  const auto lengths = [&](const TriMesh& surface) {
    VertexField h;
    for (const Vec3& x : surface.vertices()) {
      const LengthLimits::Limit limit = near.at(x);
      const double length = std::max(limit.length, least + split_slope * limit.distance);
      h.push_back(std::min(length, 1e6 * mesh.diagonal()));
    }
    return h;
  };
  SplitSurface split{mesh, lengths(mesh), {}};
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) split.parents.push_back(t);
  // Middles are given the mean of their ends; then what the places allow there, which may be less.
  const double even = mesh.area() / (spacing * spacing);
  const double most = static_cast<double>(mesh.num_facets()) + most_facets * even;
  for (int pass = 0; has_long_edges(split.mesh, Sizing(split.mesh, split.h), split_length); ++pass) {
    if (pass == most_passes || static_cast<double>(split.mesh.num_facets()) > most) return {};
    SplitSurface next = split_long_edges(split.mesh, Sizing(split.mesh, split.h), split_length, {},
                                         static_cast<std::size_t>(most));
    for (FacetId& parent : next.parents) parent = split.parents[parent];
    next.h = lengths(next.mesh);
    split = std::move(next);
  }
  return split;
}

/// The limits at the vertices of the split mesh.
void find_limits(NarrowSurface& narrow, double spacing) {
  const LengthLimits limits(narrow.places, narrow.gradation, most_growth * spacing);
  narrow.lengths.clear(), narrow.distances.clear();
  for (const Vec3& x : narrow.split.mesh.vertices()) {
    const LengthLimits::Limit limit = limits.at(x);
    narrow.lengths.push_back(limit.length), narrow.distances.push_back(limit.distance);
  }
}

std::optional<NarrowSurface> narrow_surface(const TriMesh& mesh, const Features& features, double spacing,
                                            double gradation, double longest) {
  NarrowSurface result;
  result.places = nearest_places(mesh, features, spacing, longest);
  if (result.places.empty()) return {};
  result.split = split_at(result.places, mesh, spacing, smallest * spacing);
  if (result.split.mesh.num_facets() == 0) return {};
  result.gradation = gradation;
  find_limits(result, spacing);
  return result;
}

void split_less(NarrowSurface& narrow, const TriMesh& mesh, double spacing, double least) {
  SplitSurface split = split_at(narrow.places, mesh, spacing, least);
  if (split.mesh.num_facets() == 0) return;
  narrow.split = std::move(split);
  find_limits(narrow, spacing);
}

CurveFit fit_sizing_to_curves(const TriMesh& mesh, const Sizing& base, const NarrowSurface& narrow,
                              std::size_t n) {
  const TriMesh& surface = narrow.split.mesh;
  const VertexField h = at_split_vertices(mesh, base, narrow.split);
  const auto limited = [&](double least, double growth) {
    VertexField result = h;
    for (VertexId v(0); v.index() < h.size(); v = VertexId(v.value + 1))
      result[v] = std::min(growth * h[v],
                           std::max(narrow.lengths[v], least + narrow.gradation * narrow.distances[v]));
    return Sizing(surface, std::move(result));
  };
  const auto is_too_many = [&](double least, double growth) {
    return num_samples(surface, limited(least, growth)) > static_cast<double>(n);
  };
  const double most = *std::ranges::max_element(h), most_wanted = widths_of_length * widest(narrow.places);
  for (double least = smallest * most; least < std::min(largest * most, most_wanted / least_help);
       least *= 1.2) {
    if (is_too_many(least, most_growth)) continue;
    double low = 1, high = most_growth;
    for (int step = 0; step < 24; ++step) {
      const double growth = (low + high) / 2;
      (is_too_many(least, growth) ? low : high) = growth;
    }
    return {limited(least, high), true, least};
  }
  return {Sizing(surface, h), false, 0};
}

}  // namespace fpo
