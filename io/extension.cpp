#include "io/extension.h"

#include <algorithm>

#include "geom/check.h"
#include "io/input_file.h"

namespace io {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

void fail_extension(const std::filesystem::path& path, const std::string& known) {
  const std::string extension = path.extension().string();
  throw geom::InputError(display_name(path) + ": " +
                         (extension.empty() ? "no extension" : "unknown extension " + in_quotes(extension)) +
                         " (" + known + ")");
}

void require_extension(const std::filesystem::path& path, const std::vector<std::string>& possible) {
  const std::string extension = lower_extension(path);
  if (extension.empty() || std::ranges::find(possible, extension) != possible.end()) return;
  std::string known;
  for (const std::string& one : possible) known += (known.empty() ? "use " : " or ") + one;
  fail_extension(path, known);
}

}  // namespace io
