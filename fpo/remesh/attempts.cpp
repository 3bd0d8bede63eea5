#include "fpo/remesh/attempts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace fpo {
namespace {

constexpr double small_angle = 30, useless_angle = 10, hopeless_angle = 5;
constexpr double weight_of_edges = 10, weight_of_small = 2;  // of a share of all
constexpr double no_angle = 1e-3, of_no_angle = 10;          // degrees; doublings
constexpr double long_edge = 5, weight_of_long = 4;          // in wanted lengths; of each doubling
constexpr std::size_t samples_for_one_mended = 1000;
constexpr std::size_t samples_for_one_place = 10;
constexpr std::size_t samples_for_one_fault = 10;
constexpr std::size_t samples_for_one_unmended = 100;
constexpr std::size_t most_to_mend = 20, few_in_thin_parts = 12;
constexpr std::size_t samples_for_one_spoilt = 200, least_spoilt = 10;
constexpr std::size_t triangles_for_one_small_angle = 10;
constexpr std::size_t triangles_for_one_of_few = 100;
constexpr std::size_t edges_for_one_broken = 4;
constexpr double by_chords = 0.97;  // the angle between chords of two curves over that between the curves

/// Of a mesh by collapses with edges so much longer than wanted that they leave parts of the surface out, or
/// with samples at the same place.
double left_out(const RemeshResult& r) {
  if (!r.by_collapses) return 0;
  const double by_length = std::max(std::log2(r.measures.greatest_edge / long_edge), 0.0);
  return by_length + (r.measures.theta_min < no_angle ? of_no_angle : 0);
}

auto rank(const RemeshResult& r) {
  const double edges = static_cast<double>(std::max<std::size_t>(r.feature_edges, 1));
  const double lost = static_cast<double>(r.broken_feature_edges) / edges;
  const double theta = r.measures.theta_min;
  const double small = static_cast<double>(r.measures.angles_below_30) /
                       static_cast<double>(std::max<std::size_t>(r.mesh.num_facets(), 1));
  const auto faults = static_cast<long>(r.advice.places.size() + r.broken_feature_edges);
  return std::tuple(r.type.ok(), r.type.ok() ? 0 : -faults,
                    std::min(theta / small_angle, 1.0) - weight_of_small * small - weight_of_edges * lost -
                        weight_of_long * left_out(r),
                    theta);
}

/// Of the type, and at least that or, with all edges of curves, what corners there are.
bool has_angles(const RemeshResult& r, double least) {
  if (r.broken_feature_edges == 0) least = std::min(least, by_chords * r.corner_angle);
  return r.type.ok() && r.measures.theta_min >= least;
}

/// Of another type, in a hundredth of the samples after room was made.
bool has_many_faults(const ThinParts& thin_parts, std::size_t n) {
  return !thin_parts.right_type && thin_parts.faults_after * samples_for_one_unmended > n;
}

}  // namespace

bool has_wanted_angles(const RemeshResult& r) {
  return r.broken_feature_edges == 0 && has_angles(r, small_angle);
}

bool is_fine(const RemeshResult& r) {
  if (!has_wanted_angles(r)) return false;
  if (r.measures.theta_min < small_angle) return true;
  const std::size_t few = r.feature_edges == 0 ? r.mesh.num_vertices() / samples_for_one_mended : 0;
  return r.finish.recovered_edges == 0 && r.finish.last_angles.mended <= few;
}

bool is_useful(const RemeshResult& r) { return has_angles(r, useless_angle); }

bool is_useless(const RemeshResult& r) {
  return !has_angles(r, r.broken_feature_edges > 0 ? useless_angle : hopeless_angle);
}

bool is_hopeless(const RemeshResult& r) {
  const bool has_mesh = r.mesh.num_facets() > 0;
  const std::size_t places = has_mesh ? r.advice.places.size() : r.thin_parts.faults_before;
  return (!has_mesh || !r.type.ok()) && places * samples_for_one_place > r.samples.size();
}

