#pragma once
// The command line that all tools share: options bound to variables, generated help, exit codes.
//
//   int remesh(tools::CommandLine& cli) {
//     std::size_t count = 0;  // the initial value is the default
//     cli.describe("INPUT", "Remeshes a surface.");
//     cli.integer({.name = "count", .letter = 'n', .value = "COUNT", .help = "samples"}, count, 1, 100);
//     const std::vector<std::string> operands = cli.parse(1, 1);
//     ...
//   }
//   int main(int argc, char** argv) { return tools::run("fpo-remesh", argc, argv, remesh); }

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "geom/check.h"
#include "tools/option_table.h"
#include "tools/usage.h"

namespace tools {

/// Exit codes of every tool.
inline constexpr int exit_done = 0, exit_bad_input = 2, exit_other_topology = 3, exit_bug = 70,
                     exit_interrupted = 130;

/// Bad use of the command line: run() adds a hint to --help.
struct UsageError : geom::InputError {
  using geom::InputError::InputError;
};

/// Thrown by parse() when --help or --version has been answered; run() makes exit code 0 of it.
struct Finished {};

/// The arguments of one run and the options that explain them: first declare every option, then parse().
/// Written --name value, --name=value, -n value, -nvalue, in any order; "--" ends the options; of repeated
/// ones the last counts. Names are never abbreviated.
class CommandLine : public OptionTable, public Usage {
 public:
  CommandLine(std::string program, std::vector<std::string> arguments);

  /// Reads all arguments and returns the operands, `least` to `most` of them. Throws UsageError,
  /// geom::InputError ("-n: '12x' is not a whole number"), and Finished after --help and --version.
  std::vector<std::string> parse(std::size_t least, std::size_t most);

  /// What was typed, quoted for a POSIX shell where needed.
  std::string command() const;
  std::uint64_t seed() const { return seed_; }  ///< --seed
  int threads() const { return threads_; }      ///< --threads, at least 1
  bool quiet() const { return quiet_; }         ///< --quiet

 private:
  void declare_common();

  std::vector<std::string> arguments_;
  std::uint64_t seed_ = 1;
  int threads_ = 1;
  bool quiet_ = false;
};

/// Runs a tool and returns its exit code. Each failure becomes one line on stderr, "fpo-remesh: message".
int run(const std::string& program, int argc, const char* const* argv,
        const std::function<int(CommandLine&)>& tool);

}  // namespace tools
