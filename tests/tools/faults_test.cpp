// A machine that does not play along: full disks, folders that go or may not be written, too little memory,
// nobody who reads. Every tool then says so in one line with exit code 2, and no file is half written.

#include "tests/tools/faults.h"

#include <sys/mount.h>
#include <unistd.h>

#include <csignal>

#include "doctest.h"
#include "tests/fixtures/models.h"

using faults::Job;
using faults::Workplace;
using fixtures::Conditions;
using fixtures::ProgramResult;
using fixtures::Stdout;
namespace fs = std::filesystem;

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool with_address_sanitizer = true;  // which takes terabytes of address space
#else
constexpr bool with_address_sanitizer = false;
#endif

constexpr std::size_t megabyte = std::size_t(1) << 20;

/// A file system of so many bytes, if we may mount one.
class SmallDisk {
 public:
  SmallDisk(fs::path folder, const std::string& size) : folder_(std::move(folder)) {
    fs::create_directory(folder_);
    mounted_ = ::mount("none", folder_.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount(folder_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  fs::path folder_;
  bool mounted_ = false;
};

std::vector<Job> writing_jobs() {
  std::vector<Job> jobs = faults::all_jobs();
  std::erase_if(jobs, [](const Job& job) { return job.outputs.empty(); });
  return jobs;
}

/// One for each tool that writes.
std::vector<Job> few_writing_jobs() {
  std::vector<Job> jobs;
  for (const Job& job : writing_jobs())
    if (jobs.empty() || jobs.back().program != job.program) jobs.push_back(job);
  return jobs;
}

void skip(const std::string& why) {
  fixtures::skip_announced() = true;
  MESSAGE("skipped: ", why);
}

/// The outputs of a run without faults; a log has times in it.
std::map<std::string, std::string> without_times(std::map<std::string, std::string> files) {
  if (const auto log = files.find("log.csv"); log != files.end()) log->second.clear();
  return files;
}

/// Has the job write where it cannot: one line tells, each file there is whole or was there before.
void check_without_room(const Workplace& place, const Job& job, const Conditions& conditions,
                        const std::string& folder, const std::string& reason) {
  CAPTURE(job.arguments);
  REQUIRE(place.run(job).code == 0);
  const auto whole = without_times(place.take_outputs(job));
  const std::string precious = job.outputs.back();
  place.folder().write(folder + "/" + precious, "precious");
  check_one_line(job, place.run(job, conditions, folder), reason);
  auto files = without_times(place.files(folder));
  CHECK(files.at(precious) == "precious");
  files.erase(precious);
  for (const auto& file : files) {
    const auto& [name, bytes] = file;
    CAPTURE(file.first);
    REQUIRE(whole.count(name) == 1);
    CHECK(bytes == whole.at(name));
    fs::remove(place / folder / name);
  }
  fs::remove(place / folder / precious);
}

/// Runs the job with so much address space: it ends well or in one line, and writes all or nothing.
/// True if it ended well.
bool check_with_memory(const Workplace& place, const Job& job, std::size_t bytes) {
  CAPTURE(job.program);
  CAPTURE(bytes);
  const auto before = place.files();
  const ProgramResult result = place.run(job, {.memory = bytes});
  const auto outputs = place.take_outputs(job);
  CHECK(place.files() == before);
  if (result.code == 0) {
    check_whole(job, outputs);
    return true;
  }
  check_one_line(job, result, "out of memory");
  CAPTURE(result.err);
  CHECK(outputs.empty());
  return false;
}

/// The least address space, up to a megabyte, in which the tool starts at all.
std::size_t least_memory(const Workplace& place, const std::string& program) {
  const Job version{program, {"--version"}, {}, false, 0};
  std::size_t bytes = megabyte;
  while (place.run(version, {.memory = bytes}).code != 0) bytes += megabyte;
  return bytes;
}

/// Limits that grow by `factor` up to that which suffices; how many did not.
int check_memory_limits(const Workplace& place, const Job& job, double factor) {
  const std::size_t least = least_memory(place, job.program);
  int failures = 0;
  for (auto extra = static_cast<double>(megabyte) / 8; extra < 1e10; extra *= factor) {
    if (check_with_memory(place, job, least + static_cast<std::size_t>(extra))) break;
    ++failures;
  }
  return failures;
}

}  // namespace

TEST_CASE("faults: a full disk is told in one line, and older files stay") {
  const Workplace place;
  const SmallDisk disk(place / "small", "8k");
  if (!disk.mounted()) return skip("no file system can be mounted here");
  for (const Job& job : few_writing_jobs())
    check_without_room(place, job, {}, "small", "No space left on device");
}

TEST_CASE("faults: a limit to the size of files is told like a full disk") {
  const Workplace place;
  fs::create_directory(place / "small");
  for (const Job& job : few_writing_jobs())
    check_without_room(place, job, {.file_size = 2000}, "small", "File too large");
}

TEST_CASE("faults: the folder of the outputs goes while a tool runs") {
  const Workplace place;
  const std::vector<Job> jobs = few_writing_jobs();
  for (const Job& job : jobs) {
    if (!job.resumes) continue;  // those are done before we could
    CAPTURE(job.program);
    fs::create_directory(place / "gone");
    const Conditions conditions{.meanwhile = [&] { fs::remove_all(place / "gone"); }};
    check_one_line(job, place.run(job, conditions, "gone"), "gone/");
    CHECK(!fs::exists(place / "gone"));
  }
}

TEST_CASE("faults: a folder that takes no files is told before the work starts") {
  const Workplace place;
  constexpr unsigned nobody = 65534;
  const Conditions conditions{.user = ::geteuid() == 0 ? nobody : 0};
  fs::create_directory(place / "locked");
  fs::permissions(place / "locked", fs::perms(0555));
  if (place.run({"fpo-shape", {"--list"}, {}, false, 0}, conditions).code != 0)
    return skip("another user cannot run the programs here");
  for (const Job& job : few_writing_jobs()) {
    CAPTURE(job.program);
    check_one_line(job, place.run(job, conditions, "locked"), "Permission denied");
    CHECK(place.files("locked").empty());
  }
  fs::permissions(place / "locked", fs::perms(0755));
}

TEST_CASE("faults: too little memory is told in one line, and nothing is written") {
  if (with_address_sanitizer) return skip("the sanitizer needs the address space");
  const Workplace place;
  int failures = 0;
  for (const Job& job : few_writing_jobs()) failures += check_memory_limits(place, job, 4);
  CHECK(failures > 0);
}

TEST_CASE("faults: results that nobody reads") {
  const Workplace place;
  for (Job job : few_writing_jobs()) {
    CAPTURE(job.program);
    if (job.program == "fpo-trace") continue;  // prints while it writes, so a reader who goes ends it
    const ProgramResult unread = place.run(job, {.out = Stdout::broken_pipe});
    CHECK(unread.code == 128 + SIGPIPE);  // as every filter
    CHECK(unread.err == "");
    check_whole(job, place.take_outputs(job));
    check_one_line(job, place.run(job, {.out = Stdout::full_disk}),
                   "standard output: No space left on device");
    check_whole(job, place.take_outputs(job));
    check_one_line(job, place.run(job, {.out = Stdout::closed}), "standard output: Bad file descriptor");
    check_whole(job, place.take_outputs(job));
  }
}

TEST_SUITE("faults") {
  TEST_CASE("faults: memory that ends at any moment, for every tool and way of remeshing" * doctest::skip()) {
    const Workplace place;
    int failures = 0;
    for (const Job& job : faults::all_jobs()) failures += check_memory_limits(place, job, 1.15);
    MESSAGE(failures, " limits that did not suffice");
    CHECK(failures > 0);
  }
  TEST_CASE("faults: full disks of every size" * doctest::skip()) {
    const Workplace place;
    fs::create_directory(place / "small");
    for (const Job& job : writing_jobs())
      for (const std::size_t bytes : {200, 500, 1000, 2000, 3000})
        check_without_room(place, job, {.file_size = bytes}, "small", "File too large");
  }
}
