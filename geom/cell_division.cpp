#include "geom/cell_division.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace geom {

CellDivision::CellDivision(const TriMesh& mesh, const Clipper::Sites& sites, Clipper& clipper,
                           const FragmentStore& store)
    : mesh_(mesh), sites_(sites), clipper_(clipper), store_(store) {}

void CellDivision::begin(SiteId p, std::span<const FragmentId> vacated, std::span<const SiteId> excluded) {
  p_ = p;
  vacated_.assign(vacated.begin(), vacated.end());
  heirs_.clear();
  ++stamp_;
  const auto know = [&](SiteId s) {
    if (s.index() >= known_stamp_.size()) {
      known_stamp_.resize(s.index() + 1, 0);
      heir_index_.resize(s.index() + 1, 0);
    }
    known_stamp_[s] = stamp_;
  };
  know(p);
  for (const SiteId s : excluded) know(s);
  for (const FragmentId f : vacated_)
    for (const PolygonCorner& corner : store_.corners(f))
      if (corner.edge.is_site() && is_stranger(corner.edge.site())) add_heir(corner.edge.site());
}

void CellDivision::add_heir(SiteId k) {
  if (k.index() >= known_stamp_.size()) {
    known_stamp_.resize(k.index() + 1, 0);
    heir_index_.resize(k.index() + 1, 0);
  }
  known_stamp_[k] = stamp_;
  heir_index_[k] = static_cast<std::uint32_t>(heirs_.size());
  heirs_.push_back(k);
}

void CellDivision::prepare() {
  num_shares_ = 0;
  misfit_ = false;
  corners_.clear();
  const std::size_t n = heirs_.size();
  bisectors_.resize(n * n);
  for (Heir k = 0; k < n; ++k)
    for (Heir h = 0; h < k; ++h) {
      const Bisector b = clipper_.bisector_of(heirs_[k], heirs_[h]);
      bisectors_[k * n + h] = b;
      bisectors_[h * n + k] = {-b.normal, -b.offset, b.length, b.error};  // to the bit
    }
}

CellDivision::Share& CellDivision::add_share() {
  if (num_shares_ == shares_.size()) shares_.emplace_back();
  Share& share = shares_[num_shares_++];
  share.joins = FragmentId();
  return share;
}

bool CellDivision::is_missing(SiteId j) const {
  const EdgeLabel own = EdgeLabel::bisector(j);
  return std::ranges::any_of(corners_, [&](const CellCorner& c) {
    return c.before != own && c.after != own &&  // where an edge is labelled j, j is no news
           clipper_.beats_at(c, j, clipper_.bisector_of(c.owner, j));
  });
}

/// With a the rounded distance of a corner and b = sqrt(3) tolerance, (a + b)^2 <= a^2 (1 + e) + b^2 (1 +
/// 1/e).
double CellDivision::max_radius2() const {
  constexpr double e = 1e-9, infinity = std::numeric_limits<double>::infinity();
  double result = -infinity;
  for (const CellCorner& corner : corners_) {
    const WeightedPoint3& owner = sites_[corner.owner];
    const double b2 = 3 * corner.point.tolerance * corner.point.tolerance;
    double bound = (corner.point.position - owner.position).squaredNorm() * (1 + e) + b2 * (1 + 1 / e);
    if (!(bound < infinity)) {
      bound = 0;
      for (int i = 0; i < 3; ++i)
        bound = std::max(bound, (mesh_.corner(corner.facet, i) - owner.position).squaredNorm() * (1 + e));
    }
    result = std::max(result, bound - owner.weight);
  }
  return result;
}

void CellDivision::divide() {
  prepare();
  find_old_fragments();
  for (std::size_t i = 0; i < vacated_.size(); ++i) clip_shares(i);
}

