#include "io/extension.h"

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

}  // namespace io
