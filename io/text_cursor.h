#pragma once
// Walks a text file word by word. Lines end with \n, \r\n or \r; words are separated by blanks.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "io/input_file.h"

namespace io {

/// How a format treats its lines.
struct LineSyntax {
  char comment = '#';         ///< from here to the end of the line; '\0': no comments
  bool continuation = false;  ///< a backslash at the end of a line joins the next one (not inside comments)
};

/// Cost: linear in the bytes passed over. Errors name the current line.
class TextCursor {
 public:
  explicit TextCursor(const InputFile& file, LineSyntax syntax = {}, std::size_t offset = 0,
                      std::size_t line = 1);

  /// Leaves the current line for the next one that has a word (the first call: for the first such line).
  /// False at the end of the file.
  bool next_line();

  /// Moves to the next word of the file, on this line or a later one; false at the end of the file.
  bool find_word();
  /// The next word of the current line, empty at its end.
  std::string_view word();
  /// The word that find_word finds; empty at the end of the file.
  std::string_view word_across_lines();

  /// A word as a number; throws when it is missing (empty), malformed, not finite or beyond 1e48.
  double coordinate(std::string_view word) const;
  /// The word as an integer; throws naming `what`.
  std::int64_t integer(std::string_view word, std::string_view what) const;

  void skip_line();  ///< to the first byte of the next line
  std::size_t line() const { return line_; }
  std::size_t offset() const { return at_; }
  std::size_t remaining() const { return text_.size() - at_; }
  [[noreturn]] void fail(std::string_view what) const { file_->fail({line_, Unit::line}, what); }

 private:
  bool at_line_end() const { return text_[at_] == '\n' || text_[at_] == '\r'; }
  bool at_comment() const { return syntax_.comment != '\0' && text_[at_] == syntax_.comment; }
  bool at_continuation() const;
  void pass_line_end();
  bool pass_continuation();
  void skip_blanks();

  const InputFile* file_;
  std::string_view text_;
  LineSyntax syntax_;
  std::size_t at_;
  std::size_t line_;
  bool started_ = false;
};

}  // namespace io
