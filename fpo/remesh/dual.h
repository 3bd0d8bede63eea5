#pragma once
// The remesh as the dual of the cells, and where it is no surface (paper, section 5: the topological ball
// property; how to restore it is left open there).

#include <atomic>
#include <set>
#include <span>
#include <vector>

#include "fpo/remesh/cell_faults.h"
#include "fpo/remesh/defects.h"
#include "fpo/remesh/extract.h"
#include "fpo/remesh/localize.h"
#include "fpo/remesh/type_check.h"
#include "fpo/surface/surface_domain.h"

namespace fpo {

/// A remesh of the samples as they are, with orphans given away (localize.h).
struct Dual {
  geom::TriMesh mesh;                  ///< vertex i is sample i
  std::vector<SurfaceSample> samples;  ///< ascending by id
  std::vector<CellPolygon> cells;      ///< only if asked for
  Localization localization;
  TypeCheck type;
  /// Where the mesh is no surface; if it is one, but of another type than the input, where cells are at
  /// fault.
  std::vector<Defect> defects;
  std::vector<CellFault> cell_faults;  ///< only if the type is wrong

  /// 0 if the type is right.
  std::size_t num_faults() const;
};

/// Of the type, and without defects.
bool is_right(const Dual& dual);
/// Those with a defect or at a fault of cells, maybe several times.
std::vector<SiteId> samples_at_fault(const Dual& dual);
/// Samples within `rings` rings of the RRT, themselves included.
std::set<SiteId> neighbourhood(SurfaceDomain& domain, const std::vector<SiteId>& of, int rings);

/// All of them, by id.
std::vector<SurfaceSample> samples_of(const SurfaceDomain& domain);

/// Is the sample a corner of any?
bool has_triangle(const SurfaceDomain& domain, SiteId x);

/// Leaves the domain as it is. O(n log n) if the type is right at once and no cells are to be kept: then no
/// orphans are counted. Else the cost of a diagram. `type`: of the input. If interrupted, orphans are merged
/// (localize.h). Throws InputError if there is no triangle.
Dual dual_of(const SurfaceDomain& domain, const WantedType& type, bool keep_cells,
             const std::atomic<bool>* interrupted = nullptr);

/// Those of samples that have no domain. Cost: that of building their diagram.
std::vector<CellPolygon> cells_of(const geom::TriMesh& surface, const Sizing& sizing,
                                  std::span<const SurfaceSample> samples, const SurfaceOptions& options);

/// Brings a sample to each place with defects, to where the cell reaches farthest from its sample; it is
/// taken from the place, far from all of these, where samples are closest together. The samples around the
/// hole that it leaves are moved once to their farthest points nearby. Samples without a cell are taken
/// first, and those that are left, but for fixed ones, go to the farthest points of all; none is brought to
/// where it would have none. The number of samples stays. Returns the number of samples brought.
/// Deterministic.
std::size_t refine_at(SurfaceDomain& domain, const std::vector<Defect>& defects);

}  // namespace fpo
