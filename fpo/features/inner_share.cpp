#include "fpo/features/inner_share.h"

#include <algorithm>
#include <cmath>

#include "fpo/features/curve_pieces.h"
#include "fpo/features/point_grid.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

using geom::Vec3;

namespace {

constexpr double half_row = 0.4330127;  // sqrt(3) / 4, in wanted lengths
constexpr double reach = 1;             // likewise: beyond the half row of lengths twice as long
constexpr double places_a_sample = 16;
constexpr double piece = 0.25;  // in wanted lengths

/// Spread evenly over the unit triangle (Roberts' sequence).
geom::Vec2 place_in_triangle(std::size_t i) {
  constexpr double g = 1.32471795724474602596;
  double u = std::fmod(0.5 + static_cast<double>(i + 1) / g, 1.0),
         v = std::fmod(0.5 + static_cast<double>(i + 1) / (g * g), 1.0);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return {u, v};
}

class Distances {
 public:
  Distances(const geom::TriMesh& mesh, const Features& features, double longest)
      : reach_(reach * longest), grid_((reach + piece) * longest) {
    for (std::size_t c = 0; c < features.curves.size(); ++c)
      cut_curve(mesh, features, c, piece * longest, pieces_);
    for (std::size_t i = 0; i < pieces_.size(); ++i) grid_.add(pieces_[i].middle(), i);
  }
  double at(const Vec3& x) const {
    double least2 = reach_ * reach_;
    grid_.around(x, [&](std::size_t i) {
      const CurvePiece& p = pieces_[i];
      least2 = std::min(least2, (geom::closest_point(x, {p.from, p.to, p.to}).point - x).squaredNorm());
    });
    return std::sqrt(least2);
  }

 private:
  double reach_;
  std::vector<CurvePiece> pieces_;
  PointGrid grid_;
};

}  // namespace

InnerShare::InnerShare(const geom::TriMesh& mesh, const Features& features, const Sizing& sizing,
                       double scale) {
  const std::vector<SizedPatch> patches = sized_patches(mesh, sizing);
  double longest = 0;
  for (const SizedPatch& patch : patches) longest = std::max(longest, scale * patch.least_h);
  const Distances distances(mesh, features, longest);
  for (const SizedPatch& patch : patches) {
    const double samples = patch.num_samples / (scale * scale);
    const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(places_a_sample * samples));
    const Vec3& q0 = mesh.corner(patch.facet, 0);
    const Vec3 e1 = mesh.corner(patch.facet, 1) - q0, e2 = mesh.corner(patch.facet, 2) - q0;
    for (std::size_t i = 0; i < count; ++i) {
      const geom::Vec2 in = place_in_triangle(i);
      const geom::Vec2 uv = patch.corners[0] + in.x() * (patch.corners[1] - patch.corners[0]) +
                            in.y() * (patch.corners[2] - patch.corners[0]);
      const Vec3 x = q0 + uv.x() * e1 + uv.y() * e2;
      places_.push_back({distances.at(x) / (scale * sizing.at(SurfaceSample{x, patch.facet})),
                         samples / static_cast<double>(count)});
    }
  }
  std::ranges::sort(places_, {}, &Place::distance);
  for (std::size_t i = places_.size(); i-- > 1;) places_[i - 1].samples += places_[i].samples;
}

double InnerShare::num_samples(double stretching) const {
  const auto first = std::ranges::upper_bound(places_, half_row * stretching, {}, &Place::distance);
  return first == places_.end() ? 0 : first->samples / (stretching * stretching);
}

}  // namespace fpo
