#pragma once
// One attempt at a remesh, with one choice of curves and one way with sheets: the paper, in a line; what is
// not in it comes in between. Which attempts are made, and which one is kept: sheet_ways.h, attempts.h.

#include "fpo/features/feature_choice.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/stand_in_remesh.h"

namespace fpo {

/// What a remesh begins with, and whether there is nothing to do.
struct Beginning {
  const RemeshResult* start = nullptr;
  bool only_apart = false;
  const RemeshResult* rival = nullptr;
  const RemeshResult* same = nullptr;
};

/// `coarser`: remeshes what stands in for a dense surface. If sheets are left to us and near each other, and
/// the diagram of space is not of the input's type, there are only samples; nothing if there is nothing to do
/// (`begin`). Throws geom::Interrupted if it is interrupted before there is anything, geom::InputError if
/// samples are too few for any mesh.
RemeshResult attempted_remesh(const geom::TriMesh& surface, const FeatureChoice& choice,
                              const RemeshOptions& options, const Beginning& begin,
                              const RemeshFunction& coarser);

}  // namespace fpo
