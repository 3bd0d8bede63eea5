#include "io/surface_map.h"

#include <string>

#include "io/atomic_file.h"
#include "io/numbers.h"

namespace io {

void write_surface_map(const std::filesystem::path& path, std::span<const MappedPoint> points) {
  std::string text = "# each vertex: three vertices of the input (from 1) and their weights\n";
  for (const MappedPoint& p : points) {
    for (const geom::VertexId v : p.vertices) {
      append_integer(text, v.value + 1);
      text += ' ';
    }
    for (int i = 0; i < 3; ++i) append_shortest(text += i > 0 ? " " : "", p.barycentric[i]);
    text += '\n';
  }
  write_file(path, text);
}

}  // namespace io
