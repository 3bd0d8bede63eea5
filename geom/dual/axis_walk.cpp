#include "geom/dual/axis_walk.h"

#include <utility>

namespace geom {
namespace {

constexpr int walk_limit = 256;  // facets
constexpr std::size_t after[] = {1, 2, 0}, before[] = {2, 0, 1};

/// Puts the sites in ascending order. Is that an odd permutation?
bool sort_sites(std::array<SiteId, 3>& s) {
  bool is_odd = false;
  const auto sort = [&](std::size_t i, std::size_t j) {
    if (s[j] < s[i]) std::swap(s[i], s[j]), is_odd = !is_odd;
  };
  sort(0, 1);
  sort(1, 2);
  sort(0, 1);
  return is_odd;
}

/// The bisectors where some site or facet has a level of its own.
struct LevelPair {
  const Clipper& clipper;
  const Bisector first, second;
  Eigen::Array2d error{first.error, second.error};
  Eigen::Array2d at(VertexId v) const { return {clipper.value_at(v, first), clipper.value_at(v, second)}; }
};
struct FlatPair {
  const TriMesh& mesh;
  const BisectorPair pair;
  Eigen::Array2d error = pair.error;
  Eigen::Array2d at(VertexId v) const { return pair(mesh.position(v)); }
};

/// From `start` to the facet in whose inside both vanish; sets the place's facet and point.
template <class Pair>
void walk(const TriMesh& mesh, const Clipper& clipper, const Pair& pair, FacetId start, AxisPlace& place) {
  if (!start.valid()) return;
  const double turn = place.clockwise ? -1 : 1;
  FacetId t = start;
  TriMesh::Facet corners = mesh.facet(t);
  FormPair form{{pair.at(corners[0]), pair.at(corners[1]), pair.at(corners[2])}, pair.error};
  for (int step = 0; step < walk_limit; ++step) {
    const std::array<double, 3> l = axis_numbers(form);
    if (!(turn * (l[0] + l[1] + l[2]) > 0)) return;
    const double l0 = turn * l[0], l1 = turn * l[1], l2 = turn * l[2];
    const std::size_t k = l2 < l0 && l2 < l1 ? 2 : l1 < l0 ? 1 : 0;
    if (!(turn * l[k] < 0)) {
      const AxisMinors minors = axis_minors(form, l);
      if (!(turn * l[k] > minors.error)) return;
      place.facet = t;
      place.point = clipper.meeting(t, place.sites, minors);
      return;
    }
    const std::size_t a = after[k], b = before[k];  // ends of the edge to cross
    const VertexId left = corners[a], right = corners[b];
    const Eigen::Array2d at_left = form.f[a], at_right = form.f[b];
    t = mesh.across(t, static_cast<int>(a));
    if (!t.valid()) return;
    corners = mesh.facet(t);
    for (std::size_t i = 0; i < 3; ++i)
      form.f[i] = corners[i] == left ? at_left : corners[i] == right ? at_right : pair.at(corners[i]);
  }
}

}  // namespace

AxisPlace walk_to_axis(const TriMesh& mesh, const Clipper& clipper, const std::array<SiteId, 3>& sites,
                       FacetId start) {
  AxisPlace place{FacetId(), {}, sites, false};
  place.clockwise = sort_sites(place.sites);
  const auto& [s0, s1, s2] = place.sites;
  if (clipper.have_one_level(place.sites))
    walk(mesh, clipper, FlatPair{mesh, clipper.bisectors_of(s0, s1, s2)}, start, place);
  else
    walk(mesh, clipper, LevelPair{clipper, clipper.bisector_of(s0, s1), clipper.bisector_of(s0, s2)}, start,
         place);
  return place;
}

}  // namespace geom
