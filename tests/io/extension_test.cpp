#include "io/extension.h"

#include <string>

#include "doctest.h"
#include "geom/check.h"

namespace {

std::string refusal(const std::string& name) {
  try {
    io::require_extension(name, {".txt", ".ply"});
  } catch (const geom::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("extensions: a name may have one of those possible, in any case, or none") {
  for (const char* name : {"a.txt", "b.PLY", "folder.obj/c.ply", "/dev/stdout", "sizes"})
    CHECK(refusal(name) == "");
  CHECK(refusal("a.obj") == "a.obj: unknown extension '.obj' (use .txt or .ply)");
  CHECK(refusal("a.txt.gz") == "a.txt.gz: unknown extension '.gz' (use .txt or .ply)");
}
