#include "geom/shapes/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "geom/check.h"
#include "geom/rng.h"
#include "geom/shapes/machined_shapes.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/polygonise.h"
#include "geom/shapes/thin_shapes.h"

namespace geom {
namespace {

using std::numbers::pi;

// Smooth and closed.

TriMesh icosahedron() {
  const double g = std::numbers::phi;
  MeshArrays mesh;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) mesh.add({0, a, b}), mesh.add({a, b, 0}), mesh.add({b, 0, a});
  }
  // Its facets are the triples of vertices at mutual distance 2.
  const auto adjacent = [&](std::size_t i, std::size_t j) {
    return (mesh.vertices[VertexId(i)] - mesh.vertices[VertexId(j)]).norm() < 2.1;
  };
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = i + 1; j < 12; ++j) {
      for (std::size_t k = j + 1; k < 12; ++k) {
        if (!adjacent(i, j) || !adjacent(j, k) || !adjacent(k, i)) continue;
        const Vec3 &p = mesh.vertices[VertexId(i)], &q = mesh.vertices[VertexId(j)],
                   &r = mesh.vertices[VertexId(k)];
        const bool outward = p.cross(q).dot(r) > 0;
        mesh.add_triangle(VertexId(i), VertexId(outward ? j : k), VertexId(outward ? k : j));
      }
    }
  }
  return mesh.take();
}

TriMesh sphere(int size) {
  return mapped(subdivided(icosahedron(), size), [](const Vec3& p) -> Vec3 { return p.normalized(); });
}

TriMesh two_spheres(int size) {
  const auto at = [&](double x) {
    return mapped(sphere(size), [x](const Vec3& p) -> Vec3 { return p + Vec3(x, 0, 0); });
  };
  return joined(at(-1.0005), at(1.0005));
}

TriMesh blob(int size, std::uint64_t seed) {
  struct Wave {
    Vec3 direction;
    double phase;
  };
  Rng rng(seed);
  std::array<Wave, 6> waves;
  for (Wave& wave : waves) {
    for (int a = 0; a < 3; ++a) wave.direction[a] = rng.uniform(-4, 4);
    wave.phase = rng.uniform(0, 2 * pi);
  }
  return mapped(sphere(size), [&](const Vec3& u) -> Vec3 {
    double radius = 1;
    for (const Wave& wave : waves) radius += 0.1 * std::sin(wave.direction.dot(u) + wave.phase);
    return u * radius;
  });
}

constexpr double tube = 0.4;  // radius of the tori's tubes; their axes are circles of radius 1

TriMesh torus(int size) {
  const int around_tube = std::max(3, static_cast<int>(std::lround(tube * size)));
  return grid_surface({size, Seam::closed}, {around_tube, Seam::closed}, [](double u, double v) {
    const double r = 1 + tube * std::cos(2 * pi * v);
    return Vec3(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), tube * std::sin(2 * pi * v));
  });
}

/// Distance from the torus about the z axis through (x, 0, 0), and its gradient.
ImplicitSurface::Sample torus_distance(const Vec3& p, double x) {
  const Vec3 flat(p.x() - x, p.y(), 0);
  const double radius = std::max(flat.norm(), 1e-300);
  const double to_axis = std::max(std::hypot(radius - 1, p.z()), 1e-300);
  return {to_axis - tube, (flat * ((radius - 1) / radius) + Vec3(0, 0, p.z())) / to_axis};
}

/// Two tori whose tubes share a stretch, their distances a and b joined by -log(e^-ka + e^-kb) / k.
TriMesh double_torus(int size) {
  constexpr double offset = 1.2, k = 10;
  const auto at = [](const Vec3& p) -> ImplicitSurface::Sample {
    const ImplicitSurface::Sample a = torus_distance(p, -offset), b = torus_distance(p, offset);
    const double nearer = std::min(a.value, b.value);
    const double ea = std::exp(k * (nearer - a.value)), eb = std::exp(k * (nearer - b.value));
    return {nearer - std::log(ea + eb) / k, (a.gradient * ea + b.gradient * eb) / (ea + eb)};
  };
  const Vec3 half(offset + 1 + tube + 0.25, 1 + tube + 0.25, tube + 0.25);
  return polygonised({at, Box3(-half, half)}, size);
}

// Blocks.

TriMesh cube(int size) {
  return block_surface({{{{0, 1}, {0, 1}, {0, 1}}}, {size, size, size}, [](int, int, int) { return true; }});
}

TriMesh l_block(int size) {
  const auto solid = [](int i, int j, int) { return i == 0 || j == 0; };
  return block_surface({{{{0, 0.5, 1}, {0, 0.5, 1}, {0, 0.5}}}, {size, size, size}, solid});
}

