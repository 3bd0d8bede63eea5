#pragma once
// Which facets come near a location: boxes about runs of a space-filling curve.

#include <functional>
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
  struct Box {
    float low[4], high[4];  ///< the last one: levels
    void extend(const Box& other);
    /// Is its squared distance from x at most that?
    bool comes_near(const Location3& x, double limit2) const;
  };
  static constexpr std::size_t arity = 4;

  template <class Skip>
  void search(double limit2, const Location3& x, const Skip& is_of_no_use, std::vector<FacetId>& out) const;
  template <class Skip>
  void descend(std::size_t level, std::size_t node, double limit2, const Location3& x,
               const Skip& is_of_no_use, std::vector<FacetId>& out) const;

  std::vector<FacetId> order_;
  std::vector<std::vector<Box>> levels_;  ///< of runs of 4, 16, 64, ... facets; the last one has one box
};

}  // namespace geom
