#include "fpo/remesh/harmful_creases.h"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "doctest.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/check.h"
#include "tests/fixtures/blade.h"
#include "tests/fixtures/block.h"
#include "tests/fixtures/triangles.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

constexpr std::size_t samples = 96;  // a spacing of 1

/// 10 x 4 x .3.
TriMesh plate() { return fixtures::block(10, 4, 0.3); }

RemeshOptions options() {
  RemeshOptions result;
  result.num_samples = samples;
  result.features = automatic_features();
  result.features->yielding = true;
  return result;
}

/// So many angles of 17 degrees across each of two sides of the plate.
TriMesh bad(std::size_t number) {
  std::vector<fixtures::Triangle> triangles;
  for (const double y : {0, 4})
    triangles.insert(triangles.end(), number, {Vec3(2, y, 0), Vec3(3, y, 0), Vec3(2, y, 0.3)});
  return fixtures::apart(triangles);
}

/// With all creases.
RemeshResult with_small_angles(const TriMesh& surface) {
  RemeshResult result;
  result.mesh = bad(40);
  result.feature_samples = result.mesh.num_vertices();
  result.kept = std::make_shared<const Features>(find_features(surface, automatic_features()));
  result.crease_curves = result.kept->curves.size();
  result.measures.theta_min = 17;
  return result;
}

/// What is made with other features: the smallest angle is larger, and small ones are fewer.
struct Change {
  double gain;
  std::size_t divisor;
};

/// The numbers of curves that are asked for, the edges given up for that, and what comes of it.
struct Asked {
  std::vector<std::size_t> curves;
  std::vector<std::vector<std::array<geom::VertexId, 2>>> unmarked;
  RemeshResult result;
};

Asked with_change(const Change& change) {
  const TriMesh surface = plate();
  Asked asked;
  RemeshResult last = with_small_angles(surface);
  asked.result =
      without_harmful_creases(surface, options(), with_small_angles(surface),
                              [&](const TriMesh&, const FeatureChoice& choice, const RemeshOptions& how) {
                                asked.curves.push_back(choice.features.curves.size());
                                asked.unmarked.push_back(how.features->unmarked);
                                RemeshResult result = last;
                                result.mesh = bad(last.mesh.num_facets() / 2 / change.divisor);
                                result.kept = std::make_shared<const Features>(choice.features);
                                result.measures.theta_min += change.gain;
                                last = result;
                                return result;
                              });
  return asked;
}

}  // namespace

TEST_CASE("harmful creases: given up while that helps, and told") {
  REQUIRE(with_small_angles(plate()).kept->curves.size() == 12);
  const Asked better = with_change({3, 2});
  REQUIRE(!better.curves.empty());
  CHECK(better.curves.size() <= 3);
  CHECK(better.curves.front() < 12);
  CHECK(better.result.measures.theta_min > 17);
  CHECK(better.result.features_missed);
  CHECK(better.result.given_up.find("of 12 curves, for small angles beside them") != std::string::npos);
}

TEST_CASE(
    "harmful creases: kept if without them the smallest angle is no larger, or small ones are as many") {
  for (const Change& change : {Change{-1, 2}, Change{3, 1}}) {
    const Asked asked = with_change(change);
    REQUIRE(asked.curves.size() == 3);  // without both, then without one, then without others
    CHECK(asked.curves[0] < asked.curves[1]);
    CHECK(asked.curves[2] < 12);
    for (const auto& edge : asked.unmarked[1])
      CHECK(std::ranges::find(asked.unmarked[2], edge) == asked.unmarked[2].end());
    CHECK(asked.result.kept->curves.size() == 12);
    CHECK(asked.result.given_up.empty());
    CHECK(!asked.result.features_missed);
  }
}

