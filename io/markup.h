#pragma once
// Words inside XML and HTML.

#include <string>
#include <string_view>

namespace io {

/// The text with the characters that markup claims written as entities; also fit for a value in double
/// quotes.
inline std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

}  // namespace io
