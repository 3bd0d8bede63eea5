#pragma once
// The runtimes of the paper's figures 10 (right) and 11, by number of samples.

#include <cstdint>
#include <string>
#include <vector>

#include "fpo/surface/sizing.h"
#include "tools/convergence.h"

namespace tools {

/// CPU seconds for n samples.
struct RuntimeCurve {
  std::string figure;  ///< "10 right", "11 left", "11 right"
  std::string name;    ///< as in the paper's legend
  std::vector<geom::Vec2> points;
};

/// The mean delta at which runs of figure 11 (right) end, or after so many iterations. Adaptive samples on a
/// surface come to about .877 in four to six and stay there.
inline constexpr double enough_mean_delta = 0.87;
inline constexpr int most_iterations = 20;

/// All measurements, each a job that may run in a thread of its own. In the plane: the torus, uniform and
/// with the field "waves5"; on the surface: uniform and by local feature size.
class RuntimeJobs {
 public:
  /// Keeps a reference to the surface (the paper: Homer); null: none, and no curves for one. O(F log F).
  RuntimeJobs(const geom::TriMesh* surface, std::uint64_t seed);

  std::size_t size() const { return jobs_.size(); }
  void run(std::size_t job);
  std::string name(std::size_t job) const;
  /// The samples of a job times iterations, about.
  double cost(std::size_t job) const;
  std::vector<RuntimeCurve> curves() const;

 private:
  enum class Part { iteration, without_removal, with_removal };
  struct Job {
    bool on_surface, adaptive;
    Part part;
    std::size_t samples;
    double seconds = 0, removal_seconds = 0;
  };
  void measure(fpo::Domain& domain, double start, Job& job) const;
  void run_in_plane(Job& job) const;
  void run_on_surface(Job& job) const;
  RuntimeCurve curve(const std::string& figure, const Job& like, double Job::*value) const;

  const geom::TriMesh* surface_;
  fpo::VertexField feature_size_;
  std::uint64_t seed_;
  std::vector<Job> jobs_;
};

/// One chart a figure, with a logarithmic scale both ways.
io::Chart runtimes_chart(const std::vector<RuntimeCurve>& curves, const std::string& figure);

}  // namespace tools
