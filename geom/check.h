#pragma once
// The two kinds of failure: the user's input is at fault (exit code 2), or we are (exit code 70). And the end
// that the user wants before there is a result (exit code 130).

#include <stdexcept>
#include <string>

namespace geom {

/// Bad input or bad use. The message is one line, complete, for the user: "bunny.ply:17: vertex index 99 out
/// of range".
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A broken invariant of our own.
struct Bug : std::logic_error {
  using std::logic_error::logic_error;
};

/// Interrupted so early that there is nothing to hand back.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted before there was a result") {}
};

inline void require(bool condition, const std::string& message) {
  if (!condition) throw InputError(message);
}
inline void require(bool condition, const char* message) {
  if (!condition) throw InputError(message);
}
inline void ensure(bool condition, const char* message) {
  if (!condition) throw Bug(message);
}

}  // namespace geom
