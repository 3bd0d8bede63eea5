#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

#include "geom/check.h"
#include "io/input_file.h"

namespace io {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t buffer_size = 1 << 16;

/// Short, so that any legal target name has a legal temporary; unique in this process, and by open's O_EXCL
/// among all.
std::string temporary_name() {
  static std::atomic<unsigned> counter{0};
  return ".fpo-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp";
}

/// A file of the folder that has no name yet, so that a process which dies leaves nothing; -1 where the
/// system knows no such files, or could not name it later.
int open_nameless([[maybe_unused]] const fs::path& folder) {
#ifdef O_TMPFILE
  if (::access("/proc/self/fd", X_OK) == 0)
    return ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
#endif
  return -1;
}

/// While it lives, no signal that can wait reaches this thread.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsHeld() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : name_(display_name(path)), target_(path) {
  if (path.empty()) fail(ENOENT);
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && ::access(path.c_str(), W_OK) != 0) fail(errno);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  std::error_code none, error;
  if (fs::is_symlink(path, none)) target_ = fs::weakly_canonical(path, error);
  if (error) fail(error.value());
  if (!target_.has_filename()) fail(EISDIR);
  open_temporary(target_.has_parent_path() ? target_.parent_path() : fs::path("."));
  if (exists) ::fchmod(descriptor_, status.st_mode & 0777);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::fail(int error) const {
  throw geom::InputError("cannot write " + name_ + ": " + std::generic_category().message(error));
}

void AtomicFile::open_temporary(const fs::path& folder) {
  descriptor_ = open_nameless(folder);
  nameless_ = descriptor_ >= 0;
  while (descriptor_ < 0) {
    fs::path name = folder / temporary_name();
    descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0)
      temporary_ = std::move(name);
    else if (errno != EEXIST)
      fail(errno);
  }
}

/// Gives the nameless file this name; false if it is taken.
bool AtomicFile::take_name(const fs::path& name) {
  const std::string open_file = "/proc/self/fd/" + std::to_string(descriptor_);
  if (::linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) return true;
  if (errno != EEXIST) fail(errno);
  return false;
}

/// The target's name at once if that is free, else one to rename from.
void AtomicFile::name_nameless() {
  if (take_name(target_)) return;
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  while (temporary_.empty())
    if (fs::path name = folder / temporary_name(); take_name(name)) temporary_ = std::move(name);
}

AtomicFile& AtomicFile::write(std::string_view bytes) {
  geom::ensure(descriptor_ >= 0, "AtomicFile: written to after commit");
  while (!bytes.empty()) {
    const std::string_view part = bytes.substr(0, buffer_size);
    buffer_ += part;
    bytes.remove_prefix(part.size());
    if (buffer_.size() >= buffer_size) flush();
  }
  return *this;
}

void AtomicFile::flush() {
  for (std::size_t done = 0; done < buffer_.size();) {
    const ssize_t written = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (written < 0 && errno != EINTR) fail(errno);
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  buffer_.clear();
}

void AtomicFile::commit() {
  geom::ensure(descriptor_ >= 0, "AtomicFile: committed twice");
  flush();
  const SignalsHeld held;  // for the moment that a temporary has a name
  if (nameless_) name_nameless();
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0) {
    const int error = errno;
    if (nameless_ && temporary_.empty()) ::unlink(target_.c_str());
    fail(error);
  }
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void require_writable(const fs::path& path) { AtomicFile probe(path); }

void write_file(const fs::path& path, std::string_view bytes) { AtomicFile(path).write(bytes).commit(); }

}  // namespace io
