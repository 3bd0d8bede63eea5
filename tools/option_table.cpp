#include "tools/option_table.h"

#include <algorithm>

#include "geom/check.h"
#include "io/extension.h"

namespace tools {
namespace {

std::string with_default(const std::string& given, const Option& option, const std::string& initial) {
  return given.empty() && !option.required ? initial : given;
}

std::string join(const std::vector<std::string>& words, const std::string& separator) {
  std::string joined;
  for (const std::string& word : words) joined += (joined.empty() ? "" : separator) + word;
  return joined;
}

}  // namespace

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

}  // namespace tools
