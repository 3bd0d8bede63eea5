// The built fpo-remesh with --method: what differs from farthest point optimization for its users.

#include <csignal>
#include <set>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

using fixtures::ProgramResult;
using fixtures::ScratchFolder;

namespace {

/// A folder with a torus in it, and the program run there.
struct RemeshMethodsPlace {
  RemeshMethodsPlace() { io::write_mesh(folder / "torus.obj", geom::make_shape("torus")); }
  ProgramResult run(const std::vector<std::string>& extra,
                    const fixtures::Interruption& interruption = {}) const {
    std::vector<std::string> arguments{"torus.obj", "-o", "out.ply", "--log", "log.csv"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return fixtures::run_program("fpo-remesh", arguments, folder.path(), 60, {.interruption = interruption});
  }
  ScratchFolder folder;
};

}  // namespace

TEST_CASE("fpo-remesh --method: the same bytes with any number of threads; no method gives another's") {
  const RemeshMethodsPlace place;
  std::set<std::string> meshes;
  for (const std::string method : {"fpo", "cvt", "mps", "cps", "pps", "hps", "ccst", "vbs"}) {
    const auto mesh_with = [&](const std::string& threads) {
      const ProgramResult result =
          place.run({"-n", "150", "--method", method, "--threads", threads, "--iterations", "8"});
      CHECK(result.code == 0);
      CHECK((result.err.empty() || result.err.starts_with("warning: ")));
      CHECK((result.out.find("bad_triangles") != std::string::npos) == (method == "fpo"));
      CHECK((result.out.find("disk_radius_over_h 0.") != std::string::npos) == method.ends_with("ps"));
      return ScratchFolder::read(place.folder / "out.ply");
    };
    const std::string mesh = mesh_with("1");
    CHECK(mesh == mesh_with("3"));
    CHECK(meshes.insert(mesh).second);
    const std::string log = ScratchFolder::read(place.folder / "log.csv");
    CHECK(std::ranges::count(log, '\n') >= 2);
  }
}

TEST_CASE("fpo-remesh --method: angle optimization on request; options of fpo alone are refused") {
  const RemeshMethodsPlace place;
  const ProgramResult result = place.run({"-n", "150", "--method=cps", "--optimize-angles"});
  CHECK(result.code == 0);
  CHECK(result.out.find("bad_triangles_after 0\n") != std::string::npos);
  for (const std::string option : {"--ser", "--local", "--global", "--rest"}) {
    const ProgramResult refused = place.run({"-n", "150", "--method=cvt", option});
    CHECK(refused.code == 2);
    CHECK(refused.err == "fpo-remesh: --ser, --local, --global and --rest work with --method fpo only\n");
  }
  CHECK(place.run({"-n", "150", "--method=lattice"}).code == 2);
  CHECK(place.run({"-n", "1", "--method=mps"}).code == 2);
}

TEST_CASE("fpo-remesh --maximal: fpo-quality finds no room for another sample; threads do not matter") {
  const RemeshMethodsPlace place;
  std::set<std::string> meshes;
  for (const std::string threads : {"1", "3"}) {
    const ProgramResult result = place.run(
        {"-n", "400", "--sizing", "curvature", "--method", "ccst", "--maximal", "--threads", threads});
    CHECK(result.code == 0);
    CHECK(result.out.find("\nmaximal 1\n") != std::string::npos);
    CHECK(result.out.find("\nmaximal_moves 0\n") == std::string::npos);
    meshes.insert(ScratchFolder::read(place.folder / "out.ply"));
  }
  CHECK(meshes.size() == 1);
  const ProgramResult quality =
      fixtures::run_program("fpo-quality", {"out.ply", "--reference", "torus.obj"}, place.folder.path());
  const std::string name = "covering_local ";
  const std::size_t at = quality.out.find(name);
  REQUIRE(at != std::string::npos);
  CHECK(std::stod(quality.out.substr(at + name.size())) <= 1 + 1e-6);
}

TEST_CASE("fpo-remesh --method: interrupted, each writes a mesh, or says that there is none yet") {
  const RemeshMethodsPlace place;
  for (const std::string method : {"cvt", "mps", "cps", "pps", "hps", "ccst", "vbs"}) {
    CAPTURE(method);
    const ProgramResult result =
        place.run({"-n", "8000", "--method", method, "--iterations", "100000"}, {SIGINT, 0.5});
    const bool disks = method.ends_with("ps");
    if (result.code == 0 && disks) continue;  // the number came out at once
    CHECK(result.code == 130);
    if (disks && result.err.find("before there was a result") != std::string::npos) continue;
    if (!disks)  // these may have been drawn by then: what follows is interrupted
      CHECK(result.out.find("stopped interrupted") != std::string::npos);
    CHECK(io::read_mesh(place.folder / "out.ply").num_facets() > 0);
  }
}
