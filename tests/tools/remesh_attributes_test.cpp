// fpo-remesh with what the input carries: colours, texture coordinates, marked curves, points as a product.

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "io/attributes.h"
#include "io/input_file.h"
#include "io/mesh_io.h"
#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

using fixtures::ProgramResult;
using fixtures::ScratchFolder;

namespace {

/// A sheet of 10 x 10 squares at z = 0 with x and y as colour. Its left and right half have texture
/// coordinates (x, y) and (x + 10, y), and are groups.
std::string two_charts() {
  std::ostringstream obj;
  constexpr int n = 10, columns = n + 1;
  const auto each_vertex = [&](auto visit) {
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) visit(double(i) / n, double(j) / n);
  };
  each_vertex(
      [&](double x, double y) { obj << "v " << x << " " << y << " 0 " << x << " " << y << " 0.5\n"; });
  for (const double shift : {0, 10})
    each_vertex([&](double x, double y) { obj << "vt " << x + shift << " " << y << "\n"; });
  for (const bool right : {false, true}) {
    obj << "g " << (right ? "right" : "left") << "\n";
    for (int j = 0; j < n; ++j)
      for (int i = right ? n / 2 : 0; i < (right ? n : n / 2); ++i) {
        obj << "f";
        for (const int v :
             {j * columns + i, j * columns + i + 1, (j + 1) * columns + i + 1, (j + 1) * columns + i})
          obj << " " << v + 1 << "/" << v + 1 + (right ? columns * columns : 0);
        obj << "\n";
      }
  }
  obj << "l 1 2 3\nl 1 13\n";  // along the border; over a square, which is a diagonal or none
  return obj.str();
}

