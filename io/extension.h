#pragma once
// File name extensions.

#include <filesystem>
#include <string>

namespace io {

/// The extension in lower case, with its dot: ".obj". Empty if there is none.
std::string lower_extension(const std::filesystem::path& path);

/// Throws geom::InputError "name: unknown extension '.xyz' (meshes are .obj, ...)".
[[noreturn]] void fail_extension(const std::filesystem::path& path, const std::string& known);

}  // namespace io
