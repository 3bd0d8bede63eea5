#include "geom/dual/single_component.h"

#include <algorithm>
#include <cmath>

namespace geom {

bool SingleComponent::is_all(double cell_reach, double distance) {
  const DualState& state = around_.state;
  const Frame& frame = around_.frame;
  const Vec3& p = around_.site().position;
  const double level = around_.site().level;
  link_.clear();
  for (int j = 0; j < around_.rim.size(); ++j) link_.push_back({frame.offset(j), frame.constant(j)});
  const double own = state.distance_at(cell_reach, around_.p);
  Sheets& sheets = around_.sheets;
  const Sheet* sheet = distance > margin::widest * own ? sheets.known(around_.p, level)
                                                       : sheets.around(around_.p, {p, level}, distance);
  if (sheet && sheet->covers(p, distance) && Sheets::has_one_component(*sheet, own, link_)) return true;
  others_.clear();
  const auto is_lost = [&](const Vec3& center, double radius) {
    return frame.is_behind(Vec3(0, 0, 0), 0, center - p, radius, Frame::nobody);
  };
  facets_.clear();
  state.facets.near_but(p, distance, is_lost, facets_);
  return std::ranges::all_of(facets_, [&](FacetId t) {
    return around_.flood.facets().has(t) || !state.clipper.comes_near(t, p, distance) ||
           state.clipper.levels().gap(t, level) > distance ||
           is_lost(state.clipper.middle(t), state.clipper.radius(t)) || owns_nothing_of(t, distance);
  });
}

/// Is some site nearer than p, everywhere on the facet? Mostly it is one and the same at all three corners.
/// Else the facet is clipped, in doubles, by those who are nearer somewhere, and what is left kept a little
/// too large.
bool SingleComponent::owns_nothing_of(FacetId t, double distance) {
  const DualState& state = around_.state;
  const Frame& frame = around_.frame;
  FrameVertices& vertices = around_.vertices;
  const TriMesh::Facet& corners = state.mesh.facet(t);
  const FrameVertices::Slot s0 = vertices.with_signs(corners[0]), s1 = vertices.with_signs(corners[1]),
                            s2 = vertices.with_signs(corners[2]);
  const FrameVertices::Vertex &v0 = vertices[s0], &v1 = vertices[s1], &v2 = vertices[s2];
  if (v0.sure && v1.sure && v2.sure && (v0.beaten_by & v1.beaten_by & v2.beaten_by) != 0) return true;
  part_ = {v0.y, v1.y, v2.y};
  const double most = std::max({v0.y.norm(), v1.y.norm(), v2.y.norm()});
  for (int j = 0; j < around_.rim.size(); ++j)
    if (keep_part(frame.offset(j), frame.constant(j), most)) return true;
  if (others_.empty()) {                                               // another sheet: who else is there?
    const double power = distance * distance - around_.site().weight;  // of a second component, at most
    const double radius = state.distance_at(power, around_.p);
    state.search.near({around_.p, around_.site().position, radius, power}, others_);
  }
  return std::ranges::any_of(others_, [&](SiteId s) {
    const WeightedPoint3 &site = state.sites[s], &origin = frame.origin();
    if (s == around_.p || site.level != origin.level) return false;
    return keep_part(Frame::offset(site, origin), Frame::constant(site, origin), most);
  });
}

/// Clips part_ to where a site, given by its d and c, is not nearer than p. True if nothing is left. `size`
/// bounds all |y|; what rounding may have misplaced, by far less than a 2^-40th of it, is kept.
bool SingleComponent::keep_part(const Vec3& d, double c, double size) {
  const double length = d.norm(), slack = 0x1p-40 * (length * (size + length) + std::abs(c));
  const auto value = [&](const Vec3& y) { return c - 2 * d.dot(y) + slack; };
  clipped_.clear();
  for (std::size_t i = 0; i < part_.size(); ++i) {
    const Vec3 &a = part_[i], &b = part_[i + 1 == part_.size() ? 0 : i + 1];
    const double at_a = value(a), at_b = value(b);
    if (at_a >= 0) clipped_.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) clipped_.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  part_.swap(clipped_);
  return part_.empty();
}

}  // namespace geom
