#pragma once
// Several remeshes, one after the other: of those that are interrupted only the first is of use.

#include <optional>

#include "fpo/interruption.h"
#include "fpo/remesh/pipeline.h"

namespace fpo {

inline bool interrupted(const RemeshOptions& options) { return interrupted(options.optimize.interrupted); }

/// Another result where there is one already: nothing if it is interrupted.
template <class Make>
std::optional<RemeshResult> unless_interrupted(const RemeshOptions& options, Make make) try {
  RemeshResult result = make();
  if (interrupted(options)) return {};
  return result;
} catch (const geom::Interrupted&) {
  return {};
}

}  // namespace fpo
