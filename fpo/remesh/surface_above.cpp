#include "fpo/remesh/surface_above.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fpo/remesh/prism.h"

namespace fpo {

using geom::FacetId;
using geom::Vec3;

namespace {

constexpr double rounding = 1e-9;
constexpr double unknown = -1;               // a distance
constexpr std::size_t across = 3;            // of the triangles beside come first
constexpr std::size_t most_told_apart = 64;  // of them, by the bits of SeenVertex::near
constexpr int halvings = 3;
constexpr int parts = 4;  // of an edge within

Vec3 mean_normal(const geom::TriMesh& mesh, const std::array<SurfaceSample, 3>& corners) {
  Vec3 sum(0, 0, 0);
  for (const SurfaceSample& x : corners) sum += mesh.normal(x.facet).normalized();
  return sum;
}

}  // namespace

/// One triangle's search for its farthest point.
class SurfaceAbove::Query {
 public:
  Query(SurfaceAbove& above, const std::array<SurfaceSample, 3>& corners, const Prism& prism,
        const Beside& beside, const Wanted& wanted)
      : above_(above),
        prism_(prism),
        beside_(beside),
        triangle_({corners[0].position, corners[1].position, corners[2].position}),
        most2_(wanted.enough * wanted.enough),
        most_(wanted.most),
        far_{0, corners[0]} {
    above_.begin();
    for (const SurfaceSample& x : corners) reach(x.facet);
  }

  FarPoint farthest() {
    for (std::size_t k = 0; k < above_.facets_.size() && !(far_.distance > most_); ++k)
      for (int e = 0; e < 3; ++e) look_at_edge(above_.facets_[k], e);
    return far_;
  }

 private:
  void reach(FacetId t) {
    if (above_.is_reached(t) || !(above_.mesh_.normal(t).dot(prism_.up()) > 0)) return;
    above_.facets_.push_back(t);
    above_.reached_[t] = above_.query_;
  }

  /// Of two facets at an edge the one that is reached first looks at it.
  void look_at_edge(FacetId t, int e) {
    const FacetId other = above_.mesh_.across(t, e);
    if (other.valid() && above_.done_[other] == above_.query_) return;
    if (e == 2) above_.done_[t] = above_.query_;
    const Vec3 &a = above_.mesh_.corner(t, e), &b = above_.mesh_.corner(t, (e + 1) % 3);
    SeenVertex &at_a = see(t, e), &at_b = see(t, (e + 1) % 3);
    ++above_.looks_;
    const auto share = Prism::share(at_a.depths, at_b.depths);
    if (!share) return;
    if (other.valid()) reach(other);
    // The distance is convex along an edge.
    if (distance2(a, at_a) <= most2_ && distance2(b, at_b) <= most2_) return;
    const bool is_whole = share->first == 0 && share->second == 1;
    if (is_whole && (are_near_another(a, at_a, b, at_b) || is_near_another(a, at_a, b, at_b))) return;
    const auto at = [&](double way) -> Vec3 {
      const double s = share->first + (share->second - share->first) * way;
      return s == 0 ? a : s == 1 ? b : Vec3(a + s * (b - a));
    };
    if (!is_whole) {
      const Vec3 from = at(0), to = at(1);
      if (triangle_.distance2(from) <= most2_ && triangle_.distance2(to) <= most2_) return;
      if (is_near_another(from, to)) return;
    }
    look_along(at, t);
  }

  /// Whether one of them is no farther than what counts from the whole segment. Then its ends are not farther
  /// from each other than two points of that one are, and twice what counts.
  bool is_near_another(const Vec3& a, const Vec3& b) {
    const double length = (b - a).norm() * (1 - rounding) - 2 * std::sqrt(most2_);
    if (length > 0 && length * length > others_diameter2()) return false;
    return is_any_beside([&](const geom::DistanceFromTriangle& other) {
      return other.is_within(a, most2_) && other.is_within(b, most2_);
    });
  }

  /// The same of the vertices at the ends of an edge, perhaps: each is asked once for all its edges, first
  /// about those across the triangle's sides. What counts only grows, so that what was near then is near now.
  bool are_near_another(const Vec3& a, SeenVertex& at_a, const Vec3& b, SeenVertex& at_b) {
    for (const std::size_t up_to : {across, most_told_apart})
      if (near(a, at_a, up_to) & near(b, at_b, up_to)) return true;
    return false;
  }
  /// For sure, if that has been asked: what was not near then is asked again if what counts has grown.
  bool is_near_another(const Vec3& a, const SeenVertex& at_a, const Vec3& b, const SeenVertex& at_b) {
    const bool is_known =
        at_a.within2 == most2_ && at_b.within2 == most2_ && others().size() <= most_told_apart;
    return !is_known && is_near_another(a, b);
  }

