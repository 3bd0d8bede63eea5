#include "fpo/remesh/thin_parts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fpo/farthest_move.h"
#include "fpo/interruption.h"
#include "fpo/optimize.h"
#include "fpo/remesh/protect.h"
#include "fpo/remesh/small_parts.h"

namespace fpo {

using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;

namespace {

constexpr double around_a_ring = 3.5;                   // samples that make a ring
constexpr double lowered_to = 0.6;                      // of the wanted length where the girth says nothing
constexpr double least_lowering = 0.3;                  // in one round
constexpr std::size_t corners_of_a_body = 4;            // at least
constexpr int passes = 4;                               // through the samples, in search of strays
constexpr int stray_rounds = 8, rounds_for_strays = 2;  // the first of them for nothing else
constexpr int patience = 3;
constexpr std::size_t most_growth = 3, some_faults = 10;  // times the fewest faults, and more: that is harm
constexpr std::size_t samples_for_one_fault = 10;         // with more faults it is hopeless
constexpr std::size_t least_progress = 10;  // of that many faults one must go in a round, if they are so many
constexpr std::size_t samples_for_one_fixed = 10;  // if more are, the others find their places soon
constexpr int most_futile = 2;                     // rounds in a row without that

/// What a fault wants: spots, and by how much they lower the length.
struct Wish {
  double share;
  std::vector<Spot> spots;
};

double length_at(const SurfaceDomain& domain, SiteId x) { return domain.sizing().at(domain.sample(x)); }

Wish wish_of(const SurfaceDomain& domain, const CellFault& fault, double gradation) {
  const double h = length_at(domain, fault.cell);
  double wanted = lowered_to * h;
  if (fault.girth > 0) wanted = std::min(wanted, std::max(fault.girth / around_a_ring, least_lowering * h));
  Wish wish{wanted / h, {}};
  for (const Vec3& x : fault.around) wish.spots.push_back({x, wanted, gradation});
  wish.spots.push_back({domain.sample(fault.cell).position, wanted, gradation});
  if (fault.other.valid()) wish.spots.push_back({domain.sample(fault.other).position, wanted, gradation});
  return wish;
}

/// A part of the surface that has too few samples to be a body.
Wish wish_of(const TriMesh& mesh, const std::vector<FacetId>& part, double h) {
  Wish wish{1, spots_of_body(mesh, part)};
  if (!wish.spots.empty()) wish.share = wish.spots.front().h / h;
  return wish;
}

/// The mildest first.
std::vector<Wish> wishes(const SurfaceDomain& domain, const WantedType& type, const Dual& dual,
                         double gradation) {
  std::vector<Wish> all;
  for (const CellFault& fault : dual.cell_faults) all.push_back(wish_of(domain, fault, gradation));
  for (const Defect& defect : dual.defects) {
    const double wanted = lowered_to * length_at(domain, defect.at);
    all.push_back({lowered_to, {{domain.sample(defect.at).position, wanted, gradation}}});
  }
  for (const std::size_t part : dual.type.parts) {
    std::vector<FacetId> facets;
    for (std::size_t t = 0; t < type.part_of.size(); ++t)
      if (type.part_of[FacetId(t)] == part) facets.emplace_back(t);
    const double h = domain.sizing().at(SurfaceSample{domain.mesh().corner(facets[0], 0), facets[0]});
    Wish wish = wish_of(domain.mesh(), facets, h);
    if (wish.share < 1 && !wish.spots.empty()) all.push_back(std::move(wish));
  }
  std::ranges::stable_sort(all, std::greater<>(), &Wish::share);
  return all;
}

/// How many samples a sizing calls for, each of those that are there standing for 1 of its present wanted
/// length.
double demand(const SurfaceDomain& domain, const Sizing& sizing) {
  double sum = 0;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) {
    if (domain.is_fixed(SiteId(i))) continue;
    const double ratio = length_at(domain, SiteId(i)) / sizing.at(domain.sample(SiteId(i)));
    sum += ratio * ratio;
  }
  return sum;
}

/// The scale with which the base, lowered at the spots, calls for as many samples as there are; most if that
/// is not enough.
double fitting_scale(const SurfaceDomain& domain, const Sizing& base,
                     const std::shared_ptr<const Spots>& spots, double most) {
  double low = 1, high = most, inner = 0;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) inner += !domain.is_fixed(SiteId(i));
  for (int step = 0; step < 20; ++step) {
    const double middle = (low + high) / 2;
    (demand(domain, base.lowered(middle, spots, domain.mesh())) > inner ? low : high) = middle;
  }
  return high;
}

/// Takes samples without a triangle, one after the other around a horn, to the largest empty circles there
/// are. How many.
std::size_t call_back_strays(SurfaceDomain& domain, const std::atomic<bool>* interrupted) {
  std::size_t moved = 0;
  for (std::size_t i = 0; i < domain.num_samples() && !fpo::interrupted(interrupted); ++i) {
    const SiteId x(i);
    if (!domain.is_fixed(x) && !has_triangle(domain, x)) moved += move_to_farthest(domain, x);
  }
  return moved;
}

class RoomMaker {
 public:
  RoomMaker(const SurfaceDomain& domain, const FeatureSamples& features, const WantedType& type,
            const ThinPartOptions& options)
      : features_(features),
        type_(type),
        options_(options),
        base_(domain.sizing()),
        lowering_{std::make_shared<const Spots>()} {
    options_.diagram.weight_factor = best_weight_factor(Scope::global);
  }

