#include "fpo/features/samples_for_features.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "fpo/features/feature_samples.h"
#include "fpo/remesh/feature_bound.h"
#include "fpo/remesh/remesh_task.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/block.h"
#include "tests/fixtures/cage.h"

using namespace fpo;
using fixtures::block;
using geom::TriMesh;
using geom::Vec3;

namespace {

RemeshOptions options_for(std::size_t n) {
  RemeshOptions options;
  options.num_samples = n;
  options.features = automatic_features();
  return options;
}

struct OnCurves {
  FeatureChoice choice;
  std::size_t edges = 0, crowded = 0;
};

/// The samples that a remesh has on features, and the edges whose ball holds another one, by brute force.
OnCurves samples_on_curves(const TriMesh& mesh, const RemeshOptions& options) {
  const SizingFor plain = plain_sizing(mesh, options);
  OnCurves result{chosen_features(mesh, options)};
  const auto narrow = helpful_narrow_surface(mesh, result.choice.features, plain, options);
  const TriMesh& surface = narrow ? narrow->split.mesh : mesh;
  const Features features = narrow ? chosen_features(surface, options).features : result.choice.features;
  const SharedSizing shared =
      sizing_and_features({mesh, plain, narrow ? &*narrow : nullptr, features}, options);
  const FeatureSamples& on = shared.features;
  const auto at = [&](geom::SiteId x) -> const Vec3& { return on.samples[x.index()].position; };
  for (std::size_t c = 0; c < on.chains.size(); ++c) {
    const CurveMetric metric(surface, features.curves[c], shared.sizing);
    for (std::size_t i = 0; i + 1 < on.chains[c].size(); ++i) {
      const geom::SiteId a = on.chains[c][i], b = on.chains[c][i + 1];
      double low = metric.nearest(at(a)).t, high = metric.nearest(at(b)).t;
      if (i + 2 == on.chains[c].size() && high < low) high += metric.length();
      Vec3 middle;
      for (int step = 0; step < 60; ++step) {
        const double t = (low + high) / 2;
        middle = metric.at(t > metric.length() ? t - metric.length() : t).position;
        ((middle - at(a)).norm() < (middle - at(b)).norm() ? low : high) = t;
      }
      ++result.edges;
      for (std::size_t x = 0; x < on.samples.size(); ++x)
        if (x != a.index() && x != b.index() &&
            (on.samples[x].position - middle).norm() < (at(a) - middle).norm() * (1 - 1e-9)) {
          ++result.crowded;
          break;
        }
    }
  }
  return result;
}

}  // namespace

TEST_CASE("samples for features: from there on no curve is given up and every ball on curves is empty") {
  for (const char* name : {"cube", "star", "wedge", "rib", "cone-plate"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name);
    const FeatureBound bound = feature_bound(mesh, options_for(1000));
    REQUIRE(bound.samples > 0);
    CAPTURE(bound.samples);
    for (const double more : {1.0, 1.13, 1.5, 2.3}) {
      CAPTURE(more);
      const auto n = static_cast<std::size_t>(more * static_cast<double>(bound.samples));
      if (n > 20000) continue;
      const OnCurves on = samples_on_curves(mesh, options_for(n));
      CHECK(on.choice.given_up.empty());
      CHECK(on.choice.collapsed == 0);
      CHECK(on.crowded == 0);
    }
  }
}

TEST_CASE("samples for features: a slab's number goes with its thickness, not with the samples there are") {
  double before = 0;
  for (const double height : {0.2, 0.1, 0.05, 0.025}) {
    CAPTURE(height);
    const TriMesh slab = block(1, 1, height);
    const FeatureBound bound = feature_bound(slab, options_for(500));
    CHECK(static_cast<double>(bound.samples) > before);
    before = static_cast<double>(bound.samples);
    for (const std::size_t n : {60, 3000})
      CHECK(static_cast<double>(feature_bound(slab, options_for(n)).samples) ==
            doctest::Approx(before).epsilon(0.01));
    // With lengths as they are everywhere else an edge of 1.6 heights is the longest.
    const double spacing = 1.6 * height;
    CHECK(before <= 1.01 * slab.area() / (std::sqrt(0.75) * spacing * spacing) + 60);
    const OnCurves on = samples_on_curves(slab, options_for(bound.samples));
    CHECK(on.crowded == 0);
    CHECK(on.choice.collapsed == 0);
  }
}

TEST_CASE("samples for features: none on smooth surfaces, and more where a wedge becomes sharper") {
  CHECK(feature_bound(geom::make_shape("sphere"), options_for(1000)).samples == 0);
  const TriMesh wedge = geom::make_shape("wedge");
  const Vec3 flat = [&] {  // across the thin direction
    Vec3 low = wedge.position(geom::VertexId(0)), high = low;
    for (const Vec3& x : wedge.vertices()) low = low.cwiseMin(x), high = high.cwiseMax(x);
    const Vec3 size = high - low;
    Eigen::Index least;
    size.minCoeff(&least);
    return Vec3(Vec3::Unit(least));
  }();
  std::size_t before = 0;
  for (const double sharper : {1.0, 0.5, 0.2, 0.1}) {
    CAPTURE(sharper);
    const TriMesh thin =
        geom::mapped(wedge, [&](const Vec3& p) -> Vec3 { return p - (1 - sharper) * p.dot(flat) * flat; });
    const FeatureBound bound = feature_bound(thin, options_for(500));
    CHECK(bound.samples > before);
    before = bound.samples;
  }
}

TEST_CASE("samples for features: remeshes with so many samples have all edges of curves proven") {
  for (const char* name : {"cube", "star", "cone-plate"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name);
    const std::size_t least = feature_bound(mesh, options_for(300)).samples;
    for (const std::size_t n : {least, 2 * least}) {
      RemeshOptions options = options_for(n);
      options.optimize.max_iterations = 10;
      options.sheets = Sheets::together;
      options.optimize_angles = options.improve_fidelity = false;
      const RemeshResult result = remesh(mesh, options);
      CHECK(result.feature_bound.samples == least);
      CHECK(result.given_up.empty());
      CHECK(result.feature_edges > 0);
      CHECK(result.proven_edges == result.feature_edges);
      CHECK(result.broken_feature_edges == 0);
    }
  }
}

TEST_CASE(
    "samples for features: bars, which have hardly any other samples, are of the right type from there on") {
  for (const double width : {0.1, 0.05}) {
    CAPTURE(width);
    const TriMesh bars = fixtures::cage(3, width);
    const std::size_t least = feature_bound(bars, options_for(500)).samples;
    CHECK(feature_bound(bars, options_for(3000)).samples == least);
    for (const std::size_t n : {least, least + least / 4}) {
      CAPTURE(n);
      RemeshOptions options = options_for(n);
      options.optimize.max_iterations = 10;
      const RemeshResult result = remesh(bars, options);
      CHECK(2 * result.feature_samples > n);
      CHECK(result.type.ok());
      CHECK(result.broken_feature_edges == 0);
      CHECK(result.measures.theta_min > 30);
    }
  }
}
