#pragma once
// What the tests of interruptions and faults share: one small job for every tool, and what must hold after
// it, whatever has happened.

#include <map>
#include <string>
#include <vector>

#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

namespace faults {

/// A run of a tool.
struct Job {
  std::string program;
  std::vector<std::string> arguments;
  std::vector<std::string> outputs;  ///< the files that it writes, the most important last
  bool resumes = false;              ///< heeds signals: what it has so far is a result
  std::size_t samples = 0;           ///< in the last output; 0: another number, or it has none
};

/// About a tenth of a second each: all tools, and all ways of remeshing.
std::vector<Job> all_jobs();
Job remesh_job(const std::vector<std::string>& more = {}, std::size_t samples = 100);

/// A folder with the inputs of all jobs.
class Workplace {
 public:
  Workplace();

  /// Runs the job with its outputs in `folder`, which is relative to here.
  fixtures::ProgramResult run(const Job& job, const fixtures::Conditions& conditions = {},
                              const std::string& folder = ".") const;
  /// Every regular file there, with its bytes.
  std::map<std::string, std::string> files(const std::string& folder = ".") const;
  /// Those of the job that are in the folder, which they leave.
  std::map<std::string, std::string> take_outputs(const Job& job) const;
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  const fixtures::ScratchFolder& folder() const { return folder_; }

 private:
  fixtures::ScratchFolder folder_;
};

/// Checks: the outputs are all there and each is whole, with as many samples as were asked for.
void check_whole(const Job& job, const std::map<std::string, std::string>& outputs);

/// Checks: exit code 2 and one line of the program that contains `reason`.
void check_one_line(const Job& job, const fixtures::ProgramResult& result, const std::string& reason);

}  // namespace faults
