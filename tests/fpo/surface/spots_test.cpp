#include "fpo/surface/spots.h"

#include <limits>

#include "doctest.h"
#include "fpo/surface/sizing.h"
#include "geom/rng.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::Vec3;

TEST_CASE("spots: the bound is that of the definition, by brute force") {
  geom::Rng rng(3);
  const auto place = [&] { return Vec3(rng.uniform(), rng.uniform(), rng.uniform()); };
  std::vector<Spot> some;
  for (int i = 0; i < 60; ++i) some.push_back({place(), rng.uniform(0.01, 0.2), 0.3});
  Spots spots;
  CHECK(spots.empty());
  CHECK(spots.bound(place(), 0.5) == 0.5);
  spots.add(some);
  CHECK(!spots.empty());
  for (int i = 0; i < 200; ++i) {
    const Vec3 x = place();
    double least = 0.15;
    for (const Spot& s : some) least = std::min(least, s.h + 0.3 * (x - s.at).norm());
    CHECK(spots.bound(x, 0.15) >= least * (1 - 1e-12));
    CHECK(spots.bound(x, 0.15) <= least / 0.9);  // spots that say little are left out
  }
}

TEST_CASE("spots: very many of them, in boxes, bound as they do one by one") {
  geom::Rng rng(4);
  const auto place = [&] { return Vec3(rng.uniform(), rng.uniform(), 0.01 * rng.uniform()); };
  Spots all;
  std::vector<Spot> some;
  std::vector<Spots> one_by_one;
  for (int i = 0; i < 500; ++i) {
    some.push_back({place(), rng.uniform(1e-4, 2e-4), rng.uniform(0.5, 1), rng.uniform(0, 1e-3)});
    one_by_one.emplace_back().add(std::span(&some.back(), 1));
  }
  all.add(some);
  CHECK(all.size() > 300);
  Spots halves;
  halves.add(std::span(some).first(250));
  halves.add(std::span(some).last(250));
  CHECK(halves.size() == all.size());  // in the same order
  for (int i = 0; i < 300; ++i) {
    const Vec3 x = place();
    double least = 0.02;
    for (const Spots& one : one_by_one) least = one.bound(x, least);
    CHECK(all.bound(x, 0.02) >= least);
    CHECK(all.bound(x, 0.02) <= least / 0.9);
    CHECK(halves.bound(x, 0.02) == all.bound(x, 0.02));
  }
}

TEST_CASE("spots: a sizing that is lowered again keeps the spots of before, and the scale") {
  const geom::TriMesh mesh = geom::make_shape("sphere", 6);
  const auto spots_at = [](const Vec3& x) {
    auto spots = std::make_shared<Spots>();
    spots->add(std::vector<Spot>{{x, 0.02, 0.3}});
    return spots;
  };
  const Sizing base = Sizing::uniform(0.1), once = base.lowered(1.25, spots_at(Vec3(1, 0, 0)), mesh),
               twice = once.lowered(2, spots_at(Vec3(0, 1, 0)), mesh);
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v) {
    const Vec3& x = mesh.position(geom::VertexId(v));
    const double near = std::min((x - Vec3(1, 0, 0)).norm(), (x - Vec3(0, 1, 0)).norm());
    CHECK(twice.at(geom::VertexId(v)) == doctest::Approx(std::min(0.25, 0.02 + 0.3 * near)));
  }
}

TEST_CASE("spots: a sizing lowered by them is the scaled one elsewhere, and changes no faster than they") {
  const geom::TriMesh mesh = geom::make_shape("sphere", 6);
  auto spots = std::make_shared<Spots>();
  spots->add(std::vector<Spot>{{Vec3(1, 0, 0), 0.02, 0.3}});
  const Sizing base = Sizing::uniform(0.1), lowered = base.lowered(1.25, spots, mesh);
  CHECK(base.is_uniform());
  CHECK(!lowered.is_uniform());
  CHECK(lowered.is_even());
  for (std::size_t t = 0; t < mesh.num_facets(); ++t) {
    const SurfaceSample x = location_in_facet(mesh, geom::FacetId(t), 0.2, 0.3);
    CHECK(lowered.at(x) ==
          doctest::Approx(std::min(0.125, 0.02 + 0.3 * (x.position - Vec3(1, 0, 0)).norm())));
  }
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v)
    CHECK(lowered.at(geom::VertexId(v)) ==
          doctest::Approx(
              std::min(0.125, 0.02 + 0.3 * (mesh.position(geom::VertexId(v)) - Vec3(1, 0, 0)).norm())));
}