TriMesh frame(int size) {
  const auto solid = [](int i, int j, int) { return i != 1 || j != 1; };
  return block_surface({{{{0, 1, 2, 3}, {0, 1, 2, 3}, {0, 1}}}, {size, size, size}, solid});
}

TriMesh thin_plate(int size) {
  return block_surface(
      {{{{0, 1}, {0, 1}, {0, 1.0 / 500}}}, {size, size, 1}, [](int, int, int) { return true; }});
}

// Turned. Profiles run from the axis at the bottom to the axis at the top, or counterclockwise.

TriMesh turned(const std::vector<Vec2>& profile, bool closed, int size) {
  double radius = 0;
  for (const Vec2& p : profile) radius = std::max(radius, p.x());
  return revolved(refined(profile, closed, 2 * pi * radius / size), closed, size);
}

TriMesh cylinder(int size) { return turned({{0, -1}, {1, -1}, {1, 1}, {0, 1}}, false, size); }
TriMesh cone(int size) { return turned({{0, 0}, {0.5, 0}, {0, 2}}, false, size); }
TriMesh tube_surface(int size) { return turned({{1, -1}, {1, 1}}, false, size); }

TriMesh joint(int size) {
  return turned({{0.4, 0}, {1.5, 0}, {1.5, 0.4}, {0.9, 0.4}, {0.9, 1.6}, {0.8, 1.8}, {0.4, 1.8}}, true, size);
}

// With a border.

TriMesh square(int size) {
  return grid_surface({size, Seam::open}, {size, Seam::open},
                      [](double u, double v) { return Vec3(u, v, 0); });
}

TriMesh triangle(int size) {
  MeshArrays mesh;
  mesh.add_triangle(mesh.add({0, 0, 0}), mesh.add({1, 0, 0}), mesh.add({0.5, std::sqrt(0.75), 0}));
  return subdivided(mesh.take(), size);
}

/// The hexagons about the middle of a subdivided hexagon become circles.
TriMesh wave_disk(int size) {
  MeshArrays hexagon;
  hexagon.add({0, 0, 0});
  for (int i = 0; i < 6; ++i) hexagon.add({std::cos(i * pi / 3), std::sin(i * pi / 3), 0});
  for (int i = 0; i < 6; ++i) hexagon.add_triangle(VertexId(0), VertexId(1 + i), VertexId(1 + (i + 1) % 6));
  return mapped(subdivided(hexagon.take(), size), [](const Vec3& p) -> Vec3 {
    double reach = 0;  // 1 on the hexagon's border
    for (int i = 0; i < 6; ++i) {
      const double angle = (i + 0.5) * pi / 3;
      reach = std::max(reach, (p.x() * std::cos(angle) + p.y() * std::sin(angle)) / std::sqrt(0.75));
    }
    const double r = p.norm();
    const Vec3 on_disk = r == 0 ? p : Vec3(p * (reach / r));
    return {on_disk.x(), on_disk.y(), 0.15 * std::sin(5 * on_disk.x()) * std::cos(4 * on_disk.y())};
  });
}

TriMesh moebius(int size) {
  const int across = std::max(1, size / 8);
  return grid_surface({size, Seam::reversed}, {across, Seam::open}, [](double u, double v) {
    const double s = 0.8 * (v - 0.5), r = 1 + s * std::cos(pi * u);
    return Vec3(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), s * std::sin(pi * u));
  });
}

struct Shape {
  ShapeInfo info;
  TriMesh (*build)(int size);
  int min_size = 1;
};

constexpr int finest = 4000;

