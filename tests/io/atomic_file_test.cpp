#include "io/atomic_file.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

#include "doctest.h"
#include "io/mesh_io.h"
#include "tests/fixtures/models.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/scratch_folder.h"

using fixtures::complaint;
using fixtures::ScratchFolder;
namespace fs = std::filesystem;

namespace {

mode_t permissions(const fs::path& path) {
  struct stat status {};
  ::stat(path.c_str(), &status);
  return status.st_mode & 0777;
}

/// While it lives, no file may grow beyond `bytes`: a write fails as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*old_handler_)(int);
};

}  // namespace

TEST_CASE("AtomicFile: appears at commit, whole") {
  const ScratchFolder folder;
  const std::string large(300000, 'x');
  {
    io::AtomicFile file(folder / "a.txt");
    file.write("begin ").write(large);
    CHECK(!fs::exists(folder / "a.txt"));
    file.write(" end").commit();
  }
  CHECK(ScratchFolder::read(folder / "a.txt") == "begin " + large + " end");
  CHECK(folder.num_entries() == 1);
}

TEST_CASE("AtomicFile: without a commit, or with an exception, all stays as it was") {
  const ScratchFolder folder;
  folder.write("old.txt", "old");
  for (const char* name : {"old.txt", "new.txt"}) {
    try {
      io::AtomicFile file(folder / name);
      file.write(std::string(200000, 'y'));
      throw std::logic_error("stop");
    } catch (const std::logic_error&) {
    }
    io::AtomicFile(folder / name).write("z");
    io::require_writable(folder / name);
  }
  CHECK(ScratchFolder::read(folder / "old.txt") == "old");
  CHECK(folder.num_entries() == 1);
}

TEST_CASE("AtomicFile: a full disk is reported and leaves neither file nor temporary") {
  const ScratchFolder folder;
  const auto path = folder / "large.obj";
  std::string message;
  {
    const FileSizeLimit limit(1000);
    message = complaint([&] { io::write_mesh(path, fixtures::random_soup(1, false)); });
  }
  CHECK(message == "cannot write " + path.string() + ": File too large");
  CHECK(folder.num_entries() == 0);
}

TEST_CASE("AtomicFile: no folder, a folder as target, an empty name") {
  const ScratchFolder folder;
  fs::create_directory(folder / "d.obj");
  const auto fault = [&](const fs::path& path) {
    return complaint([&] { io::write_mesh(path, fixtures::tetrahedron()); });
  };
  CHECK(fault(folder / "d.obj") == "cannot write " + (folder / "d.obj").string() + ": Is a directory");
  CHECK(fault(folder / "none/a.obj") ==
        "cannot write " + (folder / "none/a.obj").string() + ": No such file or directory");
  folder.write("file", "x");
  CHECK(fault(folder / "file/a.obj") ==
        "cannot write " + (folder / "file/a.obj").string() + ": Not a directory");
  CHECK(complaint([] { io::AtomicFile file(""); }) == "cannot write '': No such file or directory");
  CHECK(complaint([&] { io::AtomicFile file((folder / "x/").string()); }) != "");
  CHECK(folder.num_entries() == 2);
}

TEST_CASE("AtomicFile: a folder or file without write permission") {
  if (::geteuid() == 0) {
    fixtures::skip_announced() = true;
    MESSAGE("skipped: root may write everywhere");
    return;
  }
  const ScratchFolder folder;
  fs::create_directory(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  const auto message = complaint([&] { io::AtomicFile file(folder / "locked/a.obj"); });
  CHECK(message == "cannot write " + (folder / "locked/a.obj").string() + ": Permission denied");
  fs::permissions(folder / "locked", fs::perms::owner_all);
  fs::permissions(folder.write("kept.obj", "x"), fs::perms::owner_read);
  CHECK(complaint([&] { io::AtomicFile file(folder / "kept.obj"); }).ends_with(": Permission denied"));
}

TEST_CASE("AtomicFile: permissions follow the umask, or those of the file replaced; links are followed") {
  const ScratchFolder folder;
  const mode_t before = ::umask(027);
  io::write_file(folder / "new.txt", "1");
  ::umask(before);
  CHECK(permissions(folder / "new.txt") == 0640);
  fs::permissions(folder / "new.txt", fs::perms(0604));
  fs::create_symlink("new.txt", folder / "link.txt");
  io::write_file(folder / "link.txt", "2");
  CHECK(fs::is_symlink(folder / "link.txt"));
  CHECK(ScratchFolder::read(folder / "new.txt") == "2");
  CHECK(permissions(folder / "new.txt") == 0604);
  io::write_file("/dev/null", "3");
  CHECK(!fs::is_regular_file("/dev/null"));
}

TEST_CASE("AtomicFile: a name of the greatest legal length") {
  const ScratchFolder folder;
  io::write_file(folder / std::string(255, 'n'), "1");
  CHECK(folder.num_entries() == 1);
  CHECK(complaint([&] {
          io::write_file(folder / std::string(256, 'n'), "1");
        }).ends_with(": File name too long"));
  CHECK(folder.num_entries() == 1);
}
