#include "tests/endurance/stage.h"

#include <algorithm>

#include "geom/check.h"
#include "tests/endurance/plane_stage.h"
#include "tests/endurance/surface_stage.h"

namespace endurance {

bool Stage::apply(const Operation& operation) {
  const geom::SiteId s = operation.site;
  const auto at = std::ranges::lower_bound(present_, s);
  const bool is_in = at != present_.end() && *at == s;
  if (is_in == operation.insert) return false;
  if (operation.insert) {
    if (!insert(s, operation.point)) return false;
    present_.insert(at, s);
    if (s.index() >= points_.size()) points_.resize(s.index() + 1);
    points_[s] = operation.point;
  } else {
    if (!remove(s)) return false;
    present_.erase(at);
  }
  return true;
}

void Stage::copy_sites_to(Stage& other) const {
  for (const geom::SiteId s : present_) {
    const bool done = other.apply({true, s, points_[s]});
    geom::ensure(done, "a site cannot be inserted into a new structure");
  }
}

std::unique_ptr<Stage> make_stage(const Place& place, bool search) {
  if (place.shape == "plane") return std::make_unique<PlaneStage>(place);
  return std::make_unique<SurfaceStage>(place, search);
}

void verify(const Stage& stage, geom::Rng& rng) {
  stage.check();
  stage.check_by_brute_force(rng);
  stage.compare(*stage.rebuilt());
}

std::string fault_of(const Replay& replay, bool verify_always) try {
  geom::Rng rng(1);
  const auto stage = make_stage(replay.place, replay.search);
  for (const Operation& operation : replay.operations)
    if (stage->apply(operation) && verify_always) verify(*stage, rng);
  verify(*stage, rng);
  return {};
} catch (const std::exception& error) {  // also geom::InputError: no input was bad
  return error.what();
}

}  // namespace endurance
