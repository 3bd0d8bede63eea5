// The built fpo-remesh: features, fixed points, maps, strictness.

#include <sstream>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

using fixtures::ProgramResult;
using fixtures::ScratchFolder;

namespace {

struct RemeshFeaturesPlace {
  RemeshFeaturesPlace() {
    for (const char* name : {"cube", "thin-plate", "shaft"})
      io::write_mesh(folder / (std::string(name) + ".obj"), geom::make_shape(name));
  }
  ProgramResult run(std::vector<std::string> arguments) const {
    for (const char* more : {"--iterations", "4", "-o", "out.obj"}) arguments.push_back(more);
    return fixtures::run_program("fpo-remesh", arguments, folder.path());
  }
  void refused(const std::vector<std::string>& arguments, const std::string& reason) const {
    const ProgramResult result = run(arguments);
    CHECK(result.code == 2);
    CHECK(result.lines_on_stderr() == 1);
    CHECK_MESSAGE(result.err.find(reason) != std::string::npos, result.err);
    CHECK(!std::filesystem::exists(folder / "out.obj"));
  }
  ScratchFolder folder;
};

}  // namespace

TEST_CASE("fpo-remesh: too few samples for the features and bad values are refused in one line") {
  const RemeshFeaturesPlace place;
  place.folder.write("bad.xyz", "0 0 zero\n");
  place.folder.write("off.xyz", "0 0 0\n.5 .5 .5\n");
  place.refused({"cube.obj", "-n", "7", "--features", "45"},
                "7 samples are too few: the features need at least 8");
  place.refused({"cube.obj", "-n", "50", "--features", "some"}, "--features: 'some'");
  place.refused({"cube.obj", "-n", "50", "--features", "181"}, "--features: 181");
  place.refused({"cube.obj", "-n", "50", "--fixed", "none.xyz"}, "none.xyz: no such file");
  place.refused({"cube.obj", "-n", "50", "--fixed", "bad.xyz"}, "bad.xyz:1:");
  place.refused({"cube.obj", "-n", "50", "--rpd", "./out.obj"}, "named for two outputs");
  place.refused({"cube.obj", "-n", "50", "--fixed", "off.xyz"},
                "off.xyz: point 2 does not lie on the surface");
}

TEST_CASE("fpo-remesh: fixed points are kept bit for bit, the map gives back every position") {
  const RemeshFeaturesPlace place;
  place.folder.write("fixed.xyz", ".1 .7 0\n.3 0 0\n");
  const ProgramResult result =
      place.run({"cube.obj", "-n", "90", "--fixed", "fixed.xyz", "--map", "map.txt"});
  REQUIRE_MESSAGE(result.code == 0, result.err);
  CHECK(result.out.find("broken_feature_edges 0\n") != std::string::npos);
  const geom::TriMesh cube = io::read_mesh(place.folder / "cube.obj"),
                      mesh = io::read_mesh(place.folder / "out.obj");
  CHECK(mesh.num_vertices() == 90);
  CHECK(mesh.position(geom::VertexId(0)) == geom::Vec3(.1, .7, 0));
  CHECK(mesh.position(geom::VertexId(1)) == geom::Vec3(.3, 0, 0));
  std::istringstream map(ScratchFolder::read(place.folder / "map.txt"));
  std::string heading;
  std::getline(map, heading);
  for (const geom::Vec3& x : mesh.vertices()) {
    std::array<std::size_t, 3> vertices{};
    geom::Vec3 u;
    map >> vertices[0] >> vertices[1] >> vertices[2] >> u.x() >> u.y() >> u.z();
    geom::Vec3 y(0, 0, 0);
    for (int i = 0; i < 3; ++i) {
      const std::size_t v = vertices[static_cast<std::size_t>(i)];
      REQUIRE((map && v >= 1 && v <= cube.num_vertices()));
      y += u[i] * cube.position(geom::VertexId(v - 1));
    }
    CHECK((x - y).norm() < 1e-12);
  }
}

TEST_CASE("fpo-remesh: small angles beside close curves are told with a number of samples that has room") {
  const RemeshFeaturesPlace place;
  io::write_mesh(place.folder / "gear.obj", geom::make_shape("gear"));
  const std::string key = "\nsamples_for_features ", words = " on that does not matter\n";
  const ProgramResult few = place.run({"gear.obj", "-n", "400"});
  REQUIRE_MESSAGE(few.code == 0, few.err);
  REQUIRE(few.out.find(key) != std::string::npos);
  const std::size_t at = few.out.find(key) + key.size();
  const std::string bound = few.out.substr(at, few.out.find('\n', at) - at);
  const std::string line = "; some curves are close to each other, from about -n " + bound + words;
  CHECK_MESSAGE(few.err.find(line) != std::string::npos, few.err);
  const ProgramResult enough = place.run({"gear.obj", "-n", bound});
  CHECK_MESSAGE(enough.err.find(words) == std::string::npos, enough.err);
  io::write_mesh(place.folder / "wedge.obj", geom::make_shape("wedge"));  // its own corners are small
  const ProgramResult corners = place.run({"wedge.obj", "-n", "300"});
  CHECK_MESSAGE(corners.err.find(" below 30 degrees") != std::string::npos, corners.err);
  CHECK_MESSAGE(corners.err.find(words) == std::string::npos, corners.err);
}

TEST_CASE("fpo-remesh: another topology is a warning, with --strict exit code 3; the mesh is written") {
  const RemeshFeaturesPlace place;
  const std::vector<std::string> crude{"thin-plate.obj", "-n",        "300",      "--features",
                                       "none",           "--no-mend", "--sheets", "together"};
  const ProgramResult lenient = place.run(crude);
  REQUIRE(lenient.err.find("warning: ") != std::string::npos);
  CHECK(lenient.code == 0);
  std::filesystem::remove(place.folder / "out.obj");
  std::vector<std::string> strict = crude;
  strict.push_back("--strict");
  CHECK(place.run(strict).code == 3);
  CHECK(std::filesystem::exists(place.folder / "out.obj"));
  const ProgramResult good = place.run({"cube.obj", "-n", "60", "--strict"});
  CHECK(good.code == 0);
  CHECK(good.err == "");
}

TEST_CASE("fpo-remesh: lengths that are not even although they were to be are told") {
  const RemeshFeaturesPlace place;
  CHECK(place.run({"shaft.obj", "-n", "600"}).out.find("wanted_length_ratio 0.") != std::string::npos);
  CHECK(place.run({"shaft.obj", "-n", "600", "--features", "none"}).out.find("wanted_length") ==
        std::string::npos);
  CHECK(place.run({"cube.obj", "-n", "100"}).out.find("wanted_length") == std::string::npos);
}
