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
    AxisPlace meeting;     ///< of the axis of its sites with the surface
    SurfacePoint point;    ///< there
    Frame::Values values;  ///< there
    FacetId facet() const { return meeting.facet; }
  };

  /// Keeps a reference.
  explicit HoleTriangles(Surroundings& around) : around_(around) {}

  /// Fills the hole, so that no circle holds a site of the rim; p is the frame's origin. False: not certain.
  bool fill();
  std::span<const Triangle> all() const { return {triangles_.data(), size_}; }

 private:
  FacetId start() const;
  bool flatten_rim();
  bool find_circles();
  bool recall();
  void remember() const;
  bool guess();
  int apex(int first, int last) const;
  bool find_circle(Triangle& triangle, FacetId start);
  bool are_empty() const;
  bool flip_until_empty();
  void flip(int i, int e, int j, int f);
  std::span<Triangle> all() { return {triangles_.data(), size_}; }
  Triangle& numbered(int i) { return triangles_[static_cast<std::size_t>(i)]; }

  Surroundings& around_;
  std::vector<double> x_, y_;  ///< the rim in its plane, from p
  std::array<Triangle, Rim::most> triangles_;
  std::size_t size_ = 0;
  bool are_flipped_ = false;  ///< since they were guessed
};

}  // namespace geom
