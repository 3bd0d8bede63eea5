// bench-spoilt [MODEL N]: a surface spoilt in ten ways (tests/fixtures/spoilt.h), repaired and remeshed with
// the defaults of fpo-remesh: whether the remesh is of the type of the surface before, the smallest angle,
// seconds of one core, and what the repair said.

#include "tests/fixtures/spoilt.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "fpo/features/feature_choice.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/repair/repair.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"

namespace {

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void print_row(const char* way, const geom::TriMesh& spoilt, const geom::Topology& wanted, std::size_t n) {
  fpo::RemeshOptions options = fpo::default_options(n, fpo::SizingKind::uniform);
  options.features = fpo::automatic_features();
  const double start = seconds();
  const geom::Repaired repaired = geom::repaired(spoilt, geom::all_steps());
  const fpo::RemeshResult result = fpo::remesh(repaired.mesh, options);
  const geom::Topology t = geom::topology(result.mesh);
  const bool right = t.manifold() && t.unreferenced_vertices == 0 && t.misoriented_edges == 0 &&
                     t.euler == wanted.euler && t.components == wanted.components &&
                     t.boundary_loops == wanted.boundary_loops;
  std::printf("%-12s %-10s %5.1f %7.1f s ", way, right ? "right" : "WRONG TYPE", result.measures.theta_min,
              seconds() - start);
  for (const std::string& line : repaired.lines) std::printf(" %s;", line.c_str());
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  const geom::TriMesh mesh = argc > 1 ? io::read_mesh(argv[1]) : geom::make_shape("torus");
  const std::size_t n = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 300;
  const geom::Topology wanted = geom::topology(mesh);
  print_row("as it is", mesh, wanted, n);
  for (std::size_t way = 0; way < fixtures::ways_to_spoil.size(); ++way)
    print_row(fixtures::ways_to_spoil[way], fixtures::spoilt(mesh, way), wanted, n);
}
