#include "geom/dual/cell_clipper.h"

#include <algorithm>
#include <cmath>

#include "geom/mesh/aabb_tree.h"

namespace geom {
namespace {

constexpr std::size_t many = 48;  // sites: the nearest few of them first

/// From a polygon.
double distance(const Vec3& x, std::span<const PolygonCorner> corners) {
  double least2 = infinity;
  for (std::size_t k = 2; k < corners.size(); ++k)
    least2 = std::min(least2, closest_point(x, {corners[0].point.position, corners[k - 1].point.position,
                                                corners[k].point.position})
                                  .distance2);
  return std::sqrt(least2);
}

}  // namespace

double CellClipper::clip(SiteId p, CellPieces& out) {
  around_.clear();
  for (const CircleId c : state_.circles.of_site(p))
    for (const SiteId s : state_.circles[c].sites)
      if (s.valid() && s != p && std::ranges::find(around_, s) == around_.end()) around_.push_back(s);
  return clip(p, state_.reach[p], around_, out);
}

double CellClipper::clip(SiteId p, double power, std::span<const SiteId> around, CellPieces& out) {
  out.clear();
  const double radius = state_.distance_at(power, p);
  if (!(radius > 0)) return -infinity;
  begin(p, around);
  near_.clear();
  state_.facets.near({state_.sites[p].position, state_.sites[p].level}, radius, near_);
  return clip_near(p, power, radius, out);
}

bool CellClipper::has_part_of(FacetId t, SiteId p) {
  part_.clear();
  const double power = state_.reach[p], radius = state_.distance_at(power, p);
  if (!(radius > 0)) return false;
  begin(p, {});
  near_.assign(1, t);
  return clip_near(p, power, radius, part_) > -infinity;
}

/// No sites are considered but these.
void CellClipper::begin(SiteId p, std::span<const SiteId> around) {
  if (stamp_of_.size() < state_.sites.size()) stamp_of_.resize(state_.sites.size(), 0);
  stamp_of_[p] = ++stamp_;
  others_.clear();
  consider(p, around);
}

// What is left after some sites is more than the cell. So whoever takes anything of it is found by the bound
// of the power on what is left; but when that is more than the cell is known to have, it pays to look less
// far first.
/// The cell on the facets near_.
double CellClipper::clip_near(SiteId p, double power, double radius, CellPieces& out) {
  for (const FacetId t : near_)
    if (state_.clipper.comes_near(t, state_.sites[p].position, radius) &&
        state_.clipper.levels().gap(t, state_.sites[p].level) <= radius && cut(t, p, {}, 0))
      out.add(polygon_);
  for (double cap = power;;) {
    const double left = bound(out);
    if (out.pieces.empty()) return left;
    const double seen = find_others(p, std::min(left, cap));
    cut_pieces(p, out);
    if (seen == left) return others_.empty() ? left : bound(out);
    if (seen == cap) {
      drop_beyond(p, state_.distance_at(cap, p), out);
      cap = infinity;
    }
  }
}

// No location of p has more than the power that is known, and whoever takes any with less was considered. So
// what is left within that ball is the cell, and a part that went on beyond it would have a location of p at
// the ball's edge and, bisectors being continuous, beyond: parts are within the ball or without. Large facets
// that p shares with nobody near have such ones without: those that cut them are any number, and far.
void CellClipper::drop_beyond(SiteId p, double radius, CellPieces& cell) {
  const double far = radius * (1 + 1e-9) + 2 * state_.clipper.most_tolerance();
  const auto is_beyond = [&](const CellPieces::Piece& piece) {
    return distance(state_.sites[p].position, cell.corners_of(piece)) > far;
  };
  if (std::ranges::none_of(cell.pieces, is_beyond)) return;
  spare_.clear();
  for (const CellPieces::Piece& piece : cell.pieces)
    if (!is_beyond(piece)) spare_.add(piece, cell.corners_of(piece));
  std::swap(spare_, cell);
}

void CellClipper::consider(SiteId p, std::span<const SiteId> sites) {
  for (const SiteId s : sites) {
    stamp_of_[s] = stamp_;
    others_.push_back({s, state_.clipper.bisector_of(p, s)});
  }
}

/// All sites that were not considered and may take something of locations of at most that power; if they are
/// too many, the nearest of them. Returns the power up to which that is so, -infinity if they are too many.
double CellClipper::find_others(SiteId p, double power) {
  const Vec3& center = state_.sites[p].position;
  const double radius = state_.distance_at(power, p);
  candidates_.clear();
  state_.search.near({p, center, radius, power}, candidates_);
  others_.clear();
  std::erase_if(candidates_, [&](SiteId s) { return stamp_of_[s] == stamp_; });
  if (candidates_.size() > many) {
    const auto distance2 = [&](SiteId s) { return (state_.sites[s].position - center).squaredNorm(); };
    std::ranges::nth_element(candidates_, candidates_.begin() + many / 4, {}, distance2);
    candidates_.resize(many / 4);
    consider(p, candidates_);
    return -infinity;
  }
  for (const SiteId s : candidates_) {
    const Bisector b = state_.clipper.bisector_of(p, s);
    if (b(Location3(center, state_.sites[p].level)) > b.error + b.steepness() * radius * (1 + 1e-9))
      continue;  // p is nearer in all of the ball
    stamp_of_[s] = stamp_;
    others_.push_back({s, b});
  }
  return power;
}

/// Leaves in polygon_ what others_ from the first one on leave to p of a polygon, or of the whole facet if
/// there is none. False if that is nothing.
bool CellClipper::cut(FacetId t, SiteId p, std::span<const PolygonCorner> corners, std::size_t first) {
  cutting_.clear();
  if (last_ < others_.size() &&
      state_.clipper.compare_on_facet(t, others_[last_].bisector) == Clip::swallowed)
    return false;
  double least = infinity;
  std::size_t deepest = 0;
  for (const Other& other : std::span(others_).subspan(first)) {
    const auto [whole, lead] = state_.clipper.lead_on_facet(t, other.bisector);
    if (whole == Clip::swallowed) {
      last_ = static_cast<std::size_t>(&other - others_.data());
      return false;
    }
    if (whole != Clip::cut) continue;
    const double depth = lead / other.bisector.length;  // of the middle, from the bisector
    if (depth < least) least = depth, deepest = cutting_.size();
    cutting_.push_back(&other);
  }
  // First who leaves the least to be cut. What is left in the end is the same in any order, but for where the
  // cycle of corners begins: which there are is decided exactly, where they are by labels (cell_corners.h).
  if (!cutting_.empty()) std::swap(cutting_.front(), cutting_[deepest]);
  if (corners.empty()) return cut_facet(t, p);
  polygon_.facet = t;
  polygon_.owner = p;
  polygon_.corners.assign(corners.begin(), corners.end());
  for (const Other* other : cutting_) {
    const Clip outcome =
        state_.clipper.classify_corners(t, p, polygon_.corners, other->site, other->bisector, beaten_);
    if (outcome == Clip::swallowed) return false;
    if (outcome == Clip::cut) state_.clipper.cut(polygon_, other->site, other->bisector, beaten_);
  }
  return true;
}

bool CellClipper::cut_facet(FacetId t, SiteId p) {
  lazy_.start(t, p);
  for (const Other* other : cutting_)
    if (lazy_.clip(other->site, other->bisector) == Clip::swallowed) return false;
  lazy_.place(polygon_);
  return true;
}

/// Cuts all pieces by others_, and forgets these if they take nothing.
void CellClipper::cut_pieces(SiteId p, CellPieces& cell) {
  bool is_touched = false;
  for (std::size_t i = 0; i < cell.pieces.size(); ++i) {
    const CellPieces::Piece piece = cell.pieces[i];
    const std::span<const PolygonCorner> corners = cell.corners_of(piece);
    const auto takes_part = [&](const Other& other) {
      return state_.clipper.classify(piece.facet, p, corners, other.site, other.bisector, beaten_) !=
             Clip::untouched;
    };
    const auto first = std::ranges::find_if(others_, takes_part);
    if (first == others_.end()) {
      if (is_touched) spare_.add(piece, corners);
      continue;
    }
    if (!is_touched) {
      is_touched = true;
      spare_.clear();
      for (std::size_t k = 0; k < i; ++k) spare_.add(cell.pieces[k], cell.corners_of(cell.pieces[k]));
    }
    if (cut(piece.facet, p, corners, static_cast<std::size_t>(first - others_.begin()))) spare_.add(polygon_);
  }
  if (is_touched)
    std::swap(spare_, cell);
  else
    others_.clear();
}

double CellClipper::bound(const CellPieces& cell) const {
  double power = -infinity;
  for (const CellPieces::Piece& piece : cell.pieces)
    power = std::max(power, state_.clipper.bound_power(piece.facet, piece.owner, cell.corners_of(piece)));
  return power;
}

}  // namespace geom
