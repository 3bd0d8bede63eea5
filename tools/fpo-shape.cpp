// fpo-shape: writes a synthetic surface.

#include <cstdio>
#include <string>

#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tools/cli.h"

namespace {

void print_list() {
  std::printf("%-13s %-8s %-6s %-6s %s\n", "name", "size", "Euler", "loops", "what");
  for (const geom::ShapeInfo& shape : geom::shape_table()) {
    std::printf("%-13.*s %-8d %-6ld %-6zu %.*s\n", static_cast<int>(shape.name.size()), shape.name.data(),
                shape.size, shape.euler, shape.boundary_loops, static_cast<int>(shape.what.size()),
                shape.what.data());
  }
}

int make_shape(tools::CommandLine& cli) {
  int size = 0;
  bool tilt = false, list = false;
  std::filesystem::path output;
  cli.describe("NAME", "Writes a synthetic surface as a triangle mesh. --list names the shapes.");
  cli.integer(
      {.name = "size", .value = "K", .help = "fineness: facets grow as K^2", .standard = "see --list"}, size,
      1, 4000);
  cli.flag({.name = "tilt", .help = "turn it, so that no flat side is parallel to an axis"}, tilt);
  cli.path({.name = "output", .letter = 'o', .value = "OUT", .help = "the mesh: .obj .off .ply .stl"},
           output);
  cli.flag({.name = "list", .help = "list the shapes: default size, Euler number, boundary loops"}, list);
  const std::vector<std::string> operands = cli.parse(0, 1);

  if (list) {
    print_list();
    return tools::exit_done;
  }
  if (operands.empty()) throw tools::UsageError("NAME is missing; --list names the shapes");
  if (output.empty()) throw tools::UsageError("-o OUT is missing");
  geom::shape_info(operands[0]);
  io::mesh_format(output);
  geom::TriMesh mesh = geom::make_shape(operands[0], size, cli.seed());
  if (tilt) mesh = geom::tilted(mesh);
  io::write_mesh(output, mesh);
  std::printf("%s: %zu vertices, %zu facets\n", output.c_str(), mesh.num_vertices(), mesh.num_facets());
  return tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-shape", argc, argv, make_shape); }
