#include "fpo/remesh/cell_faults.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "geom/disjoint_sets.h"
#include "geom/mesh/surface_type.h"

namespace fpo {

using geom::EdgeLabel;
using geom::FacetId;
using geom::FragmentId;
using geom::PolygonCorner;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr int most_turns = 64;  // about a corner, through fragments of one cell

/// An edge of a fragment's polygon: where it begins, and what is on the other side.
struct Side {
  FragmentId fragment;
  std::size_t corner = 0;
  bool operator==(const Side&) const = default;
  auto operator<=>(const Side&) const = default;
};

/// The fragments as polygons that are joined to each other.
class Pieces {
 public:
  Pieces(const geom::RestrictedPower& diagram, const FragmentOwners& owners)
      : diagram_(diagram), owners_(owners) {}

  std::span<const PolygonCorner> corners(FragmentId f) { return diagram_.fragments().corners(f, buffer_); }
  SiteId owner(FragmentId f) const {
    const auto found = owners_.find(f);
    return found == owners_.end() ? diagram_.fragments().site(f) : found->second;
  }

  /// The fragment on the other side; none at a border of the surface.
  FragmentId beyond(Side side) {
    const EdgeLabel label = corners(side.fragment)[side.corner].edge;
    const FacetId t = diagram_.fragments().facet(side.fragment);
    if (label.is_site()) return diagram_.fragments().find(label.site(), t);
    const FacetId across = diagram_.mesh().across(t, label.edge());
    if (!across.valid()) return FragmentId();
    return diagram_.fragments().find(diagram_.fragments().site(side.fragment), across);
  }

  /// A place on a border, and which way it is followed: forward is counterclockwise in the fragment.
  struct Step {
    Side side;
    bool forward;
  };
  Step ahead(Step at) { return {at.forward ? next(at.side) : before(at.side), at.forward}; }

  /// Around the corner ahead of an inner edge: what follows on the other side of it. Where the two facets run
  /// the same way (a one-sided surface) the way turns over. None if nothing fits.
  std::optional<Step> around(Step at) {
    const FragmentId other = beyond(at.side);
    if (!other.valid()) return {};
    const EdgeLabel label = corners(at.side.fragment)[at.side.corner].edge;
    EdgeLabel wanted = EdgeLabel::bisector(diagram_.fragments().site(at.side.fragment));
    bool turned = false;
    if (!label.is_site()) {
      const MateEdge mate = mate_edge(diagram_.fragments().facet(at.side.fragment), label.edge(),
                                      diagram_.fragments().facet(other));
      if (mate.edge < 0) return {};
      wanted = EdgeLabel::facet_edge(mate.edge);
      turned = mate.turned;
    }
    const auto there = corners(other);
    for (std::size_t k = 0; k < there.size(); ++k)
      if (there[k].edge == wanted) return ahead({{other, k}, at.forward != turned});
    return {};
  }

  Side next(Side side) {
    return {side.fragment, geom::next_corner(side.corner, corners(side.fragment).size())};
  }
  Side before(Side side) {
    return {side.fragment, geom::previous_corner(side.corner, corners(side.fragment).size())};
  }
  Vec3 start(Side side) { return corners(side.fragment)[side.corner].point.position; }
  double length(Side side) { return (start(next(side)) - start(side)).norm(); }

 private:
  struct MateEdge {
    int edge = -1;  ///< none
    bool turned = false;
  };
  /// The edge of facet u that is edge e of facet t.
  MateEdge mate_edge(FacetId t, int e, FacetId u) const {
    const TriMesh::Facet &f = diagram_.mesh().facet(t), &g = diagram_.mesh().facet(u);
    const VertexId from = f[static_cast<std::size_t>(e)],
                   to = f[static_cast<std::size_t>(e == 2 ? 0 : e + 1)];
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId a = g[i], b = g[i == 2 ? 0 : i + 1];
      if (a == to && b == from) return {static_cast<int>(i), false};
      if (a == from && b == to) return {static_cast<int>(i), true};
    }
    return {};
  }

