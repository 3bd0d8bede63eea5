#include "fpo/surface/needle_parts.h"

#include <algorithm>
#include <cmath>

namespace fpo {

using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double longest = 4;
constexpr double thinnest = 4;
constexpr std::int64_t whole = std::int64_t{1} << 30;  // products of differences fit 64 bits

int next(int e) { return e == 2 ? 0 : e + 1; }

std::size_t slot(int e) { return static_cast<std::size_t>(e); }

}  // namespace

bool NeedleParts::is_needle(const TriMesh::Facet& f, const HalvedEdges& edges) {
  if (!(edges.excess(f) > longest)) return false;
  const auto& positions = edges.positions();
  const double area = (positions[f[1]] - positions[f[0]]).cross(positions[f[2]] - positions[f[0]]).norm();
  const double longest2 =
      std::max({edges.length2(f[0], f[1]), edges.length2(f[1], f[2]), edges.length2(f[2], f[0])});
  return longest2 > thinnest * area;
}

void NeedleParts::cut(const TriMesh::Facet& facet, std::size_t most,
                      geom::Table<geom::FacetId, TriMesh::Facet>& parts) {
  corners_ = {{facet[0], 0, 0}, {facet[1], whole, 0}, {facet[2], 0, whole}};
  parts_.assign(1, Part{});
  long_ = {};
  put(0, {{0, 1, 2}, {outside, outside, outside}});
  while (!long_.empty() && parts_.size() <= most) {
    const LongEdge edge = long_.top();
    long_.pop();
    const int e = find(edge.part, edge.from, edge.to);
    if (e >= 0) halve(edge.part, e);
  }
  for (const Part& part : parts_)
    parts.push_back(
        {corner(part.corners[0]).vertex, corner(part.corners[1]).vertex, corner(part.corners[2]).vertex});
}

/// Which edge of the part that is, or -1.
int NeedleParts::find(int part, int from, int to) const {
  const std::array<int, 3>& corners = at(part).corners;
  for (int e = 0; e < 3; ++e)
    if (corners[slot(e)] == from && corners[slot(next(e))] == to) return e;
  return -1;
}

/// Is c strictly left of the edge from a to b?
bool NeedleParts::is_left(int a, int b, int c) const {
  const Corner &p = corner(a), &q = corner(b), &r = corner(c);
  return (q.x - p.x) * (r.y - p.y) > (q.y - p.y) * (r.x - p.x);
}

/// And tells those across, and which edges are long.
void NeedleParts::put(int part, const Part& what) {
  parts_[slot(part)] = what;
  for (int e = 0; e < 3; ++e) {
    const int a = what.corners[slot(e)], b = what.corners[slot(next(e))], other = what.across[slot(e)];
    if (other != outside)
      if (const int back = find(other, b, a); back >= 0) parts_[slot(other)].across[slot(back)] = part;
    if (edges_.is_long(corner(a).vertex, corner(b).vertex))
      long_.push({other == outside, length2(a, b), a, b, part});
  }
}

void NeedleParts::halve(int part, int e) {
  const int first = static_cast<int>(parts_.size());
  const int other = at(part).across[slot(e)];
  if (other == outside ? halve_side(part, e) : halve_between(part, e)) {
    std::vector<int> changed{part, first};
    if (other != outside) changed.insert(changed.end(), {other, first + 1});
    flip_around(std::move(changed));
  }
}

/// False if the middle is no point of the coordinates.
bool NeedleParts::halve_side(int part, int e) {
  const Part was = at(part);
  const int a = was.corners[slot(e)], b = was.corners[slot(next(e))], c = was.corners[slot(next(next(e)))];
  const std::int64_t x = corner(a).x + corner(b).x, y = corner(a).y + corner(b).y;
  if (x % 2 != 0 || y % 2 != 0) return false;
  const int m = static_cast<int>(corners_.size()), added = static_cast<int>(parts_.size());
  corners_.push_back({edges_.middle(corner(a).vertex, corner(b).vertex), x / 2, y / 2});
  parts_.emplace_back(Part{{m, b, c}, {}});
  const int ca = was.across[slot(next(next(e)))], bc = was.across[slot(next(e))];
  put(part, {{a, m, c}, {outside, added, ca}});
  put(added, {{m, b, c}, {outside, bc, part}});
  return true;
}

NeedleParts::Quad NeedleParts::quad_at(int part, int e) const {
  const Part& here = at(part);
  const int a = here.corners[slot(e)], b = here.corners[slot(next(e))], other = here.across[slot(e)];
  const Part& there = at(other);
  const int f = find(other, b, a);
  return {a,
          b,
          here.corners[slot(next(next(e)))],
          there.corners[slot(next(next(f)))],
          here.across[slot(next(e))],
          here.across[slot(next(next(e)))],
          there.across[slot(next(f))],
          there.across[slot(next(next(f)))],
          other};
}

/// False if the middle, rounded, is not strictly within the two parts.
bool NeedleParts::halve_between(int part, int e) {
  const auto [a, b, c, d, bc, ca, ad, db, other] = quad_at(part, e);
  const int m = static_cast<int>(corners_.size()), added = static_cast<int>(parts_.size());
  corners_.push_back({VertexId(), (corner(a).x + corner(b).x) / 2, (corner(a).y + corner(b).y) / 2});
  if (!is_left(a, m, c) || !is_left(m, b, c) || !is_left(b, m, d) || !is_left(m, a, d)) {
    corners_.pop_back();
    return false;
  }
  corners_.back().vertex = edges_.middle_within(corner(a).vertex, corner(b).vertex);
  parts_.emplace_back(Part{{m, b, c}, {}});
  parts_.emplace_back(Part{{b, m, d}, {}});
  put(part, {{a, m, c}, {other, added, ca}});
  put(added, {{m, b, c}, {added + 1, bc, part}});
  put(other, {{m, a, d}, {part, ad, added + 1}});
  put(added + 1, {{b, m, d}, {added, other, db}});
  return true;
}

/// Flips edges of these parts, and then of those that this changes, as long as that makes them shorter.
void NeedleParts::flip_around(std::vector<int> waiting) {
  while (!waiting.empty()) {
    const int part = waiting.back();
    waiting.pop_back();
    for (int e = 0; e < 3; ++e) {
      const int other = at(part).across[slot(e)];
      if (other == outside || !flip(part, e)) continue;
      waiting.insert(waiting.end(), {part, other});
      break;
    }
  }
}

/// The other diagonal of the two parts at the edge, if it is shorter and within them.
bool NeedleParts::flip(int part, int e) {
  const auto [a, b, c, d, bc, ca, ad, db, other] = quad_at(part, e);
  if (!(length2(c, d) < length2(a, b)) || !is_left(a, d, c) || !is_left(d, b, c)) return false;
  put(part, {{a, d, c}, {ad, other, ca}});
  put(other, {{d, b, c}, {db, bc, part}});
  return true;
}

}  // namespace fpo