bool may_be_faced(const RemeshResult& r) {
  return r.broken_feature_edges > 0 && 2 * r.feature_samples > r.samples.size();
}

bool is_in_ruins(const RemeshResult& r) {
  return !r.type.ok() && r.thin_parts.faults_after * samples_for_one_fault > r.samples.size();
}

bool is_spoilt_by_creases(const RemeshResult& r) {
  const std::size_t n = r.samples.size(), many = std::max(least_spoilt, n / samples_for_one_spoilt);
  return !r.type.ok() && r.advice.places.size() >= many && 4 * r.feature_samples > n &&
         2 * r.crease_edges > r.feature_edges && !may_be_faced(r) && !is_undone_by_staggering(r);
}

bool has_few_small_angles(const RemeshResult& r) {
  return r.type.ok() && r.broken_feature_edges == 0 && !has_wanted_angles(r) &&
         r.measures.angles_below_30 * triangles_for_one_of_few <= r.mesh.num_facets();
}

bool is_in_pieces(const RemeshResult& r) {
  return !r.type.ok() && has_many_small_angles(r) &&
         (r.broken_feature_edges * edges_for_one_broken > r.feature_edges ||
          2 * r.measures.angles_below_30 > r.mesh.num_facets());
}

bool is_instead_of(const RemeshResult& first, const RemeshResult& without) {
  return is_in_pieces(first) ? is_useful(without) : has_wanted_angles(without);
}

bool has_many_small_angles(const RemeshResult& r) {
  return r.crease_edges > 0 &&
         r.measures.angles_below_30 * triangles_for_one_small_angle > r.mesh.num_facets();
}

std::string harm_of_creases(const RemeshResult& r) {
  return "with " + std::to_string(r.crease_curves) + " curves kept " +
         (!r.type.ok()    ? "the remesh would be of another type"
          : is_useless(r) ? "angles would be useless"
                          : "many angles would be below 30 degrees");
}

bool is_undone_by_staggering(const RemeshResult& r) {
  return r.staggered_curves > 0 && (!r.type.ok() || 2 * r.broken_feature_edges > r.feature_edges);
}

bool is_left_behind(const ThinParts& thin_parts, std::size_t n, const RemeshResult& rival) {
  return has_many_faults(thin_parts, n) && thin_parts.faults_after > 2 * rival.thin_parts.faults_after;
}

bool may_have_room(const RemeshResult& r) {
  return !r.type.ok() && r.thin_parts.faults_after > 0 && r.thin_parts.faults_after <= few_in_thin_parts;
}

bool is_past_mending(const ThinParts& thin_parts, std::size_t n) {
  return has_many_faults(thin_parts, n) && thin_parts.faults_after > most_to_mend;
}

bool is_worth_creases(const RemeshResult& with_fewer, const RemeshResult& with_all) {
  return with_fewer.type.ok() ||
         (!with_all.type.ok() && 2 * with_fewer.advice.places.size() < with_all.advice.places.size());
}

bool is_better(const RemeshResult& a, const RemeshResult& b) { return rank(a) > rank(b); }

RemeshOptions in_the_way_of(const RemeshResult& other, RemeshOptions options) {
  if (options.sheets != Sheets::automatic) return options;
  options.sheets = other.has_levels ? Sheets::apart : Sheets::together;
  options.facing_samples = other.has_facing_samples;
  return options;
}

const RemeshResult& as_it_will_be(const RemeshResult& r) {
  return r.last_resort && is_better(*r.last_resort, r) ? *r.last_resort : r;
}

bool is_better_in_the_end(const RemeshResult& a, const RemeshResult& b) {
  const auto in_the_end = [](const RemeshResult& r) {
    const RemeshResult& end = as_it_will_be(r);
    return std::tuple(has_wanted_angles(end), r.type.ok(), rank(end));
  };
  return in_the_end(a) > in_the_end(b);
}

}  // namespace fpo
