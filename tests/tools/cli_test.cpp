#include "tools/cli.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <limits>
#include <sstream>

#include "doctest.h"
#include "tools/interrupt.h"
#include "tools/progress.h"

namespace {

enum class Corners { all, type_c };

struct Settings {
  std::size_t count = 0;
  int iterations = 100;
  double target = 0.926;
  std::string sizing = "uniform";
  std::filesystem::path output;
  bool ser = true, json = false;
  Corners corners = Corners::all;
};

void declare(tools::CommandLine& cli, Settings& s) {
  cli.describe("INPUT", "Remeshes a surface.");
  cli.group("Sampling");
  cli.integer(
      {.name = "count", .letter = 'n', .value = "COUNT", .help = "number of samples", .required = true},
      s.count, 1, 1000);
  cli.integer({.name = "iterations", .value = "MAX", .help = "passes at most"}, s.iterations, 0, 10000);
  cli.number({.name = "target-delta", .value = "D", .help = "stop above it"}, s.target, 0, 1);
  cli.text({.name = "sizing", .value = "KIND", .help = "wanted spacing"}, s.sizing);
  cli.toggle({.name = "ser", .help = "remove shortest edges first"}, s.ser);
  cli.choice({.name = "corners", .value = "c|all", .help = "candidates"}, s.corners,
             {{"all", Corners::all}, {"c", Corners::type_c}});
  cli.group("Output");
  cli.path({.letter = 'o', .value = "OUT", .help = "the remesh"}, s.output);
  cli.flag({.name = "json", .help = "as JSON"}, s.json);
}

/// What a whole run leaves behind.
struct Outcome {
  int code;
  std::string out, err;
};

Outcome run(std::vector<const char*> arguments, const std::function<int(tools::CommandLine&)>& tool) {
  std::ostringstream out, err;
  std::streambuf* const old_out = std::cout.rdbuf(out.rdbuf());
  std::streambuf* const old_err = std::cerr.rdbuf(err.rdbuf());
  arguments.insert(arguments.begin(), "fpo-test");
  const int code = tools::run("fpo-test", static_cast<int>(arguments.size()), arguments.data(), tool);
  std::cout.rdbuf(old_out);
  std::cerr.rdbuf(old_err);
  return {code, out.str(), err.str()};
}

/// Parses with one operand expected; `s` shows what arrived.
Outcome parse(std::vector<const char*> arguments, Settings& s) {
  return run(std::move(arguments), [&](tools::CommandLine& cli) {
    declare(cli, s);
    std::cout << cli.parse(1, 1)[0] << " " << cli.seed() << " " << cli.quiet();
    return 0;
  });
}

Outcome parse(std::vector<const char*> arguments) {
  Settings s;
  return parse(std::move(arguments), s);
}

}  // namespace

TEST_CASE("cli: every way to write an option arrives in its variable") {
  Settings s;
  const Outcome done =
      parse({"--iterations=7", "-n12", "a.obj", "--target-delta", "-0", "--no-ser", "--corners", "c", "-o",
             "-x.obj", "--json", "--seed", "18446744073709551615", "--quiet", "--sizing="},
            s);
  CHECK(done.err == "");
  CHECK(done.code == 0);
  CHECK(done.out == "a.obj 18446744073709551615 1");
  CHECK(s.count == 12);
  CHECK(s.iterations == 7);
  CHECK(s.target == 0);
  CHECK(s.sizing == "");
  CHECK(s.output == "-x.obj");
  CHECK_FALSE(s.ser);
  CHECK(s.json);
  CHECK(s.corners == Corners::type_c);
}

TEST_CASE("cli: what is not given keeps its default, the last of equals counts, -- ends the options") {
  Settings s;
  CHECK(parse({"-n", "5", "--no-ser", "--ser", "--count=6", "--", "--json"}, s).out == "--json 1 0");
  CHECK(s.count == 6);
  CHECK(s.iterations == 100);
  CHECK(s.target == 0.926);
  CHECK(s.sizing == "uniform");
  CHECK(s.ser);
  CHECK_FALSE(s.json);
}

