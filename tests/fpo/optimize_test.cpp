#include "fpo/optimize.h"

#include <algorithm>
#include <set>
#include <string>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/surface/surface_domain.h"
#include "geom/check.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;

namespace {

/// A domain without geometry: it writes down what it is asked and answers by script. Sample x is at distance
/// separations[x] from the others, and the largest empty circle has power `radius2`.
class FakeDomain final : public Domain {
 public:
  explicit FakeDomain(std::vector<double> separations) : separations_(std::move(separations)) {}

  std::size_t num_samples() const override { return separations_.size(); }
  double separation(SiteId x) override { return note("separation", x), separations_[x.index()]; }
  void remove(SiteId x) override {
    if (removals_++ == bug_at_removal) throw geom::Bug("torn");
    note("remove", x);
    CHECK(out_ == SiteId());
    out_ = x;
  }
  Circle largest_empty(Scope scope) override {
    note(scope == Scope::global ? "largest" : "largest nearby", out_);
    return {radius2, CircleId(7)};
  }
  bool is_farther(const Circle& c, SiteId x) override { return c.radius2 > separation(x); }
  void insert_at(SiteId x, const Circle& c) override {
    note("insert", x);
    CHECK(x == out_);
    CHECK(c.id == CircleId(7));
    separations_[x.index()] = c.radius2;
    out_ = SiteId();
  }
  void put_back(SiteId x) override {
    note("put back", x);
    CHECK(x == out_);
    out_ = SiteId();
  }
  double normalized_spacing(SiteId x) override { return separations_[x.index()]; }
  void expect(SiteId x) override { expected_.insert(x); }

  double radius2 = 0;
  std::size_t bug_at_removal = SIZE_MAX;
  std::string calls;
  std::vector<SiteId> visited;  ///< in order of removal
  std::set<SiteId> expected_;

 private:
  void note(const std::string& call, SiteId x) {
    calls += call + " " + std::to_string(x.value) + "; ";
    if (call == "remove") visited.push_back(x);
  }
  std::vector<double> separations_;
  std::size_t removals_ = 0;
  SiteId out_;
};

OptimizeOptions in_turn(int iterations) {
  OptimizeOptions options;
  options.order = VisitOrder::in_turn;
  options.max_iterations = iterations;
  options.target_delta = 10;
  return options;
}

}  // namespace

TEST_CASE("optimize: each sample is measured, removed and put where Algorithm 1 says") {
  FakeDomain domain({1, 5, 2, 3});
  domain.radius2 = 2.5;
  const OptimizeResult result = optimize(domain, in_turn(1));
  CHECK(domain.calls ==
        "remove 0; largest 0; separation 0; insert 0; remove 1; largest 1; separation 1; put back 1; "
        "remove 2; largest 2; separation 2; insert 2; remove 3; largest 3; separation 3; put back 3; ");
  CHECK(result.moves == 4);
  CHECK(result.reason == StopReason::iteration_cap);
  CHECK(result.last.iteration == 1);
  CHECK(result.last.moved == 2);
  CHECK(result.last.delta == 2.5);
  CHECK(result.last.mean_delta == (2.5 + 5 + 2.5 + 3) / 4);
}

TEST_CASE("optimize: a circle no larger than where the sample is does not move it") {
  FakeDomain domain({2, 2});
  domain.radius2 = 2;
  const OptimizeResult result = optimize(domain, in_turn(50));
  CHECK(result.reason == StopReason::nothing_moved);
  CHECK(result.moves == 2);
  CHECK(result.last.iteration == 1);
  CHECK(domain.calls.find("insert") == std::string::npos);
}

TEST_CASE("optimize: stops where delta exceeds the target, where nothing moves, at the cap") {
  OptimizeOptions options = in_turn(9);
  options.target_delta = 0.5;
  FakeDomain domain({0.1, 0.2});
  domain.radius2 = 0.6;
  std::vector<IterationReport> reports;
  options.on_iteration = [&](const IterationReport& r) { reports.push_back(r); };
  CHECK(optimize(domain, options).reason == StopReason::target_reached);
  REQUIRE(reports.size() == 2);
  CHECK(reports[0].iteration == 0);
  CHECK(reports[0].moved == 0);
  CHECK(reports[0].delta == 0.1);
  CHECK(reports[1].iteration == 1);
  CHECK(reports[1].moved == 2);
  CHECK(reports[1].delta == 0.6);
  CHECK(reports[1].seconds >= reports[0].seconds);

  FakeDomain at_target({0.5, 0.5});  // "exceeds": reaching it is not enough
  CHECK(optimize(at_target, options).reason == StopReason::nothing_moved);
  FakeDomain none_allowed({0.1});
  const OptimizeResult result = optimize(none_allowed, in_turn(0));
  CHECK(result.reason == StopReason::iteration_cap);
  CHECK(result.moves == 0);
  CHECK(none_allowed.calls.empty());
  CHECK(result.last.delta == 0.1);
}

