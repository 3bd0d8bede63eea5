// fpo-trace: one move of Algorithm 1 in slow motion.

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <tuple>

#include "fpo/surface/surface_domain.h"
#include "geom/mesh/scaling.h"
#include "geom/rng.h"
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

using Pieces = std::vector<geom::RestrictedPower::Canonical>;

void print_pieces(const char* what, const Pieces& pieces) {
  std::printf("  fragments %s: %zu", what, pieces.size());
  for (const auto& piece : pieces) std::printf("  (cell %d, facet %d)", piece.site.value, piece.facet.value);
  std::printf("\n");
}

/// Which fragments of one diagram are not in the other, cut or not.
Pieces pieces_without(const Pieces& all, const Pieces& without) {
  const auto place = [](const geom::RestrictedPower::Canonical& piece) {
    return std::tie(piece.facet, piece.site);
  };
  Pieces result;
  std::ranges::set_difference(all, without, std::back_inserter(result), {}, place, place);
  return result;
}

/// Those of the second that are in the first with other labels.
Pieces pieces_cut(const Pieces& before, const Pieces& after) {
  Pieces result;
  std::ranges::set_difference(after, before, std::back_inserter(result));
  const Pieces created = pieces_without(after, before);
  std::erase_if(result, [&](const auto& piece) { return std::ranges::binary_search(created, piece); });
  return result;
}

void print_circle(const geom::RestrictedDual& dual, geom::CircleId id) {
  const geom::EmptyCircle& c = dual.circle(id);
  std::printf("    circle %d  type %c  radius2 %.9g  in facet %d  sites", id.value,
              c.place == 0  ? 'C'
              : c.place < 4 ? 'B'
                            : 'A',
              c.radius2, c.facet.value);
  for (const SiteId s : c.sites)
    if (s.valid()) std::printf(" %d", s.value);
  std::printf("\n");
}

void print_change(const fpo::SurfaceDomain& domain, const Pieces& before, const Pieces& after) {
  const geom::RestrictedDual::Change& change = domain.last_change();
  print_pieces("erased", pieces_without(before, after));
  print_pieces("cut or grown", pieces_cut(before, after));
  print_pieces("created", pieces_without(after, before));
  std::printf("  circles taken out of the heap: %zu ", change.circles_erased.size());
  for (const geom::CircleId c : change.circles_erased) std::printf(" %d", c.value);
  std::printf("\n  circles put into the heap: %zu\n", change.circles_created.size());
  for (const geom::CircleId c : change.circles_created) print_circle(domain.dual(), c);
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
  std::unique_ptr<geom::RestrictedPower> diagram = domain.diagram();
  const auto before = picture.draw(*diagram, x, nullptr);
  const Pieces with_x = diagram->canonical();

  domain.remove(x);
  std::printf("1 remove, 2 re-clip, 3 heap\n");
  diagram = domain.diagram();
  const Pieces without_x = diagram->canonical();
  print_change(domain, with_x, without_x);
  const fpo::Circle c = domain.largest_empty(fpo::Scope::global);
  std::printf("4 pick\n");
  if (c.id.valid()) print_circle(domain.dual(), c.id);
  const bool moves = c.radius2 > d;
  std::printf("  r^2 = %.9g %s d_x^2 = %.9g: the sample %s\n", c.radius2, moves ? ">" : "<=", d,
              moves ? "moves there" : "goes back");
  const auto removed = picture.draw(*diagram, x, c.id.valid() ? &domain.dual().circle(c.id) : nullptr);

  if (moves)
    domain.insert_at(x, c);
  else
    domain.put_back(x);
  const geom::Vec3& p = domain.sample(x).position;
  std::printf("5 insert at (%.9g, %.9g, %.9g)\n", p.x(), p.y(), p.z());
  diagram = domain.diagram();
  print_change(domain, without_x, diagram->canonical());
  const auto after = tools::TracePicture(mesh, domain.sample(x), 3 * fpo::hexagonal_spacing(mesh.area(), a.n))
                         .draw(*diagram, x, nullptr);
  before.save(a.folder / "before");
  removed.save(a.folder / "removed");
  after.save(a.folder / "after");
  std::printf("wrote before, removed, after (.svg, .obj) in %s\n", a.folder.c_str());
  return tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-trace", argc, argv, trace); }
