#include "io/svg.h"

#include <cstdlib>
#include <map>

#include "doctest.h"
#include "io/mesh_picture.h"
#include "io/numbers.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/scratch_folder.h"

using geom::Vec2;
using geom::Vec3;

namespace {

std::string rounded(double value, int decimals) {
  std::string text;
  io::append_rounded(text, value, decimals);
  return text;
}

std::size_t svg_count(const std::string& text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

/// A sphere of about 2 n^2 facets in geographic coordinates.
geom::TriMesh sphere(int n) {
  std::vector<Vec3> points{{0, 1, 0}, {0, -1, 0}};
  std::vector<fixtures::Facet> facets;
  const auto at = [&](int ring, int k) {
    if (ring == 0) return 0;
    return ring == n ? 1 : 2 + (ring - 1) * 2 * n + k % (2 * n);
  };
  for (int ring = 1; ring < n; ++ring)
    for (int k = 0; k < 2 * n; ++k) {
      const double theta = M_PI * ring / n, phi = M_PI * k / n;
      points.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
    }
  for (int ring = 0; ring < n; ++ring)
    for (int k = 0; k < 2 * n; ++k) {
      const int a = at(ring, k), b = at(ring, k + 1), c = at(ring + 1, k), d = at(ring + 1, k + 1);
      if (c != d) facets.push_back({a, c, d});
      if (a != b) facets.push_back({a, d, b});
    }
  return fixtures::make_mesh(points, facets);
}

}  // namespace

TEST_CASE("append_rounded: short, and within half a unit of the last place") {
  CHECK(rounded(0, 2) == "0");
  CHECK(rounded(-0.001, 2) == "0");
  CHECK(rounded(0.5, 2) == ".5");
  CHECK(rounded(-0.25, 2) == "-.25");
  CHECK(rounded(1200, 2) == "1200");
  CHECK(rounded(12.999, 2) == "13");
  CHECK(rounded(7.4, 0) == "7");
  for (double x = -3; x < 3; x += 0.0137) CHECK(std::abs(std::stod(rounded(x, 3)) - x) <= 0.0005 + 1e-12);
}

TEST_CASE("SvgPath: relative steps end where absolute rounding ends") {
  io::SvgPath path(1);
  path.move_to({0.04, 0.04});
  for (int i = 1; i <= 100; ++i) path.line_to({0.04 + 0.04 * i, 0.04 - 0.04 * i});
  // Add up the steps: "M0 0l.1 0 0-.1..." are pairs of numbers after the first.
  double x = 0, y = 0;
  const char* at = path.data().c_str();
  for (bool is_x = true; *at != '\0'; is_x = !is_x) {
    if (*at == 'M' || *at == 'l') ++at;
    char* end = nullptr;
    (is_x ? x : y) += std::strtod(at, &end);
    REQUIRE(end != at);
    at = end;
  }
  CHECK(x == doctest::Approx(4.0));
  CHECK(y == doctest::Approx(-4.0));
  const Vec2 triangle[] = {{0, 0}, {10, 0}, {0, 10}};
  CHECK(io::SvgPath(0).polygon(triangle).polygon(triangle).data() == "M0 0l10 0-10 10zM0 0l10 0-10 10z");
  CHECK(io::SvgPath(0).dot({3, 4}).dot({5, 6}).data() == "M3 4h0M5 6h0");
}

TEST_CASE("Svg: a document of every element, with open groups closed and text escaped") {
  const fixtures::ScratchFolder folder;
  io::Svg svg(100, 50.5);
  svg.style(".a{fill:none}");
  svg.begin_group(R"(class="a")");
  const Vec2 corners[] = {{0, 0}, {10, 0}, {5.25, 5}};
  svg.polygon(corners);
  svg.polyline(corners);
  svg.line({0, 0}, {1, 1}, R"(stroke="#000")");
  svg.circle({5, 5}, 0.5);
  svg.rectangle({1, 2}, {3, 4});
  svg.text({1, 2}, "a < b & c");
  svg.save(folder / "a.svg");
  const std::string text = fixtures::ScratchFolder::read(folder / "a.svg");
  CHECK(text == svg.document());
  CHECK(text.starts_with(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50.5\" viewBox=\"0 0 100 50.5\">\n"));
  CHECK(text.ends_with("</g>\n</svg>\n"));
  for (const char* element :
       {"<path d=\"M0 0l10 0-4.75 5z\"/>", "<path d=\"M0 0l10 0-4.75 5\"/>",
        "<line x1=\"0\" y1=\"0\" x2=\"1\" y2=\"1\" stroke=\"#000\"/>", "<circle cx=\"5\" cy=\"5\" r=\".5\"/>",
        "<rect x=\"1\" y=\"2\" width=\"3\" height=\"4\"/>", ">a &lt; b &amp; c</text>"})
    CHECK(svg_count(text, element) == 1);
}

TEST_CASE("draw_mesh: shows each facet that faces the viewer once, in few bytes") {
  const geom::TriMesh mesh = sphere(30);  // 1742 vertices, 3480 facets
  io::MeshPicture picture;
  std::size_t facing = 0;
  for (std::size_t t = 0; t < mesh.num_facets(); ++t)
    facing += mesh.normal(geom::FacetId(t)).dot(picture.towards_viewer) > 0 ? 1 : 0;
  const std::string text = io::draw_mesh(mesh, picture).document();
  CHECK(svg_count(text, "z") - svg_count(text, "{z") >= facing);
  CHECK(svg_count(text, "M") == facing);
  CHECK(text.size() < 100000);
  CHECK(text == io::draw_mesh(mesh, picture).document());

  picture.back_faces = true;
  CHECK(svg_count(io::draw_mesh(mesh, picture).document(), "M") == mesh.num_facets());
}

TEST_CASE("draw_mesh: points come after the facets they lie on and before those that hide them") {
  const auto mesh = fixtures::make_mesh(
      {{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}, {-1, -1, 9}, {1, -1, 9}, {0, 1, 9}}, {{0, 1, 2}, {3, 4, 5}});
  io::MeshPicture picture;
  picture.towards_viewer = {0, 0, 1};
  picture.points = {{0, 0, 1}, {0, 0, 9}};
  const std::string text = io::draw_mesh(mesh, picture).document();
  std::string order;
  for (std::size_t at = text.find("d=\""); at != text.npos; at = text.find("d=\"", at + 1))
    order += text[text.find('"', at + 3) - 1] == 'z' ? "facet " : "point ";
  CHECK(order == "facet point facet point ");
}

TEST_CASE("draw_mesh: on one page no picture changes the looks of another: a class name has one rule") {
  std::map<std::string, std::string> rules;
  for (const bool edges : {true, false})
    for (const std::uint8_t red : {10, 120, 255}) {
      io::MeshPicture picture;
      picture.surface = {red, 80, 200};
      picture.edge_width = edges ? 0.5 : 0;
      picture.points = {{0, 0, 2}};
      picture.point_radius = 1 + red / 100;
      const std::string text = io::draw_mesh(sphere(6), picture).document();
      const std::size_t end = text.find("</style>");
      for (std::size_t at = text.find("<style>.") + 7; at < end; at = text.find('\n', at) + 1) {
        const std::size_t open = text.find('{', at), close = text.find('}', at);
        if (open > end) break;
        const std::string rule = text.substr(open, close - open);
        CHECK(rules.try_emplace(text.substr(at, open - at), rule).first->second == rule);
      }
    }
  CHECK(rules.size() > 20);
}

TEST_CASE("draw_mesh: colours per facet, and what cannot be drawn") {
  const geom::TriMesh mesh = fixtures::tetrahedron();
  io::MeshPicture picture;
  picture.facet_colours = {{255, 0, 0}};
  CHECK(fixtures::complaint([&] { io::draw_mesh(mesh, picture); }) == "a picture needs one colour per facet");
  picture.facet_colours.assign(4, {255, 0, 0});
  picture.towards_viewer = picture.up;
  CHECK(fixtures::complaint([&] { io::draw_mesh(mesh, picture); }) != "");
  picture.towards_viewer = {1, 0, 0};
  CHECK(io::draw_mesh(mesh, picture).document().find("fill:#ff") != std::string::npos);
  CHECK(io::css({1, 171, 255}) == "#01abff");
}
