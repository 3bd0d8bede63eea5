// The front door in C++ and C: what goes in comes out as the pipeline makes it, and faults are told.

#include "fpo/fpo.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "doctest.h"
#include "fpo/fpo_c.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/shapes/shapes.h"

namespace {

Eigen::MatrixXd vertices_of(const geom::TriMesh& mesh) {
  Eigen::MatrixXd V(mesh.num_vertices(), 3);
  Eigen::Index row = 0;
  for (const geom::Vec3& x : mesh.vertices()) V.row(row++) = x;
  return V;
}

Eigen::MatrixXi facets_of(const geom::TriMesh& mesh) {
  Eigen::MatrixXi F(mesh.num_facets(), 3);
  Eigen::Index row = 0;
  for (const geom::TriMesh::Facet& t : mesh.facets()) F.row(row++) << t[0].value, t[1].value, t[2].value;
  return F;
}

struct Input {
  explicit Input(const std::string& shape)
      : mesh(geom::make_shape(shape)), V(vertices_of(mesh)), F(facets_of(mesh)) {}
  geom::TriMesh mesh;
  Eigen::MatrixXd V;
  Eigen::MatrixXi F;
};

fpo::Options few(std::size_t count) {
  fpo::Options options;
  options.count = count;
  options.iterations = 3;
  return options;
}

std::string complaint(const Eigen::MatrixXd& V, const Eigen::MatrixXi& F, const fpo::Options& options) {
  try {
    fpo::remesh(V, F, options);
  } catch (const geom::InputError& error) {
    return error.what();
  }
  return "";
}

/// The C function's arguments.
struct PlainInput {
  explicit PlainInput(const Input& input) : F(input.F), V(input.V) {}
  int remesh(const fpo_options& options, fpo_result& result) {
    return fpo_remesh(V.data(), V.rows(), F.data(), F.rows(), &options, &result, error.data(), error.size());
  }
  Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor> F;
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> V;
  std::array<char, 100> error{};
};

fpo_options plain(std::int64_t count) {
  fpo_options options;
  fpo_default_options(&options);
  options.count = count;
  options.iterations = 3;
  return options;
}

}  // namespace

TEST_CASE("fpo::remesh: the remesh of fpo-remesh's options, as matrices") {
  const Input input("cube");
  for (const auto sizing : {fpo::SizingKind::uniform, fpo::SizingKind::local_feature_size}) {
    fpo::Options options = few(300);
    options.sizing = sizing;
    const fpo::Remesh remesh = fpo::remesh(input.V, input.F, options);
    fpo::RemeshOptions same = fpo::default_options(300, sizing);
    same.optimize.max_iterations = 3;
    const fpo::RemeshResult result = fpo::remesh(input.mesh, same);
    CHECK(remesh.V == vertices_of(result.mesh));
    CHECK(remesh.F == facets_of(result.mesh));
    CHECK(remesh.wanted.size() == 300);
    CHECK(remesh.sizing.size() == input.V.rows());
    CHECK(remesh.measures.same_topology());
    CHECK(remesh.measures.quality.theta_min > 25);
    CHECK(remesh.measures.optimization.last.iteration == 3);
  }
}

TEST_CASE("fpo::remesh: by default a cube keeps its corners and edges") {
  const Input input("cube");
  const fpo::Remesh remesh = fpo::remesh(input.V, input.F, few(300));
  CHECK(remesh.V.colwise().minCoeff() == input.V.colwise().minCoeff());
  CHECK(remesh.V.colwise().maxCoeff() == input.V.colwise().maxCoeff());
  CHECK(remesh.measures.broken_feature_edges == 0);
}

TEST_CASE("fpo::remesh: facets and barycentric coordinates say where vertices lie, in any units") {
  const Input input("torus");
  for (const double factor : {1.0, 0x1p-600, 0x1p100}) {
    const Eigen::MatrixXd V = factor * input.V;
    const fpo::Remesh remesh = fpo::remesh(V, input.F, few(100));
    for (Eigen::Index i = 0; i < remesh.V.rows(); ++i) {
      const Eigen::RowVector3d weights = remesh.barycentric.row(i);
      Eigen::RowVector3d at = Eigen::RowVector3d::Zero();
      for (int k = 0; k < 3; ++k) at += weights[k] * V.row(input.F(remesh.facet[i], k));
      CHECK(weights.minCoeff() >= 0);
      CHECK(((at - remesh.V.row(i)) / factor).cwiseAbs().maxCoeff() < 1e-9);
    }
    CHECK(remesh.measures.quality.q_avg > 0.7);
  }
}

