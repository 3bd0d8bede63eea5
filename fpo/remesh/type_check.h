#pragma once
// Is a remesh of the topological type of its input? Part by part, each part of the input known by the samples
// on it.

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "fpo/remesh/defects.h"
#include "fpo/surface/surface_sample.h"
#include "geom/mesh/surface_type.h"

namespace fpo {

/// The type of the input, what it is between its edges of more than two facets if there are such, and the
/// edges of the remesh that are to have more than two.
struct WantedType : geom::SurfaceType {
  /// Of a surface that does not branch.
  WantedType(geom::SurfaceType type) : geom::SurfaceType(std::move(type)) {}
  WantedType(const geom::TriMesh& input, BranchEdges edges)
      : geom::SurfaceType(geom::surface_type(input)), branch_edges(std::move(edges)) {
    if (branches) pieces = geom::pieces_between_branches(input);
  }
  BranchEdges branch_edges;
  std::vector<geom::PartType> pieces;  ///< ascending
};

/// Numbers of what differs; all are 0 if the remesh is a 2-manifold, but for edges where it is not to be, of
/// the input's type. Of an input that is no manifold the type is that of geom::SurfaceType.
struct TypeCheck {
  std::size_t nonmanifold_edges = 0, nonmanifold_vertices = 0;  ///< of the remesh, where they are not to be
  std::size_t bare_samples = 0;                                 ///< without a triangle
  std::size_t lost_parts = 0;    ///< parts of the input of which nothing is left
  std::size_t joined_parts = 0;  ///< parts of the remesh with samples of several parts of the input
  std::size_t split_parts = 0;   ///< parts of the input that are several
  /// Parts of the input with another Euler number, number of border loops, or orientability: a handle or a
  /// hole was lost, or one was made.
  std::size_t changed_parts = 0;
  /// Of an input that branches: pieces between its edges of more than two facets that the remesh has not, and
  /// others that it has.
  std::size_t lost_pieces = 0, new_pieces = 0;
  std::size_t doubled_facets = 0;  ///< of the remesh: that have their vertices in common with another
  /// Of the input, ascending: those that are lost, joined, split or changed, or of which facets are doubled.
  std::vector<std::size_t> parts;

  bool is_manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
  /// Whether parts correspond, whatever the remesh is at single edges and vertices.
  bool same_parts() const { return parts.empty(); }
  bool same_pieces() const { return lost_pieces == 0 && new_pieces == 0; }
  bool ok() const { return is_manifold() && bare_samples == 0 && same_parts() && same_pieces(); }
};

/// Vertex i of the remesh is sample i, in facet i of these. O(F log F) of the remesh.
TypeCheck check_type(const WantedType& input, const geom::TriMesh& remesh,
                     std::span<const geom::FacetId> facets);
TypeCheck check_type(const WantedType& input, const geom::TriMesh& remesh,
                     std::span<const SurfaceSample> samples);

}  // namespace fpo
