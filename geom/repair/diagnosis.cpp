#include "geom/repair/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "geom/mesh/half_edges.h"
#include "geom/mesh/scaling.h"
#include "geom/repair/copies.h"
#include "geom/repair/flat_facets.h"
#include "geom/repair/holes.h"
#include "geom/repair/orient.h"
#include "geom/repair/parts.h"
#include "geom/repair/repair.h"
#include "geom/repair/repeated.h"
#include "geom/repair/spikes.h"
#include "geom/repair/weld.h"

namespace geom {
namespace {

using Facets = Table<FacetId, TriMesh::Facet>;

void look_at_borders(const TriMesh& unit, double factor, Diagnosis& found) {
  double area = 0;
  for (const MeshPart& part : mesh_parts(unit.vertices(), unit.facets())) area += part.area;
  const HoleLimits limits = usual_holes(unit.diagonal(), area);
  for (const BorderLoop& loop : border_loops(unit.vertices(), unit.facets())) {
    found.border_lengths.push_back(loop.length / factor);
    found.holes += is_hole(loop, limits);
  }
  if (!found.border_lengths.empty())
    found.weld_tolerance = wider_tolerance(unit.vertices(), unit.facets(), factor) / factor;
  std::ranges::sort(found.border_lengths, std::greater());
}

std::size_t split_vertices(const TriMesh& unit, const Places& places) {
  std::set<VertexId> border;
  const std::vector<HalfEdge> half_edges = sorted_half_edges(unit.facets());
  for_each_edge(half_edges, [&](auto first, auto last) {
    if (last - first == 1) border.insert({first->low, first->high});
  });
  std::size_t count = 0;
  Table<VertexId, char> taken(places.size(), 0);
  for (const VertexId v : border) count += taken[places[v]]++ > 0 ? 1 : 0;
  return count;
}

void look_at_parts(const TriMesh& unit, Diagnosis& found) {
  Facets facets = unit.facets();
  const std::vector<MeshPart> parts = mesh_parts(unit.vertices(), facets);
  found.parts = parts.size();
  for (const MeshPart& part : parts) found.stray_facets += part.facets.size() == 1;
  found.tiny_parts = drop_crumbs(unit.vertices(), facets, {});
  facets = unit.facets();
  const Orientation turned = orient(unit.vertices(), facets);
  found.inverted_facets = turned.inverted;
  found.inside_out_parts = turned.parts_turned;
  found.one_sided_parts = turned.one_sided;
  found.copies = drop_copies(unit.vertices(), facets, usual_copy_distance * unit.diagonal());
}

}  // namespace

Diagnosis diagnosis(const TriMesh& mesh, bool with_intersections) {
  Diagnosis found;
  const double factor = factor_to_unit_box(mesh);
  const TriMesh unit = scaled_to_unit_box(mesh, factor);
  found.topology = topology(mesh);
  const Places places = exact_places(unit.vertices());
  for (const auto& [a, b, c] : unit.facets())
    found.degenerate_facets += collinear(unit.position(a), unit.position(b), unit.position(c));
  Facets facets = unit.facets();
  found.duplicate_facets = drop_repeated(facets) + drop_doubled(places, facets);
  found.spikes = spikes(unit.vertices(), unit.facets()).size();
  found.split_vertices = split_vertices(unit, places);
  look_at_borders(unit, factor, found);
  look_at_parts(unit, found);
  if (with_intersections) found.intersections = self_intersections(unit);
  return found;
}

std::string in_words(const Diagnosis& found) {
  std::string text;
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + (count == 1 ? one : many);
  };
  const Topology& t = found.topology;
  add(t.nonmanifold_edges, "non-manifold edge", "non-manifold edges");
  if (t.nonmanifold_edges == 0) add(t.nonmanifold_vertices, "non-manifold vertex", "non-manifold vertices");
  const bool in_pieces = found.stray_facets > 1 && 2 * found.stray_facets > t.facets;
  if (in_pieces) add(found.stray_facets, "facet without a neighbour", "facets without a neighbour");
  if (!in_pieces) add(found.holes, "hole", "holes");
  if (found.weld_tolerance > 0) text += (text.empty() ? "" : ", ") + std::string("borders that nearly meet");
  add(found.split_vertices, "split vertex", "split vertices");
  add(found.tiny_parts, "crumb", "crumbs");
  add(found.copies, "part that lies on another", "parts that lie on another");
  add(found.spikes, "spike", "spikes");
  add(found.one_sided_parts > 0 ? 0 : found.inverted_facets, "inverted facet", "inverted facets");
  return text;
}

}  // namespace geom
