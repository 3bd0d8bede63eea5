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
  rivals_.clear();
  const double level = frame.origin().level;
  facets_.clear();
  state.facets.near_but(
      {p, level}, distance,
      [&](const Location3& center, double radius) {
        return is_beaten_by_rim({center.position - p, center.level - level}, radius);
      },
      facets_);
  return std::ranges::all_of(facets_, [&](FacetId t) {
    if (around_.flood.facets().has(t) || !state.clipper.comes_near(t, p, distance) ||
        levels.gap(t, level) > distance)
      return true;
    const double flat = state.clipper.radius(t), half = levels.half(t);
    const double whole = half == 0 ? flat : std::sqrt(flat * flat + half * half) * margin::more;
    const Frame::Place center(state.clipper.middle(t) - p, levels.middle(t) - level);
    if (is_beaten_by_rim(center, frame.is_level() ? flat : whole)) return true;
    if (rivals_.empty()) find_rivals(distance);
    return (whole < distance && is_beaten_by_rival(center, whole)) || owns_nothing_of(t);
  });
}

/// Is some site of the frame nearer than p in all of the ball?
bool SingleComponent::is_beaten_by_rim(const Frame::Place& center, double radius) const {
  return around_.frame.is_behind({Vec3(0, 0, 0), 0}, center, radius, Frame::nobody);
}

/// The same of a rival. The lead of one over p is affine, hence in the ball at least what it is at the center
/// less 2 |d| times the radius, which must be that of a ball in space and level: a rival may have a level of
/// its own where the rim has none. Whoever it is, is often so for the next ball, too.
bool SingleComponent::is_beaten_by_rival(const Frame::Place& center, double radius) {
  for (std::size_t i = 0; i < rivals_.size(); ++i) {
    const auto& [seen, length, slack] = rivals_[i];
    const double lead = 2 * (seen.d.dot(center.y) + seen.rise * center.rise) - seen.c;
    if (!(lead > 2 * length * radius * margin::more + slack)) continue;
    std::swap(rivals_[i], rivals_.front());
    return true;
  }
  return false;
}

/// The rim, and who may be nearer than p within that distance, on other sheets, say. The slack is for
/// rounding in balls that come within the distance and are smaller: there |y| < 2 distances, and the lead is
/// off by some 2^-49 (2 |d| distance + |c|) at most.
void SingleComponent::find_rivals(double distance) {
  const DualState& state = around_.state;
  const std::span<const SiteId> rim = around_.rim.sites();
  const double power = distance * distance - around_.site().weight;  // of a second component, at most
  const double radius = state.distance_at(power, around_.p);
  found_.assign(rim.begin(), rim.end());
  state.search.near({around_.p, around_.site().position, radius, power}, found_);
  rivals_.clear();
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const SiteId s = found_[i];
    if (s == around_.p || (i >= rim.size() && std::ranges::find(rim, s) != rim.end())) continue;
    const Frame::Seen seen = Frame::seen(state.sites[s], around_.frame.origin());
    const double length = std::sqrt(seen.d.squaredNorm() + seen.rise * seen.rise);
    rivals_.push_back({seen, length, 1e-9 * (length * (length + distance) + std::abs(seen.c))});
  }
}

/// Is some site nearer than p, everywhere on the facet? Sometimes it is one and the same at all three
/// corners. Else the facet is clipped, in doubles, by those who are nearer somewhere, and what is left kept a
/// little too large. Who takes the last of it often does so of the next facet.
bool SingleComponent::owns_nothing_of(FacetId t) {
  const DualState& state = around_.state;
  FrameVertices& vertices = around_.vertices;
  const TriMesh::Facet& corners = state.mesh.facet(t);
  const FrameVertices::Slot s0 = vertices.with_signs(corners[0]), s1 = vertices.with_signs(corners[1]),
                            s2 = vertices.with_signs(corners[2]);
  const FrameVertices::Vertex &v0 = vertices[s0], &v1 = vertices[s1], &v2 = vertices[s2];
  if (v0.sure && v1.sure && v2.sure && (v0.beaten_by & v1.beaten_by & v2.beaten_by) != 0) return true;
  part_ = {v0, v1, v2};
  const double most = std::sqrt(std::max({v0.squaredNorm(), v1.squaredNorm(), v2.squaredNorm()}));
  for (std::size_t i = 0; i < rivals_.size(); ++i) {
    if (!keep_part(rivals_[i].seen, most)) continue;
    std::swap(rivals_[i], rivals_.front());
    return true;
  }
  return false;
}

/// Clips part_ to where a site is not nearer than p. True if nothing is left. `size`
/// bounds all |y|; what rounding may have misplaced, by far less than a 2^-40th of it, is kept.
bool SingleComponent::keep_part(const Frame::Seen& site, double size) {
  const double length = std::sqrt(site.d.squaredNorm() + site.rise * site.rise),
               slack = 0x1p-40 * (length * (size + length) + std::abs(site.c));
  values_.clear();
  double least = infinity, most = -infinity;
  for (const Frame::Place& z : part_) {
    values_.push_back(site.c - 2 * (site.d.dot(z.y) + site.rise * z.rise) + slack);
    least = std::min(least, values_.back());
    most = std::max(most, values_.back());
  }
  if (least >= 0) return false;
  if (most < 0) return true;
  clipped_.clear();
  for (std::size_t i = 0; i < part_.size(); ++i) {
    const std::size_t next = i + 1 == part_.size() ? 0 : i + 1;
    const Frame::Place &a = part_[i], &b = part_[next];
    const double at_a = values_[i], at_b = values_[next];
    if (at_a >= 0) clipped_.push_back(a);
    if ((at_a >= 0) == (at_b >= 0)) continue;
    const double share = at_a / (at_a - at_b);
    clipped_.push_back({a.y + share * (b.y - a.y), a.rise + share * (b.rise - a.rise)});
  }
  part_.swap(clipped_);
  return part_.empty();
}

}  // namespace geom
