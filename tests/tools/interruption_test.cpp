// Signals at random moments: what is written is whole, nothing else is left behind, and the exit code tells.
// `make faults` runs the long versions.

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

#include "doctest.h"
#include "geom/rng.h"
#include "tests/fixtures/models.h"
#include "tests/tools/faults.h"

using faults::Job;
using faults::Workplace;
using fixtures::ProgramResult;

namespace {

constexpr const char* no_result_yet = "interrupted before there was a result: nothing is written\n";
constexpr const char* all_written = "interrupted when all was written, before it was measured\n";

/// Whether the signal met a run that was not yet, or not any more, under way is left to chance; these count.
struct Tally {
  int results = 0, no_results = 0, too_late = 0;
};

bool has_nameless_files([[maybe_unused]] const std::filesystem::path& folder) {
#ifdef O_TMPFILE
  const int opened = ::open(folder.c_str(), O_TMPFILE | O_WRONLY, 0600);
  return opened >= 0 && ::close(opened) == 0;
#else
  return false;
#endif
}

/// A signal `after` seconds from the start.
void check_interrupted(const Workplace& place, const Job& job, int signal, double after, Tally& tally) {
  CAPTURE(job.arguments);
  CAPTURE(signal);
  CAPTURE(after);
  const auto before = place.files();
  const ProgramResult result =
      place.run(job, {.interruption = {.signal = signal, .after = after, .wait_for_handler = false}});
  const auto outputs = place.take_outputs(job);
  CHECK(place.files() == before);
  REQUIRE(!result.timed_out);
  if (result.code == 0) {
    check_whole(job, outputs);
    ++tally.too_late;
  } else if (job.resumes && !outputs.empty()) {
    CHECK(result.code == 130);
    check_whole(job, outputs);
    if (result.err != job.program + ": " + all_written)  // that ends at once
      CHECK(result.out.find("wrote ") != std::string::npos);
    ++tally.results;
  } else if (job.resumes && !result.err.empty()) {
    CHECK(result.code == 130);
    CHECK(result.err == job.program + ": " + no_result_yet);
    CHECK(result.out == "");
    ++tally.no_results;
  } else {  // died of it, before it handles signals or since it does not
    CHECK(result.code == 128 + signal);
    CHECK(result.err == "");
    CHECK(outputs.size() <= (job.resumes ? 0 : job.outputs.size()));
    ++tally.no_results;
  }
}

/// `tries` at moments spread over the whole run and a little more.
Tally interrupt_often(const Workplace& place, const Job& job, int tries, geom::Rng& rng) {
  const double whole = place.run(job).seconds / fixtures::slowness;  // the moments are scaled by that again
  check_whole(job, place.take_outputs(job));
  Tally tally;
  for (int i = 0; i < tries; ++i)
    check_interrupted(place, job, i % 3 == 2 ? SIGTERM : SIGINT, (i + rng.uniform()) / tries * 1.1 * whole,
                      tally);
  return tally;
}

}  // namespace

TEST_CASE("interruption: SIGINT or SIGTERM at a random moment leaves whole files or none") {
  const Workplace place;
  geom::Rng rng(1);
  const Tally remesh = interrupt_often(place, faults::remesh_job({"--iterations", "100"}), 5, rng);
  CHECK(remesh.results > 0);
  for (const Job& job : faults::all_jobs())
    if (job.program == "fpo-plane" || job.program == "fpo-trace") interrupt_often(place, job, 2, rng);
}

TEST_CASE("interruption: before the samples there is nothing to write") {
  const Workplace place;
  const Job job = faults::remesh_job({"--sizing", "lfs"}, 3000);  // a long look for the sizing
  const ProgramResult result = place.run(job, {.interruption = {.signal = SIGINT}});
  CHECK(result.code == 130);
  CHECK(result.err == "fpo-remesh: " + std::string(no_result_yet));
  CHECK(result.out == "");
  CHECK(place.take_outputs(job).empty());
}

TEST_CASE("interruption: killed at a random moment, no tool leaves a temporary file") {
  const Workplace place;
  if (!has_nameless_files(place.folder().path())) {
    fixtures::skip_announced() = true;
    MESSAGE("skipped: this file system has no files without names");
    return;
  }
  geom::Rng rng(2);
  const auto before = place.files();
  Job job{"fpo-shape", {"torus", "--size", "300", "-o", "@out.obj"}, {"out.obj"}, false, 0};
  const double whole = place.run(job).seconds / fixtures::slowness;  // the moments are scaled by that again
  const auto complete = place.take_outputs(job);
  for (int i = 0; i < 6; ++i) {
    place.run(job, {.interruption = {SIGKILL, rng.uniform() * whole, false}});
    const auto outputs = place.take_outputs(job);
    CHECK((outputs.empty() || outputs == complete));
    CHECK(place.files() == before);
  }
}

TEST_SUITE("faults") {
  TEST_CASE("interruption: dozens of moments for every tool and way of remeshing" * doctest::skip()) {
    const Workplace place;
    geom::Rng rng(3);
    for (const Job& job : faults::all_jobs()) {
      const Tally tally = interrupt_often(place, job, 24, rng);
      std::string line = job.program;
      for (const std::string& argument : job.arguments) line += " " + argument;
      MESSAGE(line, ": ", tally.results, " results, ", tally.no_results, " without, ", tally.too_late,
              " too late");
      if (job.resumes && job.program != "fpo-spectrum") CHECK(tally.results > 0);
    }
  }
}
