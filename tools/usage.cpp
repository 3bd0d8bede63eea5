#include "tools/usage.h"

#include <algorithm>

namespace tools {
namespace {

constexpr std::size_t page_width = 79, help_column = 27;

/// "-n, --count COUNT": every way to write an option, as the help shows it.
std::string forms(const Option& option, bool negatable, bool maybe_value) {
  std::string text = option.letter ? std::string{'-', option.letter} : "   ";
  if (!option.name.empty()) {
    text += option.letter ? ", --" : " --";
    text += (negatable ? "[no-]" : "") + option.name;
  }
  if (maybe_value) return text + "[=" + option.value + "]";
  return text + (option.value.empty() ? "" : " " + option.value);
}

/// Breaks a text between words into lines of at most `width` characters, each but the first indented.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::string result;
  std::size_t column = 0, begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (column > 0 && column + 1 + (end - begin) > width) {
      result += "\n" + std::string(indent, ' ');
      column = 0;
    }
    if (column > 0) result += ' ', ++column;
    result.append(text, begin, end - begin);
    column += end - begin;
    begin = end + 1;
  }
  return result;
}

/// An option and what it does: beside it, or below if it is long.
std::string entry_text(const Option& option, const std::string& forms) {
  std::string phrase = option.help;
  if (option.required) phrase += " (required)";
  if (!option.standard.empty()) phrase += " (default " + option.standard + ")";
  std::string line = "  " + forms;
  if (line.size() + 2 > help_column) line += "\n" + std::string(help_column, ' ');
  if (line.size() < help_column) line.resize(help_column, ' ');
  return line + wrapped(phrase, help_column, page_width - help_column) + "\n";
}

}  // namespace

void Usage::describe(std::string operands, std::string summary) {
  operands_ = std::move(operands);
  summary_ = std::move(summary);
}

void Usage::example(std::string arguments, std::string what) {
  examples_.emplace_back(std::move(arguments), std::move(what));
}

std::string Usage::help(std::span<const OptionEntry> options) const {
  std::string text = "Usage: " + program_ + (operands_.empty() ? "" : " " + operands_) + " [options]\n";
  text += wrapped(summary_, 0, page_width) + "\n";
  if (!examples_.empty()) text += "\nExamples\n";
  for (const auto& [arguments, what] : examples_)
    text += "  " + program_ + " " + arguments + "\n      " + wrapped(what, 6, page_width - 6) + "\n";
  std::vector<std::string> groups;
  for (const OptionEntry& entry : options)
    if (std::ranges::find(groups, entry.group) == groups.end()) groups.push_back(entry.group);
  std::stable_partition(groups.begin(), groups.end(),
                        [](const std::string& g) { return !g.starts_with("Expert"); });
  for (const std::string& group : groups) {
    text += "\n" + group + "\n";
    for (const OptionEntry& entry : options)
      if (entry.group == group)
        text += entry_text(entry.option, forms(entry.option, entry.takes == Takes::yes_or_no,
                                               entry.takes == Takes::maybe_value));
  }
  return text;
}

}  // namespace tools
