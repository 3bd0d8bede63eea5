// What README says about extending: extended-remesh is fpo-remesh with one method, one sizing and one rule
// more (extend.cmake).

#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

using fixtures::ProgramResult;
using fixtures::ScratchFolder;

namespace {

const std::filesystem::path root = std::filesystem::path(FPO_REPLAYS_DIR) / "../../..";

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct Place {
  Place() { io::write_mesh(folder / "sphere.obj", geom::make_shape("sphere", 8)); }
  geom::TriMesh remesh(const std::vector<std::string>& extra) const {
    std::vector<std::string> arguments{"sphere.obj", "-n", "200", "-o", "out.obj", "--iterations", "3"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const ProgramResult result = fixtures::run_program("extended-remesh", arguments, folder.path());
    CHECK((result.err.empty() || result.err.starts_with("warning: ")));
    REQUIRE(result.code == 0);
    return io::read_mesh(folder / "out.obj");
  }
  ScratchFolder folder;
};

std::size_t num_above(const geom::TriMesh& mesh) {
  std::size_t above = 0;
  for (const geom::Vec3& x : mesh.vertices()) above += x.z() > 0;
  return above;
}

double shortest_edge(const geom::TriMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const geom::TriMesh::Facet& f : mesh.facets())
    for (std::size_t i = 0; i < 3; ++i)
      least = std::min(least, (mesh.position(f[i]) - mesh.position(f[(i + 1) % 3])).norm());
  return least;
}

}  // namespace

TEST_CASE("extensions: README shows the lines that are compiled here") {
  const std::string readme = text_of(root / "README.md");
  for (const std::string name : {"method", "sizing", "rule"}) {
    std::ifstream diff(root / "tests/extensions" / (name + ".diff"));
    int added = 0;
    for (std::string line; std::getline(diff, line);) {
      if (!line.starts_with("+") || line.starts_with("+++")) continue;
      ++added;
      CAPTURE(line);
      CHECK(readme.find("\n" + line + "\n") != std::string::npos);
    }
    CHECK(added == 2);
  }
}

TEST_CASE("extensions: a method, a sizing and a rule of one file and one line do what they say") {
  const Place place;
  const geom::TriMesh usual = place.remesh({});
  CHECK(usual.num_vertices() == 200);
  CHECK(num_above(usual) == doctest::Approx(100).epsilon(0.1));

  const geom::TriMesh white = place.remesh({"--method", "white"});
  CHECK(white.num_vertices() == 200);
  CHECK(shortest_edge(white) < shortest_edge(usual) / 3);

  const geom::TriMesh by_height = place.remesh({"--sizing", "height"});
  CHECK(by_height.num_vertices() == 200);
  CHECK(num_above(by_height) < 75);

  const geom::TriMesh upward = place.remesh({"--farthest", "upward", "--no-optimize-angles"});
  CHECK(upward.num_vertices() == 200);
  CHECK(num_above(upward) > num_above(usual) + 5);
}

TEST_CASE("extensions: they are in the help, and a report says which sizing it was") {
  const Place place;
  const ProgramResult help = fixtures::run_program("extended-remesh", {"--help"}, place.folder.path());
  for (const std::string word : {"white", "height (longer on top)", "radius|upward|relative"}) {
    CAPTURE(word);
    std::string squeezed;
    for (const char c : help.out)
      if (c != '\n' && !(c == ' ' && squeezed.ends_with(' '))) squeezed += c;
    CHECK(squeezed.find(word) != std::string::npos);
  }
  place.remesh({"--sizing", "height", "--report", "report.html", "--iterations", "1"});
  CHECK(text_of(place.folder / "report.html").find("height") != std::string::npos);
}