namespace {

/// Whether one try is taken that comes of fewer creases, the first one.
bool is_taken(const std::function<RemeshResult(RemeshResult)>& made) {
  const TriMesh surface = plate();
  const RemeshResult begun = with_small_angles(surface);
  int asked = 0;
  const RemeshResult result = without_harmful_creases(
      surface, options(), begun,
      [&](const TriMesh&, const FeatureChoice& choice, const RemeshOptions&) -> std::optional<RemeshResult> {
        if (++asked > 1) return {};
        RemeshResult fewer = begun;
        fewer.kept = std::make_shared<const Features>(choice.features);
        fewer.mesh = bad(10);
        fewer.measures.theta_min = 20;
        return made(std::move(fewer));
      });
  return result.features_missed;
}

/// And so many pairs of facets that cross.
TriMesh crossing(std::size_t number, std::size_t num_bad) {
  std::vector<fixtures::Triangle> triangles;
  for (std::size_t i = 0; i < number; ++i) {
    const double x = 0.01 * static_cast<double>(i);  // in the unit box
    triangles.push_back({Vec3(x, 0.5, 0), Vec3(x + 0.004, 0.5, 0), Vec3(x + 0.002, 0.503, 0)});
    triangles.push_back(
        {Vec3(x + 0.002, 0.501, -0.002), Vec3(x + 0.002, 0.501, 0.002), Vec3(x + 0.006, 0.501, 0)});
  }
  for (const fixtures::Triangle& t :
       std::vector<fixtures::Triangle>(num_bad, {Vec3(0.2, 0, 0), Vec3(0.3, 0, 0), Vec3(0.2, 0, 0.03)}))
    triangles.push_back(t);
  return fixtures::apart(triangles);
}

}  // namespace

TEST_CASE("harmful creases: what facets that cross take from angles") {
  CHECK(is_taken([](RemeshResult fewer) { return fewer; }));
  for (const std::size_t pairs : {0, 2, 40})
    CHECK(is_taken([&](RemeshResult fewer) {
            fewer.mesh = crossing(pairs, 10);
            return fewer;
          }) == (pairs < 10));
}

TEST_CASE("harmful creases: a mesh that is no dual is taken for one that is if it lacks a third as much") {
  for (const bool good : {false, true})
    CHECK(is_taken([&](RemeshResult fewer) {
            RemeshResult joined = fewer;
            joined.by_collapses = true;
            joined.mesh = bad(good ? 12 : 15);  // of 40
            fewer.type.bare_samples = 1;
            fewer.last_resort = std::make_shared<const RemeshResult>(std::move(joined));
            return fewer;
          }) == good);
}

TEST_CASE("harmful creases: what is refused or interrupted leaves the result as it is") {
  const TriMesh surface = plate();
  const RemeshResult begun = with_small_angles(surface);
  for (const bool refused : {false, true}) {
    int asked = 0;
    const RemeshResult result = without_harmful_creases(
        surface, options(), begun,
        [&](const TriMesh&, const FeatureChoice&, const RemeshOptions&) -> std::optional<RemeshResult> {
          ++asked;
          if (refused) throw geom::InputError("too few samples");
          return {};
        });
    CHECK(asked == 3);
    CHECK(result.kept == begun.kept);
  }
}

TEST_CASE(
    "harmful creases: nothing is tried for a result of another type, by collapses, with softer lengths, or "
    "if angles are as they come") {
  const TriMesh surface = plate();
  for (int what = 0; what < 5; ++what) {
    RemeshResult begun = with_small_angles(surface);
    RemeshOptions asked = options();
    if (what == 4) asked.optimize_angles = false;
    if (what == 0) begun.type.bare_samples = 1;
    if (what == 1) begun.by_collapses = true;
    if (what == 2) begun.least_length = 0.3;
    if (what == 3) begun.kept = nullptr;
    without_harmful_creases(
        surface, asked, begun,
        [&](const TriMesh&, const FeatureChoice&, const RemeshOptions&) -> std::optional<RemeshResult> {
          FAIL("asked for");
          return {};
        });
  }
}

TEST_CASE("harmful creases: lines that somebody asked for stay") {
  const TriMesh surface = plate();
  const RemeshResult begun = with_small_angles(surface);
  RemeshOptions asked = options();
  for (const FeatureCurve& curve : begun.kept->curves)
    asked.features->marked.push_back({curve.vertices.front(), curve.vertices.back()});
  without_harmful_creases(
      surface, asked, begun,
      [&](const TriMesh&, const FeatureChoice&, const RemeshOptions&) -> std::optional<RemeshResult> {
        FAIL("given up");
        return {};
      });
}

