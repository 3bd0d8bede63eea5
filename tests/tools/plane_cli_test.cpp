// fpo-plane as a user runs it: exit codes, what is written and what is not.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "doctest.h"
#include "tests/io/scratch_folder.h"

using fixtures::ScratchFolder;

namespace {

struct PlaneCliOutcome {
  int code = -1;  ///< exit code, or -signal
  std::string out, err;
};

/// True as soon as the process is the program and handles SIGINT (so that it is not killed while it starts).
bool handles_interrupt(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  bool is_program = false;
  for (std::string line; std::getline(status, line);) {
    is_program |= line == "Name:\tfpo-plane";
    if (line.starts_with("SigCgt:"))
      return is_program && ((std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1)) & 1);
  }
  return false;
}

PlaneCliOutcome plane_cli_run(const ScratchFolder& scratch, std::vector<std::string> arguments,
                              bool interrupt = false) {
  const std::filesystem::path program = std::filesystem::path(FPO_BINARY_DIR) / "fpo-plane";
  arguments.insert(arguments.begin(), program);
  const ScratchFolder streams;
  const pid_t child = fork();
  if (child == 0) {
    std::vector<char*> argv;
    for (std::string& word : arguments) argv.push_back(word.data());
    argv.push_back(nullptr);
    const bool ready = dup2(creat((streams / "out").c_str(), 0600), STDOUT_FILENO) >= 0 &&
                       dup2(creat((streams / "err").c_str(), 0600), STDERR_FILENO) >= 0 &&
                       chdir(scratch.path().c_str()) == 0;
    if (ready) execv(argv[0], argv.data());
    _exit(127);
  }
  if (interrupt) {
    for (int wait = 0; wait < 1000 && !handles_interrupt(child); ++wait) usleep(10'000);
    usleep(100'000);
    kill(child, SIGINT);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), ScratchFolder::read(streams / "out"),
          ScratchFolder::read(streams / "err")};
}

/// Runs what must be refused; the plane_cli_complaint.
std::string plane_cli_complaint(const ScratchFolder& scratch, const std::vector<std::string>& arguments) {
  const std::size_t entries = scratch.num_entries();
  const PlaneCliOutcome o = plane_cli_run(scratch, arguments);
  CHECK(o.code == 2);
  CHECK(o.out == "");
  CHECK(std::count(o.err.begin(), o.err.end(), '\n') == 1);
  CHECK(scratch.num_entries() == entries);
  return o.err;
}

std::size_t num_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("fpo-plane: bad numbers and bad files are one line, exit code 2, and nothing is written") {
  const ScratchFolder scratch;
  const auto refused = [&](std::vector<std::string> more, const std::string& count = "100") {
    std::vector<std::string> all = {"-n", count, "-o", "out.txt", "--log", "log.csv"};
    all.insert(all.end(), more.begin(), more.end());
    CAPTURE(all);
    return plane_cli_complaint(scratch, all);
  };
  for (const std::string count :
       {"0", "3", "-5", "1e3", "99999999999", "340282366920938463463374607431768211456", "x", ""})
    refused({}, count);
  for (const std::string period :
       {"0x1", "1x0", "nanx1", "1xinf", "-1x1", "1", "1x", "x", "1x1000", "1e-300x1e-300"})
    refused({"--period", period});
  refused({"--sizing", "no-such-field"});
  refused({"--sizing", "none.pgm"});
  refused({"--sizing", "none.txt"});
  refused({"--local", "--global"});
  refused({"--bounded", "--start", "random"});
  refused({"--bounded"}, "0");
  refused({"--draw-cells"});

  scratch.write("black.pgm", "P2\n2 2\n255\n0 0\n0 0\n");
  scratch.write("white.pgm", "P2\n2 2\n255\n255 255\n255 255\n");
  scratch.write("short.pgm", "P2\n2 2\n255\n0 1\n2\n");
  scratch.write("large.pgm", "P2\n2 2\n255\n0 1\n2 256\n");
  scratch.write("huge.pgm", "P5\n999999 999999\n255\n");
  scratch.write("cut.pgm", "P5\n20 20\n255\nabc");
  scratch.write("empty.pgm", "");
  scratch.write("no.pgm", "P6\n1 1\n255\nabc");
  for (const std::string image : {"black", "white", "short", "large", "huge", "cut", "empty", "no"})
    CHECK(refused({"--sizing", image + ".pgm"}).find(image + ".pgm") != std::string::npos);

  scratch.write("three.txt", "0 0\n1 1 1\n");
  scratch.write("word.txt", "0 0\n\n0 zero\n");
  scratch.write("infinite.txt", "0 0\n0 inf\n");
  scratch.write("long.txt", "0 0\n1e9 0\n");
  scratch.write("nothing.txt", "# nothing\n");
  CHECK(refused({"--sizing", "three.txt"}).find("three.txt:2: ") != std::string::npos);
  CHECK(refused({"--sizing", "word.txt"}).find("word.txt:3: ") != std::string::npos);
  CHECK(refused({"--sizing", "infinite.txt"}).find("infinite.txt:2: ") != std::string::npos);
  for (const std::string curves : {"long", "nothing"})
    CHECK(refused({"--sizing", curves + ".txt"}).find(curves + ".txt: ") != std::string::npos);

  CHECK(plane_cli_complaint(scratch, {"-n", "100", "-o", "out.ply"}).find("out.ply") != std::string::npos);
  CHECK(refused({"--log", "log.png"}).find("log.png: unknown extension '.png' (use .csv or .txt)") !=
        std::string::npos);
  CHECK(plane_cli_complaint(scratch, {"-n", "100", "-o", "no/such/folder/out.txt"}).find("out.txt") !=
        std::string::npos);
  plane_cli_complaint(scratch, {"-n", "100"});
}

TEST_CASE(
    "fpo-plane: every kind of plane_cli_run writes n samples inside the rectangle, the same bytes each "
    "time") {
  const ScratchFolder scratch;
  scratch.write("ramp.pgm", "P2\n4 2\n9\n0 3 6 9\n0 3 6 9\n");
  scratch.write("curve.txt", "0.2 0.2\n0.3 0.25\n\n1.2 0.2\n");
  for (const std::vector<std::string>& kind :
       std::vector<std::vector<std::string>>{{},
                                             {"--sizing", "spot5"},
                                             {"--sizing", "ramp.pgm", "--global"},
                                             {"--sizing", "curve.txt", "--ser"},
                                             {"--bounded"},
                                             {"--bounded", "--sizing", "curve.txt"}}) {
    CAPTURE(kind);
    for (const std::string out : {"a", "b"}) {
      std::vector<std::string> all = {
          "-n", "200",        "--iterations", "5",          "--period",       "1.5x1",
          "-o", out + ".txt", "--log",        out + ".csv", "--target-delta", "2"};
      all.insert(all.end(), kind.begin(), kind.end());
      const PlaneCliOutcome o = plane_cli_run(scratch, all);
      REQUIRE(o.code == 0);
      CHECK(o.err == "");
      CHECK(o.out.find("samples 200\n") != std::string::npos);
    }
    const std::string text = ScratchFolder::read(scratch / "a.txt");
    CHECK(text == ScratchFolder::read(scratch / "b.txt"));
    CHECK(num_lines(text) == 200);
    CHECK(num_lines(ScratchFolder::read(scratch / "a.csv")) == 7);  // title, start, five iterations
    std::ifstream lines(scratch / "a.txt");
    for (std::string line; std::getline(lines, line);) {
      double x = -1, y = -1;
      REQUIRE(std::sscanf(line.c_str(), "%lf %lf", &x, &y) == 2);
      CHECK(x >= 0);
      CHECK(x <= 1.5);
      CHECK(y >= 0);
      CHECK(y <= 1);
    }
  }
}

TEST_CASE("fpo-plane --bounded: the distances printed are those of the file; a strip is a disk") {
  const ScratchFolder scratch;
  const PlaneCliOutcome o =
      plane_cli_run(scratch, {"-n", "120", "--bounded", "--period", "1.25x0.7", "--rest", "--quiet",
                              "--iterations", "60", "--corners", "c", "-o", "a.txt"});
  REQUIRE(o.code == 0);
  CHECK(o.err == "");
  std::vector<std::array<double, 2>> points;
  std::ifstream lines(scratch / "a.txt");
  for (std::string line; std::getline(lines, line);) {
    std::array<double, 2> point{};
    REQUIRE(std::sscanf(line.c_str(), "%lf %lf", &point[0], &point[1]) == 2);
    points.push_back(point);
  }
  double least = 1e300, sum = 0;
  for (const auto& p : points) {
    double nearest = 1e300;
    for (const auto& q : points)
      if (&p != &q) nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1]));
    least = std::min(least, nearest), sum += nearest;
  }
  const double most = std::sqrt(2 * 1.25 * 0.7 / (std::sqrt(3.0) * 120));
  const auto printed = [&](const std::string& name) {
    const std::size_t at = ("\n" + o.out).find("\n" + name + " ");
    REQUIRE(at != std::string::npos);
    return std::stod(o.out.substr(at + name.size() + 1));
  };
  CHECK(printed("delta") == doctest::Approx(least / most).epsilon(1e-5));
  CHECK(printed("mean_delta") == doctest::Approx(sum / 120 / most).epsilon(1e-5));

  const PlaneCliOutcome thin =
      plane_cli_run(scratch, {"-n", "200", "--bounded", "--period", "1x200", "--quiet", "-o", "b.txt"});
  CHECK(thin.code == 0);
  CHECK(thin.err.empty());  // one, though borders are closer to each other than samples
}