// Divides one fragment P of p, on facet t, among the heirs H, which contain every label of P. The share of k
// is
//
//     { x in t : p beats k at x, and k beats every other h in H at x }
//
// because where k beats all labels of P and p beats k, p beats them too, and the location is in P. If P has
// an edge labelled k, the share lies along that edge and joins the fragment that k has there. If not, it is
// an island, for on every edge of P another heir is nearer than k; then p beats k on all of { k beats every
// other h } or nowhere on it, and a k that has a fragment on t already has no share, because the two would
// make one convex fragment.
void CellDivision::clip_shares(std::size_t vacated) {
  const FragmentId f = vacated_[vacated];
  const FacetId t = store_.facet(f);
  order_heirs(f);
  if (store_.whole(f) && inherits_whole(t)) return;
  std::array<PolygonCorner, 3> buffer;
  const std::span<const PolygonCorner> vacancy = store_.corners(f, buffer);
  for (const Heir i : order_) {
    const SiteId k = heirs_[i];
    const FragmentId old = old_fragment(vacated, i);
    const bool borders = std::ranges::any_of(
        vacancy, [&](const PolygonCorner& c) { return c.edge == EdgeLabel::bisector(k); });
    if (!borders && (old.valid() || yields_everywhere(i, vacancy))) continue;
    Share& share = add_share();
    share.joins = old;
    FacetPolygon& polygon = share.polygon;
    clipper_.start(polygon, t, k);
    const Bisector beyond = clipper_.bisector_of(k, p_);
    if (borders) clipper_.clip_beyond(polygon, p_, beyond);
    for (const Heir h : order_) {
      if (polygon.corners.empty()) break;
      if (h != i) clipper_.clip(polygon, heirs_[h], bisector(i, h));
    }
    misfit_ |= borders && polygon.corners.empty();
    if (polygon.corners.empty() || (!borders && !clipper_.beats_at(polygon, 0, p_, beyond)))
      --num_shares_;
    else
      for (std::size_t c = 0; c < polygon.corners.size(); ++c)
        corners_.push_back(cell_corner(t, k, polygon.corners, c));
  }
}

/// Is some other heir surely nearer than heir i at every corner of this polygon, hence all over it? Most
/// heirs that do not border a fragment are dismissed by this. "No" means nothing: the corners are rounded.
bool CellDivision::yields_everywhere(Heir i, std::span<const PolygonCorner> corners) const {
  return std::ranges::any_of(order_, [&](Heir h) {
    const Bisector& b = bisector(i, h);
    return h != i && std::ranges::all_of(corners, [&](const PolygonCorner& c) {
             return b(c.point.position) < -(b.error + b.length * c.point.tolerance);
           });
  });
}

/// First the heirs that border the vacancy on its facet; if none does, the one that is nearest to the facet's
/// middle.
void CellDivision::order_heirs(FragmentId vacated) {
  order_.resize(heirs_.size());
  std::iota(order_.begin(), order_.end(), Heir{0});
  std::size_t front = 0;
  for (const PolygonCorner& corner : store_.corners(vacated)) {
    if (!corner.edge.is_site()) continue;
    for (std::size_t i = front; i < order_.size(); ++i)
      if (heirs_[order_[i]] == corner.edge.site()) std::swap(order_[i], order_[front++]);
  }
  if (front > 0) return;
  const Vec3 middle = clipper_.middle(store_.facet(vacated));
  Heir best = 0;
  for (Heir i = 1; i < heirs_.size(); ++i)
    if (bisector(best, i)(middle) < 0) best = i;
  std::swap(order_[0], order_[best]);
}

/// For a facet that p owned whole: does the first heir in order get all of it? Then that is noted.
bool CellDivision::inherits_whole(FacetId t) {
  const Heir first = order_.front();
  clipper_.start(polygon_, t, heirs_[first]);
  for (Heir h = 0; h < heirs_.size(); ++h)
    if (h != first && clipper_.classify(t, polygon_.owner, polygon_.corners, heirs_[h], bisector(first, h),
                                        beaten_) != Clip::untouched)
      return false;
  Share& share = add_share();
  clipper_.start(share.polygon, t, heirs_[first]);
  for (std::size_t c = 0; c < 3; ++c)
    corners_.push_back(cell_corner(t, share.polygon.owner, share.polygon.corners, c));
  return true;
}

/// What the heirs have on the facets of the vacated fragments: from a facet's list if that is short, else heir
/// by heir.
void CellDivision::find_old_fragments() {
  const std::size_t short_list = 8 * heirs_.size();
  old_fragments_.assign(vacated_.size() * heirs_.size(), FragmentId());
  const auto is_short = [&](FragmentId f) { return store_.of_facet(store_.facet(f)).size() <= short_list; };
  for (std::size_t i = 0; i < vacated_.size(); ++i) {
    if (store_.whole(vacated_[i])) continue;
    const FacetId t = store_.facet(vacated_[i]);
    FragmentId* const row = old_fragments_.data() + i * heirs_.size();
    if (is_short(vacated_[i])) {
      for (const FragmentId g : store_.of_facet(t)) {
        const SiteId s = store_.site(g);
        const std::size_t h = s.index() < heir_index_.size() ? heir_index_[s] : none;
        if (h < heirs_.size() && heirs_[h] == s) row[h] = g;
      }
    } else {
      for (std::size_t h = 0; h < heirs_.size(); ++h) row[h] = store_.find(heirs_[h], t);
    }
  }
}

}  // namespace geom
