// Properties of the regular triangulation in space, on inputs made to be degenerate.

#include "geom/regular/regular3.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "doctest.h"
#include "geom/check.h"
#include "geom/exact/predicates.h"
#include "geom/rng.h"

using geom::Box3;
using geom::Regular3;
using geom::Rng;
using geom::SimplexId;
using geom::SiteId;
using geom::Vec3;
using geom::WeightedPoint3;

namespace {

using SimplexSet = std::vector<Regular3::Simplex>;  ///< corners ascending, simplices ascending: comparable
using Regular3Points = std::vector<WeightedPoint3>;

SimplexSet canonical(SimplexSet simplices) {
  for (Regular3::Simplex& simplex : simplices) std::sort(simplex.begin(), simplex.end());
  std::sort(simplices.begin(), simplices.end());
  return simplices;
}

SimplexSet canonical(const Regular3& t) { return canonical(t.simplices()); }

/// By the definition: all positively oriented quadruples whose orthosphere excludes all other sites.
SimplexSet regular3_brute_force(const Regular3& t, const std::vector<SiteId>& present) {
  std::vector<SiteId> all = present;
  for (int k = 0; k < geom::guard_count; ++k) all.push_back(geom::guard(k));
  const auto ranked = [&](SiteId id) {
    return geom::RankedPoint3{&t.point(id), geom::perturbation_rank(id)};
  };
  SimplexSet simplices;
  const auto test = [&](Regular3::Simplex simplex) {
    const int side = geom::orient3(t.point(simplex[0]).position, t.point(simplex[1]).position,
                                   t.point(simplex[2]).position, t.point(simplex[3]).position);
    if (side == 0) return;
    if (side < 0) std::swap(simplex[0], simplex[1]);
    for (const SiteId e : all) {
      if (std::find(simplex.begin(), simplex.end(), e) != simplex.end()) continue;
      if (geom::conflicts3(ranked(simplex[0]), ranked(simplex[1]), ranked(simplex[2]), ranked(simplex[3]),
                           ranked(e)))
        return;
    }
    simplices.push_back(simplex);
  };
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b)
      for (std::size_t c = b + 1; c < all.size(); ++c)
        for (std::size_t d = c + 1; d < all.size(); ++d) test({all[a], all[b], all[c], all[d]});
  return canonical(simplices);
}

// --- inputs, all in [-1, 1]^3 --------------------------------------------------------------------

Vec3 random_position(Rng& rng) { return {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}; }

WeightedPoint3 random_point(Rng& rng) { return {random_position(rng), 0.0}; }

WeightedPoint3 grid_point(Rng& rng) {
  const auto coordinate = [&] { return 0.5 * static_cast<double>(rng.below(5)) - 1; };
  return {{coordinate(), coordinate(), coordinate()}, 0.0};
}

WeightedPoint3 coplanar_point(Rng& rng) { return {{rng.uniform(-1, 1), rng.uniform(-1, 1), 0.25}, 0.0}; }

/// Exactly cospherical: the signed permutations of (1, 2, 2) / 3 times 3/4, repeated.
WeightedPoint3 cospherical_point(Rng& rng) {
  Vec3 at(0.5, 0.5, 0.5);
  at[static_cast<int>(rng.below(3))] = 0.25;
  for (int axis = 0; axis < 3; ++axis) {
    if (rng.below(2) == 1) at[axis] = -at[axis];
  }
  return {at, 0.0};
}

/// Cospherical but for rounding.
WeightedPoint3 rounded_sphere_point(Rng& rng) { return {random_position(rng).normalized(), 0.0}; }

WeightedPoint3 collinear_point(Rng& rng) {
  const double s = static_cast<double>(rng.below(64)) / 64;
  return {{s, 0.5 * s, -0.25 * s}, 0.0};
}

WeightedPoint3 duplicate_point(Rng& rng) {
  const double s = static_cast<double>(rng.below(4)) / 4;
  return {{s, s * s, -s}, 0.0};
}

