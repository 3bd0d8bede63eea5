#pragma once
// The initial point set on a surface (paper, section 4.2): random triangles with probability proportional to
// weighted area, a random point in each.

#include <cstdint>
#include <vector>

#include "fpo/surface/sizing.h"
#include "geom/mesh/trimesh.h"

namespace fpo {

/// More are refused: ids and memory, 1 to 3 KB a sample (tests/FIGURES.md).
inline constexpr std::size_t max_samples = 20'000'000;

/// Exactly n independent samples with density proportional to h^-2 (uniform by area if h is); a function of
/// mesh, sizing, n and seed. O(patches + n log patches). Throws InputError if n is 0 or more than
/// max_samples, or if the surface has no area.
std::vector<SurfaceSample> random_samples(const geom::TriMesh& mesh, const Sizing& sizing, std::size_t n,
                                          std::uint64_t seed);
std::vector<SurfaceSample> random_samples(const geom::TriMesh& mesh, std::size_t n, std::uint64_t seed);

}  // namespace fpo