TEST_CASE("fpo::remesh: given sizes, fixed points, row-major matrices") {
  const Input input("torus");
  fpo::Options options = few(200);
  options.sizing = fpo::SizingKind::given;
  options.sizes = Eigen::VectorXd::Ones(input.V.rows());
  options.sizes.head(input.V.rows() / 2).setConstant(2);
  options.fixed = input.V.row(7);
  const fpo::Remesh remesh = fpo::remesh(input.V, input.F, options);
  CHECK(remesh.V.row(0) == input.V.row(7));
  CHECK(remesh.wanted.maxCoeff() > 1.3 * remesh.wanted.minCoeff());
  const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows = input.V;
  CHECK(fpo::remesh(rows, input.F, options).V == remesh.V);
}

TEST_CASE("fpo::remesh: what cannot be remeshed is told in a line") {
  const Input input("cube");
  Eigen::MatrixXi F = input.F;
  CHECK(complaint(input.V, F, {}).find("number of samples") != std::string::npos);
  CHECK(complaint(input.V.leftCols(2), F, few(100)) == "V is 8 x 2, not n x 3");
  CHECK(complaint(input.V, F.topRows(0), few(100)) == "F is empty");
  F(3, 1) = 8;
  CHECK(complaint(input.V, F, few(100)) != "");
  F(3, 1) = -1;
  CHECK(complaint(input.V, F, few(100)) != "");
  fpo::Options options = few(100);
  options.sizing = fpo::SizingKind::given;
  CHECK(complaint(input.V, input.F, options) == "sizes has 0 numbers, V has 8 vertices");
  options = few(100);
  options.method = fpo::Method::cvt;
  options.rest = true;
  CHECK(complaint(input.V, input.F, options) != "");
}

TEST_CASE("fpo::remesh: callbacks, and an end before the first move") {
  const Input input("torus");
  fpo::Options options = few(100);
  int iterations = 0;
  std::size_t moves = 0;
  std::atomic<bool> stop = false;
  options.on_iteration = [&](const fpo::IterationReport&) { ++iterations; };
  options.on_move = [&](std::size_t) { stop = ++moves == 150; };
  options.interrupted = &stop;
  const fpo::Remesh remesh = fpo::remesh(input.V, input.F, options);
  CHECK(iterations == 3);  // the start, the first and half of the second
  CHECK(moves == 150);
  CHECK(remesh.measures.optimization.reason == fpo::StopReason::interrupted);
  CHECK(remesh.V.rows() == 100);
  stop = true;
  CHECK_THROWS_AS(fpo::remesh(input.V, input.F, options), geom::Interrupted);
}

TEST_CASE("fpo::remesh and C: lengths instead of a count, and how long") {
  const Input input("cube");
  fpo::Options options;
  options.edge_length = 0.2;
  options.quality = fpo::Effort::draft;
  const fpo::Remesh remesh = fpo::remesh(input.V, input.F, options);
  CHECK(remesh.measures.optimization.last.iteration == 5);
  double sum = 0;
  for (Eigen::Index t = 0; t < remesh.F.rows(); ++t)
    for (int e = 0; e < 3; ++e)
      sum += (remesh.V.row(remesh.F(t, e)) - remesh.V.row(remesh.F(t, (e + 1) % 3))).norm();
  CHECK(sum / static_cast<double>(3 * remesh.F.rows()) == doctest::Approx(0.2).epsilon(0.05));
  options.count = 100;
  CHECK(complaint(input.V, input.F, options) == "count and lengths exclude each other");

  PlainInput c(input);
  fpo_options same;
  fpo_default_options(&same);
  same.edge_length = 0.2;
  same.quality = fpo_quality_draft;
  fpo_result result;
  REQUIRE(c.remesh(same, result) == fpo_done);
  CHECK(result.num_vertices == remesh.V.rows());
  CHECK(result.iterations == 5);
  fpo_free(&result);
  same.quality = 7;
  CHECK(c.remesh(same, result) == fpo_bad_input);
}