  /// Lowers the length where the dual is at fault: false if nothing is left that can be lowered.
  bool lower(const SurfaceDomain& domain, const Dual& dual) {
    std::vector<Wish> all = wishes(domain, type_, dual, options_.gradation);
    for (; !all.empty(); all.resize(all.size() / 2)) {
      auto spots = std::make_shared<Spots>(*lowering_.spots);
      std::vector<Spot> wanted;
      for (const Wish& wish : all) wanted.insert(wanted.end(), wish.spots.begin(), wish.spots.end());
      spots->add(wanted);
      if (spots->size() == lowering_.spots->size()) return false;
      const double scale = fitting_scale(domain, base_, spots, 1.1 * options_.most_scale);
      if (scale > options_.most_scale) continue;
      lowering_ = {std::move(spots), scale};
      return true;
    }
    return false;
  }

  /// The same samples, some of them on these parts, under the lowered sizing, optimized so many times.
  std::unique_ptr<SurfaceDomain> optimized(const SurfaceDomain& domain, const std::vector<std::size_t>& parts,
                                           const OptimizeOptions& how, bool without_strays = false) const {
    std::vector<SurfaceSample> samples;
    for (std::size_t i = 0; i < domain.num_samples(); ++i) samples.push_back(domain.sample(SiteId(i)));
    Peopling peopling{domain.mesh(), type_.part_of, {}, features_.samples.size()};
    for (const std::size_t part : parts) peopling.least[part] = corners_of_a_body;
    people(peopling, samples);
    const Sizing sizing = base_.lowered(lowering_.scale, lowering_.spots, domain.mesh());
    auto result = std::make_unique<SurfaceDomain>(domain.mesh(), sizing, samples, options_.diagram);
    if (without_strays)
      for (int pass = 0; pass < passes && call_back_strays(*result, options_.interrupted) > 0; ++pass) {
      }
    OptimizeOptions optimization = how;
    optimization.order = VisitOrder::in_turn;
    optimization.interrupted = options_.interrupted;
    optimize(*result, optimization);
    protect_chains(*result, features_, options_.interrupted);
    return result;
  }

  /// What was lowered.
  struct Lowering {
    std::shared_ptr<const Spots> spots;
    double scale = 1;
  };
  const Lowering& lowering() const { return lowering_; }
  void return_to(const Lowering& lowering) { lowering_ = lowering; }
  std::size_t num_spots() const { return lowering_.spots->size(); }

 private:
  const FeatureSamples& features_;
  const WantedType& type_;
  ThinPartOptions options_;
  Sizing base_;
  Lowering lowering_;
};

}  // namespace

std::unique_ptr<SurfaceDomain> make_room_for_thin_parts(std::unique_ptr<SurfaceDomain> domain,
                                                        const FeatureSamples& features,
                                                        const WantedType& type,
                                                        const ThinPartOptions& options, ThinParts& result) {
  Dual dual = dual_of(*domain, type, false, options.interrupted);
  result.faults_before = result.faults_after = dual.num_faults();
  result.right_type = dual.type.ok();
  if (result.right_type || options.rounds == 0) return domain;
  const std::size_t many = domain->num_samples() / samples_for_one_fault;
  const std::size_t hopeless = result.faults_before + many;
  int futile = 0;   // rounds in a row, with much to be done
  int in_vain = 0;  // rounds in a row that were no better than the best
  const auto enough = [&] {
    return dual.type.ok() || futile == most_futile || dual.num_faults() > hopeless ||
           fpo::interrupted(options.interrupted);
  };
  const auto did_harm = [&] { return dual.num_faults() > most_growth * result.faults_after + some_faults; };
  RoomMaker room(*domain, features, type, options);
  std::unique_ptr<SurfaceDomain> best = std::move(domain), next;
  RoomMaker::Lowering of_best = room.lowering();
  const SurfaceDomain* last = best.get();
  const auto look_at = [&](std::unique_ptr<SurfaceDomain> found) {
    dual = dual_of(*found, type, false, options.interrupted);
    const std::size_t wanted = result.faults_after - result.faults_after / least_progress;
    futile = dual.num_faults() > std::max(wanted, many) ? futile + 1 : 0;
    ++in_vain;
    next = std::move(found);
    last = next.get();
    if (dual.num_faults() >= result.faults_after) return;
    in_vain = 0;
    of_best = room.lowering();
    result = {room.num_spots(), of_best.scale, result.faults_before, dual.num_faults(), dual.type.ok()};
    best = std::move(next);
  };
  OptimizeOptions once_more;
  once_more.max_iterations = options.iterations;
  const bool has_many_fixed = features.samples.size() * samples_for_one_fixed > best->num_samples();
  if (has_many_fixed) once_more.least_gain = options.polishing_gain;
  for (int round = 0; round < options.rounds && !enough() && !did_harm(); ++round) {
    if (!room.lower(*last, dual)) break;
    look_at(room.optimized(*last, dual.type.parts, once_more));
  }
  if (did_harm()) {
    last = best.get();
    room.return_to(of_best);
    dual = dual_of(*best, type, false, options.interrupted);
  }
  in_vain = 0;
  const int most_for_strays = has_many_fixed ? rounds_for_strays : stray_rounds;
  for (int round = 0; round < most_for_strays && !enough() && !did_harm() && in_vain < patience; ++round) {
    if (round >= rounds_for_strays) room.lower(*last, dual);
    look_at(room.optimized(*last, dual.type.parts, once_more, true));
  }
  if (!dual.type.ok() || fpo::interrupted(options.interrupted)) return best;
  OptimizeOptions polishing;
  polishing.max_iterations = options.polishing;
  polishing.least_gain = options.polishing_gain;
  polishing.scope = options.scope;
  auto polished = room.optimized(*best, {}, polishing);
  if (dual_of(*polished, type, false, options.interrupted).type.ok()) return polished;
  return best;
}

}  // namespace fpo
