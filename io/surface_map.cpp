#include "io/surface_map.h"

#include <string>

#include "io/atomic_file.h"
#include "io/numbers.h"

namespace io {

void write_surface_map(const std::filesystem::path& path, std::span<const MappedPoint> points) {
  std::string text = "# facet (from 1) and barycentric coordinates of each vertex\n";
  for (const MappedPoint& p : points) {
    append_integer(text, p.facet.value + 1);
    for (const double b : p.barycentric) {
      text += ' ';
      append_shortest(text, b);
    }
    text += '\n';
  }
  write_file(path, text);
}

}  // namespace io
