#include "fpo/features/curve_pieces.h"

#include <algorithm>
#include <cmath>

namespace fpo {

using geom::Vec3;

double cut_curve(const geom::TriMesh& mesh, const Features& features, std::size_t curve, double longest,
                 std::vector<CurvePiece>& pieces) {
  const FeatureCurve& whole = features.curves[curve];
  double start = 0;
  for (std::size_t i = 0; i < whole.facets.size(); ++i) {
    const Vec3 &a = mesh.position(whole.vertices[i]),
               &b = mesh.position(whole.vertices[(i + 1) % whole.vertices.size()]);
    const double length = (b - a).norm();
    const int parts = std::max(1, static_cast<int>(std::ceil(length / longest)));
    for (int k = 0; k < parts; ++k)
      pieces.push_back({a + (b - a) * k / parts, a + (b - a) * (k + 1) / parts, curve,
                        start + length * k / parts, whole.facets[i]});
    start += length;
  }
  return start;
}

}  // namespace fpo
