// Who is left out of what the fast way looks at, and what is said of the others, against all sites.

#include "geom/dual/strangers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "doctest.h"
#include "geom/rng.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/dual_scene.h"
#include "tests/fixtures/weighted_points.h"
#include "tests/oracle/restricted_dual_oracle.h"

using namespace geom;
using fixtures::for_scenes;
using fixtures::Placed;
using Scene = fixtures::DualScene;

namespace {

Vec3 in_ball(const Vec3& center, double radius, Rng& rng) {
  Vec3 v = fixtures::random_vector(rng);
  while (v.norm() > 1) v = fixtures::random_vector(rng);
  return center + 0.999 * radius * v;
}

/// Is that a rim for a frame, with a place for one more?
bool has_room_for(const std::vector<SiteId>& rim) { return rim.size() >= 3 && rim.size() + 1 <= Frame::most; }

/// The frame about the place of p, of these.
void begin(Frame& frame, const Scene& scene, SiteId p, const std::vector<SiteId>& rim) {
  frame.begin(scene.state.sites[p]);
  for (const SiteId r : rim) frame.add(scene.state.sites[r]);
}

/// Who is not kept, is nowhere in the ball nearer than all of these, where their power is at most that.
struct Kept {
  WeightedPoint3 origin;  ///< of the frame
  std::vector<SiteId> frame;
  Vec3 center;
  double radius, most_power;
};
void check_kept(const Scene& scene, SiteId p, const Kept& asked, Rng& rng, std::size_t& dropped) {
  std::set<SiteId> told(asked.frame.begin(), asked.frame.end());
  told.insert(p);
  for (const Strangers::Stranger& s : scene.strangers.kept()) {
    CHECK(told.insert(s.site).second);
    CHECK(s.d == Frame::seen(scene.state.sites[s.site], asked.origin).d);
    CHECK(s.c == Frame::seen(scene.state.sites[s.site], asked.origin).c);
  }
  dropped += scene.present.size() - told.size();
  for (int sample = 0; sample < 60; ++sample) {
    const Vec3 z = in_ball(asked.center, asked.radius, rng);
    double least = infinity;
    for (const SiteId s : asked.frame) least = std::min(least, scene.power_to(s, z));
    if (least > asked.most_power) continue;
    for (const SiteId s : scene.present)
      if (!told.contains(s)) CHECK(scene.power_to(s, z) > least);
  }
}

}  // namespace

TEST_CASE("strangers: who is not kept owns nothing of the hole") {
  Rng rng(1);
  std::size_t dropped = 0, kept = 0;
  for_scenes(150, [&](Scene& scene, std::span<const Placed>) {
    Frame frame;
    for (const SiteId p : scene.present) {
      std::vector<SiteId> rim = scene.link(p);
      if (!has_room_for(rim)) continue;
      if (rng.below(2) == 0) rim.resize(1 + rng.below(2));  // then there are many others
      begin(frame, scene, p, rim);
      const double radius = scene.state.distance_at(scene.state.reach[p], p) * rng.uniform(0.8, 1.5);
      const double most = scene.state.reach[p] + radius * radius * rng.uniform(0, 9);
      const Vec3& center = scene.state.sites[p].position;
      if (rng.below(2) == 0) scene.strangers.forget();  // else what is known may do
      const double range = radius + scene.state.distance_at(most);
      scene.strangers.find_heirs({p, center, radius, most}, rng.below(2) == 0 ? range : infinity);
      scene.strangers.keep_near(frame, p, rim, {Vec3(0, 0, 0), radius}, Frame::nobody);
      kept += scene.strangers.kept().size();
      check_kept(scene, p, {scene.state.sites[p], rim, center, radius, most}, rng, dropped);
    }
  });
  CHECK(dropped > 10000);
  CHECK(kept > 1000);
}

TEST_CASE("strangers: who is not kept owns nothing near a site, at its place or another") {
  Rng rng(2);
  std::size_t dropped = 0, kept = 0;
  for_scenes(150, [&](Scene& scene, std::span<const Placed>) {
    Frame frame;
    for (const SiteId p : scene.present) {
      std::vector<SiteId> rim = scene.link(p), all = rim;
      if (!has_room_for(rim)) continue;
      const WeightedPoint3 old = scene.state.sites[p];
      begin(frame, scene, p, rim);
      const double radius = scene.state.distance_at(scene.state.reach[p], p);
      const bool has_moved = rng.below(2) == 0;
      if (has_moved) {
        scene.state.sites[p].position = in_ball(old.position, 0.5 * radius, rng);
        frame.add(scene.state.sites[p]);
      }
      const Vec3 center = scene.state.sites[p].position;
      if (rng.below(2) == 0) scene.strangers.forget();
      scene.strangers.find_rivals(p, center, radius);
      const int self = has_moved ? frame.size() - 1 : Frame::none;
      scene.strangers.keep_near(frame, p, rim, {{center - old.position}, radius}, self);
      kept += scene.strangers.kept().size();
      all.push_back(p);
      check_kept(scene, p, {old, all, center, radius, infinity}, rng, dropped);
      scene.state.sites[p] = old;
    }
  });
  CHECK(dropped > 5000);
  CHECK(kept > 1000);
}

