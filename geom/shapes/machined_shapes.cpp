#include "geom/shapes/machined_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "geom/shapes/layers.h"
#include "geom/shapes/mesh_parts.h"

namespace geom {
namespace {

using std::numbers::pi;

Vec2 polar(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

}  // namespace

// Prisms.

TriMesh wedge(int size) {
  PlanarCells plan;
  plan.add_triangle({0, 0}, {1, 0}, polar(1, pi / 12));
  return subdivided(prism(plan, 0.5), size);
}

TriMesh star(int size) {
  PlanarCells plan;
  std::vector<Vec2> outline;
  outline.reserve(10);
  for (int i = 0; i < 10; ++i) outline.push_back(polar(i % 2 == 0 ? 1 : 0.3, i * pi / 5));
  plan.add_fan({0, 0}, outline);
  return subdivided(prism(plan, 0.4), size);
}

TriMesh gear(int size) {
  constexpr int teeth = 16;
  std::vector<Vec2> outline, bore;
  for (int i = 0; i < 4 * teeth; ++i) {
    const double lean = i % 4 == 2 ? 0.15 : i % 4 == 3 ? -0.15 : 0;  // tips are narrower than roots
    outline.push_back(polar(i % 4 < 2 ? 0.8 : 1, (i + lean) * 2 * pi / (4 * teeth)));
    bore.push_back(polar(0.35, i * 2 * pi / (4 * teeth)));
  }
  PlanarCells plan;
  plan.add_ring(outline, bore);
  return subdivided(prism(plan, 0.3), size);
}

namespace {

constexpr int steps_a_side = 6;

/// The unit square with its lower left corner at (i, j), counterclockwise from there. Sides of neighbours
/// have the same points.
std::vector<Vec2> square_outline(int i, int j) {
  const auto at = [](int cell, int step) { return cell + step / double(steps_a_side); };
  std::vector<Vec2> outline;
  outline.reserve(4 * steps_a_side);
  for (int k = 0; k < steps_a_side; ++k) outline.emplace_back(at(i, k), at(j, 0));
  for (int k = 0; k < steps_a_side; ++k) outline.emplace_back(at(i + 1, 0), at(j, k));
  for (int k = steps_a_side; k > 0; --k)
    outline.emplace_back(k == steps_a_side ? at(i + 1, 0) : at(i, k), at(j + 1, 0));
  for (int k = steps_a_side; k > 0; --k)
    outline.emplace_back(at(i, 0), k == steps_a_side ? at(j + 1, 0) : at(j, k));
  return outline;
}

}  // namespace

TriMesh hole_plate(int size) {
  constexpr int columns = 6, rows = 3;
  constexpr double radius = 0.25, rim = 0.05;
  PlanarCells plan;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const std::vector<Vec2> outline = square_outline(i, j);
      if (j > 0 && j + 1 < rows) {
        plan.add_fan({i + 0.5, j + 0.5}, outline);
        continue;
      }
      const Vec2 middle(i + 0.5, j == 0 ? radius + rim : rows - radius - rim);
      std::vector<Vec2> hole;
      for (std::size_t k = 0; k < outline.size(); ++k)
        hole.push_back(middle +
                       polar(radius, 2 * pi * static_cast<double>(k) / double(outline.size()) - 3 * pi / 4));
      plan.add_ring(outline, hole);
    }
  return subdivided(prism(plan, 0.4), size);
}

TriMesh rib(int size) {
  constexpr double thick = 0.15, reach = 0.7;
  const auto block = [](PlanarCells& plan, const Vec2& low, const Vec2& high) {
    plan.add_quad(low, {high.x(), low.y()}, high, {low.x(), high.y()});
  };
  PlanarCells plan;
  const std::size_t gusset = plan.add_triangle({thick, thick}, {reach, thick}, {thick, reach});
  block(plan, {0, 0}, {thick, thick});
  block(plan, {thick, 0}, {reach, thick});
  block(plan, {reach, 0}, {1, thick});
  block(plan, {0, thick}, {thick, reach});
  block(plan, {0, reach}, {thick, 1});
  const auto is_solid = [&](std::size_t cell, std::size_t slab) { return cell != gusset || slab == 1; };
  return subdivided(layered_surface({plan, {0, 0.47, 0.53, 1}, is_solid}), size);
}

// Turned.

namespace {

TriMesh turned(const std::vector<Vec2>& profile, double radius, int size) {
  return revolved(refined(profile, false, 2 * pi * radius / size), false, size);
}

}  // namespace

TriMesh shaft(int size) {
  constexpr double fillet = 0.02;
  constexpr int steps = 5;
  std::vector<Vec2> profile{{0, 0}, {0.3, 0}};
  /// A quarter of a circle about the middle, from one angle to the other.
  const auto round = [&](const Vec2& middle, double from, double to) {
    for (int i = 0; i <= steps; ++i)
      profile.push_back(middle + polar(fillet, from + (to - from) * i / steps));
  };
  round({0.3 + fillet, 0.6 - fillet}, pi, pi / 2);
  profile.insert(profile.end(), {Vec2(0.5, 0.6), Vec2(0.5, 1)});
  round({0.35 + fillet, 1 + fillet}, 3 * pi / 2, pi);
  profile.insert(profile.end(), {Vec2(0.35, 1.8), Vec2(0, 1.8)});
  return turned(profile, 0.5, size);
}

TriMesh cone_plate(int size) { return turned({{0, 0}, {1, 0}, {1, 0.15}, {0.5, 0.15}, {0, 1.15}}, 1, size); }

// Of curved patches.

namespace {

/// Patches sewn together where their points are the same to the bit.
class Patches {
 public:
  /// Quadrilaterals between the points (i, j), 0 <= i <= width, 0 <= j <= height; what has no area is left
  /// out. Outside is where i, j and the normal are a right-handed frame.
  template <class Point>
  void add(int width, int height, Point point) {
    for (int i = 0; i < width; ++i)
      for (int j = 0; j < height; ++j) {
        const VertexId a = vertex(point(i, j)), b = vertex(point(i + 1, j)), c = vertex(point(i + 1, j + 1)),
                       d = vertex(point(i, j + 1));
        if (a != b && b != c && c != a) mesh_.add_triangle(a, b, c);
        if (a != c && c != d && d != a) mesh_.add_triangle(a, c, d);
      }
  }
  VertexId vertex(const Vec3& p) {
    const auto [entry, is_new] = ids_.try_emplace({p.x(), p.y(), p.z()});
    if (is_new) entry->second = mesh_.add(p);
    return entry->second;
  }
  void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    mesh_.add_triangle(vertex(a), vertex(b), vertex(c));
  }
  TriMesh take() { return mesh_.take(); }

