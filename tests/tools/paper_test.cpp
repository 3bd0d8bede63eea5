// The built fpo-paper on a folder with a single, small model.

#include <cstdio>
#include <sstream>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/html.h"
#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

using fixtures::occurrences;
using fixtures::ProgramResult;
using fixtures::ScratchFolder;

namespace {

/// A surface by the name of one of the paper's models.
struct PaperPlace {
  explicit PaperPlace(const std::string& shape) {
    std::filesystem::create_directories(folder / "models");
    io::write_mesh(folder / "models/EIGHT.off", geom::make_shape(shape));
    folder.write("models/eightfold.obj", "no mesh, and no model of the paper");
  }
  ProgramResult run(std::vector<std::string> arguments) const {
    for (const char* more : {"models", "-o", "out", "--iterations", "1", "--no-runtimes", "--quiet"})
      arguments.push_back(more);
    return fixtures::run_program("fpo-paper", arguments, folder.path());
  }
  std::string read(const std::string& name) const { return ScratchFolder::read(folder / name); }
  ScratchFolder folder;
};

/// The cells of the first line that contains these words, without the last one, the seconds.
std::vector<std::string> cells(const std::string& table, const std::string& words) {
  const std::size_t at = table.find(words);
  if (at == std::string::npos) return {};
  const std::size_t begin = table.rfind('\n', at) + 1;
  std::istringstream line(table.substr(begin, table.find('\n', at) - begin));
  std::vector<std::string> result;
  for (std::string cell; std::getline(line, cell, '|');) {
    std::erase_if(cell, [](char c) { return c == '*' || c == ' '; });
    result.push_back(cell);
  }
  if (result.size() > 1) result.pop_back();
  return result;
}

double value(const std::string& output, const std::string& name) {
  const std::size_t at = ("\n" + output).find("\n" + name + " ");
  REQUIRE(at != std::string::npos);
  return std::stod(output.substr(at + name.size() + 1));
}

}  // namespace

TEST_CASE(
    "fpo-paper: our rows are what fpo-remesh and fpo-quality give, beside the paper's; the rest is missing") {
  const PaperPlace place("torus");
  const ProgramResult result =
      place.run({"--sets", "1", "--radius", "3", "--threads", "2", "--methods", "ccst,ser,FPO"});
  REQUIRE_MESSAGE(result.code == 0, result.err);
  CHECK(result.out.find("missing Eight") == std::string::npos);
  for (const char* name :
       {"Venus", "Homer", "Genus", "Bunny", "Kitten", "Elephant", "Triceratops", "Mask", "Joint"})
    CHECK(result.out.find(std::string("missing ") + name + "\n") != std::string::npos);
  CHECK(result.out.find("rows 3\nspectra 3\n") != std::string::npos);

  const std::string page = place.read("out/index.html"), table = place.read("out/tables.md");
  CHECK(fixtures::nesting_fault(page) == "");
  CHECK(fixtures::is_self_contained(page));
  CHECK(occurrences(page, "<svg ") == 8);  // of each method a remesh and a spectrum; all means; convergence
  CHECK(occurrences(table, "Venus 1700") == 1);  // folded
  CHECK(occurrences(table, "Bunny 6300") == 1);
  CHECK(cells(table, "paper: FPO")[4] == "0.561");

  REQUIRE(fixtures::run_program("fpo-remesh",
                                {"models/EIGHT.off", "-n", "1700", "--iterations", "1", "-o", "r.obj"},
                                place.folder.path())
              .code == 0);
  const ProgramResult quality =
      fixtures::run_program("fpo-quality", {"r.obj", "--reference", "models/EIGHT.off"}, place.folder.path());
  const std::vector<std::string> ours = cells(table, "ours: FPO");
  REQUIRE(ours.size() == 12);
  const char* names[] = {"Qmin",      "Qavg",           "theta_min", "theta_min_avg",
                         "theta_max", "theta_lt30_pct", "V567_pct",  "dH_pct"};
  const int digits[] = {3, 3, 2, 2, 2, 3, 1, 2};
  for (std::size_t i = 0; i < 8; ++i) {
    CAPTURE(names[i]);
    char expected[32];
    std::snprintf(expected, sizeof expected, "%.*f", digits[i], value(quality.out, names[i]));
    CHECK(ours[i + 4] == expected);
  }
}

TEST_CASE("fpo-paper: any number of threads gives the same rows") {
  const PaperPlace place("cube");
  const auto rows = [&](const char* threads) {
    REQUIRE(place.run({"--no-spectra", "--no-convergence", "--methods", "fpo,ser,hps", "--threads", threads})
                .code == 0);
    const std::string table = place.read("out/tables.md");
    return std::pair(cells(table, "ours: SER"), cells(table, "ours: FPO"));
  };
  const auto once = rows("1");
  CHECK(once.first.size() == 12);
  CHECK(rows("3") == once);
}

TEST_CASE("fpo-paper: it has the nine methods of table 1; another one is refused in one line") {
  const PaperPlace place("cube");
  const ProgramResult result = place.run({"--methods", "fpo,lattice"});
  CHECK(result.code == 2);
  CHECK(result.lines_on_stderr() == 1);
  CHECK(result.err.find("'LATTICE'") != std::string::npos);
  for (const char* name : {"CVT", "CPS", "PPS", "MPS", "CCST", "VBS", "HPS", "SER", "FPO"})
    CHECK(result.err.find(name) != std::string::npos);
}

TEST_CASE("fpo-paper: a folder without models or that is not there is refused in one line") {
  const PaperPlace place("cube");
  std::filesystem::remove(place.folder / "models/EIGHT.off");
  ProgramResult result = place.run({});
  CHECK(result.code == 2);
  CHECK(result.lines_on_stderr() == 1);
  CHECK(result.err.find("none of the paper's models is there") != std::string::npos);
  std::filesystem::remove_all(place.folder / "models");
  result = place.run({});
  CHECK(result.code == 2);
  CHECK(result.lines_on_stderr() == 1);
  CHECK(!std::filesystem::exists(place.folder / "out/index.html"));
}
