#include "geom/cell_assembly.h"

#include <algorithm>
#include <utility>

#include "geom/check.h"

namespace geom {

void CellAssembly::clear() {
  for (const TouchedFacet& touched : facets_) mark_[touched.facet] = -1;
  facets_.clear();
  cuts_.clear();
}

std::array<RoundedPoint, 2> CellAssembly::add_cut(FacetId t, Cut cut, SiteId p, const Bisector& b) {
  const auto meet = [&](EdgeLabel label) {
    const RoundedPoint* known = known_corner(t, label, cut.rival);
    return known ? *known : clipper_.corner(t, label, cut.rival, p, b);
  };
  cut.leave = meet(cut.leaving);
  cut.enter = meet(cut.entering);
  TouchedFacet& touched = win_on(t);
  cut.next = touched.cuts;
  cuts_.push_back(cut);
  touched.cuts = static_cast<std::int32_t>(cuts_.size()) - 1;
  return {cut.leave, cut.enter};
}

const CellAssembly::Cut* CellAssembly::cut_of(FacetId t, SiteId rival) const {
  if (!t.valid() || mark_[t] < 0) return nullptr;
  for (std::int32_t i = facets_[static_cast<std::size_t>(mark_[t])].cuts; i >= 0; i = cut_at(i).next)
    if (cut_at(i).rival == rival) return &cut_at(i);
  return nullptr;
}

/// The corner where p's bisector with the rival meets what the label stands for, if another cut of this
/// insertion has it: the one of the site that the label names, or the rival's own across that edge.
const RoundedPoint* CellAssembly::known_corner(FacetId t, EdgeLabel label, SiteId rival) const {
  if (label.is_site()) {
    const Cut* cut = cut_of(t, label.site());
    return !cut                                          ? nullptr
           : cut->leaving == EdgeLabel::bisector(rival)  ? &cut->leave
           : cut->entering == EdgeLabel::bisector(rival) ? &cut->enter
                                                         : nullptr;
  }
  const FacetId across = mesh_.across(t, label.edge());
  const Cut* cut = cut_of(across, rival);
  if (!cut) return nullptr;
  const auto ends = [&](FacetId facet, int e) -> std::pair<std::int32_t, std::int32_t> {
    const VertexId a = mesh_.facet(facet)[static_cast<std::size_t>(e)],
                   b = mesh_.facet(facet)[static_cast<std::size_t>(e == 2 ? 0 : e + 1)];
    return std::minmax(a.value, b.value);  // whose references end here
  };
  const auto same_edge = [&](EdgeLabel other) {
    return !other.is_site() && ends(across, other.edge()) == ends(t, label.edge());
  };
  return same_edge(cut->leaving) ? &cut->leave : same_edge(cut->entering) ? &cut->enter : nullptr;
}

const CellAssembly::Cut* CellAssembly::cut_entered_from(const TouchedFacet& touched, EdgeLabel label) const {
  for (std::int32_t i = touched.cuts; i >= 0; i = cut_at(i).next)
    if (cut_at(i).entering == label) return &cut_at(i);
  return nullptr;
}

//             entering                 Seen from p, the new edge of rival j runs from `enter` to `leave`. The
//        ---o-----------               next edge of p is the one that `leaving` names: the new edge of that rival,
//      p    | j   (j's fragment)       or the facet edge, up to the rival who enters from there or else to the
//        ---o-----------               corner of the facet.
//             leaving
void CellAssembly::assemble(const TouchedFacet& touched, SiteId p, FacetPolygon& out) const {
  if (touched.cuts < 0) return clipper_.start(out, touched.facet, p);
  out.facet = touched.facet;
  out.owner = p;
  out.corners.clear();
  const Cut* const first = &cut_at(touched.cuts);
  const Cut* cut = first;
  do {
    out.corners.push_back({cut->enter, EdgeLabel::bisector(cut->rival), CircleId()});
    EdgeLabel edge = cut->leaving;
    if (edge.is_site()) {
      cut = cut_of(touched.facet, edge.site());
    } else {
      out.corners.push_back({cut->leave, edge, CircleId()});
      while (!(cut = cut_entered_from(touched, edge)) && out.corners.size() <= cuts_.size() * 2 + 3) {
        const int corner = edge.edge() == 2 ? 0 : edge.edge() + 1;
        edge = EdgeLabel::facet_edge(corner);
        out.corners.push_back({{mesh_.corner(touched.facet, corner), 0}, edge, CircleId()});
      }
    }
    ensure(cut && out.corners.size() <= cuts_.size() * 2 + 3,
           "cell assembly: the edges of a new fragment do not close");
  } while (cut != first);
}

}  // namespace geom
