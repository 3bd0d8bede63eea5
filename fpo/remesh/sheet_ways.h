#pragma once
// The ways to remesh a surface with one choice of features (feature_choice.h): sheets near each other
// together or apart, samples of close curves facing each other or staggered or not. Each is an attempt
// (attempt.h); which of two is better: attempts.h.

#include <functional>
#include <optional>

#include "fpo/features/feature_choice.h"
#include "fpo/remesh/pipeline.h"

namespace fpo {

/// Creases that nobody asked for may be given up for what harm they do.
bool may_drop_creases(const RemeshOptions& options);

/// On a dense surface each way with creases is made on the surface itself, and one without can be made on a
/// coarser one (stand_in_remesh.h), by measurement several times as fast: if the first is of no use, or of
/// little, no other with creases is tried.
bool is_slow_with_creases(const geom::TriMesh& surface, const RemeshResult& result,
                          const RemeshOptions& options);

/// All creases that are kept are dropped at once, before other ways with them are tried: by measurement these
/// take minutes and end at fault. Not if lengths may differ: then smaller triangles somewhere may help.
bool should_drop_creases(const geom::TriMesh& surface, const RemeshResult& result,
                         const RemeshOptions& options);

/// The first way, and what it led to at first if that was only samples, at fault for sheets near each other:
/// these are set apart then.
struct FirstWay {
  RemeshResult result;
  std::optional<RemeshResult> begun{};
};

FirstWay first_way(const geom::TriMesh& surface, const FeatureChoice& choice, const RemeshOptions& options);

/// A remesh of a surface with those features, or none if it is interrupted.
using RemeshWithFeatures = std::function<std::optional<RemeshResult>(
    const geom::TriMesh&, const FeatureChoice&, const RemeshOptions&)>;

/// What the first way leads to: such a function.
std::optional<RemeshResult> first_way_if_time(const geom::TriMesh& surface, const FeatureChoice& choice,
                                              const RemeshOptions& options);

/// The best of all ways. Sheets that are left to us are together unless they are near each other nearly
/// everywhere, or that does harm and being apart helps. Samples of close curves face each other if edges of
/// curves are lost else, and are not staggered where that may have spoilt it. Nothing of that where creases
/// that may be dropped spoil it all, nor where the remesh is of another type and the input has edges of more
/// than two facets: most such are faulty all over, and each way is as slow. `first`: what the first way leads
/// to, if that is known.
RemeshResult remesh_sheets(const geom::TriMesh& surface, const FeatureChoice& choice,
                           const RemeshOptions& options, std::optional<FirstWay> first = {});

/// With other samples on curves than the best one has: it is taken if it is better. Each way costs as much.
/// By measurement (96 public meshes: no type was lost by it) the way in which the best one was made tells: if
/// it does not help, others are not tried. If it does, all are, that one once more.
bool take_if_better_with(const geom::TriMesh& surface, const FeatureChoice& choice,
                         const RemeshOptions& options, RemeshResult& best);

}  // namespace fpo
