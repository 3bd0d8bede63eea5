#include "geom/dual/met_facets.h"

namespace geom {

MetFacets::Slot MetFacets::add(FacetId t, FrameVertices& vertices) {
  const auto slot = static_cast<Slot>(facets_.size());
  slot_of_[t] = slot;
  const TriMesh::Facet& corners = mesh_.facet(t);
  Facet& facet = facets_.add();
  facet.id = t;
  for (std::size_t i = 0; i < 3; ++i) facet.corners[i] = vertices.with_signs(corners[i]);
  facet.done = {false, false, false};
  facet.ends = SegmentEnds::empty;
  return slot;
}

}  // namespace geom
