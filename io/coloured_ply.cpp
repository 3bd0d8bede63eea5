#include "io/coloured_ply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "geom/check.h"
#include "io/atomic_file.h"
#include "io/byte_order.h"

namespace io {
namespace {

using Rgb = std::array<double, 3>;

std::array<char, 3> colour_of(double share) {
  constexpr Rgb small{59, 76, 192}, middle{242, 242, 242}, large{180, 4, 38};
  std::array<char, 3> bytes;
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = share < 0.5 ? small[i] + 2 * share * (middle[i] - small[i])
                                 : middle[i] + (2 * share - 1) * (large[i] - middle[i]);
    bytes[i] = static_cast<char>(static_cast<unsigned char>(std::lround(c)));
  }
  return bytes;
}

}  // namespace

void write_coloured_ply(const std::filesystem::path& path, const geom::TriMesh& mesh,
                        std::span<const double> values) {
  geom::ensure(values.size() == mesh.num_vertices() && !values.empty(), "one value per vertex is needed");
  const auto [least, most] = std::ranges::minmax(values);
  const double range = std::log(most / least);
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.num_vertices()) +
      "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\nproperty uchar "
      "green\nproperty uchar blue\nproperty double value\nelement face " +
      std::to_string(mesh.num_facets()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (const double x : mesh.position(geom::VertexId(i))) append_little(bytes, x);
    for (const char c : colour_of(range > 0 ? std::log(values[i] / least) / range : 0.5)) bytes += c;
    append_little(bytes, values[i]);
  }
  for (const auto& facet : mesh.facets()) {
    bytes += '\3';
    for (const geom::VertexId v : facet) append_little(bytes, v.value);
  }
  write_file(path, bytes);
}

}  // namespace io
