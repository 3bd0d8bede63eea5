#pragma once
// Angles that are small still when the remesh is made. Angle optimization (angles.h, paper, section 5) moves
// samples under their diagram. Beside curves that are closer to each other than the samples the diagram has
// few choices: here triangles are seen as triangles, those on both sides of a curve alike.

#include <cstddef>
#include <vector>

#include "fpo/features/curve_slides.h"
#include "fpo/features/feature_samples.h"
#include "fpo/remesh/angles.h"

namespace fpo {

/// What is asked of the mesh.
struct LastAnglesGoal {
  double smallest = 30;           ///< angle, in degrees, or that of the options if that is smaller
  double least_edge = 0.55;       ///< of a vertex that is moved, in wanted lengths, or as it was
  double crowded_edge = 0.4;      ///< the same where nothing else helps, if that is less
  std::size_t most_attempts = 0;  ///< 0: a quarter of the samples and 200, but 1000 at most
};

/// A remesh whose vertex i is sample i.
struct LastAnglesTask {
  const geom::TriMesh& surface;
  const Sizing& sizing;  ///< on it
  const FeatureSamples& features;
  const CurveSlides* slides = nullptr;  ///< of these; null: samples on curves stay
  const AngleOptions& angles;
  LastAnglesGoal goal{};
};

struct LastAngles {
  std::size_t bad_before = 0, bad_after = 0;  ///< triangles with an angle below the goal
  std::size_t mended = 0;                     ///< flips and moves that were kept
};

/// Where triangles have angles below the goal: flips an edge, or moves a vertex on the surface, on its curve
/// if it is on one, by at most a third of the wanted length, with flips around it; or one of the vertices
/// around these. Kept if the sum of bad_angles() becomes smaller, no angle around smaller than it was or than
/// the goal, and no edge of a vertex that is moved shorter than it was or than the goal. Edges of curves are
/// not flipped, nor edges that the surface is folded at; corners and points of the user stay. The mesh stays
/// of its topological type; if nothing is that bad it stays as it is. The worst first, through all of them up
/// to ten times. While any are left the same is done again, and more is allowed each time: angles count as
/// far as they are below the goal only, not below what is wanted, but no more triangles may be bad; edges may
/// be as short as crowded_edge; where at most 16 are bad, those left out whose angle is one between two
/// curves that no slide makes larger, each is annealed (annealed_angles.h); more may become bad on the way,
/// if no more are in the end. With at most 200 + n / 4 attempts, and 1000, in all; each looks for some
/// hundred places on the surface, annealing, 8 + n / 20 times and eighty at most, for four thousand.
/// Deterministic.
LastAngles mend_last_angles(const LastAnglesTask& task, geom::TriMesh& remesh,
                            std::vector<SurfaceSample>& samples);

}  // namespace fpo
