#include "fpo/fpo_c.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "fpo/fpo.h"
#include "fpo/remesh/remesh_defaults.h"

namespace {

constexpr std::size_t moves_a_call = 256;  // of the progress function
constexpr std::int32_t most_threads = 1024;

template <class T>
using Rows = Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, 3, Eigen::RowMajor>>;

fpo::Method method_of(std::int32_t method) {
  switch (method) {
    case fpo_method_fpo:
      return fpo::Method::fpo;
    case fpo_method_cvt:
      return fpo::Method::cvt;
    case fpo_method_mps:
      return fpo::Method::mps;
    case fpo_method_cps:
      return fpo::Method::cps;
    case fpo_method_pps:
      return fpo::Method::pps;
    case fpo_method_ccst:
      return fpo::Method::ccst;
    case fpo_method_vbs:
      return fpo::Method::vbs;
    case fpo_method_hps:
      return fpo::Method::hps;
  }
  throw geom::InputError("there is no method " + std::to_string(method));
}

static_assert(static_cast<int>(fpo::SizingKind::local_feature_size) == fpo_sizing_lfs &&
              static_cast<int>(fpo::SizingKind::curvature) == fpo_sizing_curvature &&
              static_cast<int>(fpo::SizingKind::given) == fpo_sizing_given);

fpo::SizingKind sizing_of(std::int32_t sizing) {
  for (const fpo::SizingFacts& facts : fpo::sizings())
    if (static_cast<std::int32_t>(facts.kind) == sizing) return facts.kind;
  throw geom::InputError("there is no sizing " + std::to_string(sizing));
}

std::optional<fpo::FeatureOptions> features_of(double angle) {
  geom::require(angle <= 180, "a feature angle is at most 180 degrees");
  if (angle < 0) return fpo::automatic_features();
  if (angle == 0) return {};
  return fpo::FeatureOptions{.crease_angle = angle, .weak_crease_angle = angle};
}

fpo::Effort effort_of(std::int32_t quality) {
  switch (quality) {
    case fpo_quality_best:
      return fpo::Effort::best;
    case fpo_quality_good:
      return fpo::Effort::good;
    case fpo_quality_draft:
      return fpo::Effort::draft;
  }
  throw geom::InputError("no quality has the number " + std::to_string(quality));
}

fpo::Sheets sheets_of(std::int32_t sheets) {
  switch (sheets) {
    case fpo_sheets_auto:
      return fpo::Sheets::automatic;
    case fpo_sheets_apart:
      return fpo::Sheets::apart;
    case fpo_sheets_together:
      return fpo::Sheets::together;
  }
  throw geom::InputError("there is no way with sheets of number " + std::to_string(sheets));
}

std::optional<double> given_number(double value) { return value < 0 ? std::nullopt : std::optional(value); }
std::optional<bool> given_choice(std::int32_t value) {
  return value < 0 ? std::nullopt : std::optional(value != 0);
}

fpo::Priority farthest_of(const fpo_options& given) {
  if (given.farthest_relative == 0) return fpo::by_radius;
  const auto rules = fpo::farthest_rules();
  const auto rule = std::ranges::find(rules, std::string_view("relative"), &fpo::FarthestRule::name);
  geom::ensure(rule != rules.end(), "no rule for the farthest point is called relative");
  return rule->priority;
}

/// The choices that few make.
void add_choices(const fpo_options& given, fpo::Options& options) {
  options.sheets = sheets_of(given.sheets);
  options.at_least = given.at_least != 0;
  options.maximal = given.maximal != 0;
  options.coarse_start = given.coarse_start != 0;
  options.clean = given.clean != 0;
  options.mend = given.mend != 0;
  options.rest = given.rest != 0;
  options.shortest_edge_removal = given.ser != 0;
  if (given.corners_all != 0) options.corners = geom::CornerTypes::all;
  options.farthest = farthest_of(given);
  options.min_angle = given_number(given.min_angle);
  options.min_delta = given_number(given.min_delta);
  if (given.gradation >= 0) options.limits.gradation = given.gradation;
  if (given.min_size >= 0) options.limits.smallest = given.min_size;
  if (given.max_size >= 0) options.limits.largest = given.max_size;
  options.weight_scale = given_number(given.weight_scale);
  if (given.tile_samples >= 0) options.tile_samples = static_cast<std::size_t>(given.tile_samples);
  if (given.search >= 0)
    options.scope = given.search == fpo_search_everywhere ? fpo::Scope::global : fpo::Scope::two_ring;
  options.optimize_angles = given_choice(given.optimize_angles);
  options.improve_fidelity = given_choice(given.improve_fidelity);
  options.come_closer = given_choice(given.come_closer);
  geom::require(given.num_fixed >= 0 && (given.num_fixed == 0 || given.fixed), "fixed points are missing");
  if (given.num_fixed > 0) options.fixed = Rows<double>(given.fixed, given.num_fixed, 3);
}

void require_numbers(const fpo_options& given) {
  const std::pair<const char*, double> numbers[] = {
      {"feature_angle", given.feature_angle}, {"target_delta", given.target_delta},
      {"min_angle", given.min_angle},         {"min_delta", given.min_delta},
      {"gradation", given.gradation},         {"min_size", given.min_size},
      {"max_size", given.max_size},           {"weight_scale", given.weight_scale}};
  for (const auto& [name, value] : numbers)
    geom::require(std::isfinite(value), std::string(name) + " is not a finite number");
  const std::pair<const char*, double> lengths[] = {
      {"edge_length", given.edge_length}, {"error", given.error}, {"radius", given.radius}};
  for (const auto& [name, value] : lengths)
    geom::require(value >= 0 && std::isfinite(value), std::string(name) + " is not a length, nor 0 for none");
  geom::require(given.threads >= 0 && given.threads <= most_threads,
                "threads must be between 0 and " + std::to_string(most_threads));
}

fpo::Options options_of(const fpo_options& given, std::int64_t num_vertices) {
  require_numbers(given);
  const bool by_lengths =
      given.edge_length > 0 || given.error > 0 || given.radius > 0 || given.sizing == fpo_sizing_given;
  geom::require(given.count > 0 || (given.count == 0 && by_lengths),
                "the number of samples must be at least 1");
  fpo::Options options;
  options.count = static_cast<std::size_t>(given.count);
  options.seed = given.seed;
  options.method = method_of(given.method);
  options.sizing = sizing_of(given.sizing);
  if (options.sizing == fpo::SizingKind::given) {
    geom::require(given.sizes != nullptr, "sizes are missing");
    options.sizes = Eigen::Map<const Eigen::VectorXd>(given.sizes, num_vertices);
  }
  options.features = features_of(given.feature_angle);
  options.threads = given.threads;
  if (given.iterations >= 0) options.iterations = given.iterations;
  if (given.target_delta >= 0) options.target_delta = given.target_delta;
  if (given.edge_length > 0) options.edge_length = given.edge_length;
  if (given.error > 0) options.error = given.error;
  if (given.radius > 0) options.radius = given.radius;
  options.quality = effort_of(given.quality);
  add_choices(given, options);
  return options;
}

/// Tells the progress function, and stops the run for it.
class Reporter {
 public:
  Reporter(const fpo_options& given, fpo::Options& options) : given_(given) {
    options.interrupted = &stopped_;
    if (!given.progress) return;
    const int iterations =
        options.iterations.value_or(fpo::default_iterations(options.method, options.sizing));
    options.on_iteration = [this](const fpo::IterationReport& report) {
      delta_ = report.delta;
      iteration_ = report.iteration;
    };
    // By lengths nobody knows here how many moves make an iteration.
    options.on_move = [this, iterations](std::size_t move) {
      const double moves = static_cast<double>(given_.count) * iterations;
      const double done = given_.count > 0 ? static_cast<double>(move) / std::max(1.0, moves)
                                           : static_cast<double>(iteration_) / std::max(1, iterations);
      if (move % moves_a_call == 0 && given_.progress(given_.user, done, delta_)) stopped_ = true;
    };
  }
  bool stopped() const { return stopped_; }

