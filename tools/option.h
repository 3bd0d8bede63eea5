#pragma once
// One option of a tool: how it is written, explained and read.

#include <functional>
#include <string>

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

struct OptionEntry {
  /// Reads one value into its variable; throws geom::InputError on text that it cannot read.
  using Assign = std::function<void(const std::string& text)>;
  Option option;
  Takes takes;
  Assign assign;  ///< gets "yes" or "no" if it takes no value
  std::string group;
  bool given = false;
};

}  // namespace tools
