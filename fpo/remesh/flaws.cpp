#include "fpo/remesh/flaws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "fpo/optimize.h"
#include "fpo/remesh/nearby_places.h"
#include "fpo/remesh/triangle_distances.h"
#include "fpo/rings.h"

namespace fpo {

using geom::EmptyCircle;
using geom::Vec3;

namespace {

constexpr int resamplings = 4;     // of resampling in an attempt
constexpr std::size_t crowd = 24;  // samples: twice those around a triangle of a manifold
constexpr std::size_t spare = 16;  // one id that is not in use of so many
constexpr double drift = 1e-9;     // penalty is a running sum
constexpr std::array<double, 4> nudges = {0.01, 0.02, 0.04, 0.08};  // in units of h
constexpr int directions = 12;
constexpr double least_nudge_gain = 1e-3;  // of the penalty
constexpr double as_good = 1e-9;           // of what a nudge must come below: which sums round off

}  // namespace

Flaws::Flaws(SurfaceDomain& domain, FlawMeasure measure, Sight sight, const FlawMeasures& at_first)
    : domain_(domain), measure_(std::move(measure)), sight_(sight), untried_(Order{&domain.dual()}) {
  const std::vector<CircleId> all = triangles_of(domain.dual());
  const std::size_t most = all.empty() ? 0 : std::ranges::max(all).index() + 1;  // of the ids, by far
  untried_.reserve(most + most / spare + 16);
  penalties_.reserve(most + most / spare + 16);
  if (at_first) {
    const std::vector<double> bad = at_first(all);
    for (std::size_t i = 0; i < all.size(); ++i) add(all[i], bad[i]);
  } else {
    unmeasured_.assign(all.rbegin(), all.rend());
    catch_up();
  }
  domain.followers().add(*this);
}

Flaws::~Flaws() { domain_.followers().remove(*this); }

void Flaws::follow(const geom::RestrictedDual::Change& change) {
  ++changes_;
  for (const CircleId c : change.circles_erased)
    if (std::erase(unmeasured_, c) == 0)
      forget(c);
    else if (known_.circle == c)
      known_ = {};
  unmeasured_.insert(unmeasured_.end(), change.circles_created.begin(), change.circles_created.end());
  for (const CircleId c : change.circles_moved) measure_again(c);
  if (sight_ == Sight::triangle) return;
  for (const std::vector<CircleId>* changed :
       {&change.circles_erased, &change.circles_created, &change.circles_moved})
    for (const CircleId c : *changed)
      for (const SiteId x : domain_.dual().circle(c).sites)
        if (x.valid())
          for (const CircleId near : domain_.dual().circles_of(x)) measure_again(near);
}

void Flaws::measure_again(CircleId c) {
  if (known_.circle == c) known_ = {};
  if (std::ranges::find(unmeasured_, c) != unmeasured_.end()) return;
  forget(c);
  unmeasured_.push_back(c);
}

void Flaws::catch_up() { is_more_than(std::numeric_limits<double>::infinity()); }

/// The last ones first: what has moved is worse more often than what it has moved beside.
bool Flaws::is_more_than(double limit) {
  if (known_.at_least > limit - penalties_.sum()) return true;
  while (!unmeasured_.empty() && penalties_.sum() <= limit) {
    const CircleId c = unmeasured_.back();
    const double enough = limit - penalties_.sum(), bad = measure(c, enough);
    if (bad > enough) return known_ = {c, bad}, true;
    unmeasured_.pop_back();
    if (known_.circle == c) known_ = {};
    add(c, bad);
  }
  return penalties_.sum() > limit;
}

std::vector<CircleId> Flaws::all() {
  catch_up();
  std::vector<CircleId> bad;
  for (std::size_t i = 0; i < penalties_.num_ids(); ++i)
    if (penalties_.of(CircleId(i)) > 0) bad.emplace_back(i);
  return bad;
}

CircleId Flaws::take_worst() {
  catch_up();
  if (untried_.empty()) return CircleId();
  const CircleId c = untried_.top().slot;
  untried_.erase(c);
  tried_.insert(domain_.dual().circle(c).sites);
  return c;
}

void Flaws::try_all_again() {
  catch_up();
  tried_.clear();
  for (std::size_t i = 0; i < penalties_.num_ids(); ++i) {
    const CircleId c(i);
    if (penalties_.of(c) > 0 && !untried_.contains(c)) untried_.push(c, penalties_.of(c));
  }
}

double Flaws::measure(CircleId c, double enough) const {
  const EmptyCircle& circle = domain_.dual().circle(c);
  return circle.is_triangle() ? measure_(circle, enough) : 0;
}

void Flaws::add(CircleId c, double bad) {
  if (!(bad > 0)) return;
  penalties_.add(c, bad);
  if (!tried_.contains(domain_.dual().circle(c).sites)) untried_.push(c, bad);
}

void Flaws::forget(CircleId c) {
  if (penalties_.forget(c) && untried_.contains(c)) untried_.erase(c);
}

LocalResampling::LocalResampling(SurfaceDomain& domain, std::vector<Flaws*> flaws, double enough)
    : domain_(domain),
      flaws_(std::move(flaws)),
      before_(flaws_.size(), 0.0),
      keeps_spacing_(domain.sizing().is_even()),
      delta_(std::min(measure(domain).delta, enough)) {}

void LocalResampling::move(const Backup& x) {
  ++moves_;
  if (journal_) journal_->note(x.id);
  domain_.remove(x.id);
  domain_.insert_at(x.id, x.place, x.weight_share);
}

bool LocalResampling::resample(SiteId x) {
  if (domain_.is_fixed(x)) return false;
  ++moves_;
  if (journal_) journal_->note(x);
  return domain_.move(x, Scope::two_ring);
}

void LocalResampling::remember_penalties() {
  if (put_back_ == flaws_.front()->changes()) return;
  for (std::size_t i = 0; i < flaws_.size(); ++i) before_[i] = flaws_[i]->penalty();
}

bool LocalResampling::better() {
  const double enough = before_[0] - std::max(gain_, drift);
  return !flaws_[0]->is_more_than(enough) && flaws_[0]->penalty() < enough && others_no_worse();
}

bool LocalResampling::others_no_worse() {
  for (std::size_t i = 1; i < flaws_.size(); ++i)
    if (flaws_[i]->is_more_than(before_[i] + drift)) return false;
  return true;
}

bool LocalResampling::wide_enough(SiteId x) {
  return !keeps_spacing_ || domain_.normalized_spacing(x) >= delta_;
}

std::vector<LocalResampling::Backup> LocalResampling::backups_of(std::span<const SiteId> samples) const {
  std::vector<Backup> backups;
  for (const SiteId x : samples) backups.push_back(backup(x));
  return backups;
}

/// Resamples those that may move until all is better; else puts all back. What is not better stays so until
/// something moves, and after a pass in which nothing does nothing will.
bool LocalResampling::settle(std::span<const Backup> samples, std::span<const Backup> moving) {
  const auto wide = [&](const Backup& x) { return wide_enough(x.id) && is_joined(x.id); };
  bool unseen = true, moved = true;
  for (int pass = 0; pass < resamplings && moved; ++pass) {
    moved = false;
    for (const Backup& x : moving) {
      if (resample(x.id)) moved = unseen = true;
      if (std::exchange(unseen, false) && std::ranges::all_of(samples, wide) && better()) return true;
    }
  }
  for (const Backup& x : samples) {
    ++moves_;
    put_back(domain_, x.id, {x.place, x.weight_share});
  }
  note_that_all_is_back();
  return false;
}

bool LocalResampling::attempt(std::span<const SiteId> samples, double weight_share) {
  remember_penalties();
  const std::vector<Backup> backups = backups_of(samples);
  std::vector<Backup> moving = backups;
  for (std::size_t i = 1; i < 3 && weight_share < 1; ++i) {
    moving[i].weight_share *= weight_share;
    if (!domain_.is_fixed(samples[i])) move(moving[i]);
  }
  return settle(backups, moving);
}

bool LocalResampling::attempt_at(std::span<const SiteId> samples, const SurfaceSample& place) {
  if (domain_.is_fixed(samples[0])) return false;
  remember_penalties();
  const std::vector<Backup> backups = backups_of(samples);
  move({samples[0], place, backups[0].weight_share});
  return settle(backups, std::span(backups).subspan(1));
}

bool LocalResampling::nudge(std::span<const SiteId> corners) {
  std::vector<Trial> trials;
  for (const SiteId x : corners)
    if (can_move(x))
      for (const SurfaceSample& place : places_around(x)) trials.push_back({x, place});
  const auto cost = [&](double) { return flaws_[0]->penalty(); };
  return nudge(trials, cost, (1 - least_nudge_gain) * flaws_[0]->penalty());
}

bool LocalResampling::nudge(std::span<const Trial> trials, const CostBelow& cost, double least) {
  remember_penalties();
  const double same = as_good * least;
  std::optional<Backup> best;
  for (std::size_t i = 0; i < trials.size();) {
    const SiteId x = trials[i].sample;
    const Backup home = backup(x);
    for (; i < trials.size() && trials[i].sample == x; ++i) {
      move({x, trials[i].place, home.weight_share});
      const double now = cost(least);
      if (now >= least || !fits(x)) continue;
      least = now - same;  // of equals the first
      best = backup(x);
    }
    move(home);
  }
  if (best)
    move(*best);
  else
    note_that_all_is_back();
  return best.has_value();
}

bool LocalResampling::nudge_as_first(std::span<const Trial> trials, const CostBelow& cost, double least) {
  remember_penalties();
  std::optional<Backup> home;
  for (const auto& [x, place] : trials) {
    if (home && home->id != x) move(*std::exchange(home, {}));
    if (!home) home = backup(x);
    move({x, place, home->weight_share});
    if (cost(least) < least && fits(x)) return true;
  }
  if (home) move(*home);
  note_that_all_is_back();
  return false;
}

bool LocalResampling::attempt_to_slide(std::span<const SiteId> samples) {
  if (!can_slide(samples[0])) return false;
  for (const SurfaceSample& place : slides_->places(domain_, samples[0])) {
    remember_penalties();
    const std::vector<Backup> backups = backups_of(samples);
    move({samples[0], place, backups[0].weight_share});
    if (settle(backups, std::span(backups).subspan(1))) return true;
  }
  return false;
}

/// Points of the surface on small circles about a sample, or of the curve that it is on.
std::vector<SurfaceSample> LocalResampling::places_around(SiteId site) {
  if (can_slide(site)) return slides_->places(domain_, site);
  const SurfaceSample x = domain_.sample(site);
  if (!tree_) tree_.emplace(domain_.mesh());
  return nearby_places(domain_.mesh(), *tree_, x, {domain_.sizing().at(x), nudges, directions});
}

bool LocalResampling::restore_weight(SiteId x) {
  const Backup lowered = backup(x);
  if (lowered.weight_share == 1 || domain_.is_fixed(x)) return true;
  const double before = flaws_[0]->penalty();
  move({x, lowered.place, 1});
  if (flaws_[0]->penalty() <= before + drift) return true;
  move(lowered);
  return false;
}

bool in_growing_sets(const SurfaceDomain& domain, std::array<SiteId, 3> triangle,
                     const std::function<bool(std::span<const SiteId>)>& attempt) {
  std::vector<SiteId> samples(triangle.begin(), triangle.end()), link;
  if (attempt(samples)) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    domain.dual().link(samples[i], link);
    add_missing(samples, link);
    if (samples.size() > crowd) return false;
    if (attempt(samples)) return true;
  }
  return false;
}

}  // namespace fpo