TEST_CASE("fpo_remesh in C: the same as in C++") {
  const Input input("cube");
  PlainInput c(input);
  fpo_result result;
  REQUIRE(c.remesh(plain(300), result) == fpo_done);
  CHECK(c.error[0] == '\0');
  const fpo::Remesh same = fpo::remesh(input.V, input.F, few(300));
  REQUIRE(result.num_vertices == same.V.rows());
  REQUIRE(result.num_facets == same.F.rows());
  for (Eigen::Index i = 0; i < same.V.rows(); ++i) {
    for (int k = 0; k < 3; ++k) {
      CHECK(result.vertices[3 * i + k] == same.V(i, k));
      CHECK(result.barycentric[3 * i + k] == same.barycentric(i, k));
    }
    CHECK(result.source_facet[i] == same.facet[i]);
    CHECK(result.wanted[i] == same.wanted[i]);
  }
  for (Eigen::Index t = 0; t < same.F.rows(); ++t)
    for (int k = 0; k < 3; ++k) CHECK(result.facets[3 * t + k] == same.F(t, k));
  CHECK(result.same_topology == 1);
  CHECK(result.theta_min == same.measures.quality.theta_min);
  fpo_free(&result);
  CHECK(result.vertices == nullptr);
}

TEST_CASE("fpo_remesh in C: errors are codes and a line, cut to its room") {
  PlainInput c(Input("cube"));
  fpo_result result;
  CHECK(c.remesh(plain(0), result) == fpo_bad_input);
  CHECK(std::string(c.error.data()) == "the number of samples must be at least 1");
  CHECK(result.vertices == nullptr);
  fpo_options options = plain(100);
  options.method = 9;
  CHECK(fpo_remesh(c.V.data(), 8, c.F.data(), 12, &options, &result, c.error.data(), 5) == fpo_bad_input);
  CHECK(std::string(c.error.data()) == "ther");
  CHECK(fpo_remesh(c.V.data(), 8, c.F.data(), 12, &options, &result, nullptr, 0) == fpo_bad_input);
  options = plain(100);
  options.sizing = fpo_sizing_given;
  CHECK(c.remesh(options, result) == fpo_bad_input);
  CHECK(std::string(c.error.data()) == "sizes are missing");
}

TEST_CASE("fpo_remesh in C: null and numbers that are none are bad input") {
  PlainInput c(Input("cube"));
  fpo_result result;
  const fpo_options good = plain(100);
  const auto says = [&](const double* V, const std::int32_t* F, const fpo_options* options,
                        fpo_result* place) {
    const int code = fpo_remesh(V, 8, F, 12, options, place, c.error.data(), c.error.size());
    CHECK(code == fpo_bad_input);
    return std::string(c.error.data());
  };
  CHECK(says(nullptr, c.F.data(), &good, &result) == "vertices or facets are missing");
  CHECK(says(c.V.data(), nullptr, &good, &result) == "vertices or facets are missing");
  CHECK(says(c.V.data(), c.F.data(), nullptr, &result) == "there are no options");
  CHECK(says(c.V.data(), c.F.data(), &good, nullptr) == "there is no place for the result");
  CHECK(fpo_remesh(nullptr, 8, nullptr, 12, &good, &result, nullptr, 500) == fpo_bad_input);
  fpo_free(nullptr);
  const auto spoilt = [&](auto member, auto value) {
    fpo_options options = good;
    options.*member = value;
    return says(c.V.data(), c.F.data(), &options, &result);
  };
  const double none = std::nan("");
  CHECK(spoilt(&fpo_options::gradation, none) == "gradation is not a finite number");
  CHECK(spoilt(&fpo_options::target_delta, none) == "target_delta is not a finite number");
  CHECK(spoilt(&fpo_options::edge_length, none) == "edge_length is not a length, nor 0 for none");
  CHECK(spoilt(&fpo_options::error, -1.0) == "error is not a length, nor 0 for none");
  CHECK(spoilt(&fpo_options::threads, -7) == "threads must be between 0 and 1024");
  CHECK(spoilt(&fpo_options::count, std::int64_t{1} << 62) ==
        "the number of samples must be at most 20 million");
}

TEST_CASE("fpo_remesh in C: progress is told, and stops the run") {
  PlainInput c(Input("torus"));
  std::vector<double> shares;
  fpo_options options = plain(400);
  options.user = &shares;
  options.progress = [](void* user, double done, double) {
    auto& all = *static_cast<std::vector<double>*>(user);
    all.push_back(done);
    return all.size() == 3 ? 1 : 0;
  };
  fpo_result result;
  CHECK(c.remesh(options, result) == fpo_interrupted);
  CHECK(result.num_vertices == 400);
  CHECK(shares.size() == 3);
  CHECK(shares.back() < 1);
  fpo_free(&result);
}
