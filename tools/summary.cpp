#include "tools/summary.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace tools {
namespace {

std::string json_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      (result += '\\') += c;
    else if (static_cast<unsigned char>(c) < 0x20)
      result += worded("\\u%04x", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + "\"";
}

}  // namespace

void Summary::text(const std::string& key, const std::string& value) {
  entries_.push_back({key, value, false});
}

void Summary::count(const std::string& key, std::size_t value) {
  entries_.push_back({key, std::to_string(value), true});
}

void Summary::number(const std::string& key, double value, int decimals) {
  entries_.push_back(
      {key, decimals < 0 ? worded("%.6g", value) : worded("%.*f", decimals, value), std::isfinite(value)});
}

std::string Summary::keys() const {
  std::string text;
  for (const Entry& e : entries_) text += e.key + " " + e.value + "\n";
  return text;
}

std::string Summary::json() const {
  std::string text;
  for (const Entry& e : entries_)
    text += (text.empty() ? "{\n  " : ",\n  ") + json_string(e.key) + ": " +
            (e.number ? e.value : json_string(e.value));
  return (text.empty() ? "{" : text + "\n") + "}\n";
}

void Summary::print(bool as_json) const {
  const bool person = !words_.empty() && ::isatty(STDOUT_FILENO) == 1;
  const std::string text = as_json ? json() : person ? words_ : keys();
  std::fputs(text.c_str(), stdout);
}

}  // namespace tools
