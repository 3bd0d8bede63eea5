// What a user can get wrong before the content matters, and files damaged at random.

#include "doctest.h"
#include "io/mesh_io.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/stl.h"
#include "tests/fuzz/mutator.h"
#include "tests/io/binary_off_samples.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/scratch_folder.h"

using fixtures::complaint;
using fixtures::ScratchFolder;

namespace {

const char* const text_ply =
    "ply\nformat ascii 1.0\ncomment x\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "property list uchar int tags\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 0\n1 0 0 1 7\n1 1 0 0\n0 1 0 0\n4 0 1 2 3\n3 0 2 3\n";
const char* const text_stl =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid "
    "a\n";
const char* const text_obj =
    "# square\nv 0 0 0\nv 1 0 0\nv 1 1 \\\n0\nv 0 1 -1.5e-1\nvn 0 0 1\nf 1/1/1 2//1 3/1 4\nf -1 -2 -4\n";
const char* const text_off =
    "COFF\n# square\n4 2 0\n0 0 0 1 1 1\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 2 1 255 0 0\n";

}  // namespace

TEST_CASE("bad input: no file, a folder, an empty file, no or an unknown extension") {
  const ScratchFolder folder;
  const auto fault = [](const std::filesystem::path& path) {
    const std::string message = complaint([&] { io::read_mesh(path); });
    REQUIRE(message.starts_with(path.string() + ": "));
    return message.substr(path.string().size() + 2);
  };
  CHECK(fault(folder / "none.obj") == "no such file");
  CHECK(fault(folder / "none/none.obj") == "no such file");
  std::filesystem::create_directory(folder / "d.obj");
  CHECK(fault(folder / "d.obj") == "is a directory");
  for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl"})
    CHECK(fault(folder.write(name, "")) == "the file is empty");
  CHECK(fault(folder.write("a.gltf", "v 0 0 0")) ==
        "unknown extension '.gltf' (meshes are .obj, .off, .ply or .stl)");
  CHECK(fault(folder.write("plain", "v 0 0 0")) == "no extension (meshes are .obj, .off, .ply or .stl)");
  CHECK(complaint([] { io::read_mesh("two\nlines.obj"); }) == "two?lines.obj: no such file");
}

TEST_CASE("bad input: a damaged file is read or refused with one line that names it, nothing else") {
  const ScratchFolder folder;
  const auto tetrahedron = fixtures::tetrahedron();
  struct Sample {
    std::string name, bytes;
  };
  const Sample samples[] = {{"t.obj", text_obj},
                            {"t.off", text_off},
                            {"t.ply", text_ply},
                            {"t.stl", text_stl},
                            {"b.off", fixtures::binary_off(tetrahedron, {std::endian::big, true})},
                            {"c.off", fixtures::binary_off(tetrahedron, {std::endian::little, false})},
                            {"b.ply", io::to_ply(tetrahedron)},
                            {"b.stl", io::to_stl(tetrahedron)}};
  geom::Rng rng(2014);
  for (const Sample& sample : samples) {
    const std::string &name = sample.name, &bytes = sample.bytes;
    CAPTURE(name);
    REQUIRE(complaint([&] { io::read_mesh(folder.write(name, bytes)); }) == "");
    int refused = 0;
    constexpr int mutants = 600;
    for (int i = 0; i < mutants; ++i) {
      const std::string mutant = fuzz::damaged(bytes, rng);
      const auto path = folder.write(name, mutant);
      CAPTURE(mutant);
      std::size_t num_facets = 0;
      const std::string message = complaint([&] { num_facets = io::read_mesh(path).num_facets(); });
      CHECK((num_facets > 0) == message.empty());
      if (message.empty()) continue;
      ++refused;
      CHECK(message.starts_with(path.string() + ":"));
      CHECK(message.find('\n') == message.npos);
    }
    CHECK(refused > mutants / 10);
    CHECK(refused < mutants);
  }
}
