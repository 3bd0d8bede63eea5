#include "fpo/surface/sizing_kinds.h"

#include <algorithm>
#include <cmath>

#include "fpo/surface/curvature.h"
#include "fpo/surface/local_feature_size.h"
#include "fpo/surface/surface_cover.h"
#include "geom/check.h"

namespace fpo {
namespace {

/// Some ten surface points a sample. On needles, which have edges but no area, the estimate knows no bound:
/// there the points lie farther apart.
double cover_spacing(const geom::TriMesh& surface, std::size_t num_samples, double spacing) {
  const double most = std::min(
      20e6, 200 * static_cast<double>(num_samples) + 20 * static_cast<double>(surface.num_vertices()));
  double result = 0.3 * spacing;
  while (cover_size(surface, result) > most) result *= 2;
  return result;
}

VertexField local_feature_sizes(const SizingTask& task) {
  LocalFeatureSizeOptions options;
  options.threads = task.threads;
  options.spacing = cover_spacing(task.surface, task.num_samples, task.spacing);
  VertexField lfs = local_feature_size(task.surface, options);
  for (double& value : lfs) value = std::max(value, 1e-6 * task.spacing);  // 0 is not excluded
  return lfs;
}

/// Only the ratios of the wanted lengths count: scaled by a power of two, so that they may be of any size.
VertexField given_sizes(const SizingTask& task) {
  VertexField rho = task.given;
  double most = 0;
  for (const double value : rho)
    if (std::isfinite(value)) most = std::max(most, value);
  int exponent = 0;
  std::frexp(most, &exponent);
  for (double& value : rho) value = std::ldexp(value, -exponent);
  return rho;
}

VertexField radii_of_curvature(const SizingTask& task) {
  return curvature_size(task.surface, {.min = 1e-6 * task.spacing});
}

}  // namespace

std::span<const SizingFacts> sizings() {
  static constexpr SizingFacts table[] = {
      {SizingKind::uniform, "uniform", "uniform", "", nullptr},
      {SizingKind::local_feature_size, "lfs", "local feature size", "local feature size",
       local_feature_sizes},
      {SizingKind::curvature, "curvature", "curvature", "its radius", radii_of_curvature},
      {SizingKind::given, nullptr, "given", "a number per vertex of INPUT", given_sizes}};
  return table;
}

const SizingFacts& facts_of(SizingKind kind) {
  const auto found = std::ranges::find(sizings(), kind, &SizingFacts::kind);
  geom::ensure(found != sizings().end(), "a sizing without a line in the table of sizings");
  return *found;
}

}  // namespace fpo
