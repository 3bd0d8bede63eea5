#include "io/gray_image.h"

#include <string>

#include "geom/check.h"
#include "io/extension.h"
#include "io/input_file.h"

#ifdef FPO_WITH_PNG
#include <png.h>
#endif

namespace io {
namespace {

#ifdef FPO_WITH_PNG

constexpr png_uint_32 most_side = 32768;  // as in pgm.cpp

/// Frees what libpng holds, however it ends.
struct PngImage {
  png_image image{};
  ~PngImage() { png_image_free(&image); }
};

GrayImage read_png(const std::filesystem::path& path) {
  const InputFile file = load(path);
  PngImage holder;
  png_image& image = holder.image;
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, file.bytes.data(), file.bytes.size()))
    file.fail(image.message);
  if (image.width > most_side || image.height > most_side) file.fail("a side of more than 32768 pixels");
  image.format = PNG_FORMAT_GRAY;
  std::vector<unsigned char> bytes(PNG_IMAGE_SIZE(image));
  const png_color white{255, 255, 255};
  if (!png_image_finish_read(&image, &white, bytes.data(), 0, nullptr)) file.fail(image.message);
  GrayImage result{image.width, image.height, {}};
  result.value.reserve(bytes.size());
  for (const unsigned char byte : bytes) result.value.push_back(static_cast<float>(byte) / 255);
  return result;
}

#else

GrayImage read_png(const std::filesystem::path& path) {
  throw geom::InputError(display_name(path) + ": this was built without libpng, which reads PNG (use .pgm)");
}

#endif

}  // namespace

std::vector<std::string> image_extensions() {
#ifdef FPO_WITH_PNG
  return {".pgm", ".png"};
#else
  return {".pgm"};
#endif
}

bool is_image(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".pgm" || extension == ".png";
}

GrayImage read_gray_image(const std::filesystem::path& path) {
  return lower_extension(path) == ".png" ? read_png(path) : read_pgm(path);
}

}  // namespace io
