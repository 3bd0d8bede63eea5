#include "tools/plane_sizing_source.h"

#include "fpo/plane/curve_feature_size.h"
#include "fpo/plane/image_sizing.h"
#include "io/extension.h"
#include "io/gray_image.h"
#include "io/polylines.h"

namespace tools {
namespace {

/// What is wrong with the content of a file is said with its name.
template <class Make>
auto about_file(const std::string& name, Make&& make) {
  try {
    return make();
  } catch (const geom::InputError& error) {
    throw geom::InputError(name + ": " + error.what());
  }
}

std::unique_ptr<fpo::PlaneSizing> image_sizing(const PlaneArguments& a, const geom::FlatTorus& torus) {
  io::GrayImage image = io::read_gray_image(a.sizing);
  for (float& value : image.value) value = 1 - value;
  return about_file(a.sizing, [&] {
    return fpo::image_sizing({image.width, image.height, std::move(image.value)}, torus, a.num_samples,
                             {.gradation = a.gradation});
  });
}

std::unique_ptr<fpo::PlaneSizing> curve_sizing(const PlaneArguments& a, const geom::FlatTorus& torus) {
  const std::vector<fpo::Polyline> curves = io::read_polylines(a.sizing);
  return about_file(a.sizing, [&] {
    const auto points = fpo::curve_feature_size(curves, torus, torus.period().minCoeff() / 1024);
    return fpo::feature_sizing(points, torus, a.num_samples, {.gradation = a.gradation});
  });
}

}  // namespace

std::unique_ptr<fpo::PlaneSizing> make_plane_sizing(const PlaneArguments& a, const geom::FlatTorus& torus) {
  if (auto named = fpo::named_sizing(a.sizing, torus)) return named;
  const bool image = io::is_image(a.sizing);
  geom::require(
      image || io::lower_extension(a.sizing) == ".txt",
      "--sizing: '" + a.sizing +
          "' is neither an image (.pgm, .png), a .txt file of curves, nor the name of a field (see --help)");
  return image ? image_sizing(a, torus) : curve_sizing(a, torus);
}

}  // namespace tools
