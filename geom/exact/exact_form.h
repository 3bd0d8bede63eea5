#pragma once
// The affine functions f_j of clip_predicates.h at one place, exactly.

#include "geom/exact/expansion.h"
#include "geom/exact/predicates.h"

namespace geom {

/// F_j at q: Pi(q, j) - Pi(q, p0) = (p0 - pj).((q - p0) + (q - pj)) + (w0 - wj), in four coordinates.
Expansion form_at(const Location3& q, const RankedPoint3& owner, const RankedPoint3& j);

}  // namespace geom
