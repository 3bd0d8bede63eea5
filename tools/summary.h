#pragma once
// What a tool says at its end: a line "key value" for each number, the same as JSON, and for a person at a
// terminal some lines of words.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tools/worded.h"

namespace tools {

class Summary {
 public:
  /// A value as it is printed: a number, or text.
  void text(const std::string& key, const std::string& value);
  void count(const std::string& key, std::size_t value);
  void number(const std::string& key, double value, int decimals);  ///< decimals < 0: six digits ("%.6g")
  /// A line for people.
  void line(const std::string& words) { words_ += words + "\n"; }

  /// "key value" lines.
  std::string keys() const;
  /// An object; what is no number is quoted.
  std::string json() const;
  const std::string& words() const { return words_; }
  /// JSON if that is wanted; words on a terminal, if there are any; else keys, which programs read.
  void print(bool as_json) const;

 private:
  struct Entry {
    std::string key, value;
    bool number;
  };
  std::vector<Entry> entries_;
  std::string words_;
};

}  // namespace tools
