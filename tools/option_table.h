#pragma once
// The options of a tool: how each is written, explained and read, and the help that shows them.

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/numbers.h"

namespace tools {

/// How an option is written and explained.
struct Option {
  std::string name = {};      ///< long form, without the dashes; empty: none
  char letter = 0;            ///< short form; 0: none
  std::string value = {};     ///< what the help calls its value: "COUNT"
  std::string help = {};      ///< a phrase; the default is appended to it
  std::string standard = {};  ///< the default as the help shows it; empty: the variable's initial value
  bool required = false;
};

/// What an option takes.
enum class Takes { value, maybe_value, nothing, yes_or_no };

/// Options bound to variables, which they set when they are read, and what else the help says.
class OptionTable {
 public:
  /// Reads one value into its variable; throws geom::InputError on text that it cannot read.
  using Assign = std::function<void(const std::string& text)>;
  struct Entry {
    Option option;
    Takes takes;
    Assign assign;  ///< gets "yes" or "no" if it takes no value
    std::string group;
    bool given = false;
  };

  explicit OptionTable(std::string program) : program_(std::move(program)) {}

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
  /// --name asks for something else, which `answer` gives.
  void request(Option option, std::function<void()> answer);

  std::string help() const;
  const std::string& program() const { return program_; }
  const std::string& operands() const { return operands_; }
  std::vector<Entry>& entries() { return entries_; }

 private:
  void declare(Option option, Takes takes, Assign assign);
  void declare_choice(Option option, std::vector<std::string> words, std::function<void(std::size_t)> assign);

  std::string program_, operands_, summary_, group_ = "Options";
  std::vector<Entry> entries_;
  std::vector<std::pair<std::string, std::string>> examples_;
};

template <std::integral T>
void OptionTable::integer(Option option, T& target, std::type_identity_t<T> low,
                          std::type_identity_t<T> high) {
  if (option.standard.empty() && !option.required) option.standard = std::to_string(target);
  custom(std::move(option),
         [&target, low, high](const std::string& text) { target = parse_integer<T>(text, low, high); });
}

template <class E>
void OptionTable::choice(Option option, E& target,
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