 private:
  const fpo_options& given_;
  double delta_ = 0;
  int iteration_ = 0;
  std::atomic<bool> stopped_ = false;
};

/// A copy of the coefficients, row after row; its owner frees it.
template <class T, class Matrix>
std::unique_ptr<T[]> rows_of(const Matrix& matrix) {
  auto copy = std::make_unique_for_overwrite<T[]>(static_cast<std::size_t>(matrix.size()));
  T* next = copy.get();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) *next++ = matrix(i, j);
  return copy;
}

fpo_result result_of(const fpo::Remesh& remesh) {
  auto vertices = rows_of<double>(remesh.V), barycentric = rows_of<double>(remesh.barycentric),
       wanted = rows_of<double>(remesh.wanted);
  auto facets = rows_of<std::int32_t>(remesh.F), source_facet = rows_of<std::int32_t>(remesh.facet);
  const fpo::RemeshMeasures& m = remesh.measures;
  return {.num_vertices = remesh.V.rows(),
          .num_facets = remesh.F.rows(),
          .vertices = vertices.release(),
          .facets = facets.release(),
          .source_facet = source_facet.release(),
          .barycentric = barycentric.release(),
          .wanted = wanted.release(),
          .q_min = m.quality.q_min,
          .q_avg = m.quality.q_avg,
          .theta_min = m.quality.theta_min,
          .theta_max = m.quality.theta_max,
          .delta = m.quality.delta,
          .mean_delta = m.quality.delta_avg,
          .iterations = m.optimization.last.iteration,
          .same_topology = m.same_topology()};
}

