#pragma once
// Numbers in binary files, of either byte order, at any alignment.

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace io {

/// The number stored at `bytes`.
template <class T>
T load_number(const char* bytes, std::endian order) {
  char raw[sizeof(T)];
  std::memcpy(raw, bytes, sizeof raw);
  if (order != std::endian::native) std::reverse(raw, raw + sizeof raw);
  T value;
  std::memcpy(&value, raw, sizeof value);
  return value;
}

/// Appends a number in little-endian order.
template <class T>
void append_little(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof raw);
  if (std::endian::native != std::endian::little) std::reverse(raw, raw + sizeof raw);
  bytes.append(raw, sizeof raw);
}

}  // namespace io