TEST_CASE("strangers: whoever loses something where the power is more than that is found") {
  std::size_t losers = 0, left_out = 0;
  for_scenes(60, [&](Scene& scene, std::span<const Placed> newcomers) {
    const TriMesh& mesh = scene.state.mesh;
    const SiteId p(scene.present.size());
    const oracle::BruteDiagram before(mesh, scene.state.sites, scene.present);
    for (const Placed& x : newcomers) {
      scene.state.admit(p, x.point);
      Clipper clipper(mesh, scene.state.sites, extent_of(mesh));
      std::map<SiteId, double> most;  // the power where p beats them
      for (const auto& [key, polygon] : before.polygons())
        for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
          if (!clipper.beats_at(polygon, k, p, clipper.bisector_of(polygon.owner, p))) continue;
          double& power = most.try_emplace(polygon.owner, -infinity).first->second;
          power = std::max(power, scene.power_to(polygon.owner, polygon.corners[k].point.position));
        }
      const double near = scene.state.distance_at(scene.state.reach.largest());
      for (const double part : {2.0, 0.5, 0.1, 0.0}) {  // of the cell: how many are known before
        scene.strangers.forget();
        if (part > 0) scene.strangers.find_rivals(p, x.point.position, part * near);
        for (const double floor : {-infinity, 0.3 * near * near, 0.8 * near * near}) {
          std::vector<SiteId> found;
          scene.strangers.find_rivals_beyond(floor, p, found);
          for (const auto& [s, power] : most)
            if (power > floor + 1e-9 * near * near) {
              ++losers;
              CHECK(std::ranges::count(found, s) == 1);
            }
          left_out += scene.present.size() - found.size();
        }
      }
    }
  });
  CHECK(losers > 10000);
  CHECK(left_out > 10000);
}

TEST_CASE("strangers: none is said to be beyond a location who is as near") {
  Rng rng(4);
  std::size_t beyond = 0, ties = 0;
  for_scenes(150, [&](Scene& scene, std::span<const Placed>) {
    Frame frame;
    for (const SiteId p : scene.present) {
      const std::vector<SiteId> rim = scene.link(p);
      if (!has_room_for(rim)) continue;
      begin(frame, scene, p, rim);
      const Vec3& center = scene.state.sites[p].position;
      const double radius = scene.state.distance_at(scene.state.reach[p], p);
      scene.strangers.forget();
      scene.strangers.find_rivals(p, center, 2 * radius);
      scene.strangers.keep_near(frame, p, rim, {Vec3(0, 0, 0), 2 * radius}, Frame::nobody);
      for (int sample = 0; sample < 10; ++sample) {
        const Vec3 truth = in_ball(center, 2 * radius, rng);
        const SiteId owner = rim[rng.below(rim.size())];
        const double off = rng.below(2) == 0 ? 0 : radius * std::pow(10, rng.uniform(-14, -1));
        const Vec3 known = truth + 0.999 * off * fixtures::random_vector(rng).normalized();
        double least = infinity;
        for (const Strangers::Stranger& s : scene.strangers.kept())
          least = std::min(least, scene.power_to(s.site, truth));
        const bool says = scene.strangers.are_beyond({known, 0, off}, scene.state.sites[owner]);
        beyond += says;
        if (says) CHECK(least > scene.power_to(owner, truth));
        if (least == infinity) continue;
        // As near as that, or nearer.
        ++ties;
        const auto are_beyond = [&](double power) {
          return scene.strangers.are_beyond({truth, 0, 0}, {truth, -power});
        };
        CHECK(!are_beyond(least));
        CHECK(!are_beyond(least + std::abs(least)));
        CHECK(are_beyond(least - 1e-6));
      }
    }
  });
  CHECK(beyond > 1000);
  CHECK(ties > 1000);
}

// Nor where the point is: far from the owner a little off is much in power.
TEST_CASE("strangers: a heavy owner's power is not known to the last bit") {
  const TriMesh flat = fixtures::sheet(4, 1, [](double, double) { return 0.0; });
  const Vec3 z(0.5, 0.5, 0);
  const auto place = [&](double x, double y, double weight) {
    return Placed{{Vec3(x, y, 0), weight}, FacetId()};
  };
  Scene scene(flat, {place(0.01, 0.5, 0.24), place(0.5, 0.51, 0), place(0.2, 0.2, 0), place(0.2, 0.8, 0),
                     place(0.8, 0.5, 0)});
  const SiteId owner(0), stranger(1), p(4);
  Frame frame;
  frame.begin(scene.state.sites[p]);
  const std::vector<SiteId> rim{owner, SiteId(2), SiteId(3)};
  for (const SiteId r : rim) frame.add(scene.state.sites[r]);
  scene.strangers.find_rivals(p, scene.state.sites[p].position, 0.5);
  scene.strangers.keep_near(frame, p, rim, {{z - scene.state.sites[p].position}, 0.01}, Frame::nobody);
  REQUIRE(scene.strangers.kept().size() == 1);
  Rng rng(5);
  for (int sample = 0; sample < 1000; ++sample) {
    const double off = 1e-4 * rng.uniform();
    const Vec3 known = z + 1e-3 * Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), 0);
    const Vec3 truth = known + 0.999 * off * Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), 0).normalized();
    if (scene.strangers.are_beyond({known, 0, off}, scene.state.sites[owner]))
      CHECK(scene.power_to(stranger, truth) > scene.power_to(owner, truth));
  }
}
