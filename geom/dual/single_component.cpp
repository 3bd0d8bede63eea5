#include "geom/dual/single_component.h"

#include <algorithm>
#include <cmath>

namespace geom {

bool SingleComponent::is_all(double cell_reach, double distance) {
  const DualState& state = around_.state;
  const Frame& frame = around_.frame;
  const Vec3& p = around_.site().position;
  const FacetLevels& levels = state.clipper.levels();
  link_.clear();
  for (int j = 0; j < around_.rim.size(); ++j) link_.push_back({frame.offset(j), frame.constant(j)});
  const double own = state.distance_at(cell_reach, around_.p);
  const Sheet* sheet = distance <= margin::widest * own ? around_.sheet_around(distance)
                       : frame.is_level() ? around_.sheets.known(around_.p, frame.origin().level)
                                          : nullptr;
  if (sheet && sheet->covers(p, distance) && Sheets::has_one_component(*sheet, own, link_)) return true;
  others_.clear();
  const double level = frame.origin().level;
  facets_.clear();
  state.facets.near_but(
      {p, level}, distance,
      [&](const Location3& center, double radius) {
        return is_lost({center.position - p, center.level - level}, radius);
      },
      facets_);
  const auto is_facet_lost = [&](FacetId t) {
    const double radius = state.clipper.radius(t), half = levels.half(t);
    return is_lost({state.clipper.middle(t) - p, levels.middle(t) - level},
                   frame.is_level() ? radius : std::sqrt(radius * radius + half * half) * margin::more);
  };
  return std::ranges::all_of(facets_, [&](FacetId t) {
    return around_.flood.facets().has(t) || !state.clipper.comes_near(t, p, distance) ||
           levels.gap(t, level) > distance || is_facet_lost(t) || owns_nothing_of(t, distance);
  });
}

/// Is some site of the frame nearer than p in all of the ball?
bool SingleComponent::is_lost(const Frame::Place& center, double radius) const {
  return around_.frame.is_behind({Vec3(0, 0, 0), 0}, center, radius, Frame::nobody);
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
  part_ = {v0, v1, v2};
  const double most = std::sqrt(std::max({v0.squaredNorm(), v1.squaredNorm(), v2.squaredNorm()}));
  for (int j = 0; j < around_.rim.size(); ++j)
    if (keep_part(frame.seen(j), most)) return true;
  if (others_.empty()) {                                               // another sheet: who else is there?
    const double power = distance * distance - around_.site().weight;  // of a second component, at most
    const double radius = state.distance_at(power, around_.p);
    state.search.near({around_.p, around_.site().position, radius, power}, others_);
  }
  return std::ranges::any_of(others_, [&](SiteId s) {
    return s != around_.p && keep_part(Frame::seen(state.sites[s], frame.origin()), most);
  });
}

/// Clips part_ to where a site is not nearer than p. True if nothing is left. `size`
/// bounds all |y|; what rounding may have misplaced, by far less than a 2^-40th of it, is kept.
bool SingleComponent::keep_part(const Frame::Seen& site, double size) {
  const double length = std::sqrt(site.d.squaredNorm() + site.rise * site.rise),
               slack = 0x1p-40 * (length * (size + length) + std::abs(site.c));
  const auto value = [&](const Frame::Place& z) {
    return site.c - 2 * (site.d.dot(z.y) + site.rise * z.rise) + slack;
  };
  clipped_.clear();
  for (std::size_t i = 0; i < part_.size(); ++i) {
    const Frame::Place &a = part_[i], &b = part_[i + 1 == part_.size() ? 0 : i + 1];
    const double at_a = value(a), at_b = value(b), share = at_a / (at_a - at_b);
    if (at_a >= 0) clipped_.push_back(a);
    if ((at_a >= 0) != (at_b >= 0))
      clipped_.push_back({a.y + share * (b.y - a.y), a.rise + share * (b.rise - a.rise)});
  }
  part_.swap(clipped_);
  return part_.empty();
}

}  // namespace geom
