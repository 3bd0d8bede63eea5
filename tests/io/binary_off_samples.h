#pragma once
// Binary OFF files, which nothing of ours writes.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "geom/mesh/trimesh.h"
#include "io/byte_order.h"

namespace fixtures {

/// A file in the making, in any of its layouts.
class BinaryOff {
 public:
  struct Layout {
    std::endian order;
    bool colours;  ///< facets end with their colours
  };

  explicit BinaryOff(Layout layout, const std::string& header = "OFF BINARY\n")
      : layout_(layout), bytes_(header) {}

  void add_counts(std::size_t vertices, std::size_t facets) {
    for (const std::size_t n : {vertices, facets, std::size_t{0}}) add(static_cast<std::uint32_t>(n));
  }
  /// Its coordinates, and what else the header says it has.
  void add_vertex(const std::vector<double>& numbers) {
    for (const double x : numbers) add(static_cast<float>(x));
  }
  void add_facet(const std::vector<std::int32_t>& corners, const std::vector<float>& colours = {}) {
    add(static_cast<std::uint32_t>(corners.size()));
    for (const std::int32_t corner : corners) add(corner);
    if (!layout_.colours) return;
    add(static_cast<std::uint32_t>(colours.size()));
    for (const float colour : colours) add(colour);
  }
  /// A number where a file may have none.
  template <class T>
  void add(T value) {
    std::string little;
    io::append_little(little, value);
    if (layout_.order == std::endian::big) std::reverse(little.begin(), little.end());
    bytes_ += little;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  Layout layout_;
  std::string bytes_;
};

inline std::string binary_off(const geom::TriMesh& mesh, BinaryOff::Layout layout) {
  BinaryOff file(layout);
  file.add_counts(mesh.num_vertices(), mesh.num_facets());
  for (const geom::Vec3& p : mesh.vertices()) file.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& [a, b, c] : mesh.facets()) file.add_facet({a.value, b.value, c.value});
  return file.bytes();
}

}  // namespace fixtures
