// Point sets on their way from tool to tool: triangulations of the plane, spectra that know sizes.

#include <cmath>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

using fixtures::ProgramResult;
using fixtures::ScratchFolder;

TEST_CASE("fpo-plane: its triangulation covers one period, each triangle once") {
  const ScratchFolder folder;
  for (const std::string sizing : {"uniform", "spot5"})
    for (const std::string out : {"out.off", "out.obj"}) {
      const ProgramResult result = fixtures::run_program(
          "fpo-plane", {"-n", "200", "--period", "2x1", "--sizing", sizing, "-o", out}, folder.path());
      REQUIRE(result.code == 0);
      const geom::TriMesh mesh = io::read_mesh(folder / out);
      CHECK(mesh.num_facets() == 400);  // of a torus
      double area = 0;
      for (geom::FacetId t(0); t.index() < mesh.num_facets(); t = geom::FacetId(t.value + 1)) {
        CHECK(mesh.normal(t).z() > 0);
        area += mesh.area(t);
      }
      CHECK(area == doctest::Approx(2));
      CHECK(geom::topology(mesh).nonmanifold_edges == 0);
    }
  const ProgramResult bounded =
      fixtures::run_program("fpo-plane", {"-n", "200", "--bounded", "-o", "box.off"}, folder.path());
  REQUIRE(bounded.code == 0);
  const double area = io::read_mesh(folder / "box.off").area();  // corners of the box are no samples
  CHECK(area <= 1 + 1e-9);
  CHECK(area > 0.9);
}

TEST_CASE("fpo-spectrum: adaptive sets without sizes and surfaces of others are warned of, no others") {
  const ScratchFolder folder;
  const geom::TriMesh torus = geom::make_shape("torus");
  io::write_mesh(folder / "torus.obj", torus);
  io::write_mesh(folder / "sphere.obj", geom::make_shape("sphere"));
  std::string sizes;
  for (const geom::Vec3& x : torus.vertices()) sizes += std::to_string(x.x() > 0 ? 1.0 : 0.2) + "\n";
  folder.write("sizes.txt", sizes);
  const auto remesh = [&](std::vector<std::string> extra) {
    extra.insert(extra.begin(), {"torus.obj", "-n", "500", "--iterations", "5"});
    REQUIRE(fixtures::run_program("fpo-remesh", extra, folder.path()).code == 0);
  };
  remesh({"-o", "even.obj", "--points", "even.ply"});
  remesh({"-o", "graded.obj", "--points", "graded.ply", "--sizing", "sizes.txt"});
  const auto said = [&](const std::string& points, const std::string& surface) {
    const ProgramResult result = fixtures::run_program(
        "fpo-spectrum", {points, "--surface", surface, "--radius", "3", "-o", "out"}, folder.path());
    CHECK(result.code == 0);
    return result.err;
  };
  CHECK(said("even.obj", "torus.obj").empty());
  CHECK(said("even.ply", "torus.obj").empty());
  CHECK(said("graded.ply", "torus.obj").empty());  // by their weights
  CHECK(said("graded.obj", "torus.obj").find("the set is adaptive") != std::string::npos);
  CHECK(said("even.obj", "sphere.obj").find("is it theirs?") != std::string::npos);
  const ProgramResult png =
      fixtures::run_program("fpo-spectrum", {"even.obj", "-o", "out.png"}, folder.path());
  CHECK(png.code == 2);
  CHECK(png.lines_on_stderr() == 1);
}
