#pragma once
// Cells in one piece: the topology of thin sheets and sharp tips (the paper asks for the topological ball
// property in section 5 and leaves open what to do where it fails; cf. Yan, Bao, Zhang, Wonka, Low-resolution
// remeshing using the localized restricted Voronoi diagram, 2014).
//
// Where two sheets of the surface are closer than the samples, a sample on one side can be the nearest to a
// piece of the other: its cell has an orphan, a component that does not contain the sample. The dual then
// joins the sheets. Here each orphan is divided among the cells that surround it on its own sheet.

#include <atomic>
#include <span>

#include "fpo/remesh/extract.h"
#include "fpo/surface/surface_sample.h"
#include "geom/power/restricted_power.h"

namespace fpo {

struct Localization {
  std::size_t orphans = 0;    ///< components divided among the cells around them
  std::size_t merged = 0;     ///< components that could not be divided: each was added to one cell as a whole
  std::size_t remaining = 0;  ///< components that no other cell surrounds: left as they are
  FragmentOwners owners;      ///< of the merged ones
};

/// The components of p's cell, connected across facet edges; the one that contains the sample's facet
/// (failing that, the one of most fragments) first.
std::vector<std::vector<geom::FragmentId>> cell_components(const geom::RestrictedPower& diagram,
                                                           geom::SiteId p, geom::FacetId home);

/// Gives all orphans away: divides them or, where cells abandoned before stand in the way, merges them with
/// the cell that they have the longest border with. The result is no power diagram any more, but a diagram
/// still: it covers each facet, and cells meet at facet edges. Where giving away makes ever new orphans, no
/// fewer from round to round or more than two a sample, or when interrupted, the rest is merged.
/// Deterministic. Cost: O(fragments) plus the orphans.
Localization localize(geom::RestrictedPower& diagram, std::span<const SurfaceSample> samples,
                      const std::atomic<bool>* interrupted = nullptr);

}  // namespace fpo
