#include "io/ply_header.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "io/text_cursor.h"

namespace io {

namespace {

PlyType parse_type(const TextCursor& cursor, std::string_view word) {
  using enum PlyType;
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> names{{{"char", int8},
                                                                        {"int8", int8},
                                                                        {"uchar", uint8},
                                                                        {"uint8", uint8},
                                                                        {"short", int16},
                                                                        {"int16", int16},
                                                                        {"ushort", uint16},
                                                                        {"uint16", uint16},
                                                                        {"int", int32},
                                                                        {"int32", int32},
                                                                        {"uint", uint32},
                                                                        {"uint32", uint32},
                                                                        {"float", float32},
                                                                        {"float32", float32},
                                                                        {"double", float64},
                                                                        {"float64", float64}}};
  for (const auto& [name, type] : names)
    if (word == name) return type;
  cursor.fail(in_quotes(word) + " is not a PLY type");
}

std::optional<std::endian> parse_format(TextCursor& cursor) {
  const std::string_view format = cursor.word();
  if (format == "ascii") return std::nullopt;
  if (format == "binary_little_endian") return std::endian::little;
  if (format == "binary_big_endian") return std::endian::big;
  cursor.fail(in_quotes(format) + " is not a PLY format (ascii, binary_little_endian, binary_big_endian)");
}

PlyElement parse_element(TextCursor& cursor, const PlyHeader& header) {
  PlyElement element{std::string(cursor.word())};
  const std::int64_t count = cursor.integer(cursor.word(), "the number of elements");
  if (count < 0) cursor.fail("the number of elements is negative");
  for (const PlyElement& other : header.elements)
    if (other.name == element.name) cursor.fail("element " + in_quotes(element.name) + " appears twice");
  element.count = static_cast<std::size_t>(count);
  return element;
}

PlyProperty parse_property(TextCursor& cursor) {
  PlyProperty property{};
  std::string_view word = cursor.word();
  if (word == "list") {
    property.count = parse_type(cursor, cursor.word());
    if (!is_integer(*property.count)) cursor.fail("the length of a list must be of an integer type");
    word = cursor.word();
  }
  property.type = parse_type(cursor, word);
  property.name = cursor.word();
  if (property.name.empty()) cursor.fail("a property has no name");
  return property;
}

/// The bytes that one record takes at least; in text, a digit and a blank for each number.
std::size_t smallest_record(const PlyElement& element, bool binary) {
  std::size_t bytes = 0;
  for (const PlyProperty& p : element.properties) bytes += binary ? size_of(p.count.value_or(p.type)) : 2;
  return bytes;
}

void check_room(const TextCursor& cursor, const PlyHeader& header) {
  std::size_t room = cursor.remaining() + (header.binary ? 0 : 1);  // the last blank may be missing
  for (const PlyElement& element : header.elements) {
    const std::size_t each = smallest_record(element, header.binary.has_value());
    if (each == 0) continue;
    if (element.count > room / each)
      cursor.fail("truncated: the header promises " + std::to_string(element.count) + " records " +
                  in_quotes(element.name) + " of at least " + std::to_string(each) + " bytes, only " +
                  std::to_string(room) + " bytes are left for them");
    room -= element.count * each;
  }
}

}  // namespace

std::size_t size_of(PlyType type) {
  using enum PlyType;
  switch (type) {
    case int8:
    case uint8:
      return 1;
    case int16:
    case uint16:
      return 2;
    case int32:
    case uint32:
    case float32:
      return 4;
    case float64:
      return 8;
  }
  return 0;
}

const PlyProperty* PlyElement::find(std::string_view wanted) const {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const PlyProperty& p) { return p.name == wanted; });
  return found == properties.end() ? nullptr : &*found;
}

PlyHeader parse_ply_header(const InputFile& file) {
  TextCursor cursor(file, {.comment = '\0', .continuation = false});
  if (!cursor.next_line() || cursor.word() != "ply") cursor.fail("no PLY header ('ply' on the first line)");
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    if (!cursor.next_line()) cursor.fail("truncated: the file ends before 'end_header'");
    const std::string_view keyword = cursor.word();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      header.binary = parse_format(cursor);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(parse_element(cursor, header));
    } else if (keyword == "property") {
      if (header.elements.empty()) cursor.fail("a property before the first element");
      header.elements.back().properties.push_back(parse_property(cursor));
    } else if (keyword != "comment" && keyword != "obj_info") {
      cursor.fail(in_quotes(keyword) + " is not a PLY header line");
    }
  }
  if (!has_format) cursor.fail("the header names no format");
  cursor.skip_line();
  header.body = cursor.offset();
  header.body_line = cursor.line();
  check_room(cursor, header);
  return header;
}

}  // namespace io
