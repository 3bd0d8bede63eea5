#pragma once
// A text file with one number a line, such as a wanted edge length per vertex of a mesh.

#include <filesystem>
#include <span>
#include <vector>

namespace io {

/// Lines that are empty or comments (#) are passed over. Throws geom::InputError "path:line: what" on a line
/// that is not one positive number, and if there is no number or not `count` of them. Linear.
std::vector<double> read_positive_values(const std::filesystem::path& path, std::size_t count);

/// Writes atomically (atomic_file.h); every bit is kept.
void write_values(const std::filesystem::path& path, std::span<const double> values);

}  // namespace io
