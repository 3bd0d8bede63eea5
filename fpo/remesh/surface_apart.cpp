#include "fpo/remesh/surface_apart.h"

#include "fpo/remesh/stand_in.h"
#include "fpo/remesh/start.h"
#include "fpo/surface/near_sheets.h"
#include "fpo/surface/sheet_levels.h"

namespace fpo {
namespace {

constexpr double most_near_itself = 0.25;  // of the surface

}  // namespace

double share_near_itself(const RemeshTask& task, const SharedSizing& shared, const RemeshOptions& options) {
  if (options.sheets != Sheets::automatic || options.method != Method::fpo || task.start || !options.mend)
    return 0;
  const auto samples = initial_samples(task.surface(), shared, options.num_samples, options.seed);
  return share_on_near_sheets(task.surface(), shared.sizing, samples, SheetOptions().near);
}

std::optional<SplitSurface> surface_apart(const RemeshTask& task, SharedSizing& shared,
                                          const RemeshOptions& options, double near_itself) {
  if (facts_of(options.method).distribute) return {};
  if (options.sheets != Sheets::apart &&
      (!(near_itself > most_near_itself) ||
       has_needles(task.surface(), options.num_samples, even_spacing(task.input, options))))
    return {};
  return sheets_apart(task.surface(), shared.sizing, shared.features.samples);
}

bool has_near_sheets(const RemeshTask& task, const SharedSizing& shared, const RemeshOptions& options) {
  if (has_needles(task.surface(), options.num_samples, even_spacing(task.input, options))) return false;
  std::vector<SurfaceSample> on_features = shared.features.samples;
  return sheets_apart(task.surface(), shared.sizing, on_features).has_value();
}

}  // namespace fpo
