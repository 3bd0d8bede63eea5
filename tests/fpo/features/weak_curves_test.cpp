#include "fpo/features/weak_curves.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "doctest.h"
#include "fpo/features/feature_choice.h"
#include "fpo/features/feature_samples.h"
#include "fpo/surface/sizing.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

/// A staircase seen from the side, one step twice as high as the one before, extruded by 1.
TriMesh stairs(std::size_t steps, double least) {
  std::vector<std::array<double, 2>> outline{{0, 0}};
  for (std::size_t k = 0; k < steps; ++k) {
    const auto [x, y] = outline.back();
    const double h = std::ldexp(least, static_cast<int>(k));
    outline.push_back({x, y + h});
    outline.push_back({x + h, y + h});
  }
  geom::MeshArrays arrays;
  const std::size_t m = outline.size();
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : outline) arrays.add({x, y, z});
  const VertexId low = arrays.add({outline.back()[0], 0, 0}), high = arrays.add({outline.back()[0], 0, 1});
  const auto at = [&](std::size_t i, std::size_t z) { return VertexId(z * m + i); };
  for (std::size_t i = 0; i + 1 < m; ++i) {  // what faces up and back; the sides are fans about the far foot
    arrays.add_triangle(at(i, 0), at(i, 1), at(i + 1, 1));
    arrays.add_triangle(at(i, 0), at(i + 1, 1), at(i + 1, 0));
    arrays.add_triangle(low, at(i, 0), at(i + 1, 0));
    arrays.add_triangle(high, at(i + 1, 1), at(i, 1));
  }
  arrays.add_triangle(at(m - 1, 0), at(m - 1, 1), high);
  arrays.add_triangle(at(m - 1, 0), high, low);
  arrays.add_triangle(at(0, 0), low, high);
  arrays.add_triangle(at(0, 0), high, at(0, 1));
  return arrays.take();
}

double edge_length(const TriMesh& mesh, const std::array<VertexId, 2>& e) {
  return (mesh.position(e[0]) - mesh.position(e[1])).norm();
}

}  // namespace

TEST_CASE("weak curves: strengths are lengths in spacings times folds, whatever the division of the curve") {
  for (const std::size_t parts : {1, 3}) {
    const TriMesh cube = geom::make_shape("cube", parts);
    const Features features = find_features(cube, automatic_features());
    const std::vector<double> strengths = seen_curves(cube, features, 0.25).strengths;
    REQUIRE(strengths.size() == 12);
    for (const double s : strengths) CHECK(s == doctest::Approx(4));
  }
  // A border is no crease.
  const TriMesh square = geom::make_shape("square", 3);
  const Features border = find_features(square, automatic_features());
  for (const double s : seen_curves(square, border, 0.1).strengths) CHECK(std::isinf(s));
  CHECK(weakest_curves(seen_curves(square, border, 0.1), {.share = 0.5}).empty());
}

TEST_CASE("weak curves: the weakest first, and of two side by side only one") {
  const TriMesh mesh = stairs(6, 0.02);
  REQUIRE(geom::topology(mesh).manifold());
  const Features all = find_features(mesh, automatic_features());
  const double spacing = 0.2;
  const SeenCurves seen = seen_curves(mesh, all, spacing);
  const std::vector<double>& strengths = seen.strengths;
  const std::vector<std::size_t> weak = weakest_curves(seen, {.share = 0.1});
  REQUIRE(!weak.empty());
  double strongest_weak = 0;
  for (const std::size_t c : weak) {
    CHECK(length_of(mesh, all.curves[c]) >= spacing / 2);  // short ones come last
    strongest_weak = std::max(strongest_weak, strengths[c]);
  }
  std::size_t weaker = 0;  // long ones that are weaker than one that is given up: they face it
  for (std::size_t c = 0; c < strengths.size(); ++c)
    weaker += length_of(mesh, all.curves[c]) >= spacing / 2 && strengths[c] < strongest_weak;
  CHECK(weaker < 3 * weak.size() + 2);
}

TEST_CASE("weak curves: edges that are unmarked are no creases, the others are") {
  const TriMesh mesh = stairs(5, 0.03);
  FeatureOptions options = automatic_features();
  const Features all = find_features(mesh, options);
  std::size_t edges = 0;
  for (const FeatureCurve& curve : all.curves) edges += curve.facets.size();
  const std::vector<std::size_t> one{all.curves.size() / 2};
  options.unmarked = edges_of_curves(all, one);
  REQUIRE(!options.unmarked.empty());
  std::set<std::pair<VertexId, VertexId>> gone;
  for (const auto& e : options.unmarked) gone.insert(std::minmax(e[0], e[1]));
  const Features some = find_features(mesh, options);
  for (const FeatureCurve& curve : some.curves)
    for (std::size_t i = 0; i < curve.facets.size(); ++i, --edges)
      CHECK(!gone.contains(std::minmax(curve.vertices[i], curve.vertices[(i + 1) % curve.vertices.size()])));
  CHECK(edges == gone.size());
}

TEST_CASE("feature choice: with too few samples the large creases stay and the small ones go") {
  const TriMesh mesh = stairs(8, 0.004);
  for (const std::size_t n : {45, 60, 70, 150}) {
    CAPTURE(n);
    const double spacing = hexagonal_spacing(mesh.area(), n);
    const FeatureChoice choice = choose_features(mesh, automatic_features(), {n, spacing, {}, n > 100});
    CHECK(!choice.given_up.empty());
    CHECK(3 * least_number_of_samples(mesh, choice.features, {}) <= n);
    // What is longer than two spacings and farther than that from any other curve is there still.
    std::size_t long_edges = 0;
    for (const FeatureCurve& curve : choice.features.curves) {
      std::vector<std::array<VertexId, 2>> along =
          edges_of_curves({{}, {curve}}, std::vector<std::size_t>{0});
      for (const auto& e : along) long_edges += edge_length(mesh, e) >= 0.5;
    }
    CHECK(long_edges >= 6);  // of the block: four of length 1, and two of the highest step at least
  }
}
