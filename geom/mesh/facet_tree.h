#pragma once
// Which facets come near a location: boxes about runs of a space-filling curve.

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "geom/mesh/trimesh.h"

namespace geom {

/// A static tree over the facets of a mesh and their levels (levels.h), in single precision: some 15 bytes a
/// facet. Refers to nothing. Distances are of four coordinates.
class FacetTree {
 public:
  /// `order`: all facets, along a curve (facets_along_curve()). O(F).
  FacetTree(const TriMesh& mesh, std::vector<FacetId> order);

  std::span<const FacetId> order() const { return order_; }

  /// Appends all facets that have a point within that distance of x, and some more. Cost: those, times the
  /// logarithm of F at most.
  void near(const Location3& x, double distance, std::vector<FacetId>& out) const;
  /// The same, but facets in balls (center, radius) of which is_of_no_use says so may be left out.
  using OfNoUse = std::function<bool(const Location3&, double)>;
  void near_but(const Location3& x, double distance, const OfNoUse& is_of_no_use,
                std::vector<FacetId>& out) const;

 private:
  static constexpr std::size_t arity = 4;
  struct Box {
    float low[4], high[4];  ///< the last one: levels
    void extend(const Box& other);
  };
  /// A location in floats: the next ones below and above; and a squared distance, rounded up.
  struct Ball {
    Ball(const Location3& x, double distance);
    float low[4], high[4], limit2;
  };
  /// Boxes of four runs of facets, or fewer: a coordinate of all of them is together.
  struct Node {
    Node();
    void set(std::size_t i, const Box& box);
    Box box(std::size_t i) const;
    /// Bit i: the i-th box comes near.
    [[gnu::noinline]] std::uint32_t near(const Ball& ball) const;
    alignas(16) float low[4][arity]{}, high[4][arity]{};
  };

  template <class Skip>
  void descend(std::size_t level, std::size_t node, const Ball& ball, const Skip& is_of_no_use,
               std::vector<FacetId>& out) const;

  std::vector<FacetId> order_;
  /// Of runs of 4, 16, 64, ... facets; the last one is one node.
  std::vector<std::vector<Node>> levels_;
};

}  // namespace geom