TEST_CASE(
    "harmful creases: of another type in a few places, and what others do harm without the first ones") {
  const TriMesh surface = plate();
  RemeshResult begun = with_small_angles(surface);
  begun.type.bare_samples = 1;
  begun.advice.places = {Vec3(5, 0, 0.15)};
  std::vector<std::size_t> unmarked;
  const auto remesh = [&](const TriMesh&, const FeatureChoice& choice, const RemeshOptions& how) {
    unmarked.push_back(how.features->unmarked.size());
    RemeshResult result = begun;
    result.kept = std::make_shared<const Features>(choice.features);
    result.mesh = bad(1);
    if (unmarked.size() > 1)
      result.type = {};
    else
      result.advice.places = {Vec3(5, 4, 0.15), Vec3(2, 4, 0.15)};  // no better
    return result;
  };
  const RemeshResult result = without_harmful_creases(surface, options(), begun, remesh);
  CHECK(result.type.ok());
  REQUIRE(unmarked.size() >= 2);
  CHECK(result.given_up.find("for faults and small angles beside them") != std::string::npos);
  CHECK(unmarked[1] > unmarked[0]);

  begun.advice.places.resize(20, Vec3(5, 0, 0.15));
  unmarked.clear();
  without_harmful_creases(surface, options(), begun, remesh);
  CHECK(unmarked.empty());
}

TEST_CASE(
    "harmful creases: long edges are cut where they are near in part, and the result is of the surface") {
  const fixtures::Blade blade(1);
  const TriMesh& surface = blade.mesh;
  RemeshOptions options;
  options.num_samples = static_cast<std::size_t>(surface.area() / 0.866);  // a spacing of 1
  options.features = automatic_features();
  options.features->yielding = true;
  RemeshResult begun = with_small_angles(surface);
  begun.mesh = fixtures::apart({fixtures::Blade::tip()});
  begun.feature_samples = 3;
  std::size_t asked = 0;
  const auto remesh = [&](const TriMesh& cut, const FeatureChoice& choice, const RemeshOptions& how) {
    ++asked;
    CHECK(cut.num_vertices() == surface.num_vertices() + 2);
    CHECK(cut.area() == doctest::Approx(surface.area()));
    CHECK(how.rho.size() == (how.rho.empty() ? 0 : cut.num_vertices()));
    for (std::size_t i = 0; i < how.rho.size(); ++i)
      CHECK(how.rho[geom::VertexId(i)] ==
            doctest::Approx(1 + cut.position(geom::VertexId(i)).norm()).epsilon(1e-9));
    RemeshResult result = begun;
    result.mesh = fixtures::apart({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 0.8, 0)}});
    result.measures.theta_min = 45;
    result.kept = std::make_shared<const Features>(choice.features);
    result.sizing.resize(cut.num_vertices(), 1);
    for (std::size_t t = 0; t < cut.num_facets(); ++t)
      result.samples.push_back({cut.corner(geom::FacetId(t), 0), geom::FacetId(t)});
    return result;
  };
  for (const bool given : {false, true}) {
    if (given)
      for (const Vec3& x : surface.vertices()) options.rho.push_back(1 + x.norm());
    const RemeshResult result = without_harmful_creases(surface, options, begun, remesh);
    CHECK(result.given_up.find("1 of ") != std::string::npos);
    CHECK(result.given_up.find("in part") != std::string::npos);
    CHECK(result.sizing.size() == surface.num_vertices());
    REQUIRE(!result.samples.empty());
    for (const SurfaceSample& x : result.samples) REQUIRE(x.facet.index() < surface.num_facets());
  }
  REQUIRE(asked == 2);
  options.rho.clear();
  const FeatureCurve& any = begun.kept->curves.front();
  options.features->marked.push_back({any.vertices.front(), any.vertices.back()});
  without_harmful_creases(surface, options, begun,
                          [&](const TriMesh& as_it_is, const FeatureChoice&,
                              const RemeshOptions&) -> std::optional<RemeshResult> {
                            CHECK(as_it_is.num_vertices() == surface.num_vertices());
                            return {};
                          });
}
