#include "geom/dual/vacancy_division.h"

#include <algorithm>
#include <cmath>

namespace geom {
namespace {

constexpr std::size_t group_size = 16;  // new corners

}  // namespace

void VacancyDivision::divide(SiteId p, const CellPieces& cell, double reach) {
  begin(p, cell);
  do {
    shares_.clear();
    new_corners_.clear();
    ++stamp_;
    between_.assign(heirs_.size() * heirs_.size(), {});
    power_ = reach;
    for (const CellPieces::Piece& piece : cell.pieces) divide_piece(piece.facet, cell.corners_of(piece));
  } while (add_missing_heirs(reach));
}

void VacancyDivision::begin(SiteId p, const CellPieces& cell) {
  p_ = p;
  heirs_.clear();
  for (const CellPieces::Piece& piece : cell.pieces)
    for (const PolygonCorner& corner : cell.corners_of(piece))
      if (corner.edge.is_site() && std::ranges::find(heirs_, corner.edge.site()) == heirs_.end())
        heirs_.push_back(corner.edge.site());
  const WeightedPoint3& site = state_.sites[p];
  if (heirs_.empty()) heirs_.push_back(state_.nearest({site.position, site.level}, p).site);
  before_p_.clear();
  for (const SiteId k : heirs_) before_p_.push_back(state_.clipper.bisector_of(p, k));
}

// --- one facet -----------------------------------------------------------------------------------

void VacancyDivision::divide_piece(FacetId t, std::span<const PolygonCorner> corners) {
  find_winners(t, corners);
  const std::size_t first = shares_.pieces.size();
  if (winners_.size() == 1) {  // all of it, bordered by p alone
    const SiteId k = heirs_[winners_.front()];
    polygon_.facet = t;
    polygon_.owner = k;
    polygon_.corners.assign(corners.begin(), corners.end());
    for (PolygonCorner& corner : polygon_.corners)
      if (corner.edge.is_site()) corner.edge = EdgeLabel::bisector(p_);
    shares_.add(polygon_);
  } else {
    order_winners(corners);
    for (std::size_t i = 0; i < winners_.size(); ++i) add_share(t, corners, i);
  }
  note_new_corners(first);
}

/// Those that are not farther than another one at all corners; mostly that is seen from a ball about the
/// piece.
void VacancyDivision::find_winners(FacetId t, std::span<const PolygonCorner> corners) {
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
  for (const Bisector& b : before_p_) {
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
      const auto [lead, error] = state_.clipper.value_at(t, corners[i].point, before_p_[k]);
      leads_[k * n + i] = {lead - error, lead + error};
    }
  std::erase_if(winners_, [&](Heir k) {
    return std::ranges::any_of(winners_, [&](Heir by) { return by != k && is_dominated(k, by, n); });
  });
}

bool VacancyDivision::is_dominated(Heir k, Heir by, std::size_t num_corners) const {
  for (std::size_t i = 0; i < num_corners; ++i)
    if (!(leads_[by * num_corners + i].most < leads_[k * num_corners + i].least)) return false;
  return true;
}

void VacancyDivision::order_winners(std::span<const PolygonCorner> corners) {
  num_labels_ = 0;
  for (const PolygonCorner& corner : corners) {
    if (!corner.edge.is_site()) continue;
    const auto at = std::ranges::find(winners_, index_of(corner.edge.site()));
    if (at == winners_.end()) continue;
    std::swap(*at, winners_[num_labels_]);
    ++num_labels_;
  }
}

/// Clipped from the whole facet.
void VacancyDivision::add_share(FacetId t, std::span<const PolygonCorner> corners, std::size_t winner) {
  const Heir k = winners_[winner];
  const SiteId own = heirs_[k];
  lazy_.start(t, own);
  const bool is_bordered = num_labels_ > 0;  // else p has all of the facet
  if (is_bordered && lazy_.clip_beyond(p_, state_.clipper.bisector_of(own, p_)) == Clip::swallowed) return;
  bool is_left = true;
  for_rivals(winner, [&](Heir h) {
    is_left = lazy_.clip(heirs_[h], between(k, h)) != Clip::swallowed;
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
const RoundedPoint* VacancyDivision::known_corner(FacetId t, std::span<const PolygonCorner> corners,
                                                  EdgeLabel own, EdgeLabel before, EdgeLabel after) const {
  const EdgeLabel gone = EdgeLabel::bisector(p_);
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

/// The corner between edges with these labels, in whichever order; null if there is none.
const RoundedPoint* VacancyDivision::find_corner(std::span<const PolygonCorner> corners, EdgeLabel one,
                                                 EdgeLabel two) {
  EdgeLabel before = corners.back().edge;
  for (const PolygonCorner& corner : corners) {
    if ((before == one && corner.edge == two) || (before == two && corner.edge == one)) return &corner.point;
    before = corner.edge;
  }
  return nullptr;
}

/// All winners but this one, until `visit` returns false; first those that follow each other on the border.
template <class Visit>
void VacancyDivision::for_rivals(std::size_t winner, Visit visit) const {
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

const Bisector& VacancyDivision::between(Heir k, Heir h) {
  std::optional<Bisector>& b = between_[k * heirs_.size() + h];
  if (!b) b = state_.clipper.bisector_of(heirs_[k], heirs_[h]);
  return *b;
}

// --- who else ------------------------------------------------------------------------------------

void VacancyDivision::note_new_corners(std::size_t first_share) {
  for (std::size_t i = first_share; i < shares_.pieces.size(); ++i) {
    const auto& [t, owner, first, size] = shares_.pieces[i];
    const std::span<const PolygonCorner> share = shares_.corners_of(shares_.pieces[i]);
    const WeightedPoint3& site = state_.sites[owner];
    for (std::size_t k = 0; k < share.size(); ++k) {
      if (!is_new(share, k)) continue;
      power_ = std::max(power_, state_.clipper.bound_power(t, owner, share.subspan(k, 1)));
      if (!is_first(t, owner, share[previous_corner(k, share.size())].edge, share[k].edge)) continue;
      const double distance2 = (share[k].point.position - site.position).squaredNorm();
      new_corners_.push_back({cell_corner(t, owner, share, k), distance2 - site.weight, distance2});
    }
  }
}

/// Of the corners that are one location: in shares of other sites, or on other facets.
bool VacancyDivision::is_first(FacetId t, SiteId owner, EdgeLabel before, EdgeLabel after) {
  if ((before.is_site() && before.site() < owner) || (after.is_site() && after.site() < owner)) return false;
  if (before.is_site() && after.is_site()) return true;
  if (before.is_site() || after.is_site()) {
    const FacetId across = state_.mesh.across(t, before.is_site() ? after.edge() : before.edge());
    return !across.valid() || t < across;
  }
  std::uint32_t& stamp = stamp_of_[state_.mesh.facet(t)[static_cast<std::size_t>(after.edge())]];
  const bool is_new = stamp != stamp_;
  stamp = stamp_;
  return is_new;
}

bool VacancyDivision::add_missing_heirs(double reach) {
  const std::size_t known = heirs_.size();
  group_new_corners();
  candidates_.clear();
  state_.near({p_, state_.sites[p_].position, state_.distance_at(reach, p_), power_}, candidates_);
  for (const SiteId j : candidates_) {
    if (j == p_ || index_of(j) < known || !is_missing(j)) continue;
    heirs_.push_back(j);
    before_p_.push_back(state_.clipper.bisector_of(p_, j));
  }
  return heirs_.size() > known;
}

/// By owners, with a ball about a few at a time.
void VacancyDivision::group_new_corners() {
  std::ranges::stable_sort(new_corners_, {}, [](const NewCorner& c) { return c.corner.owner; });
  groups_.clear();
  for (std::size_t i = 0, end = 0; i < new_corners_.size(); i = end) {
    Box3 box;
    double tolerance = 0;
    for (end = i; end < std::min(i + group_size, new_corners_.size()) &&
                  new_corners_[end].corner.owner == new_corners_[i].corner.owner;
         ++end) {
      box.extend(new_corners_[end].corner.point.position);
      tolerance = std::max(tolerance, new_corners_[end].corner.point.tolerance);
    }
    groups_.push_back({i, end, box.center(), (0.5 * box.sizes().norm() + tolerance) * (1 + 1e-9)});
  }
}

/// Is j nearer than the heirs at some new corner?
bool VacancyDivision::is_missing(SiteId j) {
  return std::ranges::any_of(groups_, [&](const Group& group) {
    const std::span<const NewCorner> corners =
        std::span(new_corners_).subspan(group.begin, group.end - group.begin);
    return !is_behind(state_.sites[j], state_.sites[corners.front().corner.owner], group) &&
           std::ranges::any_of(corners, [&](const NewCorner& at) { return beats_at(j, at); });
  });
}

/// Is j farther than the owner in all of the ball?
bool VacancyDivision::is_behind(const WeightedPoint3& j, const WeightedPoint3& owner,
                                const Group& ball) const {
  if (j.level != owner.level) return false;
  const double far = geom::power(ball.center, j), near = geom::power(ball.center, owner), lead = far - near;
  if (lead <= 1e-8 * (std::abs(far) + std::abs(near) + std::abs(j.weight) + std::abs(owner.weight)))
    return false;
  return lead * lead >
         4 * ball.radius * ball.radius * (1 + 1e-6) * (j.position - owner.position).squaredNorm();
}

/// The lead of the owner over j is off by some ulps of what it is made of, and by the tolerance of the corner
/// times its slope, which is twice the distance of the two sites.
bool VacancyDivision::beats_at(SiteId j, const NewCorner& at) const {
  const WeightedPoint3& site = state_.sites[j];
  const auto& [position, tolerance] = at.corner.point;
  const double distance2 = (position - site.position).squaredNorm();
  const double lead = distance2 - site.weight - at.power, scale = distance2 + at.distance2;
  if (site.level == state_.sites[at.corner.owner].level &&
      lead > 0x1p-46 * (scale + std::abs(site.weight) + std::abs(at.power)) +
                 tolerance * (3 * std::sqrt(scale) + tolerance))
    return false;
  return state_.clipper.beats_at(at.corner, j, state_.clipper.bisector_of(at.corner.owner, j));
}

}  // namespace geom
