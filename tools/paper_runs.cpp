#include "tools/paper_runs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "fpo/remesh/remesh_defaults.h"
#include "fpo/spectrum/spectrum_set.h"
#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/parallel.h"
#include "io/extension.h"
#include "io/mesh_picture.h"
#include "tools/surface_input.h"
#include "tools/worded.h"

namespace tools {
namespace {

using fpo::PaperBlock;

/// What can run by itself, and about how long it takes (in samples times iterations on a surface).
struct Job {
  std::string name;
  double cost = 0;
  std::function<void()> run;
};

/// A set that tables and figures may share: it is made once.
struct Wanted {
  std::string model;
  std::size_t samples = 0;
  bool adaptive = false;
  std::string method;
  std::uint64_t seed = 0;

  auto operator<=>(const Wanted&) const = default;
  std::string name() const {
    return model + " " + std::to_string(samples) + (adaptive ? " adaptive " : " ") + method + ", seed " +
           std::to_string(seed);
  }
};

/// What becomes of a set, and the CPU seconds that it took.
using Use = std::function<void(const fpo::RemeshResult&, double)>;

/// The models' surfaces by their names in the paper, those that are there.
using Surfaces = std::map<std::string, geom::TriMesh>;

/// Which spectra the paper shows. Figures 7 and 8 compare methods, figure 9 is about features.
struct SpectrumCase {
  int figure;
  const char* model;
  std::size_t samples;
  bool adaptive;
};
constexpr std::array<SpectrumCase, 6> spectrum_cases = {{{7, "Venus", 1700, false},
                                                         {7, "Eight", 1700, false},
                                                         {8, "Bunny", 6300, true},
                                                         {8, "Kitten", 9800, true},
                                                         {9, "Joint", 3400, false},
                                                         {9, "Mask", 6000, false}}};

fpo::RemeshOptions options_for(const PaperMethod& method, std::size_t samples, bool adaptive,
                               const PaperOptions& paper) {
  fpo::RemeshOptions options = fpo::default_options(
      samples, adaptive ? fpo::SizingKind::local_feature_size : fpo::SizingKind::uniform);
  method.set(options);
  int& iterations = options.optimize.max_iterations;
  if (paper.iterations >= 0) iterations = std::min(iterations, paper.iterations);
  return options;
}

fpo::PowerSpectrum spectrum_of(const geom::TriMesh& surface, const fpo::RemeshResult& result, double radius,
                               bool adaptive) {
  std::vector<geom::WeightedPoint3> points;
  for (std::size_t i = 0; i < result.samples.size(); ++i)
    points.push_back({result.samples[i].position, std::pow(result.wanted[geom::VertexId(i)], 2)});
  const auto rule = adaptive ? fpo::SpacingRule::weights : fpo::SpacingRule::uniform;
  const fpo::SpectrumOptions options{.radius = radius};
  return fpo::differential_spectrum(
      fpo::surface_set(std::span<const geom::WeightedPoint3>(points), fpo::SpectrumSurface(surface), rule),
      options);
}

/// So large that it fits beside its spectrum on the page.
io::Svg thumbnail(const geom::TriMesh& mesh) {
  io::MeshPicture picture;
  picture.size = 300;
  picture.edge_width = 0.25;
  picture.back_faces = geom::topology(mesh).boundary_edges > 0;
  return io::draw_mesh(geom::scaled(mesh, geom::factor_to_unit_box(mesh)), picture);
}

/// Everything that is run, with a place for each result.
class Experiments {
 public:
  Experiments(const PaperOptions& options, const Surfaces& surfaces)
      : options_(options), surfaces_(surfaces) {
    if (options.tables) add_tables();
    if (options.spectra) add_spectra();
    add_remeshes();
    if (options.convergence) add_convergence();
    if (options.runtimes) add_runtimes();
  }