TEST_CASE("fpo-plane: pictures of a torus and a rectangle, with all that can be drawn") {
  const ScratchFolder scratch;
  for (const std::string border : {"--quiet", "--bounded"}) {
    const PlaneCliOutcome o =
        plane_cli_run(scratch, {"-n", "100", "-o", "a.svg", "--iterations", "3", "--sizing", "waves5", border,
                                "--draw-triangulation", "--draw-cells", "--draw-disks", "--draw-sizing"});
    REQUIRE(o.code == 0);
    const std::string svg = ScratchFolder::read(scratch / "a.svg");
    CHECK(svg.find("<circle") != std::string::npos);
    CHECK(svg.find("fill=\"#4a7bb7\"") != std::string::npos);  // the shortest wanted edge
    CHECK(svg.ends_with("</svg>\n"));
  }
}

TEST_CASE("fpo-plane: an interrupted plane_cli_run writes what it has and exits with 130") {
  const ScratchFolder scratch;
  for (const std::string border : {"--quiet", "--bounded"}) {
    const PlaneCliOutcome o = plane_cli_run(
        scratch, {"-n", "500", "-o", "a.txt", "--iterations", "1000000", "--target-delta", "2", border},
        true);
    CHECK(o.code == 130);
    CHECK(num_lines(ScratchFolder::read(scratch / "a.txt")) == 500);
    std::filesystem::remove(scratch / "a.txt");
  }
}