WeightedPoint3 weighted_point(Rng& rng) { return {random_position(rng), rng.uniform(-0.1, 0.6)}; }

/// Weights of few values on a grid: ties everywhere, and many hidden sites.
WeightedPoint3 weighted_grid_point(Rng& rng) {
  WeightedPoint3 p = grid_point(rng);
  p.weight = 0.25 * static_cast<double>(rng.below(4));
  return p;
}

/// On a plane through the origin, every coordinate off by at most an ulp.
WeightedPoint3 tilted_plane_point(Rng& rng) {
  const Vec3 u = Vec3(1, 2, -0.3).normalized(), v = Vec3(0.2, 0.1, 1.1).normalized();
  const auto coordinate = [&] { return static_cast<double>(rng.below(17)) / 20 - 0.4; };
  Vec3 at = coordinate() * u + coordinate() * v;
  for (int axis = 0; axis < 3; ++axis) {
    const auto step = rng.below(3);
    if (step != 0) at[axis] = std::nextafter(at[axis], step == 1 ? 2.0 : -2.0);
  }
  return {at, 0.0};
}

struct Input {
  const char* name;
  WeightedPoint3 (*draw)(Rng&);
};

constexpr Input inputs[] = {
    {"random", random_point},
    {"integer grid", grid_point},
    {"coplanar", coplanar_point},
    {"cospherical", cospherical_point},
    {"cospherical but for rounding", rounded_sphere_point},
    {"collinear", collinear_point},
    {"duplicate positions", duplicate_point},
    {"random weights", weighted_point},
    {"grid with weights", weighted_grid_point},
    {"tilted plane, off by an ulp", tilted_plane_point},
};

Box3 unit_box() { return Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)); }

/// A triangulation with the list of the sites in it.
struct Scene {
  Regular3 triangulation{unit_box()};
  std::vector<SiteId> present;
  std::vector<SiteId> absent;

  /// Room for `capacity` sites.
  explicit Scene(int capacity) {
    for (int i = capacity - 1; i >= 0; --i) absent.push_back(SiteId(i));
  }

  /// A random present site or none, as a hint.
  SiteId hint(Rng& rng) const {
    const auto k = rng.below(present.size() + 1);
    return k < present.size() ? present[k] : SiteId();
  }

  Regular3::Change insert(const WeightedPoint3& p, Rng& rng) {
    const auto k = rng.below(absent.size());
    const SiteId id = absent[k];
    absent[k] = absent.back();
    absent.pop_back();
    const SiteId near = hint(rng);
    present.push_back(id);
    return triangulation.insert(id, p, near);
  }

  Regular3::Change remove_any(Rng& rng) {
    const auto k = rng.below(present.size());
    const SiteId id = present[k];
    present[k] = present.back();
    present.pop_back();
    absent.push_back(id);
    return triangulation.remove(id);
  }

  /// Inserts or removes, keeping the scene about half full.
  Regular3::Change move(const Input& input, Rng& rng) {
    const bool grow =
        present.empty() || (!absent.empty() && rng.below(present.size() + absent.size()) < absent.size());
    return grow ? insert(input.draw(rng), rng) : remove_any(rng);
  }

  void fill(const Input& input, Rng& rng) {
    while (!absent.empty()) insert(input.draw(rng), rng);
  }
};

/// The hidden sites according to the simplices.
std::set<SiteId> without_cell(const Scene& scene) {
  std::set<SiteId> out(scene.present.begin(), scene.present.end());
  for (const Regular3::Simplex& simplex : scene.triangulation.simplices()) {
    for (const SiteId v : simplex) out.erase(v);
  }
  return out;
}

}  // namespace

TEST_CASE("regular3: guards alone triangulate their hull") {
  for (const Box3& box : {unit_box(), Box3(Vec3(0, 0, 0), Vec3(0, 0, 0)),
                          Box3(Vec3(1e6, 1e6, 5), Vec3(1e6, 1e6, 5)), Box3(Vec3(-3, 7, 7), Vec3(-3, 7, 9))}) {
    const Regular3 t(box);
    t.check();
    CHECK(canonical(t) == regular3_brute_force(t, {}));
    for (int k = 0; k < geom::guard_count; ++k) {
      CHECK(box.exteriorDistance(t.point(geom::guard(k)).position) >= 10 * box.diagonal().norm());
    }
  }
}

