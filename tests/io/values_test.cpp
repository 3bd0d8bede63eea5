#include "io/values.h"

#include "doctest.h"
#include "geom/check.h"
#include "io/atomic_file.h"
#include "io/coloured_ply.h"
#include "io/mesh_io.h"
#include "tests/fixtures/surfaces.h"
#include "tests/io/scratch_folder.h"

using fixtures::ScratchFolder;

namespace {

void check_fault(const std::filesystem::path& file, const std::string& text, const char* fault) {
  io::write_file(file, text);
  CAPTURE(text);
  CHECK_THROWS_WITH_AS(io::read_positive_values(file, 2), doctest::Contains(fault), geom::InputError);
}

}  // namespace

TEST_CASE("values: what is written is read, every bit") {
  const ScratchFolder folder;
  const std::vector<double> values{0.1, 1e-300, 3, 1.0 / 3, 1e40};
  io::write_values(folder / "v.txt", values);
  CHECK(io::read_positive_values(folder / "v.txt", 5) == values);
  io::write_file(folder / "v.txt", "# two\n\n 1e0 # one\r\n+2.5");
  CHECK(io::read_positive_values(folder / "v.txt", 2) == std::vector<double>{1, 2.5});
}

TEST_CASE("values: faults are named by line") {
  const ScratchFolder folder;
  const auto file = folder / "v.txt";
  check_fault(file, "1\nnan\n", ":2: 'nan' is not a positive number");
  check_fault(file, "1\n-2\n", ":2: '-2'");
  check_fault(file, "0\n1\n", ":1: '0'");
  check_fault(file, "1\n1e400\n", ":2:");
  check_fault(file, "1\n2x\n", ":2: '2x'");
  check_fault(file, "1 2\n", ":1: more than one number");
  check_fault(file, "1\n2\n3\n", ":3: more than 2 numbers");
  check_fault(file, "1\n", "1 numbers where 2 are wanted");
  check_fault(file, "# nothing\n", "0 numbers");
  CHECK_THROWS_AS(io::read_positive_values(folder / "missing", 2), geom::InputError);
}

TEST_CASE("coloured_ply: the mesh can be read back") {
  const ScratchFolder folder;
  const geom::TriMesh mesh = fixtures::blob(3);
  std::vector<double> values;
  for (std::size_t i = 0; i < mesh.num_vertices(); ++i) values.push_back(0.5 + static_cast<double>(i));
  io::write_coloured_ply(folder / "c.ply", mesh, values);
  const geom::TriMesh back = io::read_mesh(folder / "c.ply");
  CHECK(back.vertices() == mesh.vertices());
  CHECK(back.facets() == mesh.facets());
}
