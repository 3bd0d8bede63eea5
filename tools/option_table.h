#pragma once
// The options of a tool, bound to the variables that they set.

#include <concepts>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/numbers.h"
#include "tools/option.h"

namespace tools {

/// Variables are set when options are read.
class OptionTable {
 public:
  using Assign = OptionEntry::Assign;

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

  std::vector<OptionEntry>& entries() { return entries_; }

 private:
  void declare(Option option, Takes takes, Assign assign);
  void declare_choice(Option option, std::vector<std::string> words, std::function<void(std::size_t)> assign);

  std::string group_ = "Options";
  std::vector<OptionEntry> entries_;
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
