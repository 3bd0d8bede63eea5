#pragma once
// Asking the memory for what will be read soon.

namespace geom {

/// No effect but on speed. The empty statement keeps GCC from taking a function that does nothing else for
/// one without any effect, whose calls it drops.
inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  asm volatile("");
}

}  // namespace geom