/// Returns whether the run was stopped.
bool remesh(const Rows<double>& vertices, const Rows<std::int32_t>& facets, const fpo_options& given,
            fpo_result& result) {
  fpo::Options options = options_of(given, vertices.rows());
  const Reporter reporter(given, options);
  result = result_of(fpo::remesh(vertices, facets, options));
  return reporter.stopped();
}

int fail(int code, std::string_view message, char* error, std::size_t error_size) {
  if (error_size == 0) return code;
  const std::size_t length = std::min(message.size(), error_size - 1);
  std::memcpy(error, message.data(), length);
  error[length] = '\0';
  return code;
}

}  // namespace

extern "C" {

[[gnu::visibility("default")]] void fpo_default_options(fpo_options* options) {
  const fpo::Options standard;
  *options = {};
  options->seed = standard.seed;
  options->method = fpo_method_fpo;
  options->sizing = fpo_sizing_uniform;
  options->feature_angle = -1;
  options->iterations = -1;
  options->target_delta = -1;
  options->quality = fpo_quality_best;
  options->sheets = fpo_sheets_auto;
  options->clean = standard.clean;
  options->mend = standard.mend;
  options->coarse_start = standard.coarse_start;
  options->min_angle = options->min_delta = -1;
  options->gradation = options->min_size = options->max_size = options->weight_scale = -1;
  options->tile_samples = -1;
  options->search = fpo_by_default;
  options->optimize_angles = options->improve_fidelity = options->come_closer = fpo_by_default;
}

[[gnu::visibility("default")]] int fpo_remesh(const double* vertices, std::int64_t num_vertices,
                                              const std::int32_t* facets, std::int64_t num_facets,
                                              const fpo_options* options, fpo_result* result, char* error,
                                              std::size_t error_size) {
  if (!error) error_size = 0;
  if (!result) return fail(fpo_bad_input, "there is no place for the result", error, error_size);
  *result = {};
  fail(fpo_done, "", error, error_size);
  try {
    geom::require(options, "there are no options");
    geom::require((vertices || num_vertices == 0) && (facets || num_facets == 0),
                  "vertices or facets are missing");
    geom::require(num_vertices >= 0 && num_facets >= 0, "a negative number of vertices or facets");
    const bool stopped = remesh({vertices, num_vertices, 3}, {facets, num_facets, 3}, *options, *result);
    return stopped ? fail(fpo_interrupted, "interrupted", error, error_size) : fpo_done;
  } catch (const geom::Interrupted& end) {
    return fail(fpo_interrupted, end.what(), error, error_size);
  } catch (const geom::InputError& fault) {
    return fail(fpo_bad_input, fault.what(), error, error_size);
  } catch (const std::bad_alloc&) {
    return fail(fpo_bad_input, "out of memory", error, error_size);
  } catch (const std::system_error& fault) {  // no thread to be had
    return fail(fpo_bad_input, fault.what(), error, error_size);
  } catch (const std::exception& bug) {
    return fail(fpo_bug, bug.what(), error, error_size);
  }
}

[[gnu::visibility("default")]] void fpo_free(fpo_result* result) {
  if (!result) return;
  delete[] result->vertices;
  delete[] result->facets;
  delete[] result->source_facet;
  delete[] result->barycentric;
  delete[] result->wanted;
  *result = {};
}
}
