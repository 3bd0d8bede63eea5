#include "geom/dual/axis_walk.h"

#include <utility>

namespace geom {
namespace {

constexpr std::size_t walk_limit = 256;  // facets

}  // namespace

AxisPlace walk_to_axis(const TriMesh& mesh, const Clipper& clipper, const std::array<SiteId, 3>& sites,
                       FacetId start) {
  std::array<SiteId, 3> s = sites;
  double turn = 1;  // -1: in ascending order they turn clockwise
  const auto sort = [&](std::size_t i, std::size_t j) {
    if (s[j] < s[i]) std::swap(s[i], s[j]), turn = -turn;
  };
  sort(0, 1);
  sort(1, 2);
  sort(0, 1);
  const Bisector first = clipper.bisector_of(s[0], s[1]), second = clipper.bisector_of(s[0], s[2]);
  FacetId t = start;
  for (std::size_t step = 0; t.valid() && step < walk_limit; ++step) {
    const AxisMinors minors = axis_minors(clipper.form_on(t, first), clipper.form_on(t, second));
    if (!(turn * minors.sum > 0)) break;
    const double l0 = turn * minors.l[0], l1 = turn * minors.l[1], l2 = turn * minors.l[2];
    const int least = l2 < l0 && l2 < l1 ? 2 : l1 < l0 ? 1 : 0;
    const double closest = least == 2 ? l2 : least == 1 ? l1 : l0;
    if (closest > minors.error) return {t, clipper.meeting(t, s, minors)};
    if (!(closest < 0)) break;
    t = mesh.across(t, least == 2 ? 0 : least + 1);
  }
  return {};
}

}  // namespace geom
