#pragma once
// Surface files as an adversary would make them: small shapes, spoilt.

#include <cstdint>
#include <string>

#include "geom/rng.h"

namespace fuzz {

/// A file: its name's extension names the format.
struct Mutant {
  std::string name, bytes;
};

/// The file of a seed. A shape of at most a few hundred facets with one to three
/// spoilt properties: coordinates from denormal to 1e300, flattened, far from the origin or on a coarse grid;
/// vertices that coincide; facets that are doubled, turned, dropped, torn apart or joined to foreign
/// vertices. One in four is damaged as a file besides. Most can be read; of those many are no surface to
/// speak of.
Mutant mutant(std::uint64_t seed);

/// A closed shape of some hundred facets spoilt in one of ten ways (fixtures/spoilt.h), as an exporter or a
/// scanner would: --repair makes a closed manifold of it.
Mutant export_fault(std::uint64_t seed);

/// The bytes with one to four of them changed, a stretch removed or repeated, lines cut or doubled, words
/// exchanged, or the end cut off.
std::string damaged(std::string bytes, geom::Rng& rng);

}  // namespace fuzz
