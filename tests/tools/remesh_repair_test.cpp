// The built fpo-remesh and fpo-quality on files as exporters and scanners write them.

#include <sstream>

#include "doctest.h"
#include "geom/mesh/centring.h"
#include "geom/mesh/scaling.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/needles.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/spoilt.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/scratch_folder.h"

using fixtures::ProgramResult;
using fixtures::ScratchFolder;
using geom::TriMesh;

namespace {

struct RemeshRepairPlace {
  RemeshRepairPlace() : torus(geom::make_shape("torus", 24)) { io::write_mesh(folder / "torus.ply", torus); }

  ProgramResult remesh(const std::string& input, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{input, "-n", "200", "--iterations", "10", "-o", "out.obj"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return fixtures::run_program("fpo-remesh", arguments, folder.path());
  }
  std::string output() const { return ScratchFolder::read(folder / "out.obj"); }
  void write(const std::string& name, const TriMesh& mesh) const { io::write_mesh(folder / name, mesh); }

  ScratchFolder folder;
  TriMesh torus;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

}  // namespace

TEST_CASE(
    "fpo-remesh: a soup of triangles is remeshed like the surface it was, in every format, and says so") {
  const RemeshRepairPlace place;
  REQUIRE(place.remesh("torus.ply").err == "");
  const std::string sound = place.output();
  geom::Rng rng(1);
  const TriMesh soup = fixtures::split_vertices(place.torus, 0, rng);
  for (const std::string name : {"soup.ply", "soup.obj", "soup.off"}) {
    CAPTURE(name);
    place.write(name, soup);
    const ProgramResult result = place.remesh(name);
    CHECK(result.code == 0);
    CHECK(result.lines_on_stderr() == 1);
    CHECK(result.err.starts_with("repaired: " + name + ": welded "));
    const geom::Topology t = geom::topology(io::read_mesh(place.folder / "out.obj"));
    CHECK(t.vertices == 200);
    CHECK(t.euler == 0);
    CHECK(t.components == 1);
    CHECK(t.boundary_edges == 0);
    const ProgramResult raw = place.remesh(name, {"--no-repair"});
    CHECK(raw.code == 2);
    CHECK(raw.lines_on_stderr() == 1);
    CHECK(contains(raw.err, "too small for four of 200 samples each"));
    CHECK(contains(raw.err, "facets without a neighbour"));
    CHECK(contains(raw.err, "(--repair mends it)"));
  }
}

TEST_CASE("fpo-remesh: a surface thinner than the spacing is refused, for little of it would be left") {
  const RemeshRepairPlace place;
  place.write("thread.ply", fixtures::stretched_sphere(12, 50, 1000));
  const ProgramResult result = place.remesh("thread.ply", {"--features", "none"});
  CHECK(result.code == 2);
  CHECK(result.lines_on_stderr() == 1);
  CHECK(contains(result.err, "thinner than the spacing of 200 samples"));
  CHECK(!std::filesystem::exists(place.folder / "out.obj"));
}

TEST_CASE("fpo-remesh: what is refused after the work is refused in one line") {
  const RemeshRepairPlace place;
  place.folder.write("fan.obj",  // needles at a corner of a cube
                     "v 0 0 0\nv .39 .28 -.15\nv 169.8 .5 .045\nv .78 .55 -.29\nv .38 .77 -.1\n"
                     "f 1 2 3\nf 1 4 5\nf 2 4 3\nf 2 5 3\n");
  const ProgramResult result = place.remesh("fan.obj", {"--iterations", "1"});
  CHECK(result.code == 2);
  CHECK(result.lines_on_stderr() == 1);
  CHECK(contains(result.err, "thinner than the spacing of 200 samples"));
  CHECK(contains(result.err, "(--repair mends it)"));

  place.write("small.ply", geom::scaled(fixtures::spoilt(place.torus, 2), 0x1p-200));
  const ProgramResult small = fixtures::run_program(
      "fpo-remesh", {"small.ply", "-n", "50", "--iterations", "1", "-o", "out.stl"}, place.folder.path());
  CHECK(small.code == 2);
  CHECK(small.lines_on_stderr() == 1);
  CHECK(contains(small.err, "too small for STL's single precision"));
}

TEST_CASE("fpo-trace, fpo-spectrum: read files as fpo-remesh does") {
  const RemeshRepairPlace place;
  geom::Rng rng(1);
  place.write("soup.ply", fixtures::split_vertices(place.torus, 0, rng));
  const auto trace = [&](const std::string& input, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{input, "-n", "100", "--move", "120", "-o", "drawings"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return fixtures::run_program("fpo-trace", arguments, place.folder.path());
  };
  const ProgramResult sound = trace("torus.ply"), cleaned = trace("soup.ply");
  CHECK(sound.err == "");
  CHECK(cleaned.err.starts_with("repaired: soup.ply: welded "));
  CHECK(cleaned.code == 0);
  CHECK(trace("soup.ply", {"--no-repair"}).err.starts_with("warning: "));
  REQUIRE(place.remesh("torus.ply", {"--points", "out.xyz"}).code == 0);
  const auto spectrum = [&](const std::string& surface) {
    return fixtures::run_program(
        "fpo-spectrum", {"out.xyz", "--surface", surface, "--radius", "4", "-o", "s"}, place.folder.path());
  };
  const ProgramResult a = spectrum("torus.ply"), b = spectrum("soup.ply");
  CHECK(a.code == 0);
  CHECK(b.code == 0);
  CHECK(b.err.starts_with("repaired: soup.ply: welded "));
  CHECK(b.out == a.out);
}

TEST_CASE("fpo-remesh: a facet that names a vertex twice is dropped, with --no-repair refused") {
  const RemeshRepairPlace place;
  place.write("torus.obj", place.torus);
  const std::string bytes = ScratchFolder::read(place.folder / "torus.obj");
  REQUIRE(place.remesh("torus.obj").code == 0);
  const std::string sound = place.output();
  place.folder.write("twice.obj", bytes + "f 1 2 2\nf 3 3 3 3\n");
  const ProgramResult result = place.remesh("twice.obj");
  CHECK(result.code == 0);
  CHECK(contains(result.err, "dropped 2 facets that name a vertex twice"));
  CHECK(place.output() == sound);
  const ProgramResult raw = place.remesh("twice.obj", {"--no-repair"});
  CHECK(raw.code == 2);
  CHECK(contains(raw.err, "a facet names vertex 2 twice"));
  place.folder.write("none.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\n");
  CHECK(place.remesh("none.obj").err == "fpo-remesh: none.obj: no facet has three different vertices\n");
}

TEST_CASE(
    "fpo-remesh --repair: surfaces spoilt in ten ways give closed remeshes of their type, --strict agrees") {
  const RemeshRepairPlace place;
  for (std::size_t way = 0; way < fixtures::ways_to_spoil.size(); ++way) {
    const std::string name = fixtures::ways_to_spoil[way];
    CAPTURE(name);
    place.write("bad.ply", fixtures::spoilt(place.torus, way));
    const ProgramResult result =
        place.remesh("bad.ply", {"--repair", "--strict", "--repaired", "mended.ply"});
    CHECK(result.code == 0);
    CHECK(!contains(result.err, "warning"));
    for (const char* file : {"out.obj", "mended.ply"}) {
      const geom::Topology t = geom::topology(io::read_mesh(place.folder / file));
      CHECK(t.manifold());
      CHECK(t.euler == 0);
      CHECK(t.components == 1);
      CHECK(t.boundary_edges == 0);
      CHECK(t.misoriented_edges == 0);
    }
    const std::string once = place.output();
    place.remesh("bad.ply", {"--repair"});
    CHECK(place.output() == once);
  }
}

TEST_CASE("fpo-remesh: without --repair a warning names the fault and the option") {
  const RemeshRepairPlace place;
  const std::pair<std::size_t, const char*> faults[] = {
      {2, "hole"}, {3, "inverted facet"},    {5, "non-manifold edge"},
      {6, "hole"}, {7, "non-manifold vert"}, {8, "part that lies on another"}};
  for (const auto& kind : faults) {
    const auto& [way, fault] = kind;
    CAPTURE(fixtures::ways_to_spoil[kind.first]);
    place.write("bad.ply", fixtures::spoilt(place.torus, way));
    const ProgramResult result = place.remesh("bad.ply");
    CHECK(contains(result.err, fault));
    CHECK(contains(result.err, "(--repair mends it)"));
  }
}

TEST_CASE("fpo-remesh: single steps, with and without a value; contradictions are refused") {
  const RemeshRepairPlace place;
  place.write("holes.ply", fixtures::spoilt(place.torus, 2));
  CHECK(contains(place.remesh("holes.ply", {"--fill-holes"}).err, "filled"));
  CHECK(contains(place.remesh("holes.ply", {"--fill-holes=1e-9"}).err, "left"));
  place.write("flips.ply", fixtures::spoilt(place.torus, 3));
  CHECK(contains(place.remesh("flips.ply", {"--orient"}).err, "turned"));
  place.write("jittered.ply", fixtures::spoilt(place.torus, 1));
  CHECK(contains(place.remesh("jittered.ply", {"--weld"}).err, "welded"));
  CHECK(place.remesh("jittered.ply", {"--weld=1e-5"}).code == 0);
  CHECK(contains(place.remesh("torus.ply", {"--weld=much"}).err, "--weld: 'much' is not a number"));
  CHECK(contains(place.remesh("torus.ply", {"--no-repair", "--orient"}).err, "--no-repair excludes"));
  CHECK(contains(place.remesh("torus.ply", {"--repaired", "out.xyz"}).err, "unknown extension"));
  CHECK(place.remesh("torus.ply", {"--repair"}).err == "");
}

TEST_CASE("fpo-remesh: a body a million diagonals away is remeshed like one at the origin, as fast") {
  const RemeshRepairPlace place;
  const geom::Vec3 far(0x1p22, -0x1p21, 0);
  const auto there = [&](const TriMesh& mesh, const geom::Vec3& by) { return geom::moved_by(mesh, by); };
  const TriMesh coarse = geom::mapped(place.torus, [](const geom::Vec3& p) {  // so that moving it is exact
    return geom::Vec3((p * 0x1p20).array().round() * 0x1p-20);
  });
  place.write("near.ply", coarse);
  place.write("far.ply", there(coarse, far));
  REQUIRE(place.remesh("near.ply").code == 0);
  const TriMesh near = io::read_mesh(place.folder / "out.obj");
  REQUIRE(place.remesh("far.ply").code == 0);
  const TriMesh moved = io::read_mesh(place.folder / "out.obj");
  CHECK(geom::topology(moved).euler == 0);
  CHECK(moved.num_facets() == near.num_facets());
  CHECK(moved.area() == doctest::Approx(near.area()).epsilon(0.01));
}

TEST_CASE("fpo-quality: says what is wrong with a file") {
  const RemeshRepairPlace place;
  const auto value = [&](const std::string& file, const std::string& key) {
    std::istringstream lines(fixtures::run_program("fpo-quality", {file}, place.folder.path()).out);
    std::string name;
    double number = -1;
    while (lines >> name >> number)
      if (name == key) return number;
    return -1.0;
  };
  place.write("holes.ply", fixtures::spoilt(place.torus, 2));
  CHECK(value("holes.ply", "holes") > 0);
  CHECK(value("holes.ply", "border_loops") >= value("holes.ply", "holes"));
  CHECK(value("holes.ply", "longest_border") > 0);
  place.write("soup.ply", fixtures::spoilt(place.torus, 0));
  CHECK(value("soup.ply", "split_vertices") > 0);
  CHECK(value("soup.ply", "stray_facets") == double(place.torus.num_facets()));
  place.write("fins.ply", fixtures::spoilt(place.torus, 5));
  CHECK(value("fins.ply", "nonmanifold_edges") > 0);
  CHECK(value("torus.ply", "self_intersections") == 0);
  CHECK(value("torus.ply", "inverted_facets") == 0);
}
