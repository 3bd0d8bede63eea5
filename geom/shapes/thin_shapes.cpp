#include "geom/shapes/thin_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"

namespace geom {
namespace {

using std::numbers::pi;

bool all_solid(int, int, int) { return true; }

TriMesh flat_box(double thickness, int size) {
  return block_surface({{{{0, 1}, {0, 1}, {0, thickness}}}, {size, size, 1}, all_solid});
}

/// A closed tube whose ends are points: `radius_at` and `height_at` of a parameter in [0, 1].
template <class RadiusAt, class HeightAt>
TriMesh spindle(int size, int steps, RadiusAt radius_at, HeightAt height_at) {
  std::vector<Vec2> profile;
  for (int i = 0; i <= steps; ++i) {
    const double s = double(i) / steps;
    profile.emplace_back(i == 0 || i == steps ? 0.0 : radius_at(s), height_at(s));
  }
  return revolved(profile, false, size);
}

/// 1 up to the middle less half the width, 0 from the middle plus half of it; smooth in between.
double step_down(double x, double middle, double width) {
  const double t = std::clamp((x - middle) / width + 0.5, 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

}  // namespace

TriMesh plate(int size) { return flat_box(1.0 / 40, size); }

TriMesh paper(int size) {
  return mapped(flat_box(1.0 / 100, size), [](const Vec3& p) -> Vec3 {
    return p + Vec3(0, 0, 0.12 * std::sin(2 * pi * p.x()) * std::cos(1.5 * pi * p.y()));
  });
}

TriMesh comb(int size) {
  constexpr int teeth = 12;
  std::vector<double> along{0};
  for (int i = 0; i < teeth; ++i) {
    along.push_back(along.back() + 0.02);  // the tooth
    if (i + 1 < teeth) along.push_back(along.back() + 0.06);
  }
  const auto solid = [](int i, int j, int) { return j == 0 || i % 2 == 0; };
  return block_surface({{{along, {0, 0.2, 1}, {0, 0.05}}}, {1, size, 1}, solid});
}

TriMesh touching_boxes(int size) {
  const auto box = [&](const Vec3& low, const Vec3& high) {
    return block_surface(
        {{{{low.x(), high.x()}, {low.y(), high.y()}, {low.z(), high.z()}}}, {size, size, size}, all_solid});
  };
  return joined(box({0, 0, 0}, {1, 1, 1}), box({1, 0.25, 0.125}, {1.75, 1.125, 0.875}));
}

TriMesh horn(int size) {
  constexpr double body = 1, tip = 5;
  std::vector<Vec2> profile{{0, -body}};
  const double meets = 0.3;  // the horn's radius where it leaves the body
  const double last = pi - std::asin(meets / body);
  const int around = std::max(2, size / 2);
  for (int i = 1; i <= around; ++i) {
    const double angle = last * i / around;
    profile.emplace_back(body * std::sin(angle), -body * std::cos(angle));
  }
  const double foot = profile.back().y();
  const int up = 2 * size;
  for (int i = 1; i < up; ++i) {
    const double s = double(i) / up;
    profile.emplace_back(meets * (1 - s) * (1 - s), foot + (tip - foot) * s);
  }
  profile.emplace_back(0, tip);
  return revolved(profile, false, size);
}

TriMesh dumbbell(int size) {
  constexpr double bar = 0.03;
  const int steps = std::max(6, 2 * size);
  // Two unit balls about -1.5 and 1.5, the bar between them: by the angle around each center, and by height.
  const double leaves = std::asin(bar);
  std::vector<Vec2> profile{{0, -2.5}};
  for (int i = 1; i <= steps; ++i) {
    const double angle = (pi - leaves) * i / steps;
    profile.emplace_back(std::sin(angle), -1.5 - std::cos(angle));
  }
  const double end = 1.5 - std::cos(leaves);
  for (int i = 1; i < steps; ++i) profile.emplace_back(bar, -end + 2 * end * i / steps);
  for (int i = steps; i > 0; --i) {
    const double angle = (pi - leaves) * i / steps;
    profile.emplace_back(std::sin(angle), 1.5 + std::cos(angle));
  }
  profile.emplace_back(0, 2.5);
  return revolved(profile, false, size);
}

TriMesh narrow_torus(int size) {
  constexpr double tube = 0.97;
  return grid_surface({size, Seam::closed}, {size, Seam::closed}, [](double u, double v) {
    const double r = 1 + tube * std::cos(2 * pi * v);
    return Vec3(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), tube * std::sin(2 * pi * v));
  });
}

TriMesh thin_handle(int size) {
  constexpr double thick = 0.5, thin = 0.03;
  const int around_tube = std::max(3, size / 3);
  return grid_surface({size, Seam::closed}, {around_tube, Seam::closed}, [](double u, double v) {
    const double turn = std::abs(2 * u - 1);  // 1 in the body's middle, 0 in the handle's
    const double tube = thin + (thick - thin) * (1 - step_down(turn, 0.5, 0.4));
    const double r = 1 + tube * std::cos(2 * pi * v);
    return Vec3(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), tube * std::sin(2 * pi * v));
  });
}

TriMesh pinched_tube(int size) {
  const TriMesh round = spindle(
      size, std::max(3, size), [](double s) { return 0.5 * std::pow(std::sin(pi * s), 0.25); },
      [](double s) { return 4 * s - 2; });
  return mapped(round, [](const Vec3& p) -> Vec3 {
    const double flat = std::exp(-4 * p.z() * p.z());  // 1 in the middle
    return {p.x() * (1 + 0.5 * flat), p.y() * (1 - 0.97 * flat), p.z()};
  });
}

TriMesh shell(int size) {
  const TriMesh outer = make_shape("sphere", size);
  TriMesh inner = mapped(outer, [](const Vec3& p) -> Vec3 { return 0.92 * p + Vec3(0.06, 0, 0); });
  Table<FacetId, TriMesh::Facet> facets = inner.facets();
  for (TriMesh::Facet& f : facets) std::swap(f[1], f[2]);  // a cavity's outside is within
  return joined(outer, TriMesh(inner.vertices(), std::move(facets)));
}

TriMesh ears(int size) {
  return mapped(make_shape("sphere", size), [](const Vec3& u) -> Vec3 {
    double radius = 1;
    for (const double side : {-1.0, 1.0}) {
      const Vec3 ear = Vec3(0.6 * side, 0, 0.8), along(0, 1, 0), through = ear.cross(along);
      if (u.dot(ear) <= 0) continue;
      const double wide = u.dot(along) / 0.35, thin = u.dot(through) / 0.06;
      radius += std::exp(-wide * wide - thin * thin);
    }
    return radius * u;
  });
}

TriMesh pin_holes(int size) {
  const TriMesh whole = make_shape("sphere", size);
  constexpr std::size_t holes = 5;
  const std::size_t each = whole.num_facets() / holes;
  Table<FacetId, TriMesh::Facet> facets;
  for (std::size_t t = 0; t < whole.num_facets(); ++t)
    if (t % each != each / 2 || t / each >= holes) facets.push_back(whole.facet(FacetId(t)));
  return {whole.vertices(), std::move(facets)};
}

}  // namespace geom
