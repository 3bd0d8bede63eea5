#include "geom/dual/chains.h"

#include "geom/check.h"

namespace geom {

int same_edge(const TriMesh& mesh, FacetId before, int e, FacetId t) {
  const TriMesh::Facet &f = mesh.facet(before), &g = mesh.facet(t);
  const VertexId a = f[static_cast<std::size_t>(e)], b = f[static_cast<std::size_t>(e == 2 ? 0 : e + 1)];
  for (std::size_t i = 0; i < 3; ++i) {
    const VertexId c = g[i], d = g[i == 2 ? 0 : i + 1];
    if (((a == c && b == d) || (a == d && b == c)) && mesh.across(t, static_cast<int>(i)) == before)
      return static_cast<int>(i);
  }
  return -1;
}

void EdgeChains::add(FacetId t, std::span<const FacetPiece> pieces) {
  for (const auto& [a, corners] : pieces)
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const EdgeLabel along = corners[k].edge;
      if (!along.is_site() || along.site() < a) continue;  // once for both cells
      const SiteId b = along.site();
      if (known_.has_circles_of(a) || known_.has_circles_of(b)) continue;
      const End first = end_at(t, a, b, corners[previous_corner(k, corners.size())].edge);
      const End last = end_at(t, a, b, corners[next_corner(k, corners.size())].edge);
      const End start = follow(first);
      if (start.is_open() && last.is_open() && start.point == last.point) {  // a closed curve
        open_.erase(last.point);
        without_circle_.insert(without_circle_.end(), {a, b});
      } else {
        join(start, follow(last), a, b);
      }
    }
}

EdgeChains::End EdgeChains::end_at(FacetId t, SiteId a, SiteId b, EdgeLabel label) const {
  End end;
  if (label.is_site()) {
    for (const CircleId c : state_.circles.of_site(a)) {
      const EmptyCircle& circle = state_.circles[c];
      if (circle.facet != t || !circle.is_triangle() || !circle.touches(b) || !circle.touches(label.site()))
        continue;
      end.circle = c;
      end.side = circle.index_of(label.site());
    }
    ensure(end.circle.valid(), "chains: an edge ends at no circle");
    return end;
  }
  const FacetId across = state_.mesh.across(t, label.edge());
  if (!across.valid()) return end;
  const int e = same_edge(state_.mesh, t, label.edge(), across);
  if (e < 0) return end;
  end.point = {t < across ? 3 * std::int64_t{t.value} + label.edge() : 3 * std::int64_t{across.value} + e, a,
               b};
  return end;
}

/// Where the chain that ends there begins, if there is one.
EdgeChains::End EdgeChains::follow(const End& end) {
  if (!end.is_open()) return end;
  const auto found = open_.find(end.point);
  if (found == open_.end()) return end;
  const End other = found->second;
  open_.erase(found);
  return other;
}

void EdgeChains::join(const End& one, const End& two, SiteId a, SiteId b) {
  if (one.is_open()) open_[one.point] = two;
  if (two.is_open()) open_[two.point] = one;
  if (one.is_open() || two.is_open()) return;
  if (one.circle.valid()) state_.circles.set_beyond(one.circle, one.side, two.circle);
  if (two.circle.valid()) state_.circles.set_beyond(two.circle, two.side, one.circle);
  if (!one.circle.valid() && !two.circle.valid())
    without_circle_.insert(without_circle_.end(), {a, b});  // from border to border
}

}  // namespace geom