 private:
  MeshArrays mesh_;
  std::map<std::array<double, 3>, VertexId> ids_;
};

/// A cylinder of radius 1 about the x axis; one of radius .6 about the z axis grows out of it.
class TwoCylinders {
 public:
  explicit TwoCylinders(int size) : size_(size) {}

  TriMesh build() {
    Patches patches;
    const int half = size_ * 2;                        // of the sides of the square around the hole
    const int around = 12 * size_, length = 4 * half;  // steps of the larger cylinder
    patches.add(length, around - 2 * half, [&](int i, int j) { return on_large(i - length / 2, half + j); });
    for (const int side : {0, 1})
      patches.add(half, 2 * half,
                  [&](int i, int j) { return on_large(side == 0 ? i - 2 * half : half + i, j - half); });
    patches.add(8 * half, size_, [&](int i, int j) { return around_hole(i, size_ - j); });
    patches.add(8 * half, half, [&](int i, int j) { return on_small(i, j); });
    patches.add(8 * half, size_, [&](int i, int j) { return on_top(i, j); });
    for (const int end : {-1, 1})
      patches.add(around, size_, [&](int i, int j) -> Vec3 {
        const Vec3 p = on_large(end * 2 * half, -end * i);
        const double share = (size_ - j) / double(size_);
        return {p.x(), share * p.y(), share * p.z()};
      });
    return patches.take();
  }

 private:
  static constexpr double small = 0.6, height = 2;

  static Vec3 on_large(const Vec2& unrolled) {
    return {unrolled.x(), std::sin(unrolled.y()), std::cos(unrolled.y())};
  }
  /// Steps along the axis from the middle, and around from the top.
  Vec2 unrolled(int i, int j) const {
    const int around = 12 * size_;
    const int j_once = ((j + around / 2) % around + around) % around - around / 2;
    return {i / (2.0 * size_), 2 * pi * j_once / around};
  }
  Vec3 on_large(int i, int j) const { return on_large(unrolled(i, j)); }

