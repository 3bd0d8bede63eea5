#pragma once
// What the wanted edge lengths on a surface are made of, in one table that the pipeline, the options of the
// tools, the reports and the library read: another sizing is a line there and a file.

#include <span>

#include "fpo/surface/sizing.h"

namespace fpo {

/// A line of the table that no code names needs no name here: SizingKind{4}.
enum class SizingKind { uniform, local_feature_size, curvature, given };

/// What is to be sized, in the unit box. All references must outlive the call.
struct SizingTask {
  const geom::TriMesh& surface;
  std::size_t num_samples;
  double spacing;            ///< that many samples would have if they were spread evenly
  const VertexField& given;  ///< lengths, of the user's
  int threads = 1;           ///< no matter to the result
};

struct SizingFacts {
  SizingKind kind;
  const char* name;   ///< on the command line; null: a file
  const char* title;  ///< in reports
  const char* help;   ///< what it is, unless the name says so
  /// rho (paper, section 3.2) at each vertex: wanted lengths up to a factor. Null: the same everywhere.
  VertexField (*rho)(const SizingTask&);
};

std::span<const SizingFacts> sizings();

/// Throws Bug if the kind has no line in the table.
const SizingFacts& facts_of(SizingKind kind);

}  // namespace fpo