  /// To which of the first so many of those beside, at least.
  std::uint64_t near(const Vec3& x, SeenVertex& seen, std::size_t up_to) {
    const std::size_t end = std::min(others().size(), up_to);
    if (seen.asked >= end) return seen.near;
    if (seen.asked == 0) seen.within2 = most2_;
    for (; seen.asked < end; ++seen.asked)
      seen.near |= std::uint64_t{others()[seen.asked].is_within(x, seen.within2)} << seen.asked;
    return seen.near;
  }

  SeenVertex& see(FacetId t, int corner) {
    const geom::VertexId v = above_.mesh_.facet(t)[static_cast<std::size_t>(corner)];
    SeenVertex& seen = above_.seen_[v];
    if (seen.query == above_.query_) return seen;
    const Vec3& x = above_.mesh_.corner(t, corner);
    return seen = {above_.query_, unknown, prism_.depths(x)};
  }

  double distance2(const Vec3& x, SeenVertex& seen) {
    if (seen.distance2 == unknown) seen.distance2 = triangle_.distance2(x);
    return seen.distance2;
  }

  template <class At>
  void look_along(const At& at, FacetId t) {
    double best = -1, step = 1.0 / parts;
    for (int i = 0; i <= parts; ++i)
      if (is_farther(at(i * step), t)) best = i * step;
    for (int halving = 0; best >= 0 && halving < halvings; ++halving) {
      step /= 2;
      if (best > 0 && is_farther(at(best - step), t))
        best -= step;
      else if (best < 1 && is_farther(at(best + step), t))
        best += step;
    }
  }

  bool is_farther(const Vec3& x, FacetId t) {
    const double distance2 = triangle_.distance2(x);
    if (distance2 <= most2_ || is_nearer_to_others(x, distance2)) return false;
    most2_ = distance2;
    far_ = {std::sqrt(distance2), {geom::snapped(x), t}};
    return true;
  }

  bool is_nearer_to_others(const Vec3& x, double distance2) {
    return is_any_beside([&](const geom::DistanceFromTriangle& other) {
      return other.is_within(x, (1 - rounding) * distance2);
    });
  }

  /// What holds for one of them mostly holds for the same one next.
  template <class Property>
  bool is_any_beside(const Property& property) {
    const std::vector<geom::DistanceFromTriangle>& all = others();
    if (last_ < all.size() && property(all[last_])) return true;
    const auto found = std::ranges::find_if(all, property);
    if (found == all.end()) return false;
    last_ = static_cast<std::size_t>(found - all.begin());
    return true;
  }

  double others_diameter2() {
    if (diameter2_ < 0)
      for (const geom::DistanceFromTriangle& other : others())
        diameter2_ = std::max(diameter2_, other.diameter2());
    return diameter2_;
  }

  const std::vector<geom::DistanceFromTriangle>& others() {
    if (above_.beside_.empty()) beside_(above_.beside_);
    return above_.beside_;
  }

  SurfaceAbove& above_;
  const Prism& prism_;
  const Beside& beside_;
  geom::DistanceFromTriangle triangle_;
  double most2_;           ///< so far, squared; what is not farther does not count
  double most_;            ///< what is farther ends the search
  double diameter2_ = -1;  ///< the largest of those beside it; negative: not known
  std::size_t last_ = 0;   ///< the one beside it that was found last
  FarPoint far_;
};

void SurfaceAbove::begin() {
  if (++query_ == 0 || seen_.empty()) {  // numbers begin again
    reached_.assign(mesh_.num_facets(), 0);
    done_.assign(mesh_.num_facets(), 0);
    seen_.assign(mesh_.num_vertices(), SeenVertex{});
    query_ = 1;
  }
  facets_.clear();
  beside_.clear();
}

FarPoint SurfaceAbove::farthest(const std::array<SurfaceSample, 3>& corners, const Wanted& wanted,
                                const Beside& beside, double margin) {
  const std::array<Vec3, 3> triangle{corners[0].position, corners[1].position, corners[2].position};
  const std::optional<Prism> prism = Prism::over(triangle, mean_normal(mesh_, corners), margin);
  if (!prism) return {0, corners[0]};
  return Query(*this, corners, *prism, beside, wanted).farthest();
}

}  // namespace fpo
