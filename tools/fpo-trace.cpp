// fpo-trace: one move of Algorithm 1 in slow motion.

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "fpo/surface/surface_removal.h"
#include "geom/mesh/scaling.h"
#include "io/atomic_file.h"
#include "io/input_file.h"
#include "tools/cli.h"
#include "tools/surface_input.h"
#include "tools/trace_picture.h"

namespace {

using geom::SiteId;

struct Arguments {
  std::filesystem::path input, folder;
  std::size_t n = 0, move = 0;
  fpo::SurfaceOptions surface;
  tools::RepairArguments repair;
};

Arguments parse(tools::CommandLine& cli) {
  Arguments a;
  cli.describe("INPUT", "Runs the optimization up to one move, then shows how that one goes.");
  cli.integer(
      {.name = "count", .letter = 'n', .value = "COUNT", .help = "number of samples", .required = true}, a.n,
      2, 20'000'000);
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
  tools::declare_repair(cli, a.repair);
  a.input = cli.parse(1, 1).front();
  tools::check_repair(a.repair);
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

const char* type_of(const geom::EmptyCircle& c) { return c.place == 0 ? "C" : c.place < 4 ? "B" : "A"; }

void print_circle(const geom::EmptyCircle& c) {
  std::printf("  type %s  radius2 %.9g  in facet %d  sites", type_of(c), c.radius2, c.facet.value);
  for (const SiteId s : c.sites)
    if (s.valid()) std::printf(" %d", s.value);
  std::printf("\n");
}

void print_circles(const char* what, const geom::RestrictedDual& dual, std::span<const geom::CircleId> ids) {
  std::printf("  circles %s: %zu\n", what, ids.size());
  for (const geom::CircleId c : ids) {
    std::printf("    circle %d", c.value);
    print_circle(dual.circle(c));
  }
}

/// Allows every move, and tells one of them as it goes.
class Narrator final : public fpo::MoveGuard, public fpo::Follower<geom::DualChange> {
 public:
  /// From now on. d2: d_x^2 of the sample that will be moved.
  void listen(fpo::SurfaceDomain& domain, double d2) {
    domain_ = &domain;
    d2_ = d2;
    domain.followers().add(*this);
  }

  bool may_vacate(fpo::SurfaceRemoval& removal, fpo::Scope scope) override {
    if (!domain_) return true;
    std::printf("1 remove: %s\n", removal.is_planned() ? "planned, nothing is changed yet" : "carried out");
    std::printf("  heirs, who win something of the cell:");
    for (const SiteId y : removal.heirs()) std::printf(" %d", y.value);
    std::printf("\n");
    if (removal.is_planned()) {
      std::printf("  circles that the hole would have: %zu\n", removal.planned_circles().size());
      for (const geom::EmptyCircle& c : removal.planned_circles()) std::printf("   "), print_circle(c);
    }
    std::printf("2 pick\n");
    const bool can_tell = removal.find_largest(scope);
    if (!can_tell) {
      std::printf("  a circle of the sample itself may be the largest: the removal must be carried out\n");
      return true;
    }
    const geom::EmptyCircle* c = removal.largest();
    if (c) std::printf("   "), print_circle(*c);
    const bool moves = c && c->radius2 > d2_;
    std::printf("  r^2 = %.9g %s d_x^2 = %.9g: the sample %s\n", c ? c->radius2 : 0, moves ? ">" : "<=", d2_,
                moves ? "moves there" : "stays");
    return true;
  }
  bool offers(const geom::EmptyCircle&, const geom::WeightedPoint3&) const override { return true; }
  bool may_keep(fpo::SurfaceDomain&, SiteId, const geom::EmptyCircle&) override { return true; }

  void follow(const geom::DualChange& change) override {
    const geom::RestrictedDual& dual = domain_->dual();
    std::printf("the diagram and the heap change\n");
    print_circles("vacated, or in conflict with the sample's new place", dual, change.circles_erased);
    print_circles("moved with their sites", dual, change.circles_moved);
    print_circles("made", dual, change.circles_created);
  }

 private:
  fpo::SurfaceDomain* domain_ = nullptr;
  double d2_ = 0;
};

/// How often which way was taken in between.
void print_way(const geom::DualWays& before, const geom::DualWays& after) {
  std::printf("the way:");
  const auto print = [](const char* name, std::size_t times) {
    if (times > 0) std::printf(" %s", name);
  };
  print("in place", after.in_place - before.in_place);
  print("with-leeway", after.with_leeway - before.with_leeway);
  print("fast-removal", after.fast_removals - before.fast_removals);
  print("general-removal", after.general_removals - before.general_removals);
  print("fast-insertion", after.fast_insertions - before.fast_insertions);
  print("general-insertion", after.general_insertions - before.general_insertions);
  std::printf("\n");
}

/// What is printed and drawn has the input's unit of length, so it is not scaled as in fpo-remesh.
geom::TriMesh read_surface(const Arguments& a) {
  const std::filesystem::path& path = a.input;
  tools::SurfaceInput input = tools::read_surface(path, a.repair);
  const geom::TriMesh& mesh = input.mesh;
  const double size = mesh.box().min().cwiseAbs().cwiseMax(mesh.box().max().cwiseAbs()).maxCoeff();
  geom::require(size >= 0x1p-40 && size <= 0x1p40,
                io::display_name(path) + ": the largest coordinate must be between 1e-12 and 1e12 here");
  tools::print_notes(input);
  return geom::scaled_to_unit_box(mesh, 1);
}

void print_pieces_changed(const Pieces& before, const Pieces& after) {
  print_pieces("erased", pieces_without(before, after));
  print_pieces("cut or grown", pieces_cut(before, after));
  print_pieces("created", pieces_without(after, before));
}

/// The picture of what the move goes by, even if only planned: the diagram without x, its largest circle.
tools::TracePicture::Drawing without(const fpo::SurfaceDomain& domain, SiteId x,
                                     const tools::TracePicture& picture, const std::string& title) {
  fpo::SurfaceDomain copy = domain.rebuilt();
  copy.remove(x);
  const fpo::Circle c = copy.largest_empty(fpo::Scope::global);
  return picture.draw(*copy.diagram(), x, c.id.valid() ? &copy.dual().circle(c.id) : nullptr, title);
}

int trace(tools::CommandLine& cli) {
  const Arguments a = parse(cli);
  const geom::TriMesh mesh = read_surface(a);
  std::error_code error;
  std::filesystem::create_directories(a.folder, error);
  geom::require(!error, "cannot make " + a.folder.string() + ": " + error.message());
  Narrator narrator;
  const fpo::Sizing sizing = fpo::Sizing::uniform(fpo::hexagonal_spacing(mesh.area(), a.n));
  fpo::SurfaceDomain domain(mesh, sizing, fpo::random_samples(mesh, a.n, cli.seed()), a.surface, &narrator);
  for (std::size_t k = 0; k < a.move; ++k) domain.move(SiteId(k % a.n), fpo::Scope::global);

  const SiteId x(a.move % a.n);
  const fpo::SurfaceSample old = domain.sample(x);
  const double radius = 3 * fpo::hexagonal_spacing(mesh.area(), a.n);
  const tools::TracePicture here(mesh, old, radius);
  const std::string title = "Move " + std::to_string(a.move) + " of sample " + std::to_string(x.value) + ", ";
  std::printf("move %zu: sample %d at (%.9g, %.9g, %.9g) in facet %d\n", a.move, x.value, old.position.x(),
              old.position.y(), old.position.z(), old.facet.value);
  const std::unique_ptr<geom::RestrictedPower> diagram = domain.diagram();
  std::vector<std::pair<std::string, tools::TracePicture::Drawing>> drawings;  // written when all are made
  drawings.emplace_back("before", here.draw(*diagram, x, nullptr, title + "before: its old place"));
  drawings.emplace_back("removed", without(domain, x, here, title + "the sample is out: its old place"));

  const geom::DualWays ways = domain.dual().ways();
  narrator.listen(domain, domain.separation(x));
  domain.move(x, fpo::Scope::global);
  print_way(ways, domain.dual().ways());
  const fpo::SurfaceSample now = domain.sample(x);
  const geom::Vec3& p = now.position;
  std::printf("3 the sample is at (%.9g, %.9g, %.9g)\n", p.x(), p.y(), p.z());
  const std::unique_ptr<geom::RestrictedPower> diagram_after = domain.diagram();
  print_pieces_changed(diagram->canonical(), diagram_after->canonical());
  drawings.emplace_back("after", here.draw(*diagram_after, x, nullptr, title + "after: its old place"));
  const bool stays = p == old.position;
  if (!stays) {
    const tools::TracePicture there(mesh, now, radius);
    drawings.emplace_back("there-before", there.draw(*diagram, x, nullptr, title + "before: its new place"));
    drawings.emplace_back("there-after",
                          there.draw(*diagram_after, x, nullptr, title + "after: its new place"));
  }
  for (const auto& [name, drawing] : drawings) drawing.save(a.folder / name);
  std::printf("wrote before, removed, after%s (.svg, .obj) in %s\n",
              stays ? "" : ", there-before, there-after", a.folder.c_str());
  return tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-trace", argc, argv, trace); }
