#include "io/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "geom/check.h"

namespace io {

namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};

std::string read_all(std::FILE* file) {
  std::string bytes;
  std::size_t used = 0;
  for (std::size_t chunk = 1 << 16;; chunk = std::min<std::size_t>(2 * chunk, 1 << 24)) {
    bytes.resize(used + chunk);
    const std::size_t got = std::fread(bytes.data() + used, 1, chunk, file);
    used += got;
    if (got < chunk) break;
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace

void InputFile::fail(std::string_view what) const { throw geom::InputError(name + ": " + std::string(what)); }

void InputFile::fail(Place at, std::string_view what) const {
  throw geom::InputError(name + (at.unit == Unit::line ? ":" : ":byte ") + std::to_string(at.number) + ": " +
                         std::string(what));
}

std::string display_name(const std::filesystem::path& path) {
  std::string name = path.string();
  std::replace_if(name.begin(), name.end(), is_control, '?');
  return name.empty() ? "''" : name;
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return is_control(c) || static_cast<unsigned char>(c) >= 0x80; },
      '?');
  return "'" + text + (word.size() > longest ? "...'" : "'");
}

InputFile load(const std::filesystem::path& path) {
  InputFile file{display_name(path), {}};
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) file.fail("no such file");
  if (std::filesystem::is_directory(status)) file.fail("is a directory");
  const std::unique_ptr<std::FILE, CloseFile> handle(std::fopen(path.c_str(), "rb"));
  if (!handle) file.fail("cannot read: " + std::generic_category().message(errno));
  errno = 0;
  file.bytes = read_all(handle.get());
  if (std::ferror(handle.get())) file.fail("cannot read: " + std::generic_category().message(errno));
  if (file.bytes.empty()) file.fail("the file is empty");
  return file;
}

}  // namespace io