TEST_CASE("regular3: equals the definition after every move") {
  for (const Input& input : inputs) {
    CAPTURE(std::string(input.name));
    Rng rng(1);
    Scene scene(14);
    for (int k = 0; k < 60; ++k) {
      scene.move(input, rng);
      scene.triangulation.check();
      REQUIRE(canonical(scene.triangulation) == regular3_brute_force(scene.triangulation, scene.present));
    }
  }
}

TEST_CASE("regular3: equals the definition with thirty sites") {
  for (const Input& input : inputs) {
    CAPTURE(std::string(input.name));
    Rng rng(2);
    Scene scene(30);
    scene.fill(input, rng);
    for (int k = 0; k < 2; ++k) {
      REQUIRE(canonical(scene.triangulation) == regular3_brute_force(scene.triangulation, scene.present));
      scene.remove_any(rng);
    }
  }
}

TEST_CASE("regular3: a certificate holds through thousands of moves") {
  for (const Input& input : inputs) {
    CAPTURE(std::string(input.name));
    Rng rng(3);
    Scene scene(120);
    for (int k = 0; k < 1000; ++k) {
      scene.move(input, rng);
      scene.triangulation.check();
    }
    const std::set<SiteId> hidden = without_cell(scene);
    for (const SiteId id : scene.present) {
      CHECK(scene.triangulation.is_hidden(id) == (hidden.count(id) > 0));
    }
  }
}

TEST_CASE("regular3: removal and reinsertion are the identity") {
  for (const Input& input : inputs) {
    CAPTURE(std::string(input.name));
    Rng rng(4);
    Scene scene(150);
    scene.fill(input, rng);
    Regular3& t = scene.triangulation;
    const SimplexSet before = canonical(t);
    for (const SiteId id : scene.present) {
      const WeightedPoint3 p = t.point(id);
      t.remove(id);
      CHECK_FALSE(t.contains(id));
      t.insert(id, p, scene.hint(rng));
      REQUIRE(canonical(t) == before);
    }
    t.check();
  }
}

TEST_CASE("regular3: the order of insertion leaves no trace") {
  for (const Input& input : inputs) {
    CAPTURE(std::string(input.name));
    Rng rng(5);
    Regular3Points points(150);
    for (WeightedPoint3& p : points) p = input.draw(rng);
    std::vector<SiteId> order;
    for (int i = 0; i < 150; ++i) order.push_back(SiteId(i));
    SimplexSet first;
    for (int round = 0; round < 4; ++round) {
      Regular3 t(unit_box());
      for (const SiteId id : order) t.insert(id, points[id.index()]);
      if (round == 0) first = canonical(t);
      CHECK(canonical(t) == first);
      rng.shuffle(std::span(order));
    }
  }
}

TEST_CASE("regular3: a change tells all that changed") {
  for (const Input& input : inputs) {
    CAPTURE(std::string(input.name));
    Rng rng(6);
    Scene scene(80);
    const Regular3& t = scene.triangulation;
    std::map<SimplexId, Regular3::Simplex> mirror;
    {
      // The guards' own simplices: all ids but those that the first insertion made.
      const Regular3::Change first = scene.move(input, rng);
      const std::set<SimplexId> dead(first.destroyed.begin(), first.destroyed.end());
      const auto known = static_cast<int>(t.simplices().size() + dead.size());
      for (int i = 0; i < known; ++i) {
        if (dead.count(SimplexId(i)) == 0) mirror[SimplexId(i)] = t.simplex(SimplexId(i));
      }
    }
    std::set<SiteId> hidden = without_cell(scene);
    for (int k = 0; k < 300; ++k) {
      const std::vector<SiteId> before = scene.present;
      const Regular3::Change change = scene.move(input, rng);
      for (const SimplexId c : change.destroyed) REQUIRE(mirror.erase(c) == 1);
      for (const SimplexId c : change.created) REQUIRE(mirror.emplace(c, t.simplex(c)).second);
      for (const SiteId id : change.hidden) REQUIRE(hidden.insert(id).second);
      for (const SiteId id : change.exposed) REQUIRE(hidden.erase(id) == 1);
      for (const SiteId id : before) {
        if (!t.contains(id)) hidden.erase(id);
      }
      SimplexSet simplices;
      for (const auto& [id, simplex] : mirror) simplices.push_back(simplex);
      REQUIRE(canonical(simplices) == canonical(t));
      REQUIRE(hidden == without_cell(scene));
    }
  }
}

