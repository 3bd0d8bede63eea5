#include "geom/dual/edge_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/dual/lead.h"

namespace geom {
namespace {

constexpr std::size_t most_facets = 32;

/// A vertex of the surface from the left site, and by how much that is nearer than the right one: c - 2 d.y,
/// with the error of frame.h.
struct Seen {
  VertexId id;
  Vec3 y;
  Sure lead;
};

class View {
 public:
  View(const TriMesh& mesh, const WeightedPoint3& left, const WeightedPoint3& right)
      : mesh_(mesh), origin_(left.position), d_(right.position - left.position) {
    const double d2 = d_[0] * d_[0] + d_[1] * d_[1] + d_[2] * d_[2], heavier = right.weight - left.weight;
    c_ = d2 - heavier;
    error_ = 0x1p-49 * (d2 + std::abs(heavier));
    error_in_y_ = 0x1p-49 * std::sqrt(d2);
  }
  Seen at(VertexId id) const {
    const Vec3& z = mesh_.position(id);
    const double x = z[0] - origin_[0], y = z[1] - origin_[1], w = z[2] - origin_[2];
    return {id,
            {x, y, w},
            {c_ - 2 * (d_[0] * x + d_[1] * y + d_[2] * w),
             error_ + error_in_y_ * (std::abs(x) + std::abs(y) + std::abs(w))}};
  }

 private:
  const TriMesh& mesh_;
  const Vec3& origin_;
  Vec3 d_;
  double c_, error_, error_in_y_;
};

/// Where the lead vanishes between u and v.
Vec3 between(const Seen& u, const Seen& v) {
  const double share = u.lead.value / (u.lead.value - v.lead.value);
  return {u.y[0] + share * (v.y[0] - u.y[0]), u.y[1] + share * (v.y[1] - u.y[1]),
          u.y[2] + share * (v.y[2] - u.y[2])};
}

/// The edge by which the first facet is left: along its border the left site becomes the nearer one there,
/// from u to v. Mostly it leads to the last facet. None: not certain.
int first_way_out(const TriMesh& mesh, const View& view, const TracedEdge& edge, Seen& u, Seen& v) {
  const TriMesh::Facet& corners = mesh.facet(edge.from);
  const auto at = [&](int i) { return view.at(corners[static_cast<std::size_t>(i < 3 ? i : i - 3)]); };
  const auto leaves = [&] { return u.lead.negative() && v.lead.positive(); };
  int e = 0;
  while (e < 2 && mesh.across(edge.from, e) != edge.to) ++e;
  u = at(e);
  v = at(e + 1);
  if (leaves()) return e;
  const Seen first = u, third = at(e + 2);
  u = v, v = third;
  if (leaves()) return e == 2 ? 0 : e + 1;
  u = third, v = first;
  return leaves() ? (e == 0 ? 2 : e - 1) : -1;
}

}  // namespace

// It leaves a facet where the left site becomes the nearer one, from u to v. Across, the edge runs from v to
// u, and the third corner w tells which of the two others is next.
TracedEdge::Extent extent_of_edge(const TriMesh& mesh, const WeightedPoint3& left,
                                  const WeightedPoint3& right, const TracedEdge& edge) {
  const TracedEdge::Extent unknown{std::numeric_limits<double>::infinity(), Vec3(0, 0, 0)};
  const Vec3 start = edge.start - left.position, end = edge.end - left.position;
  TracedEdge::Extent extent{std::max(start.squaredNorm(), end.squaredNorm()), Vec3(0, 0, 0)};
  if (edge.from == edge.to) return extent.far2 *= 1 + 1e-6, extent.twice_area = start.cross(end), extent;
  const View view(mesh, left, right);
  Seen u, v;
  int e = first_way_out(mesh, view, edge, u, v);
  if (e < 0) return unknown;
  FacetId t = edge.from;
  Vec3 last = start;
  for (std::size_t step = 1;; ++step) {
    const Vec3 z = between(u, v);
    extent.far2 = std::max(extent.far2, z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
    extent.twice_area += last.cross(z);
    last = z;
    t = mesh.across(t, e);
    if (t == edge.to) break;
    if (step == most_facets || !t.valid()) return unknown;
    const TriMesh::Facet& corners = mesh.facet(t);
    std::size_t w = 0;  // the corner that is neither u nor v; before it comes u
    while (corners[w] == u.id || corners[w] == v.id) ++w;
    if (corners[w == 0 ? 2 : w - 1] != u.id) return unknown;  // the facet is turned round
    const Seen third = view.at(corners[w]);
    if (!third.lead.certain()) return unknown;
    e = static_cast<int>(third.lead.value > 0 ? (w == 0 ? 2 : w - 1) : w);  // from u to w, or from w to v
    (third.lead.value > 0 ? v : u) = third;
  }
  extent.far2 *= 1 + 1e-6;
  extent.twice_area += last.cross(end);
  return extent;
}

}  // namespace geom