  /// The long ones first.
  void run() {
    std::ranges::stable_sort(jobs_, std::greater(), &Job::cost);
    std::mutex access;
    std::size_t done = 0;
    geom::parallel_ranges(jobs_.size(), 1, options_.threads, [&](std::size_t first, std::size_t) {
      const double start = thread_seconds();
      jobs_[first].run();
      const double seconds = thread_seconds() - start;
      const std::lock_guard lock(access);
      ++done;
      cpu_seconds_ += seconds;
      if (!options_.progress) return;
      options_.progress(
          worded("%zu of %zu: %s, %.1f s", done, jobs_.size(), jobs_[first].name.c_str(), seconds));
    });
  }

  PaperResults results() {
    PaperResults r;
    r.cpu_seconds = cpu_seconds_;
    r.runs = std::move(runs_);
    for (SpectrumSets& s : spectra_) {
      PaperSpectrum& out = r.spectra.emplace_back(std::move(s.about));
      out.mean.num_sets = s.sets.size();
      out.mean.spectrum = fpo::mean_spectrum(s.sets);
      out.mean.curve = fpo::radial_curve(out.mean.spectrum, fpo::ring_width({.radius = options_.radius}));
    }
    if (!convergence_.empty()) r.convergence = mean(convergence_);
    r.convergence_models = std::move(convergence_models_);
    if (runtimes_) r.runtimes = runtimes_->curves();
    return r;
  }

 private:
  struct SpectrumSets {
    PaperSpectrum about;
    std::vector<fpo::PowerSpectrum> sets;
  };

  std::span<const PaperMethod> methods() const {
    return options_.methods.empty() ? paper_methods() : std::span<const PaperMethod>(options_.methods);
  }

  const geom::TriMesh* surface(const std::string& model) const {
    const auto found = surfaces_.find(model);
    return found == surfaces_.end() ? nullptr : &found->second;
  }

  /// A row for each method.
  void add_tables() {
    for (const PaperBlock& block : fpo::paper_blocks()) {
      if (!surface(block.model)) continue;
      for (const PaperMethod& method : methods()) runs_.push_back({block, method.name, {}, 0});
    }
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const PaperBlock& b = runs_[i].block;
      uses_[{b.model, b.samples, b.adaptive, runs_[i].method, options_.seed}].push_back(
          [this, i](const fpo::RemeshResult& result, double seconds) {
            PaperRun& run = runs_[i];
            run.seconds = seconds;
            run.figures = figures_of(measure(result.mesh, *surface(run.block.model), 1));
          });
    }
  }

  void add_spectra() {
    for (const SpectrumCase& c : spectrum_cases) {
      if (!surface(c.model)) continue;
      for (const PaperMethod& method : methods())
        if (c.figure != 9 || method.name == "FPO") add_spectrum(c, method);
    }
  }

  void add_spectrum(const SpectrumCase& c, const PaperMethod& method) {
    const int num_sets = c.figure == 7 ? options_.sets : (options_.sets + 1) / 2;
    const std::size_t i = spectra_.size();
    spectra_.push_back({{c.figure, c.model, method.name, c.samples, {}, io::Svg(1, 1)}, {}});
    spectra_[i].sets.resize(static_cast<std::size_t>(num_sets));
    for (std::size_t set = 0; set < spectra_[i].sets.size(); ++set)
      uses_[{c.model, c.samples, c.adaptive, method.name, options_.seed + set}].push_back(
          [this, i, set, c](const fpo::RemeshResult& result, double) {
            spectra_[i].sets[set] = spectrum_of(*surface(c.model), result, options_.radius, c.adaptive);
            if (set == 0) spectra_[i].about.picture = thumbnail(result.mesh);
          });
  }