  const geom::RestrictedPower& diagram_;
  const FragmentOwners& owners_;
  std::array<PolygonCorner, 3> buffer_;
};

/// What is counted of a cell: its pieces, and how they are joined.
struct Cell {
  std::vector<FragmentId> fragments;
  long inner_edges = 0;     ///< twice: once from each side
  long inner_vertices = 0;  ///< of the surface
  std::vector<Side> border;
};

/// A loop of a cell's border.
struct Loop {
  double length = 0;
  std::vector<Vec3> corners;
};

class Faults {
 public:
  Faults(const geom::RestrictedPower& diagram, const FragmentOwners& owners)
      : diagram_(diagram), pieces_(diagram, owners), cells_(diagram.num_sites()) {
    collect();
    count_inner_vertices();
  }

  std::vector<CellFault> find() {
    std::vector<CellFault> faults;
    for (SiteId i(0); i.index() < cells_.size(); i = SiteId(i.value + 1)) add_lone(i, faults);
    add_pairs(faults);
    return faults;
  }

 private:
  void collect() {
    const geom::FragmentStore& store = diagram_.fragments();
    for (FacetId t(0); t.index() < diagram_.mesh().num_facets(); t = FacetId(t.value + 1))
      for (const FragmentId f : store.of_facet(t)) {
        const SiteId owner = pieces_.owner(f);
        Cell& cell = cells_[owner];
        cell.fragments.push_back(f);
        for (std::size_t k = 0; k < pieces_.corners(f).size(); ++k) {
          const FragmentId beyond = pieces_.beyond({f, k});
          if (beyond.valid() && pieces_.owner(beyond) == owner)
            ++cell.inner_edges;
          else
            cell.border.push_back({f, k});
        }
      }
  }

  /// A vertex of the surface, or each of its sheets, that is not on the border is inside the cell with it.
  void count_inner_vertices() {
    const TriMesh& mesh = diagram_.mesh();
    geom::DisjointSets sheets = geom::sheets_at_vertices(mesh);
    const auto sheet = [&](FacetId t, int corner) {
      return sheets.find(3 * t.index() + static_cast<std::size_t>(corner));
    };
    std::vector<char> passed(3 * mesh.num_facets(), 0);  // on the border, or counted
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
      for (int e = 0; e < 3; ++e)
        if (!mesh.across(t, e).valid()) passed[sheet(t, e)] = passed[sheet(t, e == 2 ? 0 : e + 1)] = 1;
    for (Cell& cell : cells_)
      for (const FragmentId f : cell.fragments) {
        const auto corners = pieces_.corners(f);
        for (std::size_t k = 0; k < corners.size(); ++k) {
          const EdgeLabel before = corners[geom::previous_corner(k, corners.size())].edge,
                          after = corners[k].edge;
          if (before.is_site() || after.is_site()) continue;
          char& is_passed = passed[sheet(diagram_.fragments().facet(f), after.edge())];
          cell.inner_vertices += !is_passed;
          is_passed = 1;
        }
      }
  }

  /// The border as loops; those that cannot be followed are left out.
  std::vector<Loop> loops_of(const Cell& cell) {
    std::vector<Loop> loops;
    std::set<Side> untried(cell.border.begin(), cell.border.end());
    const std::size_t most_steps = 4 * (cell.border.size() + static_cast<std::size_t>(cell.inner_edges)) + 4;
    while (!untried.empty()) {
      const Side first = *untried.begin();
      Loop loop;
      Pieces::Step at{first, true};
      bool closed = false;
      for (std::size_t step = 0; step < most_steps; ++step) {
        if (untried.erase(at.side) == 1) {
          loop.length += pieces_.length(at.side);
          loop.corners.push_back(pieces_.start(at.side));
          at = pieces_.ahead(at);
        } else if (at.side == first) {
          closed = true;
          break;
        } else {
          const std::optional<Pieces::Step> next = pieces_.around(at);
          if (!next) break;
          at = *next;
        }
      }
      if (closed) loops.push_back(std::move(loop));
    }
    return loops;
  }

