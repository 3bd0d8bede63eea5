#pragma once
// Tetrahedra in space, whom they join, and where each site is: what a regular triangulation is made of. Its
// operations (insertion3.h, removal3.h) share it.

#include <array>
#include <cstdint>
#include <vector>

#include "geom/exact/predicates.h"
#include "geom/ids.h"
#include "geom/regular/guards.h"
#include "geom/regular/regular_change.h"
#include "geom/regular/tetrahedron.h"
#include "geom/vec.h"

namespace geom {

/// Between operations it is what Regular3 promises. Marks are scratch of whoever reads or changes it.
struct Triangulation3 {
  using Facet = TetrahedronFacet;
  using Simplex = std::array<SiteId, 4>;  ///< corners, positively oriented
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

  /// The guards about the box and their triangulation. Throws InputError (Regular3).
  explicit Triangulation3(const Box3& around);

  static std::size_t slot(SiteId id) {
    return static_cast<std::size_t>(std::int64_t{id.value} + 1 + guard_count);
  }
  Site& site(SiteId id) { return sites[slot(id)]; }
  const Site& site(SiteId id) const { return sites[slot(id)]; }
  const WeightedPoint3& point(SiteId id) const { return points[slot(id)]; }
  RankedPoint3 ranked(SiteId id) const { return {&points[slot(id)], perturbation_rank(id)}; }
  bool contains(SiteId id) const {
    return id.valid() && slot(id) < sites.size() && site(id).state != State::absent;
  }

  int orientation(const Simplex& corner) const;
  /// Is the site inside the orthosphere of t?
  bool in_conflict(SimplexId t, SiteId e) const;
  /// A tetrahedron that contains x, which lies in the box.
  SimplexId locate(const Vec3& x, SimplexId start) const;
  /// Appends all tetrahedra with corner v.
  void collect_star(SiteId v, std::vector<SimplexId>& out) const;
  /// A mark that no tetrahedron and no site carries.
  std::uint32_t next_mark() const;

  /// A tetrahedron joined to nobody. The change has it.
  SimplexId create(const Simplex& corner);
  /// Makes two tetrahedra neighbours across a facet. `other` may be none.
  void glue(Facet one, Facet other);
  /// Frees the destroyed of the change; only at its end, so that no id is destroyed and created in one.
  RegularChange finish_change();

  Box3 box;
  std::vector<WeightedPoint3> points;  ///< by slot: guards, none, sites
  std::vector<Site> sites;             ///< by slot
  Table<SimplexId, Tetrahedron> simplices;
  std::vector<SimplexId> free;
  SimplexId recent;  ///< a live simplex
  mutable std::uint32_t mark = 0;
  ChangeLists change;  ///< of the operation in hand, or of the last one

 private:
  void triangulate_guards();
};

// A site gets a witness, or is taken from its own. The third appends all that a dying one witnesses.
void hide(Triangulation3& t, SiteId id, SimplexId witness);
void unhide(Triangulation3& t, SiteId id);
void append_hidden(const Triangulation3& t, SimplexId witness, std::vector<SiteId>& out);

/// Verifies all that Regular3 promises; throws Bug. O(n).
void check(const Triangulation3& m);

}  // namespace geom
