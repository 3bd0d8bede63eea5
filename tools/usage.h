#pragma once
// What a tool says of itself: what it does, what it takes, how it is called.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tools/option.h"

namespace tools {

class Usage {
 public:
  explicit Usage(std::string program) : program_(std::move(program)) {}

  /// The operands as the usage line shows them, and what the tool does.
  void describe(std::string operands, std::string summary);
  /// A command to begin with, without the program's name, and what it does: the help starts with these.
  void example(std::string arguments, std::string what);

  const std::string& program() const { return program_; }
  const std::string& operands() const { return operands_; }
  /// What --help prints.
  std::string help(std::span<const OptionEntry> options) const;

 private:
  std::string program_, operands_, summary_;
  std::vector<std::pair<std::string, std::string>> examples_;
};

}  // namespace tools
