#include "io/polygons.h"

#include "io/atomic_file.h"
#include "io/numbers.h"

namespace io {

void write_polygons(const std::filesystem::path& path, const std::string& prefix,
                    const std::vector<GroupedPolygon>& polygons) {
  AtomicFile file(path);
  std::size_t vertices = 0;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const GroupedPolygon& polygon = polygons[i];
    std::string text;
    if (i == 0 || polygons[i - 1].group != polygon.group)
      text += "g " + prefix + std::to_string(polygon.group) + "\n";
    for (const geom::Vec3& corner : polygon.corners) {
      text += 'v';
      for (const double x : corner) append_shortest(text += " ", x);
      text += '\n';
    }
    text += 'f';
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) text += ' ' + std::to_string(++vertices);
    file.write(text += '\n');
  }
  file.commit();
}

}  // namespace io
