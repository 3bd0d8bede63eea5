#include "geom/power/clip.h"

#include <array>

#include "geom/check.h"

namespace geom {
namespace {

/// Which part of a polygon is kept by a cut: corners first, first + 1, ... last, cyclically. The new corners
/// lie on the edges labelled `leaving`, from corner `last` on, and `entering`, which ends in corner `first`.
struct CutPlace {
  std::size_t first, last;
  EdgeLabel leaving, entering;
};

//               beaten               The polygon is convex and the bisector a line: the beaten corners are
//            x-----------x           consecutive. `last` is the last kept corner before them, `first` the
//           /             \          first one after them.
//   --j--- m ------------- n --j--
//         /                 \        The new polygon: first ... last, then n, where the edge j starts,
//     first                last      then m.
CutPlace place_of_cut(std::span<const PolygonCorner> corners, const std::vector<char>& beaten) {
  const std::size_t n = corners.size();
  CutPlace place{};
  while (!(beaten[place.first == 0 ? n - 1 : place.first - 1] && !beaten[place.first]))
    ensure(++place.first < n, "clip: beaten corners are not consecutive");
  place.last = place.first;
  while (!beaten[next_corner(place.last, n)]) place.last = next_corner(place.last, n);
  std::size_t last_beaten = next_corner(place.last, n);
  while (beaten[next_corner(last_beaten, n)]) last_beaten = next_corner(last_beaten, n);
  ensure(next_corner(last_beaten, n) == place.first, "clip: beaten corners are not consecutive");
  place.leaving = corners[place.last].edge;
  place.entering = corners[last_beaten].edge;
  return place;
}

/// The polygon with the new corners put in.
void put_in(std::span<const PolygonCorner> old, const CutPlace& place, SiteId j,
            const std::array<RoundedPoint, 2>& leave_and_enter, std::vector<PolygonCorner>& out) {
  out.clear();
  for (std::size_t k = place.first;; k = next_corner(k, old.size())) {
    out.push_back(old[k]);
    if (k == place.last) break;
  }
  out.push_back({leave_and_enter[0], EdgeLabel::bisector(j)});
  out.push_back({leave_and_enter[1], place.entering});
}

}  // namespace

Clip Clipper::classify_corners(FacetId facet, SiteId owner, std::span<const PolygonCorner> corners, SiteId j,
                               const Bisector& b, std::vector<char>& beaten) const {
  beaten.resize(corners.size());
  std::size_t count = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto [f, bound] = value_at(facet, corners[k].point, b);
    const bool certain = f > bound || f < -bound;
    const bool yes = certain ? f < 0 : beats_exactly(cell_corner(facet, owner, corners, k), j);
    beaten[k] = yes;
    count += yes;
  }
  return count == 0 ? Clip::untouched : count == corners.size() ? Clip::swallowed : Clip::cut;
}

void Clipper::cut(FacetPolygon& polygon, SiteId j, const Bisector& b, const std::vector<char>& beaten) {
  const CutPlace place = place_of_cut(polygon.corners, beaten);
  const auto meet = [&](EdgeLabel label) { return corner(polygon.facet, label, polygon.owner, j, b); };
  put_in(polygon.corners, place, j, {meet(place.leaving), meet(place.entering)}, scratch_);
  polygon.corners.swap(scratch_);
}

Clip Clipper::clip(FacetPolygon& polygon, SiteId j, const Bisector& b) {
  const Clip outcome = classify(polygon.facet, polygon.owner, polygon.corners, j, b, beaten_);
  if (outcome == Clip::swallowed) polygon.corners.clear();
  if (outcome == Clip::cut) cut(polygon, j, b, beaten_);
  return outcome;
}

Clip Clipper::clip_beyond(FacetPolygon& polygon, SiteId j, const Bisector& b) {
  const Clip outcome = classify(polygon.facet, polygon.owner, polygon.corners, j, b, beaten_);
  if (outcome == Clip::untouched) polygon.corners.clear();
  if (outcome == Clip::cut) {
    for (char& is_beaten : beaten_) is_beaten = !is_beaten;
    cut(polygon, j, b, beaten_);
  }
  return outcome == Clip::untouched   ? Clip::swallowed
         : outcome == Clip::swallowed ? Clip::untouched
                                      : Clip::cut;
}

}  // namespace geom