// Columns as in the header; blob, the one that needs a seed, is built apart.
constexpr std::array shapes = {
    Shape{{"sphere", "subdivided icosahedron, radius 1", 24, finest, 2, 1, 0}, sphere},
    Shape{{"torus", "radii 1 and 0.4", 96, finest, 0, 1, 0}, torus, 3},
    Shape{{"double-torus", "two tori melted together, genus 2", 80, 500, -2, 1, 0}, double_torus, 12},
    Shape{{"blob", "smooth random star-shaped body (see --seed)", 24, finest, 2, 1, 0}, nullptr},
    Shape{{"two-spheres", "radius 1 each, a gap of 1/1000 between them", 24, finest, 4, 2, 0}, two_spheres},
    Shape{{"cube", "side 1; 12 facets by default", 1, finest, 2, 1, 0}, cube},
    Shape{{"l-block", "flat sides, one reentrant edge", 1, finest, 2, 1, 0}, l_block},
    Shape{{"frame", "square block with a square hole", 1, finest, 0, 1, 0}, frame},
    Shape{{"thin-plate", "1 x 1 x 1/500", 20, finest, 2, 1, 0}, thin_plate},
    Shape{{"cylinder", "with flat caps", 64, finest, 2, 1, 0}, cylinder, 3},
    Shape{{"cone", "sharp tip, flat base", 48, finest, 2, 1, 0}, cone, 3},
    Shape{{"joint", "turned part: flange, collar and bore", 96, finest, 0, 1, 0}, joint, 3},
    Shape{{"wedge", "prism with an angle of 15 degrees", 1, finest, 2, 1, 0}, wedge},
    Shape{{"star", "prism over a star with five tips", 1, finest, 2, 1, 0}, star},
    Shape{{"gear", "16 teeth and a bore", 1, finest, 0, 1, 0}, gear},
    Shape{{"hole-plate", "two rows of six holes near the border", 1, finest, -22, 1, 0}, hole_plate},
    Shape{{"shaft", "stepped, with small fillets", 64, finest, 2, 1, 0}, shaft, 3},
    Shape{{"rib", "L-block with a thin triangular rib", 1, finest, 2, 1, 0}, rib},
    Shape{{"cone-plate", "cone on a round plate", 64, finest, 2, 1, 0}, cone_plate, 3},
    Shape{{"two-cylinders", "one grows out of the other's side", 6, 300, 2, 1, 0}, two_cylinders},
    Shape{{"screw", "a thread that fades out at both ends", 64, finest, 2, 1, 0}, screw, 3},
    Shape{{"square", "flat, with a border", 1, finest, 1, 1, 1}, square},
    Shape{{"triangle", "flat, equilateral, with a border; one facet by default", 1, finest, 1, 1, 1},
          triangle},
    Shape{{"wave-disk", "disk with waves and a border", 24, finest, 1, 1, 1}, wave_disk},
    Shape{{"tube", "cylinder without caps", 64, finest, 0, 1, 2}, tube_surface, 3},
    Shape{{"moebius", "one-sided strip", 96, finest, 0, 1, 1, false}, moebius, 3},
    Shape{{"plate", "1 x 1 x 1/40", 20, finest, 2, 1, 0}, plate},
    Shape{{"paper", "1 x 1 x 1/100, in waves", 40, finest, 2, 1, 0}, paper},
    Shape{{"comb", "12 teeth, 1/50 thick", 10, finest, 2, 1, 0}, comb},
    Shape{{"horn", "ball of radius 1 with a horn that ends in nothing", 48, finest, 2, 1, 0}, horn, 3},
    Shape{{"ears", "ball with two thin lobes", 48, finest, 2, 1, 0}, ears},
    Shape{{"dumbbell", "balls of radius 1, joined by a bar of radius .03", 48, finest, 2, 1, 0}, dumbbell, 3},
    Shape{{"narrow-torus", "radii 1 and .97: a hole of radius .03", 96, finest, 0, 1, 0}, narrow_torus, 3},
    Shape{{"thin-handle", "ring that is 1 thick on one side, .06 on the other", 96, finest, 0, 1, 0},
          thin_handle,
          3},
    Shape{{"pinched-tube", "closed tube, pressed flat in the middle: .03 thick", 64, finest, 2, 1, 0},
          pinched_tube,
          3},
    Shape{{"shell", "cavity in a ball: a wall of .02 to .14", 24, finest, 4, 2, 0}, shell},
    Shape{{"pin-holes", "sphere with five holes of a facet each", 24, finest, -3, 1, 5}, pin_holes},
    Shape{{"boxes", "two that touch", 8, finest, 4, 2, 0}, touching_boxes},
};

const Shape& find(std::string_view name) {
  const auto shape =
      std::find_if(shapes.begin(), shapes.end(), [&](const Shape& s) { return s.info.name == name; });
  require(shape != shapes.end(), "there is no shape '" + std::string(name) + "'");
  return *shape;
}

}  // namespace

std::span<const ShapeInfo> shape_table() {
  static const auto table = [] {
    std::array<ShapeInfo, shapes.size()> infos{};
    std::transform(shapes.begin(), shapes.end(), infos.begin(), [](const Shape& s) { return s.info; });
    return infos;
  }();
  return table;
}

const ShapeInfo& shape_info(std::string_view name) { return find(name).info; }

TriMesh make_shape(std::string_view name, int size, std::uint64_t seed) {
  const Shape& shape = find(name);
  if (size == 0) size = shape.info.size;
  require(shape.min_size <= size && size <= shape.info.max_size,
          "the size of '" + std::string(name) + "' is " + std::to_string(shape.min_size) + " to " +
              std::to_string(shape.info.max_size));
  return shape.build ? shape.build(size) : blob(size, seed);
}

TriMesh tilted(const TriMesh& mesh) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return mapped(mesh, [&](const Vec3& p) -> Vec3 { return turn * p; });
}

}  // namespace geom
