// The library and fpo-remesh: the same options give the same bytes, and what one refuses the other does.

#include <filesystem>
#include <tuple>

#include "doctest.h"
#include "fpo/fpo.h"
#include "fpo/fpo_c.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

using fixtures::ProgramResult;
using fixtures::ScratchFolder;

namespace {

using Words = std::vector<std::string>;

struct Matrices {
  explicit Matrices(const geom::TriMesh& mesh) : V(mesh.num_vertices(), 3), F(mesh.num_facets(), 3) {
    Eigen::Index row = 0;
    for (const geom::Vec3& x : mesh.vertices()) V.row(row++) = x;
    row = 0;
    for (const geom::TriMesh::Facet& t : mesh.facets()) F.row(row++) << t[0].value, t[1].value, t[2].value;
  }
  Eigen::MatrixXd V;
  Eigen::MatrixXi F;
};

/// A shape in a file.
struct Place {
  explicit Place(const std::string& shape, int size) {
    io::write_mesh(folder / "in.obj", geom::make_shape(shape, size));
  }
  ProgramResult run(const Words& words) const {
    Words all{"in.obj", "-o", "out.obj"};
    all.insert(all.end(), words.begin(), words.end());
    return fixtures::run_program("fpo-remesh", all, folder.path());
  }
  Matrices input() const { return Matrices(io::read_mesh(folder / "in.obj")); }
  Matrices output() const { return Matrices(io::read_mesh(folder / "out.obj")); }
  ScratchFolder folder;
};

/// The options of both, in words, in C++ and in C.
struct Wish {
  Words words;
  void (*set)(fpo::Options&);
  void (*set_c)(fpo_options&);
};

const std::vector<Wish> wishes = {
    {{"-n", "120"}, [](auto& o) { o.count = 120; }, [](auto& o) { o.count = 120; }},
    {{"-n", "120", "--sizing", "lfs", "--gradation", "0.3", "--max-size", "2"},
     [](auto& o) {
       o.count = 120, o.sizing = fpo::SizingKind::local_feature_size;
       o.limits.gradation = 0.3, o.limits.largest = 2;
     },
     [](auto& o) { o.count = 120, o.sizing = fpo_sizing_lfs, o.gradation = 0.3, o.max_size = 2; }},
    {{"--edge-length", "0.4", "--quality", "good"},
     [](auto& o) { o.edge_length = 0.4, o.quality = fpo::Effort::good; },
     [](auto& o) { o.edge_length = 0.4, o.quality = fpo_quality_good; }},
    {{"--error", "0.05", "--features", "30"},
     [](auto& o) {
       o.error = 0.05;
       o.features = fpo::FeatureOptions{.crease_angle = 30, .weak_crease_angle = 30};
     },
     [](auto& o) { o.error = 0.05, o.feature_angle = 30; }},
    {{"--method", "mps", "--radius", "0.3"},
     [](auto& o) { o.method = fpo::Method::mps, o.radius = 0.3; },
     [](auto& o) { o.method = fpo_method_mps, o.radius = 0.3; }},
    {{"-n", "150", "--min-angle", "36", "--min-delta", "0.8", "--corners", "all", "--sheets", "together"},
     [](auto& o) {
       o.count = 150, o.min_angle = 36, o.min_delta = 0.8;
       o.corners = geom::CornerTypes::all, o.sheets = fpo::Sheets::together;
     },
     [](auto& o) {
       o.count = 150, o.min_angle = 36, o.min_delta = 0.8;
       o.corners_all = 1, o.sheets = fpo_sheets_together;
     }},
    {{"-n", "150", "--local", "--ser", "--rest", "--maximal", "--weight-scale", "0.5", "--seed", "9"},
     [](auto& o) {
       o.count = 150, o.scope = fpo::Scope::two_ring, o.shortest_edge_removal = o.rest = o.maximal = true;
       o.weight_scale = 0.5, o.seed = 9;
     },
     [](auto& o) {
       o.count = 150, o.search = fpo_search_nearby, o.ser = o.rest = o.maximal = 1;
       o.weight_scale = 0.5, o.seed = 9;
     }},
    {{"-n", "250", "--no-optimize-angles", "--no-improve-fidelity", "--no-mend", "--tiles", "100",
      "--features", "none", "--no-coarse-start"},
     [](auto& o) {
       o.count = 250, o.optimize_angles = o.improve_fidelity = o.mend = o.coarse_start = false;
       o.tile_samples = 100, o.features.reset();
     },
     [](auto& o) {
       o.count = 250, o.optimize_angles = o.improve_fidelity = o.mend = fpo_no;
       o.coarse_start = 0;
       o.tile_samples = 100, o.feature_angle = 0;
     }}};

void check_c(const Matrices& input, const Wish& wish, const Matrices& output) {
  const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> V = input.V;
  const Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor> F = input.F;
  fpo_options options;
  fpo_default_options(&options);
  options.iterations = 4;
  wish.set_c(options);
  fpo_result result;
  char error[200];
  REQUIRE(fpo_remesh(V.data(), V.rows(), F.data(), F.rows(), &options, &result, error, sizeof error) ==
          fpo_done);
  REQUIRE(result.num_vertices == output.V.rows());
  REQUIRE(result.num_facets == output.F.rows());
  bool same = true;
  for (Eigen::Index i = 0; i < output.V.rows(); ++i)
    for (int k = 0; k < 3; ++k) same = same && result.vertices[3 * i + k] == output.V(i, k);
  CHECK(same);
  fpo_free(&result);
}

std::string complaint(const Matrices& input, const fpo::Options& options) {
  try {
    fpo::remesh(input.V, input.F, options);
  } catch (const geom::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("library: what fpo-remesh writes, to the bit, whatever the options") {
  for (const std::string shape : {"torus", "cube"}) {
    const Place place(shape, shape == "torus" ? 12 : 2);
    const Matrices input = place.input();
    for (const Wish& wish : wishes) {
      CAPTURE(shape);
      CAPTURE(wish.words);
      Words words = wish.words;
      words.insert(words.end(), {"--iterations", "4"});
      const ProgramResult result = place.run(words);
      REQUIRE_MESSAGE(result.code == 0, result.err);
      const Matrices output = place.output();
      fpo::Options options;
      options.iterations = 4;
      wish.set(options);
      const fpo::Remesh remesh = fpo::remesh(input.V, input.F, options);
      CHECK(remesh.V == output.V);
      CHECK(remesh.F == output.F);
      if (shape == "cube") check_c(input, wish, output);
    }
  }
}

TEST_CASE("library: a soup of triangles is welded as in a file, and places are rows of the soup") {
  const geom::TriMesh torus = geom::make_shape("torus", 12);
  geom::Table<geom::VertexId, geom::Vec3> vertices;
  geom::Table<geom::FacetId, geom::TriMesh::Facet> facets;
  for (const geom::TriMesh::Facet& f : torus.facets()) {
    geom::TriMesh::Facet own;
    for (std::size_t k = 0; k < 3; ++k) own[k] = vertices.next_id(), vertices.push_back(torus.position(f[k]));
    facets.push_back(own);
  }
  facets.push_back(facets[geom::FacetId(0)]);  // once more
  const geom::TriMesh soup(vertices, facets);
  ScratchFolder folder;
  io::write_mesh(folder / "in.obj", soup);
  const ProgramResult result = fixtures::run_program(
      "fpo-remesh", {"in.obj", "-n", "100", "--iterations", "3", "-o", "out.obj"}, folder.path());
  REQUIRE(result.code == 0);
  const Matrices output(io::read_mesh(folder / "out.obj"));
  Matrices input(soup);
  input.F.conservativeResize(input.F.rows() + 1, 3);
  input.F.row(input.F.rows() - 1) << 5, 5, 7;  // no triangle at all
  fpo::Options options;
  options.count = 100, options.iterations = 3;
  const fpo::Remesh remesh = fpo::remesh(input.V, input.F, options);
  CHECK(remesh.V == output.V);
  CHECK(remesh.F == output.F);
  CHECK(remesh.measures.same_topology());
  for (Eigen::Index i = 0; i < remesh.V.rows(); ++i) {
    Eigen::RowVector3d at = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) at += remesh.barycentric(i, k) * input.V.row(input.F(remesh.facet[i], k));
    CHECK((at - remesh.V.row(i)).norm() < 1e-9);
  }
  options.clean = false;
  CHECK(complaint(input, options).find("twice") != std::string::npos);
}

TEST_CASE("library: refuses what fpo-remesh refuses, in the same words") {
  geom::MeshArrays soup;
  for (int i = 0; i < 60; ++i) {
    std::array<geom::VertexId, 3> own;
    for (int k = 0; k < 3; ++k)
      own[static_cast<std::size_t>(k)] = soup.add({2.0 * i + (k == 1), k == 2 ? 1.0 : 0.0, 0.0});
    soup.add_triangle(own[0], own[1], own[2]);
  }
  geom::TriMesh stack = geom::make_shape("square", 2);
  const geom::TriMesh square = stack;
  for (int k = 1; k < 28; ++k)
    stack = geom::joined(stack, geom::mapped(square, [k](const geom::Vec3& p) -> geom::Vec3 {
                           return p + geom::Vec3(0, 0, 1e-3 * k);
                         }));
  const geom::TriMesh thread = geom::mapped(geom::make_shape("cube"), [](const geom::Vec3& p) -> geom::Vec3 {
    return {p.x(), 1e-9 * p.y(), 1e-9 * p.z()};
  });
  const geom::TriMesh pieces = soup.take();
  for (const auto& job :
       {std::tuple(pieces, "the surface is in 60 pieces", 100),
        std::tuple(pieces, "the surface is in 60 pieces", 300), std::tuple(stack, "some ", 400),
        std::tuple(thread, "the surface is thinner than the spacing", 100)}) {
    CAPTURE(std::get<1>(job));
    const auto& [mesh, words, n] = job;
    ScratchFolder folder;
    io::write_mesh(folder / "in.obj", mesh);
    const ProgramResult result = fixtures::run_program(
        "fpo-remesh", {"in.obj", "-n", std::to_string(n), "-o", "out.obj"}, folder.path());
    CHECK(result.code == 2);
    fpo::Options options;
    options.count = static_cast<std::size_t>(n);
    const std::string said = complaint(Matrices(mesh), options);
    CHECK(said.find(words) == 0);
    CHECK(result.err.find(said) != std::string::npos);
  }
}
