#pragma once
// Components of the surface that are so small beside the spacing that they would have no sample, or too few
// to be bodies: where there is no empty circle no move brings another one. There the wanted length is lowered
// beforehand, and samples are put there to begin with. Not in the paper, whose models have one component.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "fpo/surface/sizing.h"
#include "geom/mesh/surface_type.h"

namespace fpo {

/// Those of a surface for any sizing.
class SmallParts {
 public:
  /// Keeps a reference. O(F log F).
  explicit SmallParts(const geom::TriMesh& mesh);

  /// The sizing, but on components for which it calls for fewer than some eight samples so short that these
  /// get so many; fewer, but no less than five, or only the largest get so many, if edges elsewhere would
  /// have to be longer than most_scale times what was wanted. Not on those where fixed samples make a body,
  /// or a triangle with a border, already. n is the number of all samples. Nothing if there is no such
  /// component. O(F) if there are components at all.
  std::optional<Sizing> room(const Sizing& sizing, std::size_t n, double most_scale,
                             std::span<const SurfaceSample> fixed = {}) const;

  /// Brings inner samples to components for which the sizing calls for five or more, but for few, and which
  /// have fewer than that or eight. The first samples, so many, are fixed. O(F).
  void people(const Sizing& sizing, std::size_t num_fixed, std::vector<SurfaceSample>& samples) const;

 private:
  const geom::TriMesh& mesh_;
  /// Of each part: do fixed samples make it?
  std::vector<bool> have_bodies(std::span<const SurfaceSample> fixed) const;

  std::vector<std::vector<geom::FacetId>> parts_;  ///< none if there is one alone
  std::vector<geom::PartType> types_;
  geom::Table<geom::FacetId, std::uint32_t> part_of_;
};

/// Such that a component gets some so many samples, and what is around it hardly more than without. Empty if
/// it has no area. `part`: its facets.
std::vector<Spot> spots_of_body(const geom::TriMesh& mesh, const std::vector<geom::FacetId>& part,
                                std::size_t num_samples = 8);

/// Sends samples to those of some parts that have fewer than they are to have, each to the vertex that is
/// farthest from those there: inner ones from other parts that keep eight, whoever they are.
struct Peopling {
  const geom::TriMesh& mesh;
  const geom::Table<geom::FacetId, std::uint32_t>& part_of;
  std::map<std::size_t, std::size_t> least;  ///< samples of each such part
  std::size_t num_fixed;                     ///< the first ones
};
void people(const Peopling& what, std::vector<SurfaceSample>& samples);

}  // namespace fpo
