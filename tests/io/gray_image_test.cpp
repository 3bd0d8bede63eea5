#include "io/gray_image.h"

#include <algorithm>
#include <array>

#include "doctest.h"
#include "geom/check.h"
#include "io/png.h"
#include "tests/io/scratch_folder.h"

using fixtures::ScratchFolder;

TEST_CASE("gray images: PNG gives back what was written, row by row from the top, where it can be read") {
  const ScratchFolder folder;
  const std::array<std::uint8_t, 6> pixels{0, 51, 102, 153, 204, 255};
  folder.write("image.png", io::gray_png(3, 2, pixels));
  CHECK(io::is_image("a.PNG"));
  CHECK(!io::is_image("a.txt"));
  const std::vector<std::string> endings = io::image_extensions();
  if (std::ranges::find(endings, ".png") == endings.end()) {
    CHECK_THROWS_AS(io::read_gray_image(folder / "image.png"), geom::InputError);
    return;
  }
  const io::GrayImage image = io::read_gray_image(folder / "image.png");
  CHECK(image.width == 3);
  CHECK(image.height == 2);
  REQUIRE(image.value.size() == pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    CHECK(static_cast<double>(image.value[i]) == doctest::Approx(pixels[i] / 255.0));
  const std::string bytes = io::gray_png(3, 2, pixels);
  for (const std::size_t left : {bytes.size() - 20, bytes.size() / 2, std::size_t{9}}) {
    folder.write("cut.png", bytes.substr(0, left));
    CHECK_THROWS_AS(io::read_gray_image(folder / "cut.png"), geom::InputError);
  }
  folder.write("text.png", "P2 1 1 255 0\n");
  CHECK_THROWS_AS(io::read_gray_image(folder / "text.png"), geom::InputError);
}

TEST_CASE("gray images: PGM as ever") {
  const ScratchFolder folder;
  folder.write("image.pgm", "P2 2 1 255 255 0\n");
  CHECK(io::read_gray_image(folder / "image.pgm").value == std::vector<float>{1, 0});
}
