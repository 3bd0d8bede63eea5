#include "tools/type_warnings.h"

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/book.h"

namespace {

fpo::RemeshResult spoilt_remesh() {
  fpo::RemeshResult result;
  result.samples.resize(500);
  result.type.bare_samples = 24;
  result.advice.places.resize(63);
  result.advice.samples = 2600;
  result.measures.angles_below_30 = 744;
  result.feature_bound = {1145, fpo::FeatureNeed::close_curves};
  result.feature_edges = 600;
  result.broken_feature_edges = 444;
  result.edge_advice.samples = 16800;
  return result;
}

}  // namespace

TEST_CASE("type warnings: all lines tell the same number of samples") {
  const fpo::RemeshResult result = spoilt_remesh();
  std::vector<std::string> lines = tools::type_warnings({}, result, {});
  for (const std::string& line : tools::shape_warnings({}, result, {})) lines.push_back(line);
  std::size_t told = 0;
  for (const std::string& line : lines) {
    CAPTURE(line);
    const std::size_t at = line.find("-n ");
    if (at == std::string::npos) continue;
    ++told;
    CHECK(line.compare(at, 8, "-n 2600 ") == 0);
  }
  CHECK(told == 3);
}

TEST_CASE("type warnings: the edges that are missing count where it is not known what keeps them") {
  fpo::RemeshResult result = spoilt_remesh();
  result.advice.samples = 18000;  // most edges are missing, and 1145 keep all
  CHECK(tools::enough_samples(result) == 3500);
  result.broken_feature_edges = 300;
  CHECK(tools::enough_samples(result) == 18000);
  result.feature_samples = 300;  // most of all
  CHECK(tools::enough_samples(result) == 1145);
  result.feature_samples = 100;
  result.advice.samples = 900;
  CHECK(tools::enough_samples(result) == 1145);
  result.feature_bound.samples = 400;  // and yet some are missing
  CHECK(tools::enough_samples(result) == 1000);
  result.feature_bound.samples = 0;
  CHECK(tools::enough_samples(result) == 17000);
  result.broken_feature_edges = 0;
  CHECK(tools::enough_samples(result) == 900);
  result.advice = {};
  CHECK(tools::enough_samples(result) == 0);
}

TEST_CASE("type warnings: an input with edges of more than two facets may be repaired") {
  const auto advice = [](const geom::TriMesh& input) {
    std::string told;
    for (const std::string& line : tools::type_warnings(input, spoilt_remesh(), {}))
      if (line.find("at fault") != std::string::npos) told = line;
    return told;
  };
  CHECK(advice(fixtures::book(3)).find("try --repair, which splits non-manifold edges, or -n") !=
        std::string::npos);
  const std::string without = advice(geom::make_shape("cube"));
  CHECK(without.find("try -n ") != std::string::npos);
  CHECK(without.find("--repair") == std::string::npos);
}

TEST_CASE("type warnings: features of the shape that are given up, not noise upon it") {
  fpo::RemeshResult result;
  result.given_up = "creases given up: 3 of 12 curves";
  CHECK(tools::shape_warnings({}, result, {}).empty());
  result.features_missed = true;
  CHECK(tools::shape_warnings({}, result, {}) == std::vector{result.given_up});
}

TEST_CASE("type warnings: of small angles, how many the input has between creases") {
  fpo::RemeshResult result;
  result.measures.angles_below_30 = 28;
  result.measures.theta_min = 13.6;
  const std::string plain = "28 angles are below 30 degrees, the smallest is 13.6";
  CHECK(tools::shape_warnings({}, result, {}) == std::vector{plain});
  result.corner_angle = 13.6;
  result.sharp_corners = 14;
  const std::string more = "; 14 between creases of the input are, the smallest is 13.6";
  CHECK(tools::shape_warnings({}, result, {}) == std::vector{plain + more});
  fpo::RemeshOptions with_lines;
  with_lines.features.emplace().marked = {{geom::VertexId(0), geom::VertexId(1)}};
  CHECK(tools::shape_warnings({}, result, with_lines) ==
        std::vector{plain + more + "; lines that were asked for are not given up for them"});
  result.measures.angles_below_30 = result.sharp_corners = 1;
  const std::string one = "1 angle is below 30 degrees, the smallest is 13.6";
  const std::string own = "; 1 between creases of the input is, the smallest is 13.6";
  CHECK(tools::shape_warnings({}, result, {}) == std::vector{one + own});
}

TEST_CASE("type warnings: nobody is told a number that is of no use") {
  fpo::RemeshResult result;
  result.samples.resize(500);
  result.measures.angles_below_30 = 3;
  result.measures.theta_min = 24;
  for (const std::size_t needed : {501u, 50000u, 50001u, 27482660u}) {
    CAPTURE(needed);
    result.feature_bound = {needed, fpo::FeatureNeed::small_angles};
    const std::vector<std::string> lines = tools::shape_warnings({}, result, {});
    REQUIRE(lines.size() == 1);
    CHECK((lines[0].find("-n ") != std::string::npos) == (needed <= 50000));
    CHECK(tools::enough_samples(result) == (needed <= 50000 ? needed : 0));
  }
}

TEST_CASE(
    "type warnings: the shortest edge, if it is shorter than half of what was wanted or of an even spacing") {
  const geom::TriMesh cube = geom::make_shape("cube");  // 100 samples: an even spacing of .263
  fpo::RemeshResult result;
  result.mesh = cube;
  result.samples.resize(100);
  result.measures.least = {0.4, {1, 2, 3}, false};
  result.measures.shortest = {0.1, {4, 5, 6}, true};
  const auto line = [&](double least_edge, bool is_fixed, fpo::SizingKind sizing = fpo::SizingKind::uniform) {
    result.measures.least_edge = least_edge;
    result.measures.least.is_fixed = is_fixed;
    fpo::RemeshOptions options;
    options.sizing = sizing;
    const std::vector<std::string> lines = tools::shape_warnings(cube, result, options);
    REQUIRE(lines.size() < 2);
    return lines.empty() ? "" : lines.front();
  };
  CHECK(line(0.3, false) == "the shortest edge is 0.300 wanted lengths long, at (1, 2, 3)");
  CHECK(line(0.3, true) ==
        "the shortest edge is 0.300 wanted lengths long, at (1, 2, 3): features are that close there");
  CHECK(line(0.6, false)
            .starts_with("the shortest edge is 0.380 even spacings long, at (4, 5, 6): lengths are "));
  CHECK(line(0.6, false, fpo::SizingKind::local_feature_size) == "");
  result.measures.shortest.length = 0.14;
  CHECK(line(0.6, false) == "");
}