  bool is_connected(const Cell& cell) {
    std::map<FragmentId, std::size_t> place;
    for (std::size_t i = 0; i < cell.fragments.size(); ++i) place[cell.fragments[i]] = i;
    geom::DisjointSets joined(cell.fragments.size());
    for (std::size_t i = 0; i < cell.fragments.size(); ++i)
      for (std::size_t k = 0; k < pieces_.corners(cell.fragments[i]).size(); ++k) {
        const auto other = place.find(pieces_.beyond({cell.fragments[i], k}));
        if (other != place.end()) joined.merge(i, other->second);
      }
    for (std::size_t i = 1; i < cell.fragments.size(); ++i)
      if (joined.find(i) != joined.find(0)) return false;
    return true;
  }

  /// The inside of a disk has the Euler number 1 if its border is left out.
  void add_lone(SiteId i, std::vector<CellFault>& faults) {
    const Cell& cell = cells_[i];
    if (cell.fragments.empty()) return;
    const long euler = static_cast<long>(cell.fragments.size()) - cell.inner_edges / 2 + cell.inner_vertices;
    if (euler == 1 && is_connected(cell)) return;
    CellFault fault{i, SiteId(), 0, {}};
    std::vector<Loop> loops = loops_of(cell);
    if (!loops.empty()) {
      Loop& shortest = *std::ranges::min_element(loops, {}, &Loop::length);
      fault.girth = shortest.length;
      fault.around = std::move(shortest.corners);
    }
    faults.push_back(std::move(fault));
  }

  /// Pieces of the border of two cells, less where one piece goes on in the next: the number of arcs.
  struct Meeting {
    long pieces = 0, joints = 0;  ///< joints twice
    std::vector<Vec3> corners;
  };

  void add_pairs(std::vector<CellFault>& faults) {
    std::map<std::pair<SiteId, SiteId>, Meeting> meetings;
    std::vector<double> perimeter(cells_.size(), 0);
    for (SiteId i(0); i.index() < cells_.size(); i = SiteId(i.value + 1))
      for (const Side& side : cells_[i].border) {
        perimeter[i.index()] += pieces_.length(side);
        const FragmentId beyond = pieces_.beyond(side);
        if (!beyond.valid()) continue;
        const SiteId j = pieces_.owner(beyond);
        if (!(i < j)) continue;
        Meeting& meeting = meetings[{i, j}];
        ++meeting.pieces;
        meeting.corners.push_back(pieces_.start(side));
        meeting.joints += goes_on(side, j, true) + goes_on(side, j, false);
      }
    for (auto& [pair, meeting] : meetings) {
      if (meeting.pieces - meeting.joints / 2 == 1) continue;
      const double half = (perimeter[pair.first.index()] + perimeter[pair.second.index()]) / 2;
      faults.push_back({pair.first, pair.second, half, std::move(meeting.corners)});
    }
  }

  /// Does the border with j go on at an end of this piece, on another facet or in another fragment?
  bool goes_on(Side side, SiteId j, bool forward) {
    Pieces::Step at = pieces_.ahead({side, forward});
    for (int turns = 0; turns < most_turns; ++turns) {
      const FragmentId beyond = pieces_.beyond(at.side);
      if (!beyond.valid()) return false;
      const SiteId other = pieces_.owner(beyond);
      if (other == j) return true;
      if (other != pieces_.owner(side.fragment)) return false;
      const std::optional<Pieces::Step> next = pieces_.around(at);
      if (!next) return false;
      at = *next;
    }
    return false;
  }

  const geom::RestrictedPower& diagram_;
  Pieces pieces_;
  geom::Table<SiteId, Cell> cells_;
};

}  // namespace

std::vector<CellFault> cell_faults(const geom::RestrictedPower& diagram, const FragmentOwners& owners) {
  return Faults(diagram, owners).find();
}

}  // namespace fpo
