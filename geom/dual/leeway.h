#pragma once
// How far sites may move before what was proven about the cell of one of them must be proven again.
//
// Samples soon move by a hundredth of their distance, and what a move has to prove is hardly ever near to
// failing. So it is proven with leeway: for a regular site p, seen from O, where p is, and for all places
// where
//
//   - its rim and some more sites, the watched ones, are no farther than `delta` from where they are, and p
//     no farther than `own_delta`;
//   - nobody else is within some range of O;
//   - all weights are equal.
//
// What is proven (leeway_proof.h), of all locations within `radius` of O:
//
//   - (a) p and its rim, and these with each of the strangers that are `kept`, are a simple chart (chart.h);
//   - (b) all other strangers are farther than some site of the rim;
//   - (c) bisectors of p and its rim are no steeper than `steepest`; the power to the nearest of the rim is
//     at most `power`; what p has within `near` of it, or within `radius` of O, hangs together if it has one
//     component in the sense of sheets.h, on a sheet with that axis and slope.
//
// A move in place then needs its circles only. The hole: its triangles' circles are empty of the rim and of
// those kept, which is tested at each, and by (b) of all others, so with (a) the division is right (chart.h).
// The new cell: at each of its corners p and two of the rim are nearest, tested in the same way; along an arc
// between two corners, on the bisector of p and one of the rim, a third site that were nearer somewhere would
// be nearer at an end, by (a). So the arcs are a closed curve of edges of the new diagram, and what it
// surrounds is p's cell. What p has elsewhere would have a path to it over the disc of the sheet, which holds
// the hole and p (sheets.h). Circles beyond the rim need no test: were one beaten, on the edge of r_j and
// r_j+1 that ends there, then p, who comes nearer once on that edge, would do so beyond it, and at that
// corner the third site of the circle would be nearer. And nobody is nearer to p than the nearest of its rim
// and of those kept, by (b).
//
// Who has moved? Watched sites are compared one by one. Each of the others has an anchor from which it is no
// farther than a length, the step. Who is not watched was farther than the range and two steps, its anchor
// farther than the range and one, so it is beyond the range as long as it keeps its anchor. A site that comes
// in, or leaves its anchor, gets a new one, and then all leeways end that have it within the range and two
// steps, and do not watch it.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geom/dual/site_search.h"

namespace geom {

/// What was proven allows a hundredth more than what is asked here, for rounding (slack_chart.h).
struct Leeway {
  static constexpr std::size_t most = 16;
  /// A triangle of the hole that p left last: as HoleTriangles::Triangle.
  struct Guess {
    std::array<std::int8_t, 3> corners, beyond;
  };
  struct Watched {
    SiteId site;
    std::array<float, 3> offset;  ///< from O
  };

  /// Is that a place of p which it allows?
  bool allows(const Vec3& place) const { return (place - origin).squaredNorm() <= own_delta * own_delta; }
  std::span<const Guess> last_triangles() const { return {guesses.data(), num_guesses}; }
  std::span<const Watched> all() const { return {watched.data(), size}; }
  std::span<const Watched> rim() const { return {watched.data(), num_rim}; }
  std::span<const Watched> kept() const { return {watched.data() + num_rim, num_kept}; }

  Vec3 origin{0, 0, 0};            ///< O
  Vec3 axis{0, 0, 1}, u{1, 0, 0};  ///< of the sheet
  double slope = 0;
  double delta = 0, own_delta = 0;
  double radius = 0, near = 0;
  double power = 0;
  double steepest = 0;
  double watch = 0;                                    ///< the range and two steps
  float way = std::numeric_limits<float>::infinity();  ///< of the last move of p
  bool stands = false;
  std::uint8_t num_rim = 0, num_kept = 0, size = 0;
  std::uint8_t failures = 0, rest = 0;  ///< failed attempts since p has its anchor, and moves without one
  std::uint8_t num_guesses = 0;
  std::array<Guess, 6> guesses;
  std::array<Watched, most> watched;  ///< the rim in its order, those who are kept, and others
};

/// Those of all sites.
class Leeways {
 public:
  /// None stands. Keeps references.
  Leeways(const Table<SiteId, WeightedPoint3>& sites, const SiteSearch& search)
      : sites_(sites), search_(search) {}
  Leeways(const Leeways&) = delete;

  /// All sites are in, of that even spacing: from now on there are leeways, if the sites are not too many.
  void begin(double spacing);
  /// From now on a site of that weight may come in.
  void allow(double weight) {
    if (is_in_use() && weight != weight_) end();
  }
  bool is_in_use() const { return spacing_ > 0; }
  double spacing() const { return spacing_; }
  double step() const { return step_ * spacing_; }

  /// The leeway of p, if it stands; and if p has that rim.
  const Leeway* of(SiteId p) const;
  const Leeway* of(SiteId p, std::span<const SiteId> rim) const;
  /// To be filled with what is proven of p; then call set(p).
  Leeway& to_prove(SiteId p) { return of_site_[p]; }
  void set(SiteId p);
  /// Asks the memory for what of() reads. No effect but on speed.
  void expect(SiteId p) const;
  /// What is guessed the next time; empty: nothing.
  void set_guesses(SiteId p, std::span<const Leeway::Guess> guesses);

  /// How far p has moved the last time, here or elsewhere.
  float way(SiteId p) const { return is_in_use() ? of_site_[p].way : std::numeric_limits<float>::infinity(); }
  void set_way(SiteId p, float way) {
    if (is_in_use()) of_site_[p].way = way;
  }
  /// p has come in, or moved that far.
  void arrive(SiteId p, double way);
  void leave(SiteId p);

 private:
  static constexpr double step_ = 0.06;               ///< in spacings
  static constexpr std::size_t most_sites = 100'000;  ///< some 450 bytes each; more are moved in tiles
  void end() { spacing_ = 0, of_site_ = {}, anchors_ = {}; }

  const Table<SiteId, WeightedPoint3>& sites_;
  const SiteSearch& search_;
  double spacing_ = 0, weight_ = 0;
  double longest_ = 0;  ///< no leeway watches farther
  Table<SiteId, Leeway> of_site_;
  Table<SiteId, Vec3> anchors_;
  std::vector<SiteId> found_;  // workspace
};

}  // namespace geom
