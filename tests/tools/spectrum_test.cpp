// The built fpo-spectrum as its users meet it: exit codes, messages, files.

#include <cmath>
#include <map>
#include <sstream>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "io/points.h"
#include "io/values.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/sample_sets.h"
#include "tests/io/scratch_folder.h"

using fixtures::ProgramResult;
using fixtures::ScratchFolder;

namespace {

/// A folder with sets of samples in it, and the program run there.
struct SpectrumPlace {
  SpectrumPlace() {
    for (const int seed : {1, 2})
      io::write_points(folder / ("noise" + std::to_string(seed) + ".txt"),
                       fixtures::random_in_square(150, static_cast<std::uint64_t>(seed)));
    const geom::TriMesh sphere = geom::make_shape("sphere", 5);
    io::write_mesh(folder / "sphere.obj", sphere);
    io::write_points(folder / "on_sphere.xyz", fixtures::random_on(sphere, 150, 1));
    io::write_values(folder / "sizes.txt", std::vector<double>(sphere.num_vertices(), 0.5));
  }
  ProgramResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--radius", "4", "--max-frequency", "2"});
    return fixtures::run_program("fpo-spectrum", arguments, folder.path());
  }
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      result[entry.path().filename().string()] = ScratchFolder::read(entry.path());
    return result;
  }
  ScratchFolder folder;
};

struct Row {
  double frequency = 0, mean = 0, anisotropy = NAN;
};

/// A table as it was written, with its head checked.
std::vector<Row> rows(const std::string& table) {
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  CHECK(line == "frequency,radial_mean,anisotropy_db");
  std::vector<Row> result;
  while (std::getline(lines, line)) {
    Row row;
    const int read = std::sscanf(line.c_str(), "%lf,%lf,%lf", &row.frequency, &row.mean, &row.anisotropy);
    CHECK((read == 3 || (read == 2 && line.ends_with(","))));
    result.push_back(row);
  }
  return result;
}

double mean_power(const std::vector<Row>& table) {
  double sum = 0;
  for (const Row& r : table) sum += r.mean;
  return sum / static_cast<double>(table.size());
}

void spectrum_check_refused(const SpectrumPlace& place, const std::vector<std::string>& arguments,
                            const std::string& reason) {
  CAPTURE(reason);
  const auto before = place.files();
  const ProgramResult result = place.run(arguments);
  CHECK(result.code == 2);
  CHECK(result.out == "");
  CHECK(result.lines_on_stderr() == 1);
  CHECK_MESSAGE(result.err.find(reason) != std::string::npos, result.err);
  CHECK(place.files() == before);
}

}  // namespace

