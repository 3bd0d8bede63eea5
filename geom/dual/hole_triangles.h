#pragma once
// How the hole that a site leaves is filled: by triangles of the rim, guessed in a plane, each with the
// circle where the axis of its sites meets the surface.

#include <array>
#include <span>
#include <vector>

#include "geom/dual/surroundings.h"

namespace geom {

class HoleTriangles {
 public:
  /// Sites by their places on the rim, counterclockwise.
  struct Triangle {
    std::array<int, 3> corners;
    /// Opposite to each corner: a triangle of the hole, or -1 - the edge of the rim from that place on.
    std::array<int, 3> beyond;
    FacetId facet;
    SurfacePoint point;
    Frame::Values values;  ///< there
  };

  /// Keeps a reference.
  explicit HoleTriangles(Surroundings& around) : around_(around) {}

  /// Fills the hole, so that no circle holds a site of the rim; p is the frame's origin. False: not certain.
  bool fill();
  std::span<const Triangle> all() const { return triangles_; }

 private:
  FacetId start() const;
  bool flatten_rim();
  bool find_circles();
  bool recall();
  void remember() const;
  bool guess();
  int apex(int first, int last) const;
  bool find_circle(Triangle& triangle, FacetId start);
  bool flip_until_empty();
  void flip(int i, int e, int j, int f);
  Triangle& numbered(int i) { return triangles_[static_cast<std::size_t>(i)]; }

  Surroundings& around_;
  std::vector<double> x_, y_;  ///< the rim in its plane, from p
  std::vector<Triangle> triangles_;
  bool are_flipped_ = false;  ///< since they were guessed
};

}  // namespace geom
