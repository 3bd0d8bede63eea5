#include "geom/dual/edge_part.h"

#include <bit>
#include <cstdint>

namespace geom {

// Along the edge from u to v, site i is nearer than the origin before t_i = g_i(u) / (g_i(u) - g_i(v)) if it
// is so at u, and after t_i if at v. So the origin has what lies after the last t_i of the former and before
// the first of the latter. t_i < t_j iff M_ij = g_i(u) g_j(v) - g_j(u) g_i(v) > 0 for two of the same kind, <
// 0 for two of different kinds.
Meets find_part(const FrameVertices::Vertex& u, const FrameVertices::Vertex& v, EdgePart& out) {
  constexpr int at_vertex = EdgePart::at_vertex;
  out = {};
  for (std::uint32_t set = u.beaten_by; set != 0; set &= set - 1) {
    const int i = std::countr_zero(set);
    if (out.begin == at_vertex) {
      out.begin = i;
      continue;
    }
    const Sure m = determinant(u, v, out.begin, i, Frame::none);
    if (!m.certain()) return Meets::unsure;
    if (m.value > 0) out.begin = i;
  }
  for (std::uint32_t set = v.beaten_by; set != 0; set &= set - 1) {
    const int i = std::countr_zero(set);
    if (out.end == at_vertex) {
      out.end = i;
      continue;
    }
    const Sure m = determinant(u, v, i, out.end, Frame::none);
    if (!m.certain()) return Meets::unsure;
    if (m.value > 0) out.end = i;
  }
  if (out.begin == at_vertex || out.end == at_vertex) return Meets::yes;
  const Sure m = determinant(u, v, out.begin, out.end, Frame::none);
  if (!m.certain()) return Meets::unsure;
  return m.value < 0 ? Meets::yes : Meets::no;
}

// The owners along the part without the origin: at a vertex the nearest site, where it is as near as site i
// that one. If both ends have one owner, all between has. Else the bisectors of consecutive owners meet the
// edge, and a third site that is nearer there comes between.
bool find_owners(const FrameVertices& vertices, const FrameVertices::Vertex& u,
                 const FrameVertices::Vertex& v, const EdgePart& part, std::vector<int>& owners) {
  const int first = part.begin == EdgePart::at_vertex ? vertices.nearest(u) : part.begin,
            last = part.end == EdgePart::at_vertex ? vertices.nearest(v) : part.end;
  if (first < 0 || last < 0) return false;
  owners.assign({first});
  if (first == last) return true;
  owners.push_back(last);
  const int num_sites = vertices.frame().size();
  for (std::size_t k = 0; k + 1 < owners.size();) {
    const int a = owners[k], b = owners[k + 1];
    if (!u.nearer(a, b) || !v.nearer(b, a)) return false;
    int between = -1;  // the nearest there: it owns something
    double most = 0;
    for (int c = 0; c < num_sites; ++c) {
      if (c == a || c == b) continue;
      if (u.nearer(a, c) && v.nearer(a, c)) continue;
      const Sure m = determinant(u, v, a, c, b);  // (g_a - g_b)(u) (g_c - g_b)(v) - ...
      if (!m.certain()) return false;
      if (!(m.value > most)) continue;
      between = c;
      most = m.value;
    }
    if (between >= 0) {
      if (owners.size() > Frame::most) return false;
      owners.insert(owners.begin() + static_cast<std::ptrdiff_t>(k) + 1, between);
    } else {
      ++k;
    }
  }
  return true;
}

}  // namespace geom
