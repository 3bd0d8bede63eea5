// Round trips and the extension.

#include "io/mesh_io.h"

#include <chrono>

#include "doctest.h"
#include "tests/fixtures/models.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/scratch_folder.h"

using fixtures::complaint;
using fixtures::ScratchFolder;

TEST_CASE("mesh_io: OBJ, OFF and PLY give back the same mesh, bit for bit") {
  const ScratchFolder folder;
  for (const std::string name : {"a.obj", "a.off", "a.ply"}) {
    CAPTURE(name);
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const geom::TriMesh mesh = fixtures::random_soup(seed, false);
      io::write_mesh(folder / name, mesh);
      const geom::TriMesh read = io::read_mesh(folder / name);
      CHECK(fixtures::identical(read, mesh));
      io::write_mesh(folder / ("again-" + name), read);
      CHECK(ScratchFolder::read(folder / name) == ScratchFolder::read(folder / ("again-" + name)));
    }
  }
}

TEST_CASE("mesh_io: the sign of zero and denormal numbers survive OBJ, OFF and PLY") {
  const ScratchFolder folder;
  const auto mesh = fixtures::make_mesh(
      {{-0.0, 5e-324, 1e48}, {1, -2.2250738585072014e-308, 0}, {0.1, 1. / 3, -1e48}}, {{0, 1, 2}});
  for (const std::string name : {"a.obj", "a.off", "a.ply"}) {
    io::write_mesh(folder / name, mesh);
    const geom::TriMesh read = io::read_mesh(folder / name);
    CHECK(fixtures::identical(read, mesh));
    CHECK(std::signbit(read.position(geom::VertexId(0)).x()));
  }
}

TEST_CASE("mesh_io: STL gives back the facets of a single-precision mesh") {
  const ScratchFolder folder;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const geom::TriMesh mesh = fixtures::random_soup(seed, true);
    io::write_mesh(folder / "a.stl", mesh);
    const geom::TriMesh read = io::read_mesh(folder / "a.stl");
    CHECK(fixtures::same_soup(read, mesh));
    CHECK(read.num_vertices() == mesh.num_vertices());
  }
  const geom::TriMesh doubles = fixtures::random_soup(9, false);
  io::write_mesh(folder / "b.stl", doubles);
  const geom::TriMesh read = io::read_mesh(folder / "b.stl");
  REQUIRE(read.num_facets() == doubles.num_facets());
  for (std::size_t t = 0; t < read.num_facets(); ++t)
    for (int k = 0; k < 3; ++k)
      CHECK(read.corner(geom::FacetId(t), k) ==
            doubles.corner(geom::FacetId(t), k).cast<float>().cast<double>());
}

TEST_CASE("mesh_io: the extension decides in any case of letters, and the content must agree") {
  const ScratchFolder folder;
  const geom::TriMesh mesh = fixtures::tetrahedron();
  for (const std::string name : {"A.OBJ", "A.Off", "A.PLY", "a.b.StL"}) {
    io::write_mesh(folder / name, mesh);
    CHECK(io::read_mesh(folder / name).num_facets() == 4);
  }
  const char* const extensions[] = {"obj", "off", "ply", "stl"};
  for (const std::string written : extensions)
    for (const std::string claimed : extensions) {
      if (written == claimed) continue;
      io::write_mesh(folder / ("true." + written), mesh);
      const auto path = folder.write("false." + claimed, ScratchFolder::read(folder / ("true." + written)));
      const std::string message = complaint([&] { io::read_mesh(path); });
      CAPTURE(message);
      CHECK(message.starts_with(path.string() + ":1: the extension says "));
    }
  CHECK(complaint([&] { io::write_mesh(folder / "a.xyz", mesh); }) ==
        (folder / "a.xyz").string() + ": unknown extension '.xyz' (meshes are .obj, .off, .ply or .stl)");
  CHECK(complaint([&] { io::mesh_format("plain"); }).starts_with("plain: no extension"));
}

TEST_CASE("mesh_io: the paper's models survive all formats") {
  const ScratchFolder folder;
  for (const std::string name : {"eight.obj", "joint.obj", "mask.obj", "bunny.obj"}) {
    const auto path = fixtures::model(name);
    if (!path) return;
    const auto start = std::chrono::steady_clock::now();
    const geom::TriMesh mesh = io::read_mesh(*path);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    MESSAGE(name, ": ", mesh.num_facets(), " facets read in ", time.count(), " ms");
    for (const std::string copy : {"copy.obj", "copy.off", "copy.ply"}) {
      io::write_mesh(folder / copy, mesh);
      CHECK(fixtures::identical(io::read_mesh(folder / copy), mesh));
    }
    io::write_mesh(folder / "copy.stl", mesh);
    CHECK(io::read_mesh(folder / "copy.stl").num_facets() == mesh.num_facets());
  }
}
