#pragma once
// Gray images: PGM, text (P2) and binary (P5), 8 or 16 bits.

#include <cstddef>
#include <filesystem>
#include <vector>

namespace io {

/// Row by row from the top; 0 is black, 1 is white.
struct GrayImage {
  std::size_t width = 0, height = 0;
  std::vector<float> value;
};

/// The first image of the file. Throws geom::InputError "path:line: what" or "path:byte n: what": no PGM
/// file, sides not in 1 .. 32768, a largest value not in 1 .. 65535, a value beyond it, too few values.
/// Linear.
GrayImage read_pgm(const std::filesystem::path& path);

}  // namespace io
