#pragma once
// Output files that are complete or not there at all.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace io {

/// Writes to a temporary file in the folder of `path` and renames it to `path` on commit(). Without a commit
/// (an exception, an early return) the temporary is removed and `path` stays as it was. Where the file system
/// can (Linux's O_TMPFILE), the temporary has no name before commit(), where it takes that of `path` at once
/// if there is no such file, so that even a process that is killed leaves nothing behind. Elsewhere, and in
/// the moment of replacing a file, a kill may leave .fpo-PID-NUMBER.tmp. An existing file keeps its
/// permissions, a new one gets those of the umask; a symbolic link is followed; a device or pipe is written
/// directly. Every failure is a geom::InputError "cannot write path: reason".
class AtomicFile {
 public:
  /// Throws if `path` is a directory, cannot be replaced, or its folder takes no new file.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  AtomicFile& write(std::string_view bytes);  ///< buffered
  void commit();                              ///< once, after the last write

 private:
  [[noreturn]] void fail(int error) const;
  void open_temporary(const std::filesystem::path& folder);
  bool take_name(const std::filesystem::path& name);
  void name_nameless();
  void flush();

  std::string name_;                 ///< for messages
  std::filesystem::path target_;     ///< links resolved
  std::filesystem::path temporary_;  ///< empty: none, or no longer, or it has no name
  std::string buffer_;
  int descriptor_ = -1;
  bool nameless_ = false;  ///< the temporary gets its name at commit()
};

/// Throws what writing to `path` would throw at its start; leaves nothing behind. Lets a long computation
/// refuse early.
void require_writable(const std::filesystem::path& path);

/// Writes a whole file atomically.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace io
