#include "geom/mesh/surface_type.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "geom/mesh/edges.h"
#include "geom/mesh/opened_mesh.h"
#include "geom/mesh/vertex_fans.h"

namespace geom {
namespace {

/// Which parts have a way round after which left is right: a facet and its mirror image, two nodes each, are
/// joined across edges of two facets as these run; where both come together the part is one-sided. Where all
/// run alike nothing can.
void find_one_sided(const TriMesh& mesh, SurfaceType& type) {
  bool run_alike = true;
  for_each_edge(mesh, [&](auto first, auto last) {
    run_alike &= last - first != 2 || first[0].ascending != first[1].ascending;
  });
  if (run_alike) return;
  const std::size_t count = type.part_of.size();
  DisjointSets sides(2 * count);
  for_each_edge(mesh, [&](auto first, auto last) {
    if (last - first != 2) return;
    const std::size_t a = first[0].facet.index(), b = first[1].facet.index();
    const std::size_t turned = first[0].ascending == first[1].ascending ? count : 0;
    sides.merge(a, b + turned);
    sides.merge(a + count, b + (count - turned));
  });
  for (std::size_t t = 0; t < count; ++t)
    if (sides.find(t) == sides.find(t + count)) type.parts[type.part_of[FacetId(t)]].orientable = false;
}

std::size_t corner_at(const TriMesh& mesh, FacetId t, VertexId v) {
  const TriMesh::Facet& f = mesh.facet(t);
  return 3 * t.index() + static_cast<std::size_t>(std::ranges::find(f, v) - f.begin());
}

/// The sheets at vertices by numbers below `count`.
class NumberedSheets {
 public:
  explicit NumberedSheets(const TriMesh& mesh) : mesh_(mesh), count_(mesh.num_vertices()) {
    const VertexFans fans(mesh);
    bool are_manifold = true;
    for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
      are_manifold &= fans.is_manifold(v);
    if (are_manifold) return;
    count_ = 3 * mesh.num_facets();
    corners_ = sheets_at_vertices(mesh);
  }
  std::size_t count() const { return count_; }
  /// That of facet t at its corner v.
  std::size_t at(FacetId t, VertexId v) {
    return corners_ ? corners_->find(corner_at(mesh_, t, v)) : v.index();
  }

