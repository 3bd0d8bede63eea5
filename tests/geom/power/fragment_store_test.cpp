#include "geom/power/fragment_store.h"

#include <map>

#include "doctest.h"
#include "geom/rng.h"
#include "tests/fixtures/surfaces.h"

using namespace geom;

namespace {

using FragmentStoreLabels = std::vector<EdgeLabel>;

/// What the store should hold, as an obvious map.
using Model = std::map<std::pair<SiteId, FacetId>, std::pair<FragmentId, FragmentStoreLabels>>;

FragmentStoreLabels whole_facet() {
  return {EdgeLabel::facet_edge(0), EdgeLabel::facet_edge(1), EdgeLabel::facet_edge(2)};
}

std::vector<PolygonCorner> polygon(const FragmentStoreLabels& labels) {
  std::vector<PolygonCorner> corners;
  for (const EdgeLabel label : labels)
    corners.push_back({{Vec3(static_cast<double>(corners.size()), 0, 0), 0}, label});
  return corners;
}

FragmentStoreLabels labels_of(std::span<const PolygonCorner> corners) {
  FragmentStoreLabels labels;
  for (const PolygonCorner& c : corners) labels.push_back(c.edge);
  return labels;
}

/// Three to thirty edges, some of them whole facets.
FragmentStoreLabels random_labels(Rng& rng) {
  if (rng.below(4) == 0) return whole_facet();
  FragmentStoreLabels labels;
  for (std::size_t i = 0, n = 3 + rng.below(rng.below(10) == 0 ? 28 : 6); i < n; ++i)
    labels.push_back(EdgeLabel::bisector(SiteId(static_cast<std::size_t>(rng.below(1000)))));
  return labels;
}

void check_equal(const FragmentStore& store, const Model& model, std::size_t num_sites,
                 std::size_t num_facets) {
  store.check();
  REQUIRE(store.size() == model.size());
  std::array<PolygonCorner, 3> buffer;
  for (const auto& [key, value] : model) {
    const auto& [site, facet] = key;
    const auto& [f, labels] = value;
    REQUIRE(store.find(site, facet) == f);
    CHECK(store.site(f) == site);
    CHECK(store.facet(f) == facet);
    CHECK(store.whole(f) == (labels == whole_facet()));
    CHECK(labels_of(store.corners(f, buffer)) == labels);
    CHECK(store.corners(f).size() == (store.whole(f) ? 0 : labels.size()));
    CHECK(store.max_radius2(f) == static_cast<double>(labels.size()));
  }
  std::size_t absent = 0, found = 0;
  for (std::size_t s = 0; s < num_sites; ++s)
    for (std::size_t t = 0; t < num_facets; ++t)
      if (!model.contains({SiteId(s), FacetId(t)})) {
        ++absent;
        found += store.find(SiteId(s), FacetId(t)).valid();
      }
  CHECK(absent + model.size() == num_sites * num_facets);
  CHECK(found == 0);
}

}  // namespace

TEST_CASE("fragment store: equals a map under random creation, change and erasure") {
  const TriMesh mesh = fixtures::box(Vec3(1, 1, 1), 1);
  constexpr std::size_t num_sites = 9;
  FragmentStore store(mesh);
  Model model;
  Rng rng(3);
  for (int step = 0; step < 4000; ++step) {
    const SiteId site(static_cast<std::size_t>(rng.below(num_sites)));
    const FacetId facet(static_cast<std::size_t>(rng.below(mesh.num_facets())));
    const auto at = model.find({site, facet});
    if (at == model.end()) {
      const FragmentId f = store.create(site, facet);
      for (const auto& [key, value] : model) REQUIRE(value.first != f);
      model[{site, facet}] = {f, {}};
    } else if (rng.below(3) == 0) {
      store.erase(at->second.first);
      model.erase(at);
      continue;
    }
    auto& [f, labels] = model[{site, facet}];
    labels = random_labels(rng);
    store.set_corners(f, polygon(labels));
    store.set_max_radius2(f, static_cast<double>(labels.size()));
    if (step % 50 == 0) check_equal(store, model, num_sites, mesh.num_facets());
  }
  check_equal(store, model, num_sites, mesh.num_facets());
}

TEST_CASE("fragment store: ids are used again") {
  const TriMesh mesh = fixtures::box(Vec3(1, 1, 1), 1);
  FragmentStore store(mesh);
  for (int round = 0; round < 3; ++round) {
    for (std::size_t t = 0; t < mesh.num_facets(); ++t) {
      const FragmentId f = store.create(SiteId(5), FacetId(t));
      CHECK(f.index() < mesh.num_facets());
      store.set_corners(f, polygon(whole_facet()));
    }
    std::size_t seen = 0;
    for (; !store.of_cell(SiteId(5)).empty(); ++seen) store.erase(store.of_cell(SiteId(5)).front());
    CHECK(seen == mesh.num_facets());
    CHECK(store.size() == 0);
    CHECK(store.of_cell(SiteId(5)).empty());
    CHECK(store.of_cell(SiteId(77)).empty());
    store.check();
  }
}

TEST_CASE("fragment store: the corners of a whole facet are the facet's") {
  const TriMesh mesh = fixtures::blob(2);
  FragmentStore store(mesh);
  const FacetId t(std::size_t{7});
  const FragmentId f = store.create(SiteId(0), t);
  store.set_corners(f, polygon(whole_facet()));
  std::array<PolygonCorner, 3> buffer;
  const auto corners = store.corners(f, buffer);
  REQUIRE(corners.size() == 3);
  for (int i = 0; i < 3; ++i) {
    CHECK(corners[static_cast<std::size_t>(i)].point.position == mesh.corner(t, i));
    CHECK(corners[static_cast<std::size_t>(i)].edge == EdgeLabel::facet_edge(i));
  }
}
