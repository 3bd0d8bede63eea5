#include "io/surface_map.h"

#include <array>
#include <cstdlib>
#include <sstream>

#include "doctest.h"
#include "geom/check.h"
#include "tests/io/scratch_folder.h"

using fixtures::ScratchFolder;

TEST_CASE("surface map: a line a point, vertices from 1, every bit back") {
  const ScratchFolder folder;
  const std::array<io::MappedPoint, 2> points{
      io::MappedPoint{{geom::VertexId(0), geom::VertexId(7), geom::VertexId(3)},
                      geom::Vec3(1.0 / 3, 1.0 / 7, 1 - 1.0 / 3 - 1.0 / 7)},
      io::MappedPoint{{geom::VertexId(41), geom::VertexId(1), geom::VertexId(0)}, geom::Vec3(0, 1, 1e-300)}};
  io::write_surface_map(folder / "map.txt", points);
  std::istringstream in(ScratchFolder::read(folder / "map.txt"));
  std::string rest;
  std::getline(in, rest);
  CHECK(rest.starts_with("# "));
  for (const io::MappedPoint& point : points) {
    for (const geom::VertexId v : point.vertices) {
      int vertex = 0;
      in >> vertex;
      CHECK(vertex == v.value + 1);
    }
    for (int i = 0; i < 3; ++i) {
      std::string number;
      in >> number;
      CHECK(std::strtod(number.c_str(), nullptr) == point.barycentric[i]);
    }
  }
  CHECK(!(in >> rest));
  CHECK_THROWS_AS(io::write_surface_map(folder / "none" / "map.txt", points), geom::InputError);
}
