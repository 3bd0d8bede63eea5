#include "geom/cell_division.h"

#include <algorithm>
#include <limits>

#include "geom/check.h"

namespace geom {

CellDivision::CellDivision(const TriMesh& mesh, const Clipper::Sites& sites, Clipper& clipper,
                           const FragmentStore& store)
    : mesh_(mesh),
      sites_(sites),
      clipper_(clipper),
      store_(store),
      vacated_index_(mesh.num_facets(), -1),
      vertex_stamp_(mesh.num_vertices(), 0),
      vertex_owner_(mesh.num_vertices(), 0) {}

void CellDivision::begin(SiteId p, std::span<const FragmentId> vacated, std::span<const SiteId> excluded) {
  p_ = p;
  for (const FacetId t : vacated_facets_) vacated_index_[t] = -1;
  vacated_.assign(vacated.begin(), vacated.end());
  vacated_facets_.clear();
  for (const FragmentId f : vacated_) vacated_facets_.push_back(store_.facet(f));
  for (std::size_t i = 0; i < vacated_.size(); ++i)
    vacated_index_[vacated_facets_[i]] = static_cast<std::int32_t>(i);
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

bool CellDivision::is_missing(SiteId j, std::size_t first_corner) const {
  const EdgeLabel own = EdgeLabel::bisector(j);
  return std::ranges::any_of(std::span(corners_).subspan(first_corner), [&](const CellCorner& c) {
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

// --- division by the boundary --------------------------------------------------------------------

void CellDivision::start() {
  prepare();
  crossings_.clear();
  edge_crossings_.assign(vacated_.size(), {});
  ++vertex_stamp_now_;
  find_old_fragments();
}

void CellDivision::divide() {
  start();
  for (std::size_t i = 0; i < vacated_.size(); ++i) divide(i);
}

void CellDivision::leave_to(SiteId heir, std::size_t vacated) {
  Share& share = add_share();
  share.joins = old_fragment(vacated, heir_index_[heir]);
  share.polygon.facet = vacated_facets_[vacated];
  share.polygon.owner = heir;
  const std::span<const PolygonCorner> corners = store_.corners(vacated_[vacated]);
  share.polygon.corners.assign(corners.begin(), corners.end());
  for (PolygonCorner& corner : share.polygon.corners) {
    corner.circle = CircleId();
    if (corner.edge.is_site()) corner.edge = EdgeLabel::bisector(p_);
  }
}

void CellDivision::divide(std::size_t vacated) {
  const FragmentId f = vacated_[vacated];
  std::array<PolygonCorner, 3> buffer;
  trace_boundary(vacated, store_.corners(f, buffer));
  outlines_.clear();
  for (const Run& run : runs_)
    if (std::ranges::find(outlines_, run.heir, &Run::heir) == outlines_.end()) outlines_.push_back(run);
  const std::size_t mark = corners_.size();
  close_cycle(store_.facet(f), 0);
  if (holds_island(mark)) {
    corners_.resize(mark);
    return clip_shares(vacated);
  }
  for (const Run& run : outlines_) emit(vacated, run);
}

//        a     a'              An heir a that owns two runs owns the chord between them, because its share is
//      .-------------.         convex. The two parts of P beside a chord are divided each by itself: in each, a
//     /  \     /   d  \        has one run, which begins and ends with those of a that are there.
//    | b  \ a /   .----|
//     \    \ /   / e   /       If all heirs of a part are distinct, their shares are bounded by their run and a
//      '----'-----------'      chain of new edges that stays in the part. So three consecutive runs a, b, c
// whose corner in the plane of the facet no other owner is nearer to, and which turn around it
// counterclockwise, meet there: b's share ends in that corner. As in removal from a Delaunay triangulation
// there always is such an ear.
/// Closes the outlines of the cycle runs_[begin], runs_[begin + 1], ... and takes it off runs_.
void CellDivision::close_cycle(FacetId t, std::size_t begin) {
  std::size_t r, s;
  while (find_repetition(begin, r, s)) {
    const std::size_t end = runs_.size();
    runs_.push_back({runs_[r].heir, runs_[s].first, runs_[r].last});
    for (std::size_t i = r + 1; i < s; ++i) runs_.push_back(Run(runs_[i]));
    close_cycle(t, end);
    runs_[r].last = runs_[s].last;
    runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(r) + 1,
                runs_.begin() + static_cast<std::ptrdiff_t>(s) + 1);
  }
  while (runs_.size() - begin > 3) {
    std::size_t b = begin;
    while (!is_ear(t, begin, b))
      ensure(++b < runs_.size(), "cell division: no three owners meet in a corner");
    cut_ear(t, begin, b);
  }
  if (runs_.size() - begin == 3) cut_ear(t, begin, begin);
  if (runs_.size() - begin == 2) {
    const RoundedPoint at_first = nodes_[runs_[begin].first].point;
    append(runs_[begin], nodes_[runs_[begin + 1].first].point, EdgeLabel::bisector(site(runs_[begin + 1])));
    append(runs_[begin + 1], at_first, EdgeLabel::bisector(site(runs_[begin])));
  }
  for (std::size_t i = begin; i < runs_.size(); ++i) nodes_[runs_[i].last].next = runs_[i].first;
  runs_.resize(begin);
}

/// Does an heir that owns nothing of the boundary own something inside? It had nothing in the plane of the
/// facet before: p hid it there. Then it beats the division at one of the corners inside, those from `first`
/// on.
bool CellDivision::holds_island(std::size_t first) const {
  for (Heir h = 0; h < heirs_.size(); ++h) {
    if (std::ranges::find(outlines_, h, &Run::heir) != outlines_.end()) continue;
    for (std::size_t c = first; c < corners_.size(); ++c)
      if (clipper_.beats_at(corners_[c], heirs_[h], bisector(heir_index_[corners_[c].owner], h))) return true;
  }
  return false;
}

/// Two runs of one owner in the cycle from `begin` on.
bool CellDivision::find_repetition(std::size_t begin, std::size_t& r, std::size_t& s) const {
  for (s = begin; s < runs_.size(); ++s)
    for (r = begin; r < s; ++r)
      if (runs_[r].heir == runs_[s].heir) return true;
  return false;
}

/// Fills runs_, in cyclic order, no two neighbours with the same owner.
void CellDivision::trace_boundary(std::size_t vacated, std::span<const PolygonCorner> corners) {
  nodes_.clear();
  runs_.clear();
  const FacetId t = store_.facet(vacated_[vacated]);
  const std::size_t n = corners.size();
  const auto follow = [&](Heir heir, const RoundedPoint& start, EdgeLabel edge) {
    if (runs_.empty() || runs_.back().heir != heir) {
      nodes_.push_back({start, edge, none});
      runs_.push_back({heir, nodes_.size() - 1, nodes_.size() - 1});
    } else {
      append(runs_.back(), start, edge);
    }
  };
  const auto owner_at = [&](EdgeLabel neighbour, int corner) {
    return neighbour.is_site() ? heir_index_[neighbour.site()] : owner_of_vertex(t, corner);
  };
  for (std::size_t k = 0; k < n; ++k) {
    const EdgeLabel label = corners[k].edge;
    if (label.is_site()) {
      follow(heir_index_[label.site()], corners[k].point, EdgeLabel::bisector(p_));
      continue;
    }
    const int e = label.edge();
    const Heir first = owner_at(corners[k == 0 ? n - 1 : k - 1].edge, e);
    const Heir last = owner_at(corners[k + 1 == n ? 0 : k + 1].edge, e == 2 ? 0 : e + 1);
    const Range range = crossings_on_edge(vacated, e, first, last);
    follow(first, corners[k].point, label);
    for (std::size_t c = range.first; c < range.first + range.count; ++c)
      follow(crossings_[c].to, crossings_[c].point, label);
  }
  if (runs_.size() > 1 && runs_.front().heir == runs_.back().heir) {
    nodes_[runs_.back().last].next = runs_.front().first;
    runs_.front().first = runs_.back().first;
    runs_.pop_back();
  }
}

/// Of a vertex of the surface in the vacated cell.
CellDivision::Heir CellDivision::owner_of_vertex(FacetId t, int corner) {
  const VertexId v = mesh_.facet(t)[static_cast<std::size_t>(corner)];
  if (vertex_stamp_[v] == vertex_stamp_now_) return vertex_owner_[v];
  CellCorner at{t,
                SiteId(),
                EdgeLabel::facet_edge(corner == 0 ? 2 : corner - 1),
                EdgeLabel::facet_edge(corner),
                {mesh_.position(v), 0}};
  Heir best = 0;
  for (Heir h = 1; h < heirs_.size(); ++h) {
    at.owner = heirs_[best];
    if (clipper_.beats_at(at, heirs_[h], bisector(best, h))) best = h;
  }
  at.owner = heirs_[best];
  corners_.push_back(at);
  vertex_stamp_[v] = vertex_stamp_now_;
  vertex_owner_[v] = static_cast<std::uint32_t>(best);
  return best;
}

/// Where the owner changes along the part of facet edge e in the vacated cell, from its first owner to its
/// last.
CellDivision::Range CellDivision::crossings_on_edge(std::size_t vacated, int e, Heir first, Heir last) {
  Range& range = edge_crossings_[vacated][static_cast<std::size_t>(e)];
  range.first = crossings_.size();
  if (first == last) return range;
  const FacetId t = store_.facet(vacated_[vacated]);
  if (!copy_from_across(t, e)) {
    const RoundedPoint point =
        clipper_.corner(t, EdgeLabel::facet_edge(e), heirs_[first], heirs_[last], bisector(first, last));
    crossings_.push_back({first, last, point});
    for (Heir h = 0; h < heirs_.size(); ++h)
      if (h != first && h != last) insert_crossings(t, e, h, range.first);
    for (std::size_t c = range.first; c < crossings_.size(); ++c)
      corners_.push_back({t, heirs_[crossings_[c].from], EdgeLabel::facet_edge(e),
                          EdgeLabel::bisector(heirs_[crossings_[c].to]), crossings_[c].point});
  }
  range.count = crossings_.size() - range.first;
  return range;
}

/// The facet on the other side has the same crossings, if they are known already: mostly the other way round.
bool CellDivision::copy_from_across(FacetId t, int e) {
  const FacetId across = mesh_.across(t, e);
  if (!across.valid() || vacated_index_[across] < 0) return false;
  const auto& ranges = edge_crossings_[static_cast<std::size_t>(vacated_index_[across])];
  const auto start = mesh_.facet(t)[static_cast<std::size_t>(e)],
             end = mesh_.facet(t)[static_cast<std::size_t>(e == 2 ? 0 : e + 1)];
  for (std::size_t i = 0; i < 3; ++i) {
    const VertexId a = mesh_.facet(across)[i], b = mesh_.facet(across)[i == 2 ? 0 : i + 1];
    const bool same = a == start && b == end, reversed = a == end && b == start;
    if ((!same && !reversed) || ranges[i].count == 0) continue;
    for (std::size_t k = 0; k < ranges[i].count; ++k) {
      const Crossing c = crossings_[ranges[i].first + (same ? k : ranges[i].count - 1 - k)];
      crossings_.push_back(same ? c : Crossing{c.to, c.from, c.point});
    }
    return true;
  }
  return false;
}

/// Heir h, on edge e, to which the crossings from `begin` on belong. Where it beats the owners it beats them
/// at consecutive crossings, since it does not at the ends of the edge.
void CellDivision::insert_crossings(FacetId t, int e, Heir h, std::size_t begin) {
  const EdgeLabel edge = EdgeLabel::facet_edge(e);
  std::size_t first = none, last = none;
  for (std::size_t c = begin; c < crossings_.size(); ++c) {
    const auto& [from, to, point] = crossings_[c];
    if (!clipper_.beats_at({t, heirs_[from], edge, EdgeLabel::bisector(heirs_[to]), point}, heirs_[h],
                           bisector(from, h)))
      continue;
    if (first == none) first = c;
    last = c;
  }
  if (first == none) return;
  const Heir from = crossings_[first].from, to = crossings_[last].to;
  const auto meet = [&](Heir a, Heir b) {
    return clipper_.corner(t, edge, heirs_[a], heirs_[b], bisector(a, b));
  };
  const auto at = crossings_.begin() + static_cast<std::ptrdiff_t>(first);
  crossings_.erase(at, crossings_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  crossings_.insert(crossings_.begin() + static_cast<std::ptrdiff_t>(first),
                    {Crossing{from, h, meet(from, h)}, Crossing{h, to, meet(h, to)}});
}

bool CellDivision::is_ear(FacetId t, std::size_t begin, std::size_t b) const {
  const std::size_t end = runs_.size(), a = b == begin ? end - 1 : b - 1, c = b + 1 == end ? begin : b + 1;
  const SiteId sa = site(runs_[a]), sb = site(runs_[b]), sc = site(runs_[c]);
  if (clipper_.orientation(t, sa, sb, sc) <= 0) return false;
  for (std::size_t d = begin; d < end; ++d)
    if (d != a && d != b && d != c && clipper_.beats_in_plane(t, sb, sa, sc, site(runs_[d]))) return false;
  return true;
}

//        a   b|a   b             Run b ends: its share is bounded by its run, then the edge b|c up to the corner,
//    ---------+----.             then the edge b|a back. The corner is the new junction of a and c.
//              \    \.  b
//               *----+
//           a    b|c  \  c
void CellDivision::cut_ear(FacetId t, std::size_t begin, std::size_t b) {
  const std::size_t end = runs_.size(), a = b == begin ? end - 1 : b - 1, c = b + 1 == end ? begin : b + 1;
  const SiteId sa = site(runs_[a]), sb = site(runs_[b]), sc = site(runs_[c]);
  const EdgeLabel la = EdgeLabel::bisector(sa), lb = EdgeLabel::bisector(sb), lc = EdgeLabel::bisector(sc);
  const RoundedPoint corner = clipper_.corner(t, la, sb, sc, bisector(runs_[b].heir, runs_[c].heir));
  corners_.push_back({t, sb, lc, la, corner});
  append(runs_[a], nodes_[runs_[b].first].point, lb);
  append(runs_[b], nodes_[runs_[c].first].point, lc);
  append(runs_[b], corner, la);
  nodes_.push_back({corner, lb, runs_[c].first});
  runs_[c].first = nodes_.size() - 1;
  nodes_[runs_[b].last].next = runs_[b].first;
  runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(b));
}

void CellDivision::append(Run& run, const RoundedPoint& point, EdgeLabel edge) {
  nodes_.push_back({point, edge, none});
  nodes_[run.last].next = nodes_.size() - 1;
  run.last = nodes_.size() - 1;
}

/// The share of the owner of this run: its closed outline.
void CellDivision::emit(std::size_t vacated, const Run& run) {
  Share& share = add_share();
  share.polygon.facet = store_.facet(vacated_[vacated]);
  share.polygon.owner = site(run);
  share.polygon.corners.clear();
  std::size_t i = run.first;
  do {
    share.polygon.corners.push_back({nodes_[i].point, nodes_[i].edge, CircleId()});
    if (nodes_[i].edge == EdgeLabel::bisector(p_)) share.joins = old_fragment(vacated, run.heir);
    i = nodes_[i].next;
  } while (i != run.first);
}

/// What the heirs have on the facets of the vacated fragments: from a facet's list if that is short, else heir
/// by heir. All that will be read is asked for before any of it is.
void CellDivision::find_old_fragments() {
  const std::size_t short_list = 8 * heirs_.size();
  old_fragments_.assign(vacated_.size() * heirs_.size(), FragmentId());
  const auto is_short = [&](FragmentId f) { return store_.of_facet(store_.facet(f)).size() <= short_list; };
  for (const FragmentId f : vacated_)
    if (is_short(f))
      for (const FragmentId g : store_.of_facet(store_.facet(f))) store_.prefetch_fragment(g);
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
    for (std::size_t h = 0; h < heirs_.size(); ++h)
      if (row[h].valid()) store_.prefetch_corners(row[h]);
  }
}

}  // namespace geom
