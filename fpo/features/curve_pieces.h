#pragma once
// Feature curves in short straight pieces, to be looked for in space.

#include <vector>

#include "fpo/features/features.h"

namespace fpo {

/// A straight part of a curve.
struct CurvePiece {
  geom::Vec3 from, to;
  std::size_t curve;
  double start;  ///< of the curve's length
  geom::FacetId facet;
  double length() const { return (to - from).norm(); }
  geom::Vec3 middle() const { return (from + to) / 2; }
  double at_middle() const { return start + length() / 2; }  ///< of the curve's length
};

/// Appends the pieces of one curve, none longer than that. The curve's length.
double cut_curve(const geom::TriMesh& mesh, const Features& features, std::size_t curve, double longest,
                 std::vector<CurvePiece>& pieces);

}  // namespace fpo