TEST_CASE("optimize: stops where five iterations have gained less than is wanted, if that is asked for") {
  const auto run = [](std::optional<double> least_gain) {
    FakeDomain domain({1, 1});
    domain.radius2 = 1.125;
    OptimizeOptions options = in_turn(20);
    options.least_gain = least_gain;
    options.on_iteration = [&](const IterationReport& r) {
      if (r.iteration > 0) domain.radius2 += r.iteration < 3 ? 0.125 : 0x1p-10;
    };
    return optimize(domain, options);
  };
  const OptimizeResult result = run(0.125);  // from the third iteration to the eighth it is less
  CHECK(result.reason == StopReason::nothing_gained);
  CHECK(result.last.iteration == 8);
  CHECK(result.moves == 16);
  CHECK(run(5 * 0x1p-10).last.iteration == 20);  // exactly so much is enough
  CHECK(run({}).last.iteration == 20);
  CHECK(run({}).reason == StopReason::iteration_cap);
}

TEST_CASE("optimize: an interruption is looked at before each move and leaves all samples in") {
  FakeDomain domain({1, 1, 1, 1});
  domain.radius2 = 2;
  std::atomic<bool> stop{false};
  OptimizeOptions options = in_turn(5);
  options.interrupted = &stop;
  options.on_move = [&](std::size_t move) { stop = move == 2; };
  const OptimizeResult result = optimize(domain, options);
  CHECK(result.reason == StopReason::interrupted);
  CHECK(result.moves == 3);  // the move in hand is finished
  CHECK(result.last.iteration == 1);
  CHECK(result.last.moved == 3);
  CHECK(domain.calls.ends_with("insert 2; "));

  FakeDomain untouched({1, 1});
  options.on_move = {};
  CHECK(optimize(untouched, options).reason == StopReason::interrupted);
  CHECK(untouched.calls.empty());
}

TEST_CASE("optimize: a bug is reported with the number of the move, counted over iterations") {
  FakeDomain domain({1, 1, 1});
  domain.radius2 = 2;
  domain.bug_at_removal = 4;
  std::size_t last_told = 0;
  OptimizeOptions options = in_turn(5);
  options.on_move = [&](std::size_t move) { last_told = move; };
  std::string message;
  try {
    optimize(domain, options);
  } catch (const geom::Bug& bug) {
    message = bug.what();
  }
  CHECK(message == "move 4: torn");
  CHECK(last_told == 4);
}

TEST_CASE("optimize: shuffled orders are permutations, seeded, and as anew as they say") {
  const auto visits = [](VisitOrder order, std::uint64_t seed) {
    FakeDomain domain(std::vector<double>(40, 1.0));
    OptimizeOptions options = in_turn(2);
    options.order = order;
    options.seed = seed;
    std::size_t iteration = 0;
    options.on_iteration = [&](const IterationReport&) {
      domain.radius2 = 2 + static_cast<double>(iteration++);
    };
    optimize(domain, options);
    CHECK(domain.expected_.size() >= 36);  // all but the first few
    REQUIRE(domain.visited.size() == 80);
    std::array<std::vector<SiteId>, 2> result;
    for (std::size_t i = 0; i < 80; ++i) result[i / 40].push_back(domain.visited[i]);
    for (const auto& order_of_one : result)
      CHECK(std::set(order_of_one.begin(), order_of_one.end()).size() == 40);
    return result;
  };
  const auto turn = visits(VisitOrder::in_turn, 1), once = visits(VisitOrder::shuffled_once, 1),
             anew = visits(VisitOrder::shuffled, 1);
  CHECK(std::ranges::is_sorted(turn[0]));
  CHECK(turn[1] == turn[0]);
  CHECK_FALSE(std::ranges::is_sorted(once[0]));
  CHECK(once[1] == once[0]);
  CHECK(anew[1] != anew[0]);
  CHECK(visits(VisitOrder::shuffled, 1) == anew);
  CHECK(visits(VisitOrder::shuffled, 2) != anew);
}

TEST_CASE("optimize: the local scope is handed on") {
  FakeDomain domain({1});
  OptimizeOptions options = in_turn(1);
  options.scope = Scope::two_ring;
  optimize(domain, options);
  CHECK(domain.calls == "remove 0; largest nearby 0; separation 0; put back 0; ");
}

TEST_CASE("optimize: no move lowers delta on a surface") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const geom::TriMesh& mesh = surface.mesh;
    for (const Scope scope : {Scope::global, Scope::two_ring}) {
      SurfaceDomain domain(mesh, random_samples(mesh, 40, 3));
      OptimizeOptions options = in_turn(4);
      options.scope = scope;
      double delta = measure(domain).delta;
      options.on_move = [&](std::size_t) {
        const double now = measure(domain).delta;
        CHECK(now >= delta * (1 - 1e-12));
        delta = now;
      };
      optimize(domain, options);
    }
  }
}
