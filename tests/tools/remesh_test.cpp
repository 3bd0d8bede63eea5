// The built fpo-remesh as its users meet it: exit codes, messages, files.

#include <csignal>
#include <functional>
#include <map>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/program.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/scratch_folder.h"

using fixtures::ProgramResult;
using fixtures::ScratchFolder;

namespace {

/// A folder with a sound surface in it, and the program run there.
struct RemeshPlace {
  RemeshPlace() { io::write_mesh(folder / "torus.obj", geom::make_shape("torus")); }

  ProgramResult run(const std::vector<std::string>& arguments,
                    const fixtures::Interruption& interruption = {}) const {
    return fixtures::run_program("fpo-remesh", arguments, folder.path(), 60, {.interruption = interruption});
  }
  /// Every file, by name.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      if (entry.is_regular_file())
        result[entry.path().filename().string()] = ScratchFolder::read(entry.path());
    return result;
  }
  ScratchFolder folder;
};

/// Exit code 2, one line on stderr that contains `reason`, nothing on stdout, no file written or touched.
void remesh_check_refused(const RemeshPlace& place, const std::vector<std::string>& arguments,
                          const std::string& reason) {
  std::string line;
  for (const std::string& argument : arguments) line += argument + " ";
  CAPTURE(line);
  const auto before = place.files();
  const ProgramResult result = place.run(arguments);
  CHECK(result.code == 2);
  CHECK(result.out == "");
  CHECK(result.err.starts_with("fpo-remesh: "));
  CHECK(result.lines_on_stderr() == 1);
  CHECK_MESSAGE(result.err.find(reason) != std::string::npos, result.err);
  CHECK(place.files() == before);
}

void check_mesh_refused(const RemeshPlace& place, const std::string& name, const std::string& bytes,
                        const std::string& reason) {
  place.folder.write(name, bytes);
  remesh_check_refused(place, {name, "-n", "50", "-o", "out.obj"}, reason);
}

const std::string header = "property float x\nproperty float y\nproperty float z\n";

}  // namespace