TEST_CASE("fpo-spectrum: white noise in the plane and on a sphere: a picture, and a table around 1") {
  const SpectrumPlace place;
  const std::vector<std::string> runs[] = {
      {"noise1.txt", "noise2.txt"},
      {"noise1.txt", "noise2.txt", "--bounded"},
      {"noise1.txt", "noise2.txt", "--periodogram"},
      {"noise1.txt", "--spacing", "local"},
      {"on_sphere.xyz", "--surface", "sphere.obj"},
      {"on_sphere.xyz", "--surface", "sphere.obj", "--sizes", "sizes.txt"},
  };
  for (std::vector<std::string> arguments : runs) {
    CAPTURE(arguments.back());
    arguments.insert(arguments.end(), {"-o", "out"});
    const ProgramResult result = place.run(arguments);
    CHECK(result.err == "");
    REQUIRE(result.code == 0);
    CHECK(result.out.find("wrote out.svg out.csv\n") != std::string::npos);
    const auto table = rows(ScratchFolder::read(place.folder / "out.csv"));
    REQUIRE(table.size() >= 14);
    CHECK(mean_power(table) == doctest::Approx(1).epsilon(0.12));
    const std::string picture = ScratchFolder::read(place.folder / "out.svg");
    CHECK(picture.starts_with("<svg"));
    CHECK(picture.ends_with("</svg>\n"));
    CHECK(picture.size() < 150'000);
    CHECK(picture.find("data:image/png;base64,") != std::string::npos);
    const std::size_t image = picture.find("base64,"), after = picture.find('"', image);
    CHECK((picture.substr(0, image) + picture.substr(after)).find("nan") == std::string::npos);
  }
}

TEST_CASE("fpo-spectrum: the table is the mean over the sets") {
  const SpectrumPlace place;
  for (const char* set : {"noise1", "noise2"})
    REQUIRE(place.run({std::string(set) + ".txt", "-o", set}).code == 0);
  REQUIRE(place.run({"noise1.txt", "noise2.txt", "-o", "both.svg"}).code == 0);
  const auto table = [&](const char* name) { return rows(ScratchFolder::read(place.folder / name)); };
  const auto one = table("noise1.csv"), two = table("noise2.csv"), both = table("both.csv");
  REQUIRE((one.size() == both.size() && two.size() == both.size()));
  for (std::size_t i = 0; i < both.size(); ++i) {
    CHECK(both[i].frequency == one[i].frequency);
    CHECK(both[i].mean == doctest::Approx((one[i].mean + two[i].mean) / 2).epsilon(1e-4));
  }
}

TEST_CASE("fpo-spectrum: any number of threads writes the same bytes; equal sizes are no sizes") {
  const SpectrumPlace place;
  const auto outputs = [&](std::vector<std::string> extra) {
    std::vector<std::string> arguments{"on_sphere.xyz", "--surface", "sphere.obj", "-o", "out"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    REQUIRE(place.run(arguments).code == 0);
    return std::pair(ScratchFolder::read(place.folder / "out.svg"),
                     ScratchFolder::read(place.folder / "out.csv"));
  };
  const auto one = outputs({"--threads", "1"});
  CHECK(outputs({"--threads", "3"}) == one);
  CHECK(outputs({"--spacing", "uniform"}) == one);
}

TEST_CASE("fpo-spectrum: the vertices of a mesh, on another surface or on its own") {
  const SpectrumPlace place;
  CHECK(place.run({"sphere.obj", "-o", "own"}).code == 0);
  CHECK(place.run({"sphere.obj", "--surface", "sphere.obj", "-o", "given"}).code == 0);
  CHECK(ScratchFolder::read(place.folder / "own.csv") == ScratchFolder::read(place.folder / "given.csv"));
}

TEST_CASE("fpo-spectrum: bad use and bad input are refused in one line, with nothing written") {
  const SpectrumPlace place;
  place.folder.write("one.txt", "0.5 0.5\n");
  place.folder.write("far.txt", "0.5 0.5\n0.25 3\n");
  place.folder.write("word.txt", "0.5 0.5\n0.25 x\n");
  place.folder.write("short.txt", "1\n2\n");
  spectrum_check_refused(place, {"-o", "out"}, "POINTS");
  spectrum_check_refused(place, {"noise1.txt"}, "-o");
  spectrum_check_refused(place, {"absent.txt", "-o", "out"}, "absent.txt");
  spectrum_check_refused(place, {"noise1.txt", "-o", "no/such/out"}, "cannot write");
  spectrum_check_refused(place, {"one.txt", "-o", "out"}, "one.txt: a spectrum needs two samples");
  spectrum_check_refused(place, {"word.txt", "-o", "out"}, "word.txt:2");
  spectrum_check_refused(place, {"far.txt", "--bounded", "-o", "out"}, "far.txt: a sample lies outside");
  spectrum_check_refused(place, {"noise1.txt", "--spacing", "weights", "-o", "out"}, "positive");
  spectrum_check_refused(place, {"noise1.txt", "--spacing", "some", "-o", "out"}, "'some'");
  spectrum_check_refused(place, {"noise1.txt", "--period", "2", "-o", "out"}, "WIDTHxHEIGHT");
  spectrum_check_refused(place, {"noise1.txt", "-o", "out", "--radius", "1"}, "radius");
  spectrum_check_refused(place, {"noise1.txt", "--surface", "sphere.obj", "-o", "out"}, "--surface");
  spectrum_check_refused(place, {"noise1.txt", "sphere.obj", "-o", "out"}, "do not mix");
  spectrum_check_refused(place, {"noise1.txt", "--bounded", "--periodogram", "-o", "out"}, "--periodogram");
  spectrum_check_refused(place, {"noise1.txt", "far.txt", "--periodogram", "-o", "out"}, "equally many");
  spectrum_check_refused(place, {"on_sphere.xyz", "-o", "out"},
                         "on_sphere.xyz: points in space need --surface");
  spectrum_check_refused(place, {"sphere.obj", "--bounded", "-o", "out"}, "--bounded");
  spectrum_check_refused(place, {"sphere.obj", "--sizes", "sizes.txt", "-o", "out"}, "--sizes");
  spectrum_check_refused(
      place, {"on_sphere.xyz", "--surface", "sphere.obj", "--sizes", "short.txt", "-o", "out"}, "short.txt");
}
