#include "geom/dual/piece_division.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geom {
namespace {

/// The corner between edges with these labels, in whichever order; null if there is none.
const RoundedPoint* find_corner(std::span<const PolygonCorner> corners, EdgeLabel one, EdgeLabel two) {
  EdgeLabel before = corners.back().edge;
  for (const PolygonCorner& corner : corners) {
    if ((before == one && corner.edge == two) || (before == two && corner.edge == one)) return &corner.point;
    before = corner.edge;
  }
  return nullptr;
}

}  // namespace

void PieceDivision::divide(FacetId t, std::span<const PolygonCorner> corners) {
  find_winners(t, corners);
  if (winners_.size() == 1) {  // all of it, bordered by p alone
    const SiteId k = heirs_[winners_.front()];
    polygon_.facet = t;
    polygon_.owner = k;
    polygon_.corners.assign(corners.begin(), corners.end());
    for (PolygonCorner& corner : polygon_.corners)
      if (corner.edge.is_site()) corner.edge = EdgeLabel::bisector(heirs_.p());
    shares_.add(polygon_);
  } else {
    order_winners(corners);
    for (std::size_t i = 0; i < winners_.size(); ++i) add_share(t, corners, i);
  }
}

/// Those that are not farther than another one at all corners; mostly that is seen from a ball about the
/// piece.
void PieceDivision::find_winners(FacetId t, std::span<const PolygonCorner> corners) {
  const std::size_t n = corners.size();
  Box3 box;
  double tolerance = 0;
  for (const PolygonCorner& corner : corners) {
    box.extend(corner.point.position);
    tolerance = std::max(tolerance, corner.point.tolerance);
  }
  const Vec3 middle = box.center();
  const double radius = (0.5 * box.sizes().norm() + tolerance) * (1 + 1e-9);
  double bound = infinity;
  least_.clear();
  for (const Bisector& b : heirs_.before_p()) {
    double lead = b(middle), off = b.error + b.length * radius;
    if (b.rise != 0) {
      lead += b.rise * state_.clipper.levels().middle(t);
      off += std::abs(b.rise) * state_.clipper.levels().half(t);
    }
    least_.push_back(lead - off);
    bound = std::min(bound, lead + off);
  }
  winners_.clear();
  for (Heir k = 0; k < heirs_.size(); ++k)
    if (least_[k] <= bound) winners_.push_back(k);
  if (winners_.size() == 1) return;
  leads_.resize(n * heirs_.size());
  for (const Heir k : winners_)
    for (std::size_t i = 0; i < n; ++i) {
      const auto [lead, error] = state_.clipper.value_at(t, corners[i].point, heirs_.before_p()[k]);
      leads_[k * n + i] = {lead - error, lead + error};
    }
  std::erase_if(winners_, [&](Heir k) {
    return std::ranges::any_of(winners_, [&](Heir by) { return by != k && is_dominated(k, by, n); });
  });
}

bool PieceDivision::is_dominated(Heir k, Heir by, std::size_t num_corners) const {
  for (std::size_t i = 0; i < num_corners; ++i)
    if (!(leads_[by * num_corners + i].most < leads_[k * num_corners + i].least)) return false;
  return true;
}

void PieceDivision::order_winners(std::span<const PolygonCorner> corners) {
  num_labels_ = 0;
  for (const PolygonCorner& corner : corners) {
    if (!corner.edge.is_site()) continue;
    const auto at = std::ranges::find(winners_, heirs_.index_of(corner.edge.site()));
    if (at == winners_.end()) continue;
    std::swap(*at, winners_[num_labels_]);
    ++num_labels_;
  }
}

/// Clipped from the whole facet.
void PieceDivision::add_share(FacetId t, std::span<const PolygonCorner> corners, std::size_t winner) {
  const Heir k = winners_[winner];
  const SiteId own = heirs_[k];
  lazy_.start(t, own);
  const bool is_bordered = num_labels_ > 0;  // else p has all of the facet
  if (is_bordered &&
      lazy_.clip_beyond(heirs_.p(), state_.clipper.bisector_of(own, heirs_.p())) == Clip::swallowed)
    return;
  bool is_left = true;
  for_rivals(winner, [&](Heir h) {
    is_left = lazy_.clip(heirs_[h], heirs_.between(k, h)) != Clip::swallowed;
    return is_left;
  });
  if (!is_left) return;
  lazy_.place(polygon_, [&](EdgeLabel before, EdgeLabel after) {
    return known_corner(t, corners, EdgeLabel::bisector(own), before, after);
  });
  shares_.add(polygon_);
}

/// A corner of a share of `own`; null if it is not known: those on p's border are corners of its cell, others
/// may be of shares that were found before on the same facet.
const RoundedPoint* PieceDivision::known_corner(FacetId t, std::span<const PolygonCorner> corners,
                                                EdgeLabel own, EdgeLabel before, EdgeLabel after) const {
  const EdgeLabel gone = EdgeLabel::bisector(heirs_.p());
  if (before == gone || after == gone) return find_corner(corners, own, before == gone ? after : before);
  for (std::size_t i = shares_.pieces.size(); i > 0 && shares_.pieces[i - 1].facet == t; --i) {
    const EdgeLabel other = EdgeLabel::bisector(shares_.pieces[i - 1].owner);
    if (other != before && other != after) continue;
    if (const RoundedPoint* point =
            find_corner(shares_.corners_of(shares_.pieces[i - 1]), own, other == before ? after : before))
      return point;
  }
  return nullptr;
}

/// All winners but this one, until `visit` returns false; first those that follow each other on the border.
template <class Visit>
void PieceDivision::for_rivals(std::size_t winner, Visit visit) const {
  const std::size_t n = num_labels_;
  if (winner < n) {
    for (std::size_t step = 1; step <= n / 2; ++step)
      if (!visit(winners_[(winner + step) % n]) ||
          (2 * step != n && !visit(winners_[(winner + n - step) % n])))
        return;
  } else {
    for (std::size_t i = 0; i < n; ++i)
      if (!visit(winners_[i])) return;
  }
  for (std::size_t i = n; i < winners_.size(); ++i)
    if (i != winner && !visit(winners_[i])) return;
}

}  // namespace geom
