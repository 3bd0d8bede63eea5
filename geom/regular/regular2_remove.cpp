// Removal: the star of a site becomes a hole, which is filled by gift wrapping. Every triangle of the filling
// has a chord or edge of the hole and, of the corners beyond it, the one whose circle with the chord contains
// no other.
//
//          apex
//           *           A chord (last, first) closes the chain first .. last of the hole's corners. Its
//         /   \         triangle's apex splits it into two shorter chains; the first chord is the edge
//      __/     \__      from the last corner of the whole hole to its first. All numbers are seen from the
//   last -------> first removed site, so they are small and exact.

#include <algorithm>
#include <cmath>

#include "geom/check.h"
#include "geom/regular/regular2.h"

namespace geom {
namespace {

constexpr double roundoff = 0x1p-53;

}  // namespace

Regular2::Change Regular2::remove(SiteId id) {
  ensure(contains(id), "removal of a site that is not in the triangulation");
  begin_change();
  if (is_hidden(id)) {
    unlink_hidden(id);
    sites_[id].at = Side();
    return change();
  }
  open_hole(id);
  plan_hole(hole_scale());
  require_short_chords();
  fill_hole(id);
  if (!displaced_.empty()) expose_orphans();
  return change();
}

void Regular2::open_hole(SiteId p) {
  star_.clear();
  rim_.clear();
  beyond_.clear();
  const Site& origin = sites_[p];
  visit_star(p, [&](SimplexId t, int corner) {
    const Simplex& simplex = simplices_[t];
    star_.push_back(t);
    rim_.push_back(seen_from(origin, simplex.corner[static_cast<std::size_t>(next(corner))]));
    beyond_.push_back(simplex.mate[static_cast<std::size_t>(corner)]);
  });
}

// With all |coordinates| <= M and weights within V of each other, the quantities of apex() are bounded by
// |b|^2, |c|^2, |b.c|, |D| <= 8 M^2 and |B|, |C| <= 8 M^2 + V, so |n| <= 16 M^2 (8 M^2 + V). D carries three
// roundings: 3u 8 M^2 < 32u M^2. The comparison n D' - n' D carries at most a dozen along each product, two
// products of at most 128 M^4 (8 M^2 + V): 24u 128 M^4 (8 M^2 + V) < 4096u M^4 (8 M^2 + V).
Regular2::HoleScale Regular2::hole_scale() const {
  double m = 0, lightest = rim_[0].weight, heaviest = lightest;
  for (const Corner& c : rim_) {
    m = std::max({m, std::abs(c.x), std::abs(c.y)});
    lightest = std::min(lightest, c.weight);
    heaviest = std::max(heaviest, c.weight);
  }
  const double m2 = m * m;
  return {32 * roundoff * m2, 4096 * roundoff * m2 * m2 * (8 * m2 + (heaviest - lightest))};
}

/// Which corner of the chain makes the triangle on its chord.
///
/// Seen from a = rim[last], with b = rim[first]: the centers of the circles orthogonal to a and b are
/// (B / 2|b|^2) b + t b', where B = |b|^2 - w_b + w_a and b' is b turned left. The one orthogonal to c too
/// has t = n / (2 |b|^2 D), n = C |b|^2 - B (b.c), D = det(b, c). Of the candidates on the left of the chord
/// (D > 0) the one of least t has no other inside its circle: compare n / D by cross multiplication.
std::int32_t Regular2::apex(std::int32_t first, std::int32_t last, const HoleScale& scale) const {
  if (last - first == 2) return first + 1;
  const auto corner = [&](std::int32_t k) -> const Corner& { return rim_[static_cast<std::size_t>(k)]; };
  const auto point = [&](std::int32_t k) {
    return WeightedPoint2{{corner(k).x, corner(k).y}, corner(k).weight};
  };
  const Corner& a = corner(last);
  const double bx = corner(first).x - a.x, by = corner(first).y - a.y;
  const double b2 = bx * bx + by * by, bw = b2 - (corner(first).weight - a.weight);
  std::int32_t best = -1;
  double best_n = 0, best_det = 0;
  for (std::int32_t k = first + 1; k < last; ++k) {
    const double cx = corner(k).x - a.x, cy = corner(k).y - a.y;
    const double det = bx * cy - by * cx;
    if (det < -scale.orientation) continue;
    if (det <= scale.orientation &&
        orient2(point(last).position, point(first).position, point(k).position) <= 0)
      continue;
    const double cw = cx * cx + cy * cy - (corner(k).weight - a.weight);
    const double n = cw * b2 - bw * (bx * cx + by * cy);
    const double lead = best_n * det - n * best_det;  // > 0: k is inside the circle with best
    bool better = best < 0 || lead > scale.comparison;
    if (!better && lead >= -scale.comparison) {
      const WeightedPoint2 pa = point(last), pb = point(first), pc = point(best), pe = point(k);
      better = conflicts2({&pa, a.id.value}, {&pb, corner(first).id.value}, {&pc, corner(best).id.value},
                          {&pe, corner(k).id.value});
    }
    if (better) {
      best = k;
      best_n = n;
      best_det = det;
    }
  }
  ensure(best >= 0, "no corner of the hole is on the left of a chord");
  return best;
}

/// Parents before children.
void Regular2::plan_hole(const HoleScale& scale) {
  plan_.clear();
  chords_.clear();
  chords_.push_back({0, static_cast<std::int32_t>(rim_.size()) - 1, -1, 0});
  while (!chords_.empty()) {
    const auto [first, last, parent, which] = chords_.back();
    chords_.pop_back();
    const auto index = static_cast<std::int32_t>(plan_.size());
    if (parent >= 0) plan_[static_cast<std::size_t>(parent)].child[static_cast<std::size_t>(which)] = index;
    const std::int32_t middle = apex(first, last, scale);
    plan_.push_back({first, middle, last, {-1, -1}, Side()});
    if (middle - first > 1) chords_.push_back({first, middle, index, 0});
    if (last - middle > 1) chords_.push_back({middle, last, index, 1});
  }
}

void Regular2::require_short_chords() const {
  for (std::size_t k = 1; k < plan_.size(); ++k) {
    const Corner &a = rim_[static_cast<std::size_t>(plan_[k].first)],
                 &b = rim_[static_cast<std::size_t>(plan_[k].last)];
    require(torus_.is_short(b.x - a.x, b.y - a.y),
            "too few samples, or too clustered: without one there is a gap of about half a period");
  }
}

void Regular2::fill_hole(SiteId p) {
  displaced_.clear();
  for (const SimplexId t : star_) {
    if (simplices_[t].first_hidden.valid()) take_hidden_of(simplices_[t]);
    destroy(t);
  }
  sites_[p].at = Side();
  for (std::size_t k = plan_.size(); k-- > 0;) {
    Chain& chain = plan_[k];
    const auto first = static_cast<std::size_t>(chain.first), middle = static_cast<std::size_t>(chain.apex);
    const SimplexId t = create(rim_[static_cast<std::size_t>(chain.last)], rim_[first], rim_[middle]);
    const auto side_of = [&](std::int32_t child, std::size_t edge) {
      return child >= 0 ? plan_[static_cast<std::size_t>(child)].closing : beyond_[edge];
    };
    glue(Side(t, 0), side_of(chain.child[0], first));
    glue(Side(t, 1), side_of(chain.child[1], middle));
    chain.closing = Side(t, 2);
  }
  glue(plan_.front().closing, beyond_.back());
}

/// Inserts again what the removed site's triangles were hiding. One may swallow another, so who is exposed is
/// known at the end.
void Regular2::expose_orphans() {
  orphans_.swap(displaced_);
  std::sort(orphans_.begin(), orphans_.end());
  for (const SiteId v : orphans_) insert_visible_or_hide(v, recent_);
  hidden_.clear();
  for (const SiteId v : orphans_) {
    if (!is_hidden(v)) exposed_.push_back(v);
  }
  if (!exposed_.empty()) normalize_change();
}

/// After several changes in one: each triangle once, and only those that are there now as created.
void Regular2::normalize_change() {
  for (std::vector<SimplexId>* list : {&destroyed_, &created_}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  std::erase_if(created_, [&](SimplexId t) { return !is_live(t); });
}

}  // namespace geom