  /// The square around the hole, counterclockwise from above, from a corner on.
  Vec2 on_square(int i) const {
    const int half = size_ * 2, side = 2 * half;
    i %= 4 * side;
    const int k = i % side - half;
    switch (i / side) {
      case 0:
        return unrolled(half, k);
      case 1:
        return unrolled(-k, half);
      case 2:
        return unrolled(-half, -k);
      default:
        return unrolled(k, -half);
    }
  }
  Vec2 on_circle(int i) const {
    const int steps = 16 * size_;
    return polar(small, 2 * pi * (i % steps) / steps - pi / 4);
  }
  Vec3 around_hole(int i, int j) const {
    const Vec2 circle = on_circle(i), hole(circle.x(), std::asin(circle.y()));
    const double share = j / double(size_);
    return on_large(Vec2(share * on_square(i) + (1 - share) * hole));
  }
  Vec3 on_small(int i, int j) const {
    const Vec3 low = around_hole(i, 0);
    const double share = j / (2.0 * size_);
    return {low.x(), low.y(), (1 - share) * low.z() + share * height};
  }
  Vec3 on_top(int i, int j) const {
    const Vec3 rim = around_hole(i, 0);
    const double share = (size_ - j) / double(size_);
    return {share * rim.x(), share * rim.y(), height};
  }

  int size_;
};

}  // namespace

TriMesh two_cylinders(int size) { return TwoCylinders(size).build(); }

namespace {

/// A thread on a core of radius 1: rows of points follow the helix, `flank` of them to a flank.
class Screw {
 public:
  explicit Screw(int size) : size_(size), flank_(std::max(1, static_cast<int>(pitch * size / 10))) {}

  TriMesh build() {
    Patches patches;
    patches.add(size_, rows(), [&](int i, int j) { return on_thread(i, j); });
    for (const bool top : {false, true}) {
      // The wall between the first or last row, which rises by a pitch, and the plane below or above.
      for (int i = 0; i < size_; ++i) add_wall(patches, i, top);
      for (int i = 0; i < size_; ++i) {
        const Vec3 a = on_rim(i, top), b = on_rim(i + 1, top), middle(0, 0, a.z());
        patches.add_triangle(middle, top ? a : b, top ? b : a);
      }
    }
    return patches.take();
  }

 private:
  static constexpr int turns = 8;
  static constexpr double pitch = 0.4, depth = 0.3, rest = 0.4;  // rest: core beyond the thread

  int rows() const { return 2 * flank_ * turns; }

  /// On the helix i steps around and j rows up; a turn has as many rows as two flanks.
  Vec3 on_thread(int i, int j) const {
    if (i == size_) i = 0, j += 2 * flank_;
    const double turn = i / double(size_) + j / (2.0 * flank_);  // z in pitches
    const double fade = std::clamp(std::min(turn - 1, turns - turn) / 1.5, 0.0, 1.0);
    const double tooth = 1 - std::abs((j % (2 * flank_)) / double(flank_) - 1);
    const Vec2 p = polar(1 + depth * fade * tooth, 2 * pi * i / size_);
    return {p.x(), p.y(), pitch * turn};
  }
  Vec3 on_rim(int i, bool top) const {
    const Vec2 p = polar(1, 2 * pi * (i % size_) / size_);
    return {p.x(), p.y(), top ? pitch * (turns + 1) + rest : -rest};
  }

  void add_wall(Patches& patches, int i, bool top) const {
    std::vector<Vec3> polygon;  // counterclockwise at the bottom; its first corner sees all of it
    if (!top) {
      polygon = {on_thread(i, 0), on_rim(i, top), on_rim(i + 1, top)};
      if (i + 1 == size_)
        for (int j = 0; j < 2 * flank_; ++j) polygon.push_back(on_thread(0, j));
      polygon.push_back(on_thread(i + 1, 0));
    } else {
      polygon = {on_thread(i + 1, rows())};
      polygon.push_back(on_rim(i + 1, top)), polygon.push_back(on_rim(i, top));
      if (i == 0)
        for (int j = 2 * flank_; j > 0; --j) polygon.push_back(on_thread(0, rows() + j));
      polygon.push_back(on_thread(i, rows()));
    }
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
      patches.add_triangle(polygon[0], polygon[k], polygon[k + 1]);
  }

  int size_, flank_;
};

}  // namespace

TriMesh screw(int size) { return Screw(size).build(); }

}  // namespace geom