TEST_CASE("cli: bad use is one line and exit code 2") {
  const auto complaint = [](std::vector<const char*> arguments) {
    const Outcome failed = parse(std::move(arguments));
    CHECK(failed.code == 2);
    CHECK(failed.out == "");
    CHECK(failed.err.find('\n') + 1 == failed.err.size());
    return failed.err;
  };
  const std::string hint = " (see fpo-test --help)\n";
  CHECK(complaint({"x", "-n", "12x"}) == "fpo-test: -n: '12x' is not a whole number\n");
  CHECK(complaint({"x", "--count", "12x"}) == "fpo-test: --count: '12x' is not a whole number\n");
  CHECK(complaint({"x", "-n", ""}) == "fpo-test: -n: '' is not a whole number\n");
  CHECK(complaint({"x", "-n", " 1"}) == "fpo-test: -n: ' 1' is not a whole number\n");
  CHECK(complaint({"x", "-n", "1e2"}) == "fpo-test: -n: '1e2' is not a whole number\n");
  CHECK(complaint({"x", "-n", "-1"}) == "fpo-test: -n: -1 is not between 1 and 1000\n");
  CHECK(complaint({"x", "-n", "0"}) == "fpo-test: -n: 0 is not between 1 and 1000\n");
  CHECK(complaint({"x", "-n", "99999999999999999999999"}) ==
        "fpo-test: -n: 99999999999999999999999 is not between 1 and 1000\n");
  CHECK(complaint({"x", "--iterations=-1"}) == "fpo-test: --iterations: -1 is not between 0 and 10000\n");
  CHECK(complaint({"x", "--target-delta=0.9f"}) == "fpo-test: --target-delta: '0.9f' is not a number\n");
  CHECK(complaint({"x", "--target-delta=nan"}) == "fpo-test: --target-delta: 'nan' is not a number\n");
  CHECK(complaint({"x", "--target-delta=inf"}) == "fpo-test: --target-delta: inf is not between 0 and 1\n");
  CHECK(complaint({"x", "--corners", "b"}) == "fpo-test: --corners: 'b' is none of all, c\n");
  CHECK(complaint({"x", "-o", ""}) == "fpo-test: -o: a file name cannot be empty\n");
  CHECK(complaint({"x", "-n"}) == "fpo-test: -n COUNT: the value is missing" + hint);
  CHECK(complaint({"x", "--iter", "3"}) == "fpo-test: unknown option --iter" + hint);
  CHECK(complaint({"x", "-q"}) == "fpo-test: unknown option -q" + hint);
  CHECK(complaint({"x", "--no-json"}) == "fpo-test: unknown option --no-json" + hint);
  CHECK(complaint({"x", "--json=1"}) == "fpo-test: --json takes no value" + hint);
  CHECK(complaint({"x"}) == "fpo-test: -n COUNT is missing" + hint);
  CHECK(complaint({"-n", "3"}) == "fpo-test: INPUT is missing" + hint);
  CHECK(complaint({"x", "y", "-n", "3"}) == "fpo-test: unexpected argument 'y'" + hint);
}

TEST_CASE("cli: help names every option with its default, in aligned columns no wider than a page") {
  const Outcome done = parse({"--help"});
  CHECK(done.code == 0);
  CHECK(done.err == "");
  std::vector<std::string> expected = {"Usage: fpo-test INPUT [options]", "\nSampling\n", "\nOutput\n",
                                       "\nCommon\n"};
  for (const char* name :
       {"-n, --count COUNT", "--iterations MAX", "--[no-]ser", "  -o OUT", "--seed S", "(required)",
        "(default 100)", "(default 0.926)", "(default on)", "(default all)"}) {
    expected.emplace_back(name);
  }
  for (const std::string& text : expected) {
    CAPTURE(text);
    CHECK(done.out.find(text) != std::string::npos);
  }
  std::istringstream lines(done.out);
  for (std::string line; std::getline(lines, line);) CHECK(line.size() < 80);
  CHECK(parse({"--version"}).out.substr(0, 9) == "fpo-test ");
  CHECK(parse({"--version"}).code == 0);
}

TEST_CASE("cli: each kind of failure has its exit code") {
  const auto throwing = [](auto error) {
    return run({}, [error](tools::CommandLine&) -> int { throw error; });
  };
  const Outcome bad = throwing(geom::InputError("a.ply: empty file"));
  CHECK(bad.code == 2);
  CHECK(bad.err == "fpo-test: a.ply: empty file\n");
  const Outcome bug = throwing(geom::Bug("move 17: two owners"));
  CHECK(bug.code == 70);
  CHECK(bug.err == "fpo-test: internal error: move 17: two owners (seed 1)\n");
  const Outcome memory = throwing(std::bad_alloc());
  CHECK(memory.code == 2);
  CHECK(memory.err.find("out of memory") != std::string::npos);
  CHECK(run({}, [](tools::CommandLine&) { return 130; }).code == 130);
}

TEST_CASE("cli: results that cannot be written are a failure") {
  const Outcome failed = run({}, [](tools::CommandLine&) {
    std::cout.setstate(std::ios::badbit);
    return 0;
  });
  std::cout.clear();
  CHECK(failed.code == 2);
  CHECK(failed.err.find("fpo-test: standard output: ") == 0);
}

TEST_CASE("cli: numbers read back as they were written") {
  for (const double value : {0.0, 0.1, 1.0 / 3, 1e300, -5e-324, 0.926}) {
    const double huge = std::numeric_limits<double>::max();
    CHECK(tools::parse_number(tools::shortest(value), -huge, huge) == value);
  }
}

TEST_CASE("interrupt: the first signal raises the flag, the second ends the program") {
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child = fork();
    if (child == 0) {
      std::signal(signal, SIG_DFL);
      if (tools::interrupt_flag()) _exit(1);
      std::raise(signal);
      if (!tools::interrupt_flag()) _exit(2);
      std::raise(signal);
      _exit(3);
    }
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == signal);
  }
}

TEST_CASE("progress: the line tells share, delta and time to go") {
  CHECK(tools::progress_text("fpo", 0, 0.5, 0) == "fpo    0%  delta 0.500");
  CHECK(tools::progress_text("fpo", 0.25, 0.9126, 4) == "fpo   25%  delta 0.913  12 s to go");
  CHECK(tools::progress_text("fpo", 0.5, 0.9, 185) == "fpo   50%  delta 0.900  3 min 05 s to go");
  CHECK(tools::progress_text("fpo", 0.5, 0.9, 7800) == "fpo   50%  delta 0.900  2 h 10 min to go");
  CHECK(tools::progress_text("fpo", 2, 0.9, 1) == "fpo  100%  delta 0.900  0 s to go");
}
