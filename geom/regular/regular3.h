#pragma once
// Dynamic regular triangulation of weighted points in space (paper, section 3.1), the dual of the power
// diagram.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/exact/predicates.h"
#include "geom/ids.h"
#include "geom/regular/facet_matcher.h"
#include "geom/vec.h"

namespace geom {

/// The regular triangulation of the inserted sites and of eight guards: far samples of weight 0 that are
/// never removed, so that every site lies strictly inside the hull and coplanar input needs no special case.
/// All decisions are exact (predicates.h) with ties broken by the symbolic perturbation, hence the
/// triangulation is a function of the box, the sites, their weights and their ids alone: insertion order
/// leaves no trace. Steady state allocates nothing. Queries use scratch marks: one thread at a time.
class Regular3 {
 public:
  /// What one insertion or removal did. Valid until the next one. No simplex is in both lists: the ids of the
  /// destroyed are free only for the next change.
  struct Change {
    std::span<const SimplexId> destroyed;
    std::span<const SimplexId> created;
    std::span<const SiteId> hidden;   ///< sites that lost their last tetrahedron (the inserted one included)
    std::span<const SiteId> exposed;  ///< sites that were hidden and are vertices now
  };

  /// Corners of a tetrahedron, positively oriented; guards are sites with negative ids below none.
  using Simplex = std::array<SiteId, 4>;

  static constexpr int guard_count = 8;
  static constexpr SiteId guard(int k) { return SiteId(-2 - k); }
  static constexpr bool is_guard(SiteId id) { return id.value < -1; }
  /// The place of a site or guard in the symbolic perturbation: its id; guards come last, so they lose ties.
  static constexpr std::int32_t rank(SiteId id) {
    return id.value >= 0 ? id.value : INT32_MAX + (id.value + 2);
  }

  /// Guards are put at least ten diagonals around `box`; all sites must lie inside the box (InputError
  /// otherwise, also for an empty or infinite box).
  explicit Regular3(const Box3& box);

  /// Inserts a site under an id that is not in use. `hint`: a site nearby, none for a walk from anywhere.
  /// Expected O(1) with a good hint.
  Change insert(SiteId id, const WeightedPoint3& point, SiteId hint = SiteId());
  /// Removes a site, visible or hidden. Expected O(1).
  Change remove(SiteId id);

  bool contains(SiteId id) const;
  bool is_hidden(SiteId id) const;
  const WeightedPoint3& point(SiteId id) const { return points_[slot(id)]; }
  /// The sites joined to `id` by an edge, guards left out, in no particular order. Empty for a hidden site.
  void link(SiteId id, std::vector<SiteId>& out) const;
  /// The same and the hidden sites that the tetrahedra at `id` witness: if `id` were removed, the sites with
  /// other cells than before were all among them.
  void link_and_hidden(SiteId id, std::vector<SiteId>& out) const;

  /// Corners of a live tetrahedron, such as one that a Change calls created.
  const Simplex& simplex(SimplexId t) const { return simplices_[t].corner; }
  /// All live tetrahedra (guards included), for tests and drawings.
  std::vector<Simplex> simplices() const;
  /// Verifies orientation, adjacency, the empty-orthosphere property of every facet and the witnesses of
  /// hidden sites; throws Bug. O(n).
  void check() const;

 private:
  /// The facet of a tetrahedron opposite one of its corners; none outside the hull.
  class Facet {
   public:
    Facet() = default;
    explicit Facet(std::int32_t code) : code_(code) {}
    Facet(SimplexId t, int corner) : code_(4 * t.value + corner) {}
    bool valid() const { return code_ >= 0; }
    SimplexId simplex() const { return SimplexId(code_ >> 2); }
    int corner() const { return code_ & 3; }
    std::int32_t code() const { return code_; }
    bool operator==(const Facet&) const = default;

   private:
    std::int32_t code_ = -1;
  };
  /// A free one has no corners.
  struct Tetrahedron {
    Simplex corner;
    std::array<Facet, 4> mate;  ///< the facet opposite each corner as a facet of the neighbor there
    SiteId first_hidden;        ///< the sites that it witnesses, a list through Site::next_hidden
    mutable std::uint32_t mark = 0;
  };
  enum class State : std::uint8_t { absent, visible, hidden };
  /// Site or guard. `simplex`: a tetrahedron at this vertex; the witness, if hidden: one that contains the
  /// site and with whose orthosphere the site is not in conflict.
  struct Site {
    SimplexId simplex;
    State state = State::absent;
    mutable std::uint32_t mark = 0;
    SiteId next_hidden, previous_hidden;
  };
  /// A facet of a hole that is being filled; the hole is on the positive side of a, b, c.
  struct OpenFacet {
    SiteId a, b, c;
    Facet outer;  ///< the same facet of the tetrahedron outside
    bool closed = false;
  };

  static std::size_t slot(SiteId id) {
    return static_cast<std::size_t>(std::int64_t{id.value} + 1 + guard_count);
  }
  Site& site(SiteId id) { return sites_[slot(id)]; }
  const Site& site(SiteId id) const { return sites_[slot(id)]; }
  const Vec3& position(SiteId id) const { return points_[slot(id)].position; }
  RankedPoint3 ranked(SiteId id) const { return {&points_[slot(id)], rank(id)}; }

  int orientation(const Simplex& corner) const;
  bool in_conflict(SimplexId t, SiteId e) const;
  int corner_of(SimplexId t, SiteId v) const;
  SimplexId locate(const Vec3& x, SimplexId start) const;
  void collect_star(SiteId v, std::vector<SimplexId>& out) const;

  void triangulate_guards();
  void admit(SiteId id, const WeightedPoint3& point);
  void begin_change();
  Change finish_change();
  SimplexId create(const Simplex& corner);
  void glue(Facet one, Facet other);
  std::uint32_t next_mark() const;

  void dig_cavity(SimplexId start, SiteId p);
  void star_cavity(SiteId p);
  void hide_swallowed();

  void open_hole(SiteId p);
  void fill_hole();
  SiteId apex(const OpenFacet& facet) const;

  void hide(SiteId id, SimplexId witness);
  void unlink_hidden(SiteId id);
  void take_hidden_of(SimplexId t);

  void check_simplex(SimplexId t) const;
  void check_site(SiteId id) const;

  Box3 box_;
  std::vector<WeightedPoint3> points_;  ///< by slot: guards, none, sites
  std::vector<Site> sites_;             ///< by slot
  Table<SimplexId, Tetrahedron> simplices_;
  std::vector<SimplexId> free_;
  SimplexId recent_;  ///< a live simplex
  mutable std::uint32_t mark_ = 0;

  std::vector<SimplexId> destroyed_, created_;  ///< the current change
  std::vector<SiteId> hidden_, exposed_;
  std::vector<SiteId> displaced_;  ///< sites whose witness is destroyed
  FacetMatcher matcher_;
  std::vector<Facet> boundary_;          ///< of the cavity: facets of destroyed simplices
  std::vector<OpenFacet> open_;          ///< of the hole
  std::vector<SiteId> candidates_;       ///< corners that tetrahedra in the hole may have
  mutable std::vector<SimplexId> star_;  ///< scratch of link()
};

}  // namespace geom
