#pragma once
// From samples to a mesh: the dual of the restricted power diagram (paper, section 5; RRT of section 4.1).

#include <map>
#include <vector>

#include "fpo/surface/surface_domain.h"
#include "geom/power/restricted_power.h"

namespace fpo {

/// Fragments that belong to another cell than their site's (localize.h).
using FragmentOwners = std::map<geom::FragmentId, geom::SiteId>;

/// The restricted regular triangulation: sample i is vertex i, and every type C corner gives the triangle of
/// the three sites that meet there, oriented like the surface. A triangle that occurs at several corners (a
/// sharp fold or a thin sheet, sampled too sparsely) is taken once for each orientation. Facets are sorted,
/// so the mesh is a function of the diagram. Not a manifold unless each cell is a disk (topological ball
/// property): see geom::topology(). Throws geom::InputError if there is no triangle: too few samples.
geom::TriMesh extract(const geom::RestrictedPower& diagram, std::size_t num_samples,
                      const FragmentOwners& owners = {});

/// The same of the domain's samples, from its circles: no diagram is needed. O(n log n).
geom::TriMesh extract(const SurfaceDomain& domain);

/// A fragment of the diagram with rounded corners, for output.
struct CellPolygon {
  geom::SiteId site;
  geom::FacetId facet;
  std::vector<geom::Vec3> corners;
};

/// All fragments, sorted by site and facet, each from its edge of smallest label on: a function of the
/// diagram, whatever its history.
std::vector<CellPolygon> cell_polygons(const geom::RestrictedPower& diagram);

}  // namespace fpo
