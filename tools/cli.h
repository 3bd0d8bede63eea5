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

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geom/check.h"
#include "tools/numbers.h"

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

/// How an option is written and explained.
struct Option {
  std::string name = {};      ///< long form, without the dashes; empty: none
  char letter = 0;            ///< short form; 0: none
  std::string value = {};     ///< what the help calls its value: "COUNT"
  std::string help = {};      ///< a phrase; the default is appended to it
  std::string standard = {};  ///< the default as the help shows it; empty: the variable's initial value
  bool required = false;
};

/// The arguments of one run and the options that explain them: first declare every option, then parse().
/// Written --name value, --name=value, -n value, -nvalue, in any order; "--" ends the options; of repeated
/// ones the last counts. Names are never abbreviated.
class CommandLine {
 public:
  /// Reads one value into its variable; throws geom::InputError on text that it cannot read.
  using Assign = std::function<void(const std::string& text)>;

  CommandLine(std::string program, std::vector<std::string> arguments);

  /// The operands as the usage line shows them, and what the tool does.
  void describe(std::string operands, std::string summary);
  /// A command to begin with, without the program's name, and what it does: the help starts with these.
  void example(std::string arguments, std::string what);
  /// Starts a block of the help, or goes on with one of that title. Blocks are shown in the order in which
  /// they begin, those whose title begins with "Expert" after all others.
  /// The following options belong to it.
  void group(std::string title);

  /// A whole number in [low, high].
  template <std::integral T>
  void integer(Option option, T& target, std::type_identity_t<T> low, std::type_identity_t<T> high);
  /// A finite number in [low, high].
  void number(Option option, double& target, double low, double high);
  void text(Option option, std::string& target);
  void path(Option option, std::filesystem::path& target);
  /// A file to be written, of a format that has these endings (".txt") only.
  void output(Option option, std::filesystem::path& target, std::vector<std::string> endings);
  /// --name, without a value, makes the target true.
  void flag(Option option, bool& target);
  /// --name makes the target true, --no-name false.
  void toggle(Option option, bool& target);
  /// The same; not given, the target stays as it is.
  void toggle(Option option, std::optional<bool>& target);
  /// The same for any use of it.
  void toggle(Option option, std::function<void(bool)> assign);
  /// One of several words, each with the value that it stands for.
  template <class E>
  void choice(Option option, E& target, std::vector<std::pair<std::string, std::type_identity_t<E>>> words);
  /// A value of any other kind.
  void custom(Option option, Assign assign);
  /// --name or --name=value; without a value the text is empty.
  void custom_or_none(Option option, Assign assign);

  /// Reads all arguments and returns the operands, `least` to `most` of them. Throws UsageError,
  /// geom::InputError ("-n: '12x' is not a whole number"), and Finished after --help and --version.
  std::vector<std::string> parse(std::size_t least, std::size_t most);

  std::string help() const;
  const std::string& program() const { return program_; }
  /// What was typed, quoted for a POSIX shell where needed.
  std::string command() const;
  std::uint64_t seed() const { return seed_; }  ///< --seed
  int threads() const { return threads_; }      ///< --threads, at least 1
  bool quiet() const { return quiet_; }         ///< --quiet

 private:
  enum class Kind { with_value, maybe_value, flag, toggle };
  struct Entry {
    Option option;
    Kind kind;
    Assign assign;  ///< a flag or toggle gets "yes" or "no"
    std::string group;
    bool given = false;
  };
  void declare(Option option, Kind kind, Assign assign);
  void declare_common();
  void declare_choice(Option option, std::vector<std::string> words, std::function<void(std::size_t)> assign);
  Entry& find(const std::string& written);
  std::size_t read_long(std::size_t i);
  std::size_t read_short(std::size_t i);
  std::size_t read_next(Entry& entry, const std::string& written, std::size_t i);
  void apply(Entry& entry, const std::string& written, const std::string& value);
  void check_complete(const std::vector<std::string>& operands, std::size_t least, std::size_t most) const;

  std::string program_, operands_, summary_, group_ = "Options";
  std::vector<std::string> arguments_;
  std::vector<Entry> entries_;
  std::vector<std::pair<std::string, std::string>> examples_;
  std::uint64_t seed_ = 1;
  int threads_ = 1;
  bool quiet_ = false;
};

/// Runs a tool and returns its exit code. Each failure becomes one line on stderr, "fpo-remesh: message".
int run(const std::string& program, int argc, const char* const* argv,
        const std::function<int(CommandLine&)>& tool);

template <std::integral T>
void CommandLine::integer(Option option, T& target, std::type_identity_t<T> low,
                          std::type_identity_t<T> high) {
  if (option.standard.empty() && !option.required) option.standard = std::to_string(target);
  custom(std::move(option),
         [&target, low, high](const std::string& text) { target = parse_integer<T>(text, low, high); });
}

template <class E>
void CommandLine::choice(Option option, E& target,
                         std::vector<std::pair<std::string, std::type_identity_t<E>>> words) {
  std::vector<std::string> names;
  for (const auto& [name, value] : words) {
    names.push_back(name);
    if (value == target && option.standard.empty() && !option.required) option.standard = name;
  }
  declare_choice(std::move(option), std::move(names),
                 [&target, words](std::size_t i) { target = words[i].second; });
}

}  // namespace tools
