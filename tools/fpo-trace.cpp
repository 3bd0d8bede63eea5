// fpo-trace: one move of Algorithm 1 in slow motion.

#include <cstdio>

#include "fpo/surface_domain.h"
#include "geom/rng.h"
#include "geom/scaling.h"
#include "io/atomic_file.h"
#include "io/input_file.h"
#include "io/mesh_io.h"
#include "tools/cli.h"
#include "tools/trace_picture.h"

namespace {

using geom::SiteId;

struct Arguments {
  std::filesystem::path input, folder;
  std::size_t n = 0, move = 0;
  fpo::SurfaceOptions surface;
};

Arguments parse(tools::CommandLine& cli) {
  Arguments a;
  cli.describe("INPUT", "Runs the optimization up to one move, then shows that move step by step.");
  cli.integer(
      {.name = "count", .letter = 'n', .value = "COUNT", .help = "number of samples", .required = true}, a.n,
      1, 20'000'000);
  cli.integer({.name = "move",
               .value = "M",
               .help = "which move, counted from 0 over all iterations",
               .required = true},
              a.move, 0, 1'000'000'000'000);
  cli.path(
      {.name = "output", .letter = 'o', .value = "DIR", .help = "folder of the drawings", .required = true},
      a.folder);
  cli.choice({.name = "corners", .value = "c|all", .help = "as in fpo-remesh"}, a.surface.corners,
             {{"c", geom::CornerTypes::c_only}, {"all", geom::CornerTypes::all}});
  cli.choice({.name = "engine", .value = "search|triangulation", .help = "as in fpo-remesh"},
             a.surface.engine,
             {{"search", fpo::Engine::search}, {"triangulation", fpo::Engine::triangulation}});
  a.input = cli.parse(1, 1).front();
  a.surface.seed = cli.seed();
  return a;
}

void print_pieces(const char* what, const std::vector<geom::RestrictedPower::Change::Piece>& pieces) {
  std::printf("  fragments %s: %zu", what, pieces.size());
  for (const auto& [site, facet] : pieces) std::printf("  (cell %d, facet %d)", site.value, facet.value);
  std::printf("\n");
}

void print_circle(const geom::RestrictedPower& diagram, geom::CircleId id) {
  const geom::EmptyCircle& c = diagram.circle(id);
  std::printf("    circle %d  type %c  radius2 %.9g  in facet %d  sites", id.value,
              c.place == 0  ? 'C'
              : c.place < 4 ? 'B'
                            : 'A',
              c.radius2, c.facet.value);
  for (const SiteId s : c.sites)
    if (s.valid()) std::printf(" %d", s.value);
  std::printf("\n");
}

void print_change(const fpo::SurfaceDomain& domain) {
  const geom::RestrictedPower::Change& change = domain.last_change();
  std::printf("  cells touched: %zu ", change.cells.size());
  for (const SiteId s : change.cells) std::printf(" %d", s.value);
  std::printf("\n");
  print_pieces("erased", change.erased);
  print_pieces("cut or grown", change.cut);
  print_pieces("created", change.created);
  std::printf("  circles taken out of the heap: %zu ", change.circles_erased.size());
  for (const geom::CircleId c : change.circles_erased) std::printf(" %d", c.value);
  std::printf("\n  circles put into the heap: %zu\n", change.circles_created.size());
  for (const geom::CircleId c : change.circles_created) print_circle(domain.diagram(), c);
}

/// The moves before the one of interest, as fpo-remesh makes them.
void advance(fpo::SurfaceDomain& domain, std::size_t moves) {
  for (std::size_t k = 0; k < moves; ++k) {
    const SiteId x(k % domain.num_samples());
    domain.remove(x);
    const fpo::Circle c = domain.largest_empty(fpo::Scope::global);
    if (domain.is_farther(c, x))
      domain.insert_at(x, c);
    else
      domain.put_back(x);
  }
}

/// What is printed and drawn has the input's unit of length, so it is not scaled as in fpo-remesh.
geom::TriMesh read_surface(const std::filesystem::path& path) {
  const geom::TriMesh mesh = io::read_mesh(path);
  const double size = mesh.box().min().cwiseAbs().cwiseMax(mesh.box().max().cwiseAbs()).maxCoeff();
  geom::require(size >= 0x1p-40 && size <= 0x1p40,
                io::display_name(path) + ": the largest coordinate must be between 1e-12 and 1e12 here");
  return geom::scaled_to_unit_box(mesh, 1);
}

int trace(tools::CommandLine& cli) {
  const Arguments a = parse(cli);
  const geom::TriMesh mesh = read_surface(a.input);
  std::error_code error;
  std::filesystem::create_directories(a.folder, error);
  geom::require(!error, "cannot make " + a.folder.string() + ": " + error.message());
  fpo::SurfaceDomain domain(mesh, fpo::random_samples(mesh, a.n, cli.seed()), a.surface);
  advance(domain, a.move);

  const SiteId x(a.move % a.n);
  const fpo::SurfaceSample old = domain.sample(x);
  const double d = domain.separation(x);
  tools::TracePicture picture(mesh, old, 3 * fpo::hexagonal_spacing(mesh.area(), a.n));
  std::printf("move %zu: sample %d at (%.9g, %.9g, %.9g) in facet %d\n", a.move, x.value, old.position.x(),
              old.position.y(), old.position.z(), old.facet.value);
  const auto before = picture.draw(domain.diagram(), x, nullptr);

  domain.remove(x);
  std::printf("1 remove, 2 re-clip, 3 heap\n");
  print_change(domain);
  const fpo::Circle c = domain.largest_empty(fpo::Scope::global);
  std::printf("4 pick\n");
  if (c.id.valid()) print_circle(domain.diagram(), c.id);
  const bool moves = c.radius2 > d;
  std::printf("  r^2 = %.9g %s d_x^2 = %.9g: the sample %s\n", c.radius2, moves ? ">" : "<=", d,
              moves ? "moves there" : "goes back");
  const auto removed =
      picture.draw(domain.diagram(), x, c.id.valid() ? &domain.diagram().circle(c.id) : nullptr);

  if (moves)
    domain.insert_at(x, c);
  else
    domain.put_back(x);
  const geom::Vec3& p = domain.sample(x).position;
  std::printf("5 insert at (%.9g, %.9g, %.9g)\n", p.x(), p.y(), p.z());
  print_change(domain);
  const auto after = tools::TracePicture(mesh, domain.sample(x), 3 * fpo::hexagonal_spacing(mesh.area(), a.n))
                         .draw(domain.diagram(), x, nullptr);
  before.save(a.folder / "before");
  removed.save(a.folder / "removed");
  after.save(a.folder / "after");
  std::printf("wrote before, removed, after (.svg, .obj) in %s\n", a.folder.c_str());
  return tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-trace", argc, argv, trace); }
