// Farthest point optimization in tiles beside that on the whole surface: quality and wall-clock time, by
// turns.
//   bench-tiles MODEL.obj N ITERATIONS global|local [SAMPLES_A_TILE] [SWEEPS] [THREADS] [SEED]
//   SAMPLES_A_TILE 0: the whole surface

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "fpo/tiles/tiled_optimize.h"
#include "io/mesh_io.h"

int main(int argc, char** argv) {
  if (argc < 5) return 0;  // `make bench` runs every benchmark without arguments
  const auto number = [&](int i, int standard) { return argc > i ? std::atoi(argv[i]) : standard; };
  const geom::TriMesh mesh = io::read_mesh(argv[1]);
  const auto n = static_cast<std::size_t>(number(2, 0));
  fpo::OptimizeOptions options;
  options.max_iterations = number(3, 10);
  options.scope = std::string(argv[4]) == "local" ? fpo::Scope::two_ring : fpo::Scope::global;
  options.order = fpo::VisitOrder::in_turn;
  options.target_delta = 2;
  options.on_iteration = [](const fpo::IterationReport& r) {
    if (r.iteration % 10 == 0)
      std::printf("  %4d moved %8zu delta %.4f mean %.4f %8.2f s\n", r.iteration, r.moved, r.delta,
                  r.mean_delta, r.seconds);
  };
  const fpo::TileOptions tiles{static_cast<std::size_t>(number(5, 3000)), number(6, 10), number(7, 1)};
  const fpo::Sizing sizing = fpo::Sizing::uniform(fpo::hexagonal_spacing(mesh.area(), n));
  fpo::SurfaceOptions surface;
  surface.threads = tiles.threads;
  auto samples = fpo::random_samples(mesh, n, static_cast<std::uint64_t>(number(8, 1)));
  const auto start = std::chrono::steady_clock::now();
  fpo::OptimizeResult result;
  if (tiles.most_samples == 0) {
    fpo::SurfaceDomain domain(mesh, sizing, samples, surface);
    result = fpo::optimize(domain, options);
  } else {
    fpo::optimize_in_tiles({mesh, sizing, std::move(samples), surface}, tiles, options, result);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%s %zu tile %zu sweeps %d threads %d: moves %zu delta %.4f mean %.4f seconds %.2f\n", argv[1],
              n, tiles.most_samples, tiles.sweeps, tiles.threads, result.moves, result.last.delta,
              result.last.mean_delta, seconds);
}
