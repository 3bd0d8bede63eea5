#include "io/polylines.h"

#include <string>

#include "doctest.h"
#include "geom/check.h"
#include "tests/io/scratch_folder.h"

TEST_CASE("polylines: blank lines and comment lines separate, a line by itself is a point") {
  const fixtures::ScratchFolder scratch;
  const auto file = scratch.write("a.txt", "\n\n0 0\n1 0 # a comment\r\n1 1\n\n\n.5 .5\n# apart\n2 2\n3 3");
  const auto found = io::read_polylines(file);
  REQUIRE(found.size() == 3);
  CHECK(found[0].size() == 3);
  CHECK(found[0][2] == geom::Vec2(1, 1));
  CHECK(found[1] == std::vector<geom::Vec2>{{0.5, 0.5}});
  CHECK(found[2].size() == 2);
}

TEST_CASE("polylines: complaints name file and line") {
  const fixtures::ScratchFolder scratch;
  const auto complaint = [&](const std::string& text) -> std::string {
    const auto file = scratch.write("bad.txt", text);
    try {
      io::read_polylines(file);
    } catch (const geom::InputError& error) {
      const std::string what = error.what();
      return what.substr(what.find("bad.txt"));
    }
    return "none";
  };
  CHECK(complaint("0 0\n1\n").starts_with("bad.txt:2: "));
  CHECK(complaint("0 0\n1 x\n").starts_with("bad.txt:2: "));
  CHECK(complaint("0 0 7\n").starts_with("bad.txt:1: "));
  CHECK(complaint("0 nan\n").starts_with("bad.txt:1: "));
  CHECK(complaint("# only this\n").starts_with("bad.txt: no points"));
  CHECK_THROWS_AS(io::read_polylines(scratch.path() / "none.txt"), geom::InputError);
}
