#pragma once
// File name extensions.

#include <filesystem>
#include <string>
#include <vector>

namespace io {

/// The extension in lower case, with its dot: ".obj". Empty if there is none.
std::string lower_extension(const std::filesystem::path& path);

/// Throws geom::InputError "name: unknown extension '.xyz' (meshes are .obj, ...)".
[[noreturn]] void fail_extension(const std::filesystem::path& path, const std::string& known);

/// Whether a name may be given to a file of a format with these extensions (".txt"). A name without one says
/// nothing about the content and will do: /dev/stdout. Throws geom::InputError "name: unknown extension
/// '.png' (use .svg)".
void require_extension(const std::filesystem::path& path, const std::vector<std::string>& possible);

}  // namespace io