/// The same sheet as PLY with `texcoord` lists: quadrangles, and a number of each face.
std::string two_charts_as_ply() {
  constexpr int n = 10, columns = n + 1;
  std::ostringstream ply;
  ply << "ply\nformat ascii 1.0\nelement vertex " << columns * columns
      << "\nproperty double x\nproperty double y\nproperty double z\nproperty float quality\nelement face "
      << n * n << "\nproperty list uchar int vertex_indices\nproperty list uchar double texcoord\n"
      << "property uchar shade\nend_header\n";
  const auto at = [](int i) { return double(i) / n; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) ply << at(i) << " " << at(j) << " 0 " << at(i) + at(j) << "\n";
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::array<std::array<int, 2>, 4> corners{{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
      ply << 4;
      for (const auto& [x, y] : corners) ply << " " << y * columns + x;
      ply << " " << 8;
      for (const auto& [x, y] : corners) ply << " " << at(x) + (i < n / 2 ? 0 : 10) << " " << at(y);
      ply << " 200\n";
    }
  return ply.str();
}

struct RemeshAttributesPlace {
  RemeshAttributesPlace() {
    folder.write("sheet.obj", two_charts()), folder.write("sheet.ply", two_charts_as_ply());
  }
  ProgramResult run(const std::vector<std::string>& extra, const std::string& input = "sheet.obj") const {
    std::vector<std::string> arguments{input, "--iterations", "5"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return fixtures::run_program("fpo-remesh", arguments, folder.path());
  }
  ScratchFolder folder;
};

double remesh_attributes_value(const io::Attributes& a, const char* name, std::size_t v) {
  for (const io::VertexProperty& p : a.properties)
    if (p.name == name) return p.values[v];
  FAIL("no property " << name);
  return 0;
}

}  // namespace

TEST_CASE("fpo-remesh --carry: a linear colour is that of the place, as OBJ and as PLY") {
  const RemeshAttributesPlace place;
  for (const std::string out : {"out.obj", "out.ply"}) {
    CAPTURE(out);
    REQUIRE(place.run({"-n", "150", "--carry", "-o", out}).code == 0);
    const io::Attributes a = io::read_attributes(place.folder / out);
    REQUIRE(a.vertices.size() == 150);
    const double one = out == "out.ply" ? 255 : 1, tolerance = out == "out.ply" ? 0.5001 : 1e-9;
    for (std::size_t v = 0; v < 150; ++v) {
      const geom::Vec3& x = a.vertices[geom::VertexId(v)];
      CHECK(std::abs(remesh_attributes_value(a, "red", v) - one * x.x()) <= tolerance);
      CHECK(std::abs(remesh_attributes_value(a, "green", v) - one * x.y()) <= tolerance);
      CHECK(std::abs(remesh_attributes_value(a, "blue", v) - one * 0.5) <= tolerance);
    }
  }
}

TEST_CASE("fpo-remesh --carry --features auto,seams: each triangle has the texture of its chart") {
  const RemeshAttributesPlace place;
  struct Job {
    std::string input, features, output;
  };
  for (const Job& job :
       {Job{"sheet.obj", "auto,seams", "out.obj"}, Job{"sheet.obj", "auto,groups", "out.obj"},
        Job{"sheet.obj", "auto,seams", "out.ply"}, Job{"sheet.ply", "auto,seams", "out.obj"},
        Job{"sheet.ply", "auto,seams", "out.ply"}}) {
    CAPTURE(job.input + " " + job.features + " " + job.output);
    const auto& [input, features, output] = job;
    const ProgramResult result =
        place.run({"-n", "150", "--carry", "--features", features, "-o", output}, input);
    REQUIRE(result.code == 0);
    CHECK(result.err.find("cross a seam") == std::string::npos);
    CHECK((result.err.find("numbers of faces") != std::string::npos) == (input == "sheet.ply"));
    const double tolerance = output == "out.ply" ? 1e-6 : 1e-9;  // single precision
    const io::Attributes a = io::read_attributes(place.folder / output);
    CHECK(!a.triangles.empty());
    for (const io::AttributedTriangle& t : a.triangles) {
      double middle = 0;
      for (const geom::VertexId v : t.vertices) middle += a.vertices[v].x() / 3;
      for (std::size_t i = 0; i < 3; ++i) {
        const geom::Vec3& x = a.vertices[t.vertices[i]];
        CHECK((middle > 0.5 ? x.x() > 0.5 - 1e-9 : x.x() < 0.5 + 1e-9));  // none crosses
        REQUIRE(t.texture[i] >= 0);
        const geom::Vec2& at = a.texture[static_cast<std::size_t>(t.texture[i])];
        CHECK(std::abs(at.x() - x.x() - (middle > 0.5 ? 10 : 0)) < tolerance);
        CHECK(std::abs(at.y() - x.y()) < tolerance);
      }
    }
  }
  CHECK(place.run({"-n", "150", "--carry", "-o", "out.obj"}).err.find("cross a seam") != std::string::npos);
}

TEST_CASE("fpo-remesh: what is dropped is said in a line") {
  const RemeshAttributesPlace place;
  const auto said = [&](std::vector<std::string> extra) {
    extra.insert(extra.end(), {"-n", "100", "--features", "none"});
    return place.run(extra).err;
  };
  CHECK(said({"-o", "out.obj"})
            .find("dropped: vertex colours, texture coordinates, groups and materials, "
                  "lines (--carry") == 0);
  CHECK(said({"-o", "out.off", "--carry"}).find("dropped: vertex colours, texture coordinates, groups") == 0);
  CHECK(said({"-o", "out.ply", "--carry"}).find("dropped: groups and materials, lines\n") !=
        std::string::npos);
  CHECK(said({"-o", "out.ply", "--quiet"}).empty());
}

TEST_CASE("fpo-remesh --features: a file of polylines is kept, edge by edge; what is no edge is counted") {
  const RemeshAttributesPlace place;
  place.folder.write("curve.txt",
                     "# a step\n0.3 0.2 0\n0.4 0.2 0\n0.5 0.2 0\n0.5 0.3 0\n\n0 0.9 0\n1 0.9 0\n");
  const ProgramResult result = place.run({"-n", "300", "--features", "auto,curve.txt", "-o", "out.obj"});
  CHECK(result.code == 0);
  CHECK(result.err.find("features: curve.txt: 1 of 4 pieces are no edges") != std::string::npos);
  CHECK(result.out.find("broken_feature_edges 0") != std::string::npos);
  const geom::TriMesh mesh = io::read_mesh(place.folder / "out.obj");
  for (const geom::Vec3& corner : {geom::Vec3(.3, .2, 0), geom::Vec3(.5, .2, 0), geom::Vec3(.5, .3, 0)})
    CHECK(std::ranges::count(mesh.vertices(), corner) == 1);
  CHECK(place.run({"-n", "300", "--features", "curves", "-o", "out.obj"}).code == 2);
}

TEST_CASE("fpo-remesh --points: without a mesh, with normals, areas that add up, and ranks") {
  const RemeshAttributesPlace place;
  const ProgramResult result = place.run({"-n", "120", "--points", "points.ply"});
  REQUIRE(result.code == 0);
  const auto properties = io::parse_ply_properties(io::load(place.folder / "points.ply"));
  double area = 0;
  std::vector<double> ranks;
  for (const io::VertexProperty& p : properties) {
    REQUIRE(p.values.size() == 120);
    if (p.name == "area")
      for (const double part : p.values) area += part;
    if (p.name == "nz")
      for (const double z : p.values) CHECK(z == doctest::Approx(1));
    if (p.name == "rank") ranks = p.values;
    if (p.name == "weight")  // of uniform samples all the same
      for (const double weight : p.values) CHECK(weight == p.values.front());
  }
  CHECK(area == doctest::Approx(1));
  std::ranges::sort(ranks);
  for (std::size_t i = 0; i < 120; ++i) CHECK(ranks[i] == static_cast<double>(i));
}

TEST_CASE("fpo-remesh: lengths instead of a number, and back from --sizing-out") {
  const RemeshAttributesPlace place;
  const auto samples = [&](const std::vector<std::string>& extra) {
    std::vector<std::string> arguments = extra;
    arguments.insert(arguments.end(), {"-o", "out.off"});
    const ProgramResult result = place.run(arguments);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return std::stoul(result.out.substr(result.out.find("samples ") + 8));
  };
  // 2 / (sqrt 3 h^2) samples of the area of 1, h = .05 / 1.018, and half the border's.
  CHECK(std::abs(double(samples({"--edge-length", ".05"})) - 519) < 25);
  CHECK(samples({"-n", "333", "--sizing", "curvature", "--sizing-out", "sizes.ply"}) == 333);
  const std::size_t again = samples({"--sizing", "sizes.ply"});
  CHECK(samples({"--sizing", "sizes.ply:value"}) == again);
  CHECK(samples({"-n", "444", "--sizing", "sizes.ply"}) == 444);
  place.folder.write("image.pgm", "P2 2 1 255 255 0\n");  // left white, right black
  CHECK(samples({"-n", "200", "--sizing", "image.pgm"}) == 200);
  const geom::TriMesh mesh = io::read_mesh(place.folder / "out.off");
  CHECK(std::ranges::count_if(mesh.vertices(), [](const geom::Vec3& x) { return x.x() > 0.5; }) > 120);
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"-n", "9", "--edge-length", "1"},
                                              {"--error", "0"},
                                              {"--radius", ".1"},
                                              {"--edge-length", "1e-9"},
                                              {"-n", "50", "--sizing", "sizes.ply:blau"},
                                              {"--sizing", "image.pgm"}}) {
    std::vector<std::string> arguments = bad;
    arguments.insert(arguments.end(), {"-o", "bad.off"});
    const ProgramResult result = place.run(arguments);
    CHECK(result.code == 2);
    CHECK(result.lines_on_stderr() == 1);
  }
}
