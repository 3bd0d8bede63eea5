#pragma once
// Horns, necks and handles thinner than a few samples around: there the wanted length is lowered by what the
// topology needs, and the samples come from everywhere else. Not in the paper, whose section 5 asks for the
// topological ball property and leaves open how to reach it.

#include <atomic>
#include <cstddef>
#include <memory>

#include "fpo/features/feature_samples.h"
#include "fpo/remesh/dual.h"
#include "fpo/surface/surface_domain.h"

namespace fpo {

struct ThinPartOptions {
  double gradation = 0.3;        ///< of the wanted length about a thin place
  double most_scale = 2;         ///< nothing is lowered that would stretch the edges elsewhere by more
  int rounds = 6;                ///< at most; 0: only looks
  int iterations = 5;            ///< of farthest point optimization in each round
  int polishing = 40;            ///< at the end, at most
  double polishing_gain = 1e-3;  ///< of mean delta in five of these, or they end; and those of rounds, too,
                                 ///< if more than a tenth of the samples are on features
  SurfaceOptions diagram;        ///< of the domains
  Scope scope = Scope::global;   ///< of the polishing: samples are brought by global moves in any case
  const std::atomic<bool>* interrupted = nullptr;  ///< looked at before each move
};

struct ThinParts {
  std::size_t places = 0;  ///< spots where the length was lowered
  double scale = 1;        ///< by which edges elsewhere are longer than wanted
  std::size_t faults_before = 0, faults_after = 0;
  bool right_type = false;  ///< of the dual of the domain that is returned
};

/// If the dual is not of the input's type, looks for cells that are no disks, or meet in several arcs
/// (cell_faults.h), and lowers the wanted length around these: to a third of the way around, or by half.
/// Parts with fewer samples than a tetrahedron has corners have no empty circle for others to come to: some
/// are sent there. Then it optimizes anew, and looks again. If faults are left after all rounds, samples that
/// stand one after the other on a horn, without a triangle, are taken to the largest empty circles: the horn
/// ends earlier. That goes on, with lengths lowered again, until three rounds are in vain, unless many
/// samples are on features. Where a round makes three times as many faults as there were at best, samples are
/// lacking elsewhere: it goes on from the best. Gives up where so many faults come up that near sheets must
/// be to blame, or where more than a tenth of the samples are at fault and two rounds have not mended a tenth
/// of that. Returns the domain with the fewest faults, its sizing lowered or the same; the one given if that
/// has none. Exactly as many samples; fixed ones stay. Deterministic. Cost: that of some five iterations a
/// round, and those of the polishing.
std::unique_ptr<SurfaceDomain> make_room_for_thin_parts(std::unique_ptr<SurfaceDomain> domain,
                                                        const FeatureSamples& features,
                                                        const WantedType& type,
                                                        const ThinPartOptions& options, ThinParts& result);

}  // namespace fpo
