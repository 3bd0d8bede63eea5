#include "tools/option_table.h"

#include <algorithm>

#include "geom/check.h"
#include "io/extension.h"

namespace tools {
namespace {

constexpr std::size_t page_width = 79, help_column = 27;

std::string with_default(const std::string& given, const Option& option, const std::string& initial) {
  return given.empty() && !option.required ? initial : given;
}

std::string join(const std::vector<std::string>& words, const std::string& separator) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : separator) + word;
  return joined;
}

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

void OptionTable::describe(std::string operands, std::string summary) {
  operands_ = std::move(operands);
  summary_ = std::move(summary);
}

void OptionTable::example(std::string arguments, std::string what) {
  examples_.emplace_back(std::move(arguments), std::move(what));
}

void OptionTable::group(std::string title) { group_ = std::move(title); }

void OptionTable::declare(Option option, Takes takes, Assign assign) {
  entries_.push_back({std::move(option), takes, std::move(assign), group_});
}

void OptionTable::custom(Option option, Assign assign) {
  declare(std::move(option), Takes::value, std::move(assign));
}

void OptionTable::custom_or_none(Option option, Assign assign) {
  declare(std::move(option), Takes::maybe_value, std::move(assign));
}

void OptionTable::number(Option option, double& target, double low, double high) {
  option.standard = with_default(option.standard, option, shortest(target));
  custom(std::move(option),
         [&target, low, high](const std::string& text) { target = parse_number(text, low, high); });
}

void OptionTable::text(Option option, std::string& target) {
  option.standard = with_default(option.standard, option, target);
  custom(std::move(option), [&target](const std::string& text) { target = text; });
}

void OptionTable::path(Option option, std::filesystem::path& target) {
  option.standard = with_default(option.standard, option, target.string());
  custom(std::move(option), [&target](const std::string& text) {
    geom::require(!text.empty(), "a file name cannot be empty");
    target = text;
  });
}

void OptionTable::output(Option option, std::filesystem::path& target, std::vector<std::string> endings) {
  custom(std::move(option), [&target, endings = std::move(endings)](const std::string& text) {
    geom::require(!text.empty(), "a file name cannot be empty");
    io::require_extension(text, endings);
    target = text;
  });
}

void OptionTable::flag(Option option, bool& target) {
  declare(std::move(option), Takes::nothing, [&target](const std::string&) { target = true; });
}

void OptionTable::toggle(Option option, bool& target) {
  option.standard = with_default(option.standard, option, target ? "on" : "off");
  declare(std::move(option), Takes::yes_or_no,
          [&target](const std::string& text) { target = text == "yes"; });
}

void OptionTable::toggle(Option option, std::optional<bool>& target) {
  declare(std::move(option), Takes::yes_or_no,
          [&target](const std::string& text) { target = text == "yes"; });
}

void OptionTable::toggle(Option option, std::function<void(bool)> assign) {
  declare(std::move(option), Takes::yes_or_no,
          [assign = std::move(assign)](const std::string& text) { assign(text == "yes"); });
}

void OptionTable::declare_choice(Option option, std::vector<std::string> words,
                                 std::function<void(std::size_t)> assign) {
  custom(std::move(option), [words = std::move(words), assign = std::move(assign)](const std::string& text) {
    const auto word = std::find(words.begin(), words.end(), text);
    geom::require(word != words.end(), "'" + text + "' is none of " + join(words, ", "));
    assign(static_cast<std::size_t>(word - words.begin()));
  });
}

void OptionTable::request(Option option, std::function<void()> answer) {
  declare(std::move(option), Takes::nothing, [answer = std::move(answer)](const std::string&) { answer(); });
}

std::string OptionTable::help() const {
  std::string text = "Usage: " + program_ + (operands_.empty() ? "" : " " + operands_) + " [options]\n";
  text += wrapped(summary_, 0, page_width) + "\n";
  if (!examples_.empty()) text += "\nExamples\n";
  for (const auto& [arguments, what] : examples_)
    text += "  " + program_ + " " + arguments + "\n      " + wrapped(what, 6, page_width - 6) + "\n";
  std::vector<std::string> groups;
  for (const Entry& entry : entries_)
    if (std::ranges::find(groups, entry.group) == groups.end()) groups.push_back(entry.group);
  std::stable_partition(groups.begin(), groups.end(),
                        [](const std::string& g) { return !g.starts_with("Expert"); });
  for (const std::string& group : groups) {
    text += "\n" + group + "\n";
    for (const Entry& entry : entries_)
      if (entry.group == group)
        text += entry_text(entry.option, forms(entry.option, entry.takes == Takes::yes_or_no,
                                               entry.takes == Takes::maybe_value));
  }
  return text;
}

}  // namespace tools