TEST_CASE("regular3: the link is what the simplices say") {
  for (const Input& input : inputs) {
    CAPTURE(std::string(input.name));
    Rng rng(7);
    Scene scene(60);
    scene.fill(input, rng);
    std::map<SiteId, std::set<SiteId>> joined;
    for (const Regular3::Simplex& simplex : scene.triangulation.simplices()) {
      for (const SiteId v : simplex)
        for (const SiteId w : simplex) {
          if (v != w && w.valid()) joined[v].insert(w);
        }
    }
    std::vector<SiteId> link;
    for (const SiteId id : scene.present) {
      scene.triangulation.link(id, link);
      CHECK(std::set<SiteId>(link.begin(), link.end()) == joined[id]);
      CHECK(link.size() == joined[id].size());
    }
  }
}

TEST_CASE("regular3: among equals the smallest id is visible") {
  Regular3 t(unit_box());
  for (const int id : {5, 3, 8, 1, 9}) t.insert(SiteId(id), {{0.1, 0.2, 0.3}, 0.5});
  for (const int id : {1, 3, 5, 8, 9}) {
    CHECK_FALSE(t.is_hidden(SiteId(id)));
    t.check();
    t.remove(SiteId(id));
  }
  CHECK(canonical(t) == regular3_brute_force(t, {}));
}

TEST_CASE("regular3: one heavy site hides many, and they come back") {
  Rng rng(8);
  Scene scene(300);
  Regular3& t = scene.triangulation;
  scene.fill(inputs[0], rng);
  const SimplexSet before = canonical(t);
  const SiteId heavy(300);
  CHECK(t.insert(heavy, {{0, 0, 0}, 1e4}).hidden.size() == 300);
  t.check();
  CHECK(t.remove(heavy).exposed.size() == 300);
  t.check();
  CHECK(canonical(t) == before);
}

TEST_CASE("regular3: errors") {
  CHECK_THROWS_AS(Regular3{Box3()}, geom::InputError);
  CHECK_THROWS_AS(Regular3(Box3(Vec3(0, 0, 0), Vec3(1, 1, INFINITY))), geom::InputError);
  Regular3 t(unit_box());
  t.insert(SiteId(4), {{0, 0, 0}, 0});
  CHECK_THROWS_AS(t.insert(SiteId(5), {{0, 0, 1.5}, 0}), geom::InputError);
  CHECK_THROWS_AS(t.insert(SiteId(5), {{0, NAN, 0}, 0}), geom::InputError);
  CHECK_THROWS_AS(t.insert(SiteId(5), {{0, 0, 0}, NAN}), geom::InputError);
  CHECK_THROWS_AS(t.insert(SiteId(4), {{0, 0, 0}, 0}), geom::Bug);
  CHECK_THROWS_AS(t.insert(SiteId(), {{0, 0, 0}, 0}), geom::Bug);
  CHECK_THROWS_AS(t.remove(SiteId(5)), geom::Bug);
  CHECK_THROWS_AS(t.remove(geom::guard(0)), geom::Bug);
  t.check();
  CHECK(t.contains(SiteId(4)));
  CHECK_FALSE(t.contains(SiteId(5)));
}
