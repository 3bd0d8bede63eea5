#pragma once
// Gray images in files: PGM, and PNG where libpng was there when this was built.

#include <filesystem>
#include <string>
#include <vector>

#include "io/pgm.h"

namespace io {

/// ".pgm", and ".png" if it can be read.
std::vector<std::string> image_extensions();
/// Whether a name is that of an image: .pgm or .png, readable here or not.
bool is_image(const std::filesystem::path& path);

/// Reads .pgm or .png; colours become luminance as they are stored, what is transparent is white. Throws
/// geom::InputError as read_pgm() does, also on a PNG if this was built without libpng. Linear.
GrayImage read_gray_image(const std::filesystem::path& path);

}  // namespace io
