#pragma once
// A file under reading: its bytes and its name, and the one way to complain about it.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace io {

/// What the number in an error message counts.
enum class Unit { line, byte };

/// A place in a file: a line (from 1) of a text, a byte offset (from 0) of a binary file.
struct Place {
  std::size_t number;
  Unit unit;
};

/// The whole content of a file. Every complaint is a geom::InputError of one line.
struct InputFile {
  std::string name;  ///< as the user gave it, control characters replaced by '?'
  std::string bytes;

  [[noreturn]] void fail(std::string_view what) const;  ///< "name: what"
  /// "name:17: what", or "name:byte 480: what" in binary content.
  [[noreturn]] void fail(Place at, std::string_view what) const;
};

/// A path as it appears in messages: one line, control characters replaced by '?'.
std::string display_name(const std::filesystem::path& path);

/// A piece of a file as it appears in messages: quoted, at most 40 bytes, printable ASCII only.
std::string in_quotes(std::string_view word);

/// The file's content. Throws geom::InputError: "name: no such file", "name: is a directory", "name: the file
/// is empty", "name: cannot read: reason".
InputFile load(const std::filesystem::path& path);

}  // namespace io
