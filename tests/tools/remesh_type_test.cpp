// fpo-remesh where the remesh is of another topological type than the input, or would be.

#include "doctest.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/pinched.h"
#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

using fixtures::ProgramResult;
using fixtures::ScratchFolder;

namespace {

struct RemeshTypePlace {
  RemeshTypePlace() {
    io::write_mesh(folder / "handle.obj", geom::make_shape("thin-handle", 36));
    io::write_mesh(folder / "torus.obj", geom::make_shape("torus", 24));
    io::write_mesh(folder / "pinched.obj", fixtures::pinched_sphere());
    io::write_mesh(folder / "both.obj",
                   geom::joined(fixtures::pinched_sphere(), geom::make_shape("thin-handle", 36)));
  }
  ProgramResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"-o", "out.obj", "--iterations", "5", "--features", "none"});
    return fixtures::run_program("fpo-remesh", arguments, folder.path());
  }
  ScratchFolder folder;
};

bool says(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

}  // namespace

TEST_CASE(
    "fpo-remesh: another topological type is said with places and what to do, --strict makes it code 3") {
  const RemeshTypePlace place;
  const ProgramResult lost =
      place.run({"handle.obj", "-n", "120", "--no-mend", "--report", "report.html", "--strict"});
  CHECK(lost.code == 3);
  CHECK(says(lost.err, "warning: "));
  CHECK_MESSAGE(says(lost.err, "at fault, the first at ("), lost.err);
  CHECK(says(lost.err, "try -n "));
  CHECK(says(lost.err, "--at-least"));
  const std::string page = ScratchFolder::read(place.folder / "report.html");
  CHECK(says(page, "class=\"banner\""));
  CHECK(says(page, "at fault, the first at ("));
  CHECK(says(page, "Dots: where it is of another topological type"));

  const ProgramResult sound = place.run({"torus.obj", "-n", "120", "--report", "report.html", "--strict"});
  CHECK(sound.code == 0);
  CHECK_MESSAGE(sound.err.find("warning") == std::string::npos, sound.err);
  CHECK(!says(ScratchFolder::read(place.folder / "report.html"), "class=\"banner\""));
}

TEST_CASE(
    "fpo-remesh: vertices in which the input meets itself are split, and a line says what that changes") {
  const RemeshTypePlace place;
  const ProgramResult split = place.run({"pinched.obj", "-n", "400", "--strict"});
  CHECK_MESSAGE(split.code == 0, split.err);
  CHECK_MESSAGE(says(split.err, "warning: Euler number 1 -> 2, as 1 vertex was split\n"), split.err);
  const geom::Topology topology = geom::topology(io::read_mesh(place.folder / "out.obj"));
  CHECK(topology.manifold());
  CHECK(topology.euler == 2);
  CHECK(topology.components == 1);

  const ProgramResult wrong = place.run({"both.obj", "-n", "240", "--no-mend", "--strict"});
  CHECK(wrong.code == 3);
  CHECK_MESSAGE(says(wrong.err, "; the input, with 1 non-manifold vertex split, has 2, 2, 0\n"), wrong.err);
}

TEST_CASE("fpo-remesh: a tip that is cut off is said with its place and what keeps it, and that does") {
  const RemeshTypePlace place;
  io::write_mesh(place.folder / "cone.obj", geom::make_shape("cone", 48));  // its tip is at (0, 0, 2)
  const ProgramResult cut = place.run({"cone.obj", "-n", "200", "--report", "report.html"});
  const std::string line = "wanted lengths, at (0, 0, 2), as if cut off; try more samples";
  CHECK_MESSAGE(says(cut.err, line), cut.err);
  CHECK(says(cut.err, ", or --corners all, or --sizing lfs\n"));
  CHECK(says(ScratchFolder::read(place.folder / "report.html"), line));
  const ProgramResult kept = place.run({"cone.obj", "-n", "200", "--corners", "all"});
  CHECK_MESSAGE(!says(kept.err, "cut off"), kept.err);
}

TEST_CASE("fpo-remesh: --at-least takes more samples until the type is right, and says how many") {
  const RemeshTypePlace place;
  const ProgramResult more = place.run({"torus.obj", "-n", "6", "--at-least", "--strict"});
  CHECK(more.code == 0);
  CHECK_MESSAGE(says(more.out, "not_enough_samples "), more.out);
  const geom::TriMesh mesh = io::read_mesh(place.folder / "out.obj");
  CHECK(mesh.num_vertices() > 6);
  CHECK(geom::topology(mesh).euler == 0);
  CHECK(geom::topology(mesh).manifold());
  const ProgramResult enough = place.run({"torus.obj", "-n", "120", "--at-least"});
  CHECK(!says(enough.out, "not_enough_samples "));
  CHECK(io::read_mesh(place.folder / "out.obj").num_vertices() == 120);
}

TEST_CASE("fpo-remesh: delta is that of the mesh in the file") {
  const RemeshTypePlace place;
  const ProgramResult result = place.run({"torus.obj", "-n", "120"});
  const ProgramResult measured =
      fixtures::run_program("fpo-quality", {"out.obj", "--reference", "torus.obj"}, place.folder.path());
  const auto number = [](const std::string& text, const std::string& name) {
    const std::size_t at = ("\n" + text).find("\n" + name + " ");
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + name.size() + 1));
  };
  CHECK(number(result.out, "delta") == doctest::Approx(number(measured.out, "delta")).epsilon(1e-5));
  CHECK(number(measured.out, "edge_min") == number(measured.out, "delta"));
  CHECK(number(measured.out, "edge_avg") > number(measured.out, "delta_avg"));
}