 private:
  const TriMesh& mesh_;
  std::size_t count_;
  std::optional<DisjointSets> corners_;  ///< none if each vertex has one sheet
};

/// Vertices and their borders, counted once for each sheet.
void count_at_vertices(const TriMesh& mesh, SurfaceType& type) {
  NumberedSheets sheets(mesh);
  DisjointSets loops(0);
  std::vector<char> on_border;  // both of no size if there is no border
  for_each_edge(mesh, [&](auto first, auto last) {
    type.branches |= last - first > 2;
    if (last - first != 1) return;
    const std::size_t a = sheets.at(first->facet, first->low), b = sheets.at(first->facet, first->high);
    if (on_border.empty()) {
      on_border.assign(sheets.count(), 0);
      loops = DisjointSets(sheets.count());
    }
    on_border[a] = on_border[b] = 1;
    loops.merge(a, b);
  });
  std::vector<char> counted(sheets.count(), 0), sheets_of(mesh.num_vertices(), 0);  // 2: several
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (const VertexId v : mesh.facet(t)) {
      const std::size_t sheet = sheets.at(t, v);
      if (std::exchange(counted[sheet], 1) == 1) continue;
      PartType& part = type.parts[type.part_of[t]];
      ++part.euler;
      part.border_loops += !on_border.empty() && on_border[sheet] && loops.find(sheet) == sheet;
      char& sheets_here = sheets_of[v.index()];
      type.split_vertices += sheets_here == 1;
      if (sheets_here < 2) ++sheets_here;
    }
}

}  // namespace

DisjointSets sheets_at_vertices(const TriMesh& mesh) {
  DisjointSets sheets(3 * mesh.num_facets());
  for_each_edge(mesh, [&](auto first, auto last) {
    for (auto h = first + 1; h != last; ++h)
      for (const VertexId v : {h->low, h->high})
        sheets.merge(corner_at(mesh, first->facet, v), corner_at(mesh, h->facet, v));
  });
  return sheets;
}

PartType SurfaceType::whole() const {
  PartType sum;
  for (const PartType& part : parts) {
    sum.euler += part.euler;
    sum.border_loops += part.border_loops;
    sum.orientable &= part.orientable;
  }
  return sum;
}

namespace {

/// Facets that hang together by edges are a part; its Euler number so far is that of facets and edges alone.
void find_parts(const TriMesh& mesh, SurfaceType& type) {
  DisjointSets joined(mesh.num_facets());
  for_each_edge(mesh, [&](auto first, auto last) {
    for (auto h = first + 1; h != last; ++h) joined.merge_to_least(first->facet.index(), h->facet.index());
  });
  type.part_of.reserve(mesh.num_facets());
  for (std::size_t t = 0; t < mesh.num_facets(); ++t) {
    const std::size_t first = joined.find(t);
    const bool is_new = first == t;
    type.part_of.push_back(is_new ? static_cast<std::uint32_t>(type.parts.size())
                                  : type.part_of[FacetId(first)]);
    if (is_new) type.parts.emplace_back();
    ++type.parts[type.part_of.back()].euler;
  }
  for_each_edge(mesh, [&](auto first, auto) { --type.parts[type.part_of[first->facet]].euler; });
}

}  // namespace

SurfaceType surface_type(const TriMesh& mesh) {
  SurfaceType type;
  find_parts(mesh, type);
  count_at_vertices(mesh, type);
  find_one_sided(mesh, type);
  return type;
}

namespace {

/// The same surface with a vertex more on each side of an edge of more than two facets: these sides have
/// nothing in common but their ends.
TriMesh with_sides_parted(const TriMesh& mesh) {
  Table<FacetId, std::array<bool, 3>> branches(mesh.num_facets(), {false, false, false});
  for_each_edge(mesh, [&](auto first, auto last) {
    for (auto h = first; h != last; ++h)
      branches[h->facet][static_cast<std::size_t>(h->edge)] = last - first > 2;
  });
  Table<VertexId, Vec3> positions = mesh.vertices();
  Table<FacetId, TriMesh::Facet> facets;
  std::vector<VertexId> around;  // a facet, from a new vertex on if there is one
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    around.clear();
    const std::size_t start =
        static_cast<std::size_t>(std::ranges::find(branches[t], true) - branches[t].begin()) % 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t e = (start + k) % 3;
      around.push_back(mesh.facet(t)[e]);
      if (!branches[t][e]) continue;
      around.emplace_back(positions.size());
      positions.push_back(
          (mesh.corner(t, static_cast<int>(e)) + mesh.corner(t, static_cast<int>((e + 1) % 3))) / 2);
    }
    if (around.size() > 3) std::rotate(around.begin(), around.begin() + 1, around.end());
    for (std::size_t k = 1; k + 1 < around.size(); ++k)
      facets.push_back({around[0], around[k], around[k + 1]});
  }
  return {std::move(positions), std::move(facets)};
}

}  // namespace

std::vector<PartType> pieces_between_branches(const TriMesh& mesh) {
  const TriMesh parted = with_sides_parted(mesh);
  DisjointSets sheets(3 * parted.num_facets());
  for_each_edge(parted, [&](auto first, auto last) {
    if (last - first != 2) return;
    for (const VertexId v : {first->low, first->high})
      sheets.merge(corner_at(parted, first[0].facet, v), corner_at(parted, first[1].facet, v));
  });
  std::vector<PartType> pieces = surface_type(opened(parted, sheets).mesh).parts;
  std::ranges::sort(pieces);
  return pieces;
}

}  // namespace geom
