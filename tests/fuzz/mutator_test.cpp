// The first seeds of the fuzzer, in process: whatever the file, a remesh or one line that says why not.

#include "tests/fuzz/mutator.h"

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "geom/repair/repair.h"
#include "io/mesh_io.h"
#include "tests/fixtures/effort.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/scratch_folder.h"

namespace {

fpo::RemeshOptions small_job(fpo::Engine engine) {
  fpo::RemeshOptions options;
  options.num_samples = 50;
  options.surface.engine = engine;
  options.optimize.max_iterations = 2;
  return options;
}

}  // namespace

TEST_CASE("fuzz: a seed gives the same file again, other seeds other files") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CHECK(fuzz::mutant(seed).bytes == fuzz::mutant(seed).bytes);
    CHECK(fuzz::mutant(seed).bytes != fuzz::mutant(seed + 1).bytes);
  }
}

TEST_CASE("fuzz: what exporters spoil is repaired to a closed manifold") {
  const fixtures::ScratchFolder folder;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const fuzz::Mutant mutant = fuzz::export_fault(seed);
    const geom::TriMesh input = io::read_mesh(folder.write(mutant.name, mutant.bytes));
    const geom::Topology t = geom::topology(geom::repaired(input, geom::all_steps()).mesh);
    CHECK(t.manifold());
    CHECK(t.boundary_edges == 0);
    CHECK(t.misoriented_edges == 0);
  }
}

TEST_CASE("fuzz: any soup can be repaired to manifold sheets, or is refused in one line") {
  const fixtures::ScratchFolder folder;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const fuzz::Mutant mutant = fuzz::mutant(seed);
    const auto path = folder.write(mutant.name, mutant.bytes);
    geom::Repaired result;
    const std::string fault = fixtures::complaint([&] {
      std::size_t repeated = 0;
      const geom::TriMesh input = io::read_mesh(path, repeated);
      result = geom::repaired(input, geom::all_steps());
    });
    CHECK(fault.find('\n') == fault.npos);
    if (fault.empty()) CHECK(geom::topology(result.mesh).manifold());
  }
}

TEST_CASE("fuzz: spoilt surfaces are remeshed or refused in one line, alike by both engines") {
  const fixtures::ScratchFolder folder;
  int remeshed = 0, refused = 0;
  const int count = fixtures::effort(25, 150);
  for (int seed = 0; seed < count; ++seed) {
    CAPTURE(seed);
    const fuzz::Mutant mutant = fuzz::mutant(static_cast<std::uint64_t>(seed));
    const auto path = folder.write(mutant.name, mutant.bytes);
    fpo::RemeshResult a, b;
    const std::string fault = fixtures::complaint([&] {
      const geom::TriMesh input = io::read_mesh(path);
      a = fpo::remesh(input, small_job(fpo::Engine::search));
      b = fpo::remesh(input, small_job(fpo::Engine::triangulation));
    });
    if (fault.empty()) {
      ++remeshed;
      CHECK(a.mesh.num_vertices() == 50);
      CHECK(fixtures::identical(a.mesh, b.mesh));
    } else {
      ++refused;
      CHECK(fault.find('\n') == fault.npos);
    }
  }
  CHECK(remeshed > count / 3);
  CHECK(refused > count / 15);
}
