// fpo-remesh --report: the page as text, and in a browser where there is one.

#include <cstdlib>
#include <sstream>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/html.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

using fixtures::nesting_fault;
using fixtures::occurrences;
using fixtures::ProgramResult;
using fixtures::ScratchFolder;

namespace {

/// A folder with a report of a cube in it: features, and all scenes.
struct ReportPlace {
  explicit ReportPlace(std::vector<std::string> more = {}, const std::string& shape = "cube") {
    io::write_mesh(folder / (shape + ".obj"), geom::make_shape(shape));
    std::vector<std::string> arguments{shape + ".obj", "-n",       "150",         "--iterations", "5", "-o",
                                       "out.obj",      "--report", "report.html", "--threads",    "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    result = fixtures::run_program("fpo-remesh", arguments, folder.path());
    REQUIRE_MESSAGE(result.code == 0, result.err);
    page = ScratchFolder::read(folder / "report.html");
  }
  ScratchFolder folder;
  ProgramResult result;
  std::string page;
};

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t first = at + begin.size();
  return text.substr(first, text.find(end, first) - first);
}

/// The path of a browser that prints what became of a page; empty: there is none.
std::string browser() {
  std::istringstream folders(std::getenv("PATH") ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
      const std::filesystem::path path = std::filesystem::path(folder) / name;
      std::error_code ignored;
      if (std::filesystem::exists(path, ignored)) return path.string();
    }
  }
  return "";
}

}  // namespace

TEST_CASE("fpo-remesh --report: well-formed, in one piece, of moderate size, the same again but for times") {
  const ReportPlace place, again;
  CHECK(nesting_fault(place.page) == "");
  CHECK(occurrences(place.page, "<figure class=\"scene\">") == 6);
  CHECK(occurrences(place.page, "<svg ") == 4);  // two histograms, convergence, spectrum
  CHECK(place.page.find("fpo-remesh cube.obj -n 150 --iterations 5") != std::string::npos);
  CHECK(fixtures::is_self_contained(place.page));
  CHECK(place.page.size() < 500'000);
  const auto without_times = [](std::string page) {
    const std::size_t at = page.find("seconds, threads"), end = page.find("</tr>", at);
    REQUIRE(end != std::string::npos);
    return page.erase(at, end - at);
  };
  CHECK(without_times(place.page) == without_times(again.page));
}

TEST_CASE("fpo-remesh --report: its figures are those of fpo-quality") {
  const ReportPlace place({"--sizing", "curvature"}, "torus");
  const ProgramResult quality = fixtures::run_program(
      "fpo-quality", {"out.obj", "--reference", "torus.obj", "--json"}, place.folder.path());
  REQUIRE(quality.code == 0);
  const std::string ours = between(place.page, "id=\"measures\">", "</script>");
  // After them fpo-quality tells the faults of the file.
  CHECK(quality.out.starts_with(ours.substr(0, ours.size() - 1) + ", \"border_loops\": 0"));
  CHECK(ours.find("\"dH_pct\": ") != std::string::npos);
}

TEST_CASE("fpo-remesh --report: refused before any work if it cannot be written or is another output") {
  const ReportPlace place;
  for (const char* name : {"out.obj", "none/report.html"}) {
    const ProgramResult result = fixtures::run_program(
        "fpo-remesh", {"cube.obj", "-n", "150", "-o", "out.obj", "--report", name}, place.folder.path());
    CHECK(result.code == 2);
    CHECK(result.lines_on_stderr() == 1);
  }
}

TEST_CASE("fpo-remesh --report: a browser draws all scenes without complaint") {
  const std::string program = browser();
  if (program.empty()) {
    fixtures::skip_announced() = true;
    MESSAGE("skipped: there is no chromium to open a report with");
    return;
  }
  const ReportPlace place;
  const ProgramResult result = fixtures::run_program(
      program,
      {"--headless=new", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--v=0",
       "--virtual-time-budget=5000", "--user-data-dir=" + (place.folder / "browser").string(), "--dump-dom",
       "file://" + (place.folder / "report.html").string()},
      place.folder.path());
  REQUIRE(result.code == 0);
  CHECK(result.out.find("data-drawn=\"6\"") != std::string::npos);
  CHECK(occurrences(result.out, "<canvas ") == 6);
  CHECK_MESSAGE(result.err.find("CONSOLE") == std::string::npos, result.err);
}