  /// A job for each set, whoever uses it.
  void add_remeshes() {
    for (const auto& entry : uses_) {
      const auto& wanted = entry.first;
      const auto& uses = entry.second;
      const auto method = std::ranges::find(paper_methods(), wanted.method, &PaperMethod::name);
      fpo::RemeshOptions options = options_for(*method, wanted.samples, wanted.adaptive, options_);
      options.seed = wanted.seed;
      jobs_.push_back({wanted.name(), cost(options), [this, &wanted, &uses, options] {
                         const double start = thread_seconds();
                         const fpo::RemeshResult result = remeshed(wanted.model, options);
                         const double seconds = thread_seconds() - start;
                         for (const Use& use : uses) use(result, seconds);
                       }});
    }
  }

  fpo::RemeshResult remeshed(const std::string& model, const fpo::RemeshOptions& options) const try {
    return fpo::remesh(*surface(model), options);
  } catch (const geom::InputError& error) {
    throw geom::InputError(model + ": " + error.what());
  }

  void add_convergence() {
    const int iterations = options_.iterations >= 0 ? std::min(100, options_.iterations) : 100;
    for (const ConvergenceCase& c : convergence_cases)
      if (surface(c.model))
        convergence_models_.push_back(c.model + std::string(" ") + std::to_string(c.samples));
    convergence_.resize(convergence_models_.size());
    std::size_t i = 0;
    for (const ConvergenceCase& c : convergence_cases) {
      if (!surface(c.model)) continue;
      jobs_.push_back({std::string("figure 10 left ") + c.model, static_cast<double>(c.samples) * iterations,
                       [this, i, c, iterations] {
                         convergence_[i] = converge(*surface(c.model), c.samples, options_.seed, ways[0],
                                                    {.iterations = iterations});
                       }});
      ++i;
    }
  }

  void add_runtimes() {
    runtimes_ = std::make_unique<RuntimeJobs>(surface("Homer"), options_.seed);
    for (std::size_t i = 0; i < runtimes_->size(); ++i)
      jobs_.push_back({runtimes_->name(i), runtimes_->cost(i), [this, i] { runtimes_->run(i); }});
  }

  static double cost(const fpo::RemeshOptions& o) {
    return static_cast<double>(o.num_samples) * (o.optimize.max_iterations + 30);
  }

  const PaperOptions& options_;
  const Surfaces& surfaces_;
  std::map<Wanted, std::vector<Use>> uses_;
  std::vector<Job> jobs_;
  double cpu_seconds_ = 0;
  std::vector<PaperRun> runs_;
  std::vector<SpectrumSets> spectra_;
  std::vector<Convergence> convergence_;
  std::vector<std::string> convergence_models_;
  std::unique_ptr<RuntimeJobs> runtimes_;
};

}  // namespace

std::vector<PaperModel> find_models(const std::filesystem::path& folder) {
  std::error_code error;
  std::set<std::filesystem::path> files;  // in order
  for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->is_regular_file()) files.insert(at->path());
  geom::require(!error, folder.string() + ": " + error.message());
  std::vector<PaperModel> models;
  for (const fpo::PaperRow& row : fpo::paper_rows()) {
    if (std::ranges::find(models, row.model, &PaperModel::name) != models.end()) continue;
    const auto fits = [&](const std::filesystem::path& file) {
      const std::string extension = io::lower_extension(file);
      return (extension == ".obj" || extension == ".off" || extension == ".ply" || extension == ".stl") &&
             fpo::is_paper_model(file.stem().string(), row.model);
    };
    const auto file = std::ranges::find_if(files, fits);
    models.push_back({row.model, file == files.end() ? std::filesystem::path() : *file});
  }
  return models;
}

PaperResults run_paper(const PaperOptions& options) {
  std::vector<PaperModel> models = find_models(options.models);
  Surfaces surfaces;
  for (const PaperModel& model : models)
    if (!model.file.empty()) surfaces.emplace(model.name, read_cleaned(model.file));
  geom::require(!surfaces.empty(), options.models.string() + ": none of the paper's models is there");
  Experiments experiments(options, surfaces);
  experiments.run();
  PaperResults results = experiments.results();
  results.models = std::move(models);
  return results;
}

}  // namespace tools
