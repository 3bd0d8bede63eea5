#include "io/pgm.h"

#include <string>

#include "doctest.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/scratch_folder.h"

using fixtures::complaint;
using fixtures::ScratchFolder;

TEST_CASE("pgm: text and binary, 8 and 16 bits, with comments, give the same image") {
  const ScratchFolder folder;
  const std::vector<float> values = {0, 0.2f, 1, 0.4f, 0.6f, 0.8f};
  const auto is_right = [&](const std::string& bytes) {
    const io::GrayImage image = io::read_pgm(folder.write("a.pgm", bytes));
    return image.width == 3 && image.height == 2 && image.value == values;
  };
  CHECK(is_right("P2\n# made by hand\n3 2\n5\n0 1 5\n2 3 4\n"));
  CHECK(is_right("P2 3 # width\n2 255 0 51 255 102 153 204"));
  CHECK(is_right(std::string("P5\n3 2\n5\n") + std::string("\0\1\5\2\3\4", 6)));
  CHECK(is_right(std::string("P5 3 2 65535\n") +
                 std::string("\x00\x00\x33\x33\xff\xff\x66\x66\x99\x99\xcc\xcc", 12)));
  // A first value that looks like a blank or a comment is a value.
  CHECK(io::read_pgm(folder.write("b.pgm", "P5 2 1 255\n#\n")).value ==
        std::vector<float>{35 / 255.f, 10 / 255.f});
}

TEST_CASE("pgm: each fault is named in one line") {
  const ScratchFolder folder;
  const auto fault = [&](const std::string& bytes) {
    const auto path = folder.write("a.pgm", bytes);
    const std::string message = complaint([&] { io::read_pgm(path); });
    REQUIRE(message.starts_with(path.string()));
    CHECK(message.find('\n') == std::string::npos);
    return message.substr(path.string().size());
  };
  CHECK(fault("P6 1 1 255\n") == ": is no PGM image (it starts with neither P2 nor P5)");
  CHECK(fault("P2\n0 4\n255\n") == ":2: the width 0 is not between 1 and 32768");
  CHECK(fault("P2\n4 99999\n255\n") == ":2: the height 99999 is not between 1 and 32768");
  CHECK(fault("P2\n4 4\n0\n") == ":3: the largest value 0 is not between 1 and 65535");
  CHECK(fault("P2\n2 1\n9\n3 10\n") == ":4: the value 10 is not between 0 and 9");
  CHECK(fault("P2\n2 1\n9\n3 -1\n") == ":4: the value -1 is not between 0 and 9");
  CHECK(fault("P2\n2 2\n9\n3 1\n").ends_with("the image ends after 2 of 4 values"));
  CHECK(fault("P5\n30000 30000\n255\nabc") == ":byte 22: the image ends after 3 of 900000000 values");
  CHECK(fault(std::string("P5\n1 1\n5\n\6")) == ":byte 9: the value 6 is not between 0 and 5");
  fault("P2\n3 x 5\n");
  fault("P2\n3");
  fault("P5");
}