TEST_CASE("fpo-remesh: bad input is refused in one line, and nothing is written") {
  const RemeshPlace place;
  const auto tetrahedron = fixtures::tetrahedron();
  remesh_check_refused(place, {"none.obj", "-n", "50", "-o", "out.obj"}, "none.obj: no such file");
  check_mesh_refused(place, "empty.ply", "", "empty.ply: the file is empty");
  check_mesh_refused(place, "odd.xyz", "0 0 0\n", "unknown extension '.xyz'");
  check_mesh_refused(place, "cut.ply",
                     "ply\nformat ascii 1.0\nelement vertex 3\n" + header +
                         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n",
                     "cut.ply:");
  io::write_mesh(place.folder / "whole.ply", tetrahedron);
  const std::string binary = ScratchFolder::read(place.folder / "whole.ply");
  for (const std::size_t left : {binary.size() - 1, binary.size() - 20, binary.size() / 2})
    check_mesh_refused(place, "part.ply", binary.substr(0, left), "part.ply");
  check_mesh_refused(place, "nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", "nan.obj:2:");
  check_mesh_refused(place, "inf.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 inf 0\n3 0 1 2\n", "inf.off:5:");
  check_mesh_refused(place, "range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "range.obj:4:");
  check_mesh_refused(place, "bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "bare.obj: no facets");
  check_mesh_refused(place, "line.obj", "v 0 0 0\nv 1 2 3\nv 2 4 6\nf 1 2 3\n", "the surface has no area");
}

TEST_CASE(
    "fpo-remesh: a facet no wider than rounding is refused for what its samples make, not for bad data") {
  const RemeshPlace place;  // three times .1 is not .3
  check_mesh_refused(place, "line.obj", "v 0 0 0\nv .1 .2 .7\nv .3 .6 2.1\nf 1 2 3\n",
                     "line.obj: the surface is thinner than the spacing of 50 samples");
}

TEST_CASE("fpo-remesh: where the format cannot hold the remesh nothing else is written") {
  const RemeshPlace place;
  std::ofstream(place.folder / "tiny.obj")
      << "v 0 0 0\nv 1e-40 0 0\nv 0 1e-40 0\nv 0 0 1e-40\nf 1 3 2\nf 1 2 4\n"
         "f 2 3 4\nf 3 1 4\n";
  for (const std::string option : {"-o", "--repaired"}) {
    const ProgramResult result = place.run({"tiny.obj", "-n", "30", "--iterations", "2", "--points", "p.xyz",
                                            "--picture", "p.svg", option, "t.stl"});
    CHECK(result.code == 2);
    CHECK(result.lines_on_stderr() == 1);
    CHECK(result.err.find("too small for STL") != std::string::npos);
    for (const char* name : {"p.xyz", "p.svg", "t.stl"}) CHECK(!std::filesystem::exists(place.folder / name));
  }
}

TEST_CASE("fpo-remesh: no output is written under a name that says another format") {
  const RemeshPlace place;
  const auto refused = [&](const std::string& option, const std::string& name, const std::string& endings) {
    const std::string unknown = std::filesystem::path(name).extension().string();
    remesh_check_refused(
        place, {"torus.obj", "-n", "50", "-o", "out.obj", option, name},
        option + ": " + name + ": unknown extension '" + unknown + "' (use " + endings + ")");
  };
  refused("--picture", "x.png", ".svg");
  refused("--rpd", "y.ply", ".obj");
  refused("--report", "r.pdf", ".html or .htm");
  refused("--map", "m.ply", ".txt");
  refused("--sizing-out", "s.obj", ".txt or .ply");
  refused("--log", "l.json", ".csv or .txt");
}

TEST_CASE("fpo-remesh: bad use is refused in one line, and nothing is written") {
  const RemeshPlace place;
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& reason) {
    remesh_check_refused(place, arguments, reason);
  };
  refused({"torus.obj", "-n", "0", "-o", "out.obj"}, "-n: 0 is not between 1 and");
  refused({"torus.obj", "-n", "1000000000", "-o", "out.obj"}, "-n: 1000000000 is not between 1 and");
  refused({"torus.obj", "-n", "many", "-o", "out.obj"}, "-n: 'many' is not a whole number");
  refused({"torus.obj", "-n", "1", "-o", "out.obj"}, "1 sample is too few");
  refused({"torus.obj", "-n", "50", "-o", "none/out.obj"}, "cannot write none/out.obj: ");
  refused({"torus.obj", "-n", "50", "-o", "."}, ".");
  refused({"torus.obj", "-n", "50", "-o", "/proc/out.obj"}, "cannot write /proc/out.obj: ");
  refused({"torus.obj", "-n", "50", "-o", "out.obj", "--rpd", "none/rpd.obj"}, "cannot write none/rpd.obj: ");
  refused({"torus.obj", "-n", "50", "-o", "out.xyz"}, "unknown extension '.xyz'");
  refused({"torus.obj", "-n", "50", "-o", "out"}, "no extension");
  refused({"torus.obj", "-n", "50", "-o", "out.obj", "--points", "p.txt"}, "p.txt: use .xyz or .ply");
  refused({"torus.obj", "-n", "50", "-o", "out.obj", "--bluer"}, "unknown option --bluer");
  refused({"torus.obj", "-n", "50", "-o", "out.obj", "--engine", "guess"}, "--engine: 'guess' is none of");
  refused({"torus.obj", "-n", "50", "-o", "out.obj", "--threads", "0"}, "--threads: 0 is not between");
  refused({"torus.obj", "-n", "50", "-o", "out.obj", "--tiles", "5"}, "5 is not between 100 and");
  refused({"torus.obj", "-n", "50", "-o", "out.obj", "--tiles", "on"}, "'on' is not a number");
  refused({"torus.obj", "-n", "50", "-o", "out.obj", "--tiles", "100.7"}, "must be a whole number: 100.7");
  refused({"torus.obj", "-n", "50"}, "-o OUT is missing");
  refused({"-n", "50", "-o", "out.obj"}, "INPUT is missing");
}

TEST_CASE("fpo-remesh: an output of a failed run keeps what was there before") {
  const RemeshPlace place;
  place.folder.write("out.obj", "precious");
  remesh_check_refused(place, {"none.obj", "-n", "50", "-o", "out.obj"}, "no such file");
  remesh_check_refused(place, {"torus.obj", "-n", "1", "-o", "out.obj"}, "too few");
}

TEST_CASE("fpo-remesh: interrupted in the middle, it writes a mesh of exactly n vertices") {
  const RemeshPlace place;
  for (const int signal : {SIGINT, SIGTERM}) {
    CAPTURE(signal);
    const ProgramResult result = place.run({"torus.obj", "-n", "500", "-o", "out.ply", "--points", "out.xyz",
                                            "--iterations", "1000000", "--target-delta", "2"},
                                           {signal, 0.6});  // a loaded machine is slow to begin
    CHECK(result.code == 130);
    CHECK(result.out.find("stopped interrupted") != std::string::npos);
    const geom::TriMesh mesh = io::read_mesh(place.folder / "out.ply");
    CHECK(mesh.num_vertices() == 500);
    CHECK(geom::topology(mesh).unreferenced_vertices == 0);
    const std::string points = ScratchFolder::read(place.folder / "out.xyz");
    CHECK(std::ranges::count(points, '\n') == 500);
    CHECK(place.files().size() == 3);  // the input and two outputs: no temporary is left
    std::filesystem::remove(place.folder / "out.ply");
    std::filesystem::remove(place.folder / "out.xyz");
  }
}

TEST_CASE("fpo-remesh: the same bytes again, from either engine and with any number of threads") {
  const RemeshPlace place;
  const auto outputs = [&](std::vector<std::string> extra) {
    std::vector<std::string> arguments{"torus.obj", "-n",        "250",      "--iterations", "8",
                                       "-o",        "out.obj",   "--points", "p.xyz",        "--rpd",
                                       "rpd.obj",   "--picture", "out.svg",  "--log",        "log.csv"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    const ProgramResult result = place.run(arguments);
    CHECK(result.code == 0);
    CHECK(result.err == "");
    auto files = place.files();
    // The last column of the log is a time.
    std::string log;
    for (std::size_t at = 0; at < files["log.csv"].size();) {
      const std::size_t end = files["log.csv"].find('\n', at);
      log += files["log.csv"].substr(at, files["log.csv"].rfind(',', end) - at) + "\n";
      at = end + 1;
    }
    files["log.csv"] = log;
    CHECK(files.size() == 6);
    for (const char* name : {"out.obj", "p.xyz", "rpd.obj", "out.svg", "log.csv"})
      std::filesystem::remove(place.folder / name);
    return files;
  };
  const auto in_one_piece = outputs({});
  CHECK(outputs({"--tiles", "auto"}) == in_one_piece);
  for (const std::string tiles : {"off", "100"}) {
    CAPTURE(tiles);
    const auto once = outputs({"--tiles", tiles});
    CHECK((once == in_one_piece) == (tiles != "100"));
    CHECK(once.at("rpd.obj").find("g cell_249\n") != std::string::npos);
    CHECK(outputs({"--tiles", tiles}) == once);
    CHECK(outputs({"--tiles", tiles, "--engine", "triangulation"}) == once);
    CHECK(outputs({"--tiles", tiles, "--engine", "triangulation", "--threads", "2"}) == once);
    CHECK(outputs({"--tiles", tiles, "--threads", "1"}) == once);
    CHECK(outputs({"--tiles", tiles, "--threads", "3"}) == once);
    CHECK(outputs({"--tiles", tiles, "--seed", "2"}) != once);
  }
}
