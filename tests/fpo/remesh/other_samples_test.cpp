#include "fpo/remesh/other_samples.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <set>
#include <vector>

#include "doctest.h"
#include "fpo/remesh/remesh_defaults.h"
#include "fpo/surface/cut_edges.h"
#include "geom/check.h"
#include "tests/fixtures/block.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

TriMesh surface() { return fixtures::block(4, 4, 4); }

/// With so many angles below 30 degrees, of triangles enough that these are few.
RemeshResult with_flaws(std::size_t number) {
  RemeshResult result;
  result.mesh = geom::make_shape("sphere", 4);
  result.kept = std::make_shared<const Features>(find_features(surface()));
  result.measures.angles_below_30 = number;
  result.measures.theta_min = number > 0 ? 29 - static_cast<double>(number) : 33;
  return result;
}

RemeshOptions options() {
  RemeshOptions result;
  result.num_samples = 500;
  result.seed = 5;
  return result;
}

/// What is made with the other seeds, one after the other: the last one again and again.
struct Tries {
  std::vector<std::size_t> flaws;
  std::set<std::uint64_t> seeds{};
  std::size_t made = 0;

  RemeshResult operator()() { return with_flaws(flaws[std::min(made++, flaws.size() - 1)]); }
};

RemeshResult best_of(Tries& tries, const RemeshResult& first, const RemeshOptions& how = options()) {
  return with_other_samples(surface(), how, first,
                            [&](const TriMesh&, const FeatureChoice& choice, const RemeshOptions& asked) {
                              CHECK(asked.seed != how.seed);
                              tries.seeds.insert(asked.seed);
                              CHECK(choice.given_up == first.given_up);
                              CHECK(choice.features.curves.size() == 12);
                              return tries();
                            });
}

}  // namespace

TEST_CASE("other samples: the best of four, no more where one has the wanted angles") {
  Tries worse{{9, 3, 7}};
  CHECK(best_of(worse, with_flaws(5)).measures.angles_below_30 == 3);
  CHECK(worse.made == 3);
  CHECK(worse.seeds.size() == 3);
  Tries good{{8, 0}};
  CHECK(best_of(good, with_flaws(5)).measures.angles_below_30 == 0);
  CHECK(good.made == 2);
  Tries vain{{6}};
  CHECK(best_of(vain, with_flaws(5)).measures.angles_below_30 == 5);
  CHECK(vain.made == 3);
  Tries same{{5}};  // the angle of a curve, that no other samples mend
  CHECK(best_of(same, with_flaws(5)).measures.angles_below_30 == 5);
  CHECK(same.made == 1);
}

TEST_CASE("other samples: of another type in a few places") {
  RemeshResult first = with_flaws(0);
  first.type.bare_samples = 1;
  first.advice.places = {Vec3(0, 0, 0)};
  Tries good{{0}};
  CHECK(best_of(good, first).type.ok());
  CHECK(good.made == 1);
  first.advice.places.resize(13);
  Tries none{{0}};
  best_of(none, first);
  CHECK(none.made == 0);
}

TEST_CASE("other samples: none for what is good, is at corners of the input, or is no luck") {
  const std::atomic<bool> interrupted{true};
  for (int what = 0; what < 9; ++what) {
    RemeshResult first = with_flaws(what == 0 ? 0 : what == 1 ? 13 : 2);
    RemeshOptions how = options();
    if (what == 2) first.sharp_corners = 2;
    if (what == 3) first.by_collapses = true;
    if (what == 4) first.kept = nullptr;
    if (what == 5) first.least_length = 0.3;
    if (what == 6) first.broken_feature_edges = 1;
    if (what == 7) how.optimize_angles = false;
    if (what == 8) how.optimize.interrupted = &interrupted;
    Tries none{{0}};
    CHECK(best_of(none, first, how).measures.angles_below_30 == first.measures.angles_below_30);
    CHECK(none.made == 0);
  }
}

TEST_CASE("other samples: what is refused or interrupted leaves the result as it is") {
  for (const bool refused : {false, true}) {
    int asked = 0;
    const RemeshResult result = with_other_samples(
        surface(), options(), with_flaws(4),
        [&](const TriMesh&, const FeatureChoice&, const RemeshOptions&) -> std::optional<RemeshResult> {
          ++asked;
          if (refused) throw geom::InputError("too few samples");
          return {};
        });
    CHECK(asked == 3);
    CHECK(result.measures.angles_below_30 == 4);
  }
}

TEST_CASE("other samples: on the surface with edges cut, and returned from there") {
  const TriMesh whole = surface();
  const Features features = find_features(whole);
  const EdgeCut cut{{features.curves[0].vertices[0], features.curves[0].vertices[1]}, 0.5};
  RemeshResult first = with_flaws(4);
  first.cut = std::make_shared<const SplitSurface>(with_cut_edges(whole, {&cut, 1}));
  RemeshOptions how = options();
  for (const Vec3& x : whole.vertices()) how.rho.push_back(1 + x.x());
  const RemeshResult result = with_other_samples(
      whole, how, first, [&](const TriMesh& on, const FeatureChoice&, const RemeshOptions& asked) {
        REQUIRE(on.num_vertices() == whole.num_vertices() + 1);
        REQUIRE(asked.rho.size() == on.num_vertices());
        for (geom::VertexId v(0); v.index() < on.num_vertices(); v = geom::VertexId(v.value + 1))
          CHECK(asked.rho[v] == doctest::Approx(1 + on.position(v).x()));
        RemeshResult made = with_flaws(0);
        made.sizing.resize(on.num_vertices(), 1);
        for (geom::FacetId t(0); t.index() < on.num_facets(); t = geom::FacetId(t.value + 1))
          made.samples.push_back({on.corner(t, 0), t});
        return made;
      });
  CHECK(result.measures.angles_below_30 == 0);
  CHECK(result.cut == first.cut);
  CHECK(result.sizing.size() == whole.num_vertices());
  for (std::size_t i = 0; i < result.samples.size(); ++i)
    CHECK(result.samples[i].facet == first.cut->parents[geom::FacetId(i)]);
}
