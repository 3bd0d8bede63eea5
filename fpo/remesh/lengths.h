#pragma once
// A remesh wanted by lengths instead of a number of samples: how many samples that takes, and, for a bound on
// the error, where.

#include <cstddef>
#include <optional>

#include "fpo/remesh/pipeline.h"

namespace fpo {

/// The mean edge of a remesh in units of the wanted length, which is the spacing of a hexagonal arrangement:
/// 1.016 to 1.022 on eight, venus, homer and bunny.
inline constexpr double mean_edge_over_wanted = 1.018;

/// More than these are refused: whoever asks for so many has mistaken the unit.
inline constexpr std::size_t most_samples_by_length = 20'000'000;

/// Lengths in the units of the surface. Neither: the lengths are those of a given sizing.
struct Lengths {
  std::optional<double> edge_length;  ///< mean edge; of a given sizing, and of an error, the longest
  std::optional<double> error;        ///< wanted distance between surface and remesh, about
  std::optional<double> radius;       ///< of Poisson disks: as many samples as about fit
};

/// The wanted length at each vertex with which triangles that are inscribed in a surface of that curvature
/// stay within `error` of it: h^2 = 3.5 error / curvature, at least `error` and at most `largest`. Curvature
/// (curvature.h) is that of each side of the features, whose folds are none; where facets are about as wide
/// as h, their folds over their widths count, too. O(F log F).
VertexField error_size(const geom::TriMesh& surface, const Features& features, double error, double largest);

/// Sets the number of samples and, for an error or a given sizing, lengths that sizing and features share. A
/// given sizing (RemeshOptions::rho) is taken as wanted lengths, no more up to a factor, graded by the
/// limits. Local feature size and curvature share out as many samples as evenly spread edges of that length
/// take. Without an edge length an error's lengths are at most a tenth of the diagonal. Features, fixed
/// points and limits must be set. Throws InputError on lengths that are not positive, that take more than 20
/// million samples, or that are missing or of no use together; a radius is for uniform sizing. O(F log F).
void set_number_of_samples(const geom::TriMesh& surface, const Lengths& given, RemeshOptions& options);

}  // namespace fpo
