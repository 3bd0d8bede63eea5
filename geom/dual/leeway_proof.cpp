#include "geom/dual/leeway_proof.h"

#include <algorithm>
#include <cmath>

namespace geom {
namespace {

constexpr double ample = 1.01;                         // lengths that sites may be off
constexpr double first_delta = 0.04, own_share = 1.5;  // in spacings; of p to that of others
constexpr double wider = 1.12;                         // than the cell as it is
constexpr double too_far = 0.02;  // in spacings: who moves so far would not have leeway for long
constexpr int most_failures = 3;  // each halves what is asked for; then
constexpr int moves_of_rest = 3;  // there is no attempt for so long

Leeway::Watched watched(SiteId s, const Vec3& d) {
  return {s, {static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])}};
}

}  // namespace

const Leeway* LeewayProof::find() {
  Leeways& all = around_.state.leeways;
  if (!all.is_in_use()) return nullptr;
  if (const Leeway* known = all.of(around_.p, around_.rim.sites())) return known;
  Leeway& leeway = all.to_prove(around_.p);
  leeway.stands = false;
  if (leeway.rest > 0) return --leeway.rest, nullptr;
  if (static_cast<double>(leeway.way) > too_far * all.spacing()) return nullptr;
  if (prove(leeway)) {
    all.set(around_.p);
    return &leeway;
  }
  leeway.failures = static_cast<std::uint8_t>(std::min(leeway.failures + 1, most_failures));
  leeway.rest = leeway.failures == most_failures ? moves_of_rest : 0;
  return nullptr;
}

bool LeewayProof::prove(Leeway& leeway) {
  const DualState& state = around_.state;
  const Leeways& all = state.leeways;
  const WeightedPoint3& site = around_.site();
  double corner2 = 0;
  for (const CircleId c : around_.rim.inside())
    corner2 = std::max(corner2, (state.circles[c].center - site.position).squaredNorm());
  leeway.origin = site.position;
  const double scale = all.spacing() / (1 << leeway.failures);
  leeway.delta = first_delta * scale;
  leeway.own_delta = own_share * leeway.delta;
  leeway.radius = wider * std::sqrt(corner2) + leeway.own_delta;
  leeway.watch = 0;
  leeway.num_guesses = 0;
  if (around_.rim.size() + 1 > SlackChart::most) return false;
  const Sheet* sheet =
      around_.sheets.around(around_.p, {site.position, site.level}, leeway.radius + leeway.own_delta);
  if (!sheet || !bound_power(leeway, *sheet)) return false;
  const int rim = around_.rim.size();
  slack_.begin(*sheet, leeway.radius);
  slack_.add(Vec3(0, 0, 0), leeway.own_delta);
  for (int j = 0; j < rim; ++j) slack_.add(around_.frame.offset(j), leeway.delta);
  if (!slack_.is_simple() || !find_watched(leeway)) return false;
  leeway.steepest = slack_.steepest();
  leeway.axis = sheet->axis;
  leeway.u = sheet->u;
  leeway.slope = sheet->slope;
  leeway.near = sheet->distance_from(site.position) - ample * leeway.own_delta;
  return leeway.steepest < infinity;
}

/// Sets power and range_, by the rim.
bool LeewayProof::bound_power(Leeway& leeway, const Sheet& sheet) {
  const double weight = around_.site().weight, off = ample * leeway.delta;
  chart_.begin(sheet);
  for (int j = 0; j < around_.rim.size(); ++j) chart_.add(around_.frame.offset(j), around_.frame.constant(j));
  const Chart::Gain most = chart_.most_gain(around_.rim.size(), leeway.radius, weight, weight);
  const double far = std::sqrt(std::max(most.power + weight, 0.0)) + off;
  leeway.power = far * far - weight;
  range_ = most.range + off;
  leeway.watch = range_ + 2 * around_.state.leeways.step();
  return range_ < infinity;
}

/// Who is near: the rim, strangers that may come between, others.
bool LeewayProof::find_watched(Leeway& leeway) {
  const DualState& state = around_.state;
  const Frame& frame = around_.frame;
  const double off = ample * leeway.delta;
  found_.clear();
  others_.clear();
  if (!state.search.find_near(leeway.origin, leeway.watch, found_)) return false;
  std::size_t size = 0;
  double most2 = 0;
  for (int j = 0; j < around_.rim.size(); ++j) {
    if (size == Leeway::most) return false;
    leeway.watched[size++] = watched(around_.rim[j], frame.offset(j));
    most2 = std::max(most2, frame.offset(j).squaredNorm());
  }
  leeway.num_rim = static_cast<std::uint8_t>(size);
  for (const SiteId s : found_) {
    if (s == around_.p || std::ranges::find(around_.rim.sites(), s) != around_.rim.sites().end()) continue;
    const Vec3 d = state.sites[s].position - leeway.origin;
    const double d2 = d.squaredNorm(), distance = std::sqrt(d2);
    if (distance > leeway.watch * (1 + 1e-9)) continue;
    const double lead_off = 2 * off * (2 * leeway.radius + distance + std::sqrt(most2) + off);
    const auto is_behind = [&] {
      const Frame::Seen seen{d, d2 - lead_off};
      return frame.is_behind(seen, Vec3(0, 0, 0), leeway.radius, Frame::nobody) ||
             frame.is_behind_two(seen, Vec3(0, 0, 0), leeway.radius);
    };
    if (distance > range_ + off || is_behind()) {
      others_.push_back(watched(s, d));
    } else {
      if (size == Leeway::most || !slack_.is_simple_with(d, leeway.delta)) return false;
      leeway.watched[size++] = watched(s, d);
    }
  }
  leeway.num_kept = static_cast<std::uint8_t>(size - leeway.num_rim);
  if (size + others_.size() > Leeway::most) return false;
  std::ranges::copy(others_, leeway.watched.begin() + static_cast<std::ptrdiff_t>(size));
  leeway.size = static_cast<std::uint8_t>(size + others_.size());
  return true;
}

}  // namespace geom
