#include "geom/dual/vacancy_division.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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
  if (heirs_.empty()) heirs_.push_back(state_.nearest(state_.sites[p].position, p).site);
  before_p_.clear();
  for (const SiteId k : heirs_) before_p_.push_back(state_.clipper.bisector_of(p, k));
}

// --- one facet -----------------------------------------------------------------------------------

void VacancyDivision::divide_piece(FacetId t, std::span<const PolygonCorner> corners) {
  find_winners(corners);
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
    for (std::size_t i = 0; i < winners_.size(); ++i) add_share(t, i);
  }
  note_new_corners(first);
}

/// Those that are not farther than another one at all corners.
void VacancyDivision::find_winners(std::span<const PolygonCorner> corners) {
  const std::size_t n = corners.size();
  leads_.resize(n * heirs_.size());
  least_.clear();
  double bound = infinity;
  for (Heir k = 0; k < heirs_.size(); ++k) {
    const Bisector& b = before_p_[k];
    double least = infinity, most = -infinity;
    for (std::size_t i = 0; i < n; ++i) {
      const RoundedPoint& point = corners[i].point;
      const double lead = b(point.position), error = b.error + b.length * point.tolerance;
      leads_[k * n + i] = {lead - error, lead + error};
      least = std::min(least, lead - error);
      most = std::max(most, lead + error);
    }
    least_.push_back(least);
    bound = std::min(bound, most);
  }
  winners_.clear();
  for (Heir k = 0; k < heirs_.size(); ++k)
    if (least_[k] <= bound) winners_.push_back(k);
  if (winners_.size() > 1)
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

/// Clipped from the whole facet; in doubles, unless something is not certain.
void VacancyDivision::add_share(FacetId t, std::size_t winner) {
  using Outcome = RoughPolygon::Outcome;
  const Heir k = winners_[winner];
  const SiteId own = heirs_[k];
  const Bisector b = state_.clipper.bisector_of(own, p_);
  const bool is_bordered = num_labels_ > 0;  // else p has all of the facet
  Outcome outcome = Outcome::untouched;
  rough_.start();
  if (is_bordered) {
    const LinearForm form = state_.clipper.form_on(t, b);
    outcome = rough_.clip(EdgeLabel::bisector(p_), {{-form.f[0], -form.f[1], -form.f[2]}, form.error});
  }
  const auto is_going_on = [&] { return outcome == Outcome::untouched || outcome == Outcome::cut; };
  if (is_going_on())
    for_rivals(winner, [&](Heir h) {
      outcome = rough_.clip(EdgeLabel::bisector(heirs_[h]), state_.clipper.form_on(t, between(k, h)));
      return is_going_on();
    });
  if (outcome == Outcome::swallowed) return;
  if (is_going_on()) {
    state_.clipper.set_corners(polygon_, t, own, rough_.size(), [&](std::size_t i) { return rough_.label(i); });
  } else {
    state_.clipper.start(polygon_, t, own);
    if (is_bordered && state_.clipper.clip_beyond(polygon_, p_, b) == Clip::swallowed) return;
    for_rivals(winner, [&](Heir h) {
      return state_.clipper.clip(polygon_, heirs_[h], between(k, h)) != Clip::swallowed;
    });
    if (polygon_.corners.empty()) return;
  }
  shares_.add(polygon_);
}

/// All winners but this one, until `visit` returns false; first those that follow each other on the border.
template <class Visit>
void VacancyDivision::for_rivals(std::size_t winner, Visit visit) const {
  const std::size_t n = num_labels_;
  if (winner < n) {
    for (std::size_t step = 1; step <= n / 2; ++step)
      if (!visit(winners_[(winner + step) % n]) || (2 * step != n && !visit(winners_[(winner + n - step) % n])))
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
  const double radius = state_.distance_at(reach, p_);
  const std::size_t known = heirs_.size();
  candidates_.clear();
  state_.near({p_, state_.sites[p_].position, radius, power_}, candidates_);
  for (const SiteId j : candidates_) {
    if (j == p_ || is_behind(state_.sites[j], radius) || index_of(j) < heirs_.size() || !is_missing(j)) continue;
    heirs_.push_back(j);
    before_p_.push_back(state_.clipper.bisector_of(p_, j));
  }
  return heirs_.size() > known;
}

/// Is j farther than some heir in all of the ball about p's cell?
bool VacancyDivision::is_behind(const WeightedPoint3& j, double radius) const {
  const Vec3& center = state_.sites[p_].position;
  const double own = geom::power(center, j);
  for (const SiteId k : heirs_) {
    const WeightedPoint3& site = state_.sites[k];
    const double other = geom::power(center, site), lead = own - other;
    if (lead <= 1e-8 * (std::abs(own) + std::abs(other) + std::abs(j.weight) + std::abs(site.weight))) continue;
    if (lead * lead > 4 * radius * radius * (1 + 1e-6) * (j.position - site.position).squaredNorm()) return true;
  }
  return false;
}

/// Is j nearer than the heirs at some new corner? The lead of the owner over j is off by some ulps of what it is made of,
/// and by the tolerance of the corner times its slope, which is twice the distance of the two sites.
bool VacancyDivision::is_missing(SiteId j) {
  const WeightedPoint3& site = state_.sites[j];
  return std::ranges::any_of(new_corners_, [&](const NewCorner& at) {
    const auto& [position, tolerance] = at.corner.point;
    const double distance2 = (position - site.position).squaredNorm();
    const double lead = distance2 - site.weight - at.power, scale = distance2 + at.distance2;
    if (lead > 0x1p-46 * (scale + std::abs(site.weight) + std::abs(at.power)) +
                   tolerance * (3 * std::sqrt(scale) + tolerance))
      return false;
    return state_.clipper.beats_at(at.corner, j, state_.clipper.bisector_of(at.corner.owner, j));
  });
}

}  // namespace geom
