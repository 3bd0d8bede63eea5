#pragma once
// The header of a PLY file (Stanford polygon format).

#include <bit>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_file.h"

namespace io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);
constexpr bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count = {};  ///< of a list: the type of its length
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties = {};

  const PlyProperty* find(std::string_view wanted) const;  ///< or null
};

struct PlyHeader {
  std::optional<std::endian> binary;  ///< the byte order; none: text
  std::vector<PlyElement> elements;
  std::size_t body = 0;       ///< offset of the first byte after the header
  std::size_t body_line = 0;  ///< and its line
};

/// Reads the header and checks that the body can hold the elements it promises.
/// Throws geom::InputError "name:line: what".
PlyHeader parse_ply_header(const InputFile& file);

}  // namespace io
