#include "io/text_cursor.h"

#include <string>

#include "io/numbers.h"

namespace io {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

}  // namespace

TextCursor::TextCursor(const InputFile& file, LineSyntax syntax, std::size_t offset, std::size_t line)
    : file_(&file), text_(file.bytes), syntax_(syntax), at_(offset), line_(line) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (at_ == 0 && text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
}

void TextCursor::pass_line_end() {
  at_ += text_.substr(at_, 2) == "\r\n" ? 2 : 1;
  ++line_;
}

bool TextCursor::at_continuation() const {
  return syntax_.continuation && text_[at_] == '\\' && at_ + 1 < text_.size() &&
         (text_[at_ + 1] == '\n' || text_[at_ + 1] == '\r');
}

bool TextCursor::pass_continuation() {
  if (!at_continuation()) return false;
  ++at_;
  pass_line_end();
  return true;
}

void TextCursor::skip_blanks() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_]))
      ++at_;
    else if (!pass_continuation())
      return;
  }
}

void TextCursor::skip_line() {
  bool comment = false;
  while (at_ < text_.size() && !at_line_end()) {
    comment = comment || at_comment();
    if (comment || !pass_continuation()) ++at_;
  }
  if (at_ < text_.size()) pass_line_end();
}

bool TextCursor::next_line() {
  if (started_) skip_line();
  started_ = true;
  return find_word();
}

std::string_view TextCursor::word() {
  skip_blanks();
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]) && !at_line_end() && !at_comment() && !at_continuation())
    ++at_;
  return text_.substr(begin, at_ - begin);
}

bool TextCursor::find_word() {
  for (;; skip_line()) {
    skip_blanks();
    if (at_ == text_.size()) return false;
    if (!at_line_end() && !at_comment()) return true;
  }
}

std::string_view TextCursor::word_across_lines() { return find_word() ? word() : std::string_view(); }

double TextCursor::coordinate(std::string_view word) const {
  if (word.empty()) fail("a coordinate is missing");
  const auto value = parse_real(word);
  if (!value) fail(in_quotes(word) + " is not a number");
  if (const char* fault = coordinate_fault(*value)) fail(fault);
  return *value;
}

std::int64_t TextCursor::integer(std::string_view word, std::string_view what) const {
  if (word.empty()) fail(std::string(what) + " is missing");
  const auto value = parse_integer(word);
  if (!value) fail(std::string(what) + " " + in_quotes(word) + " is not a whole number");
  return *value;
}

}  // namespace io
