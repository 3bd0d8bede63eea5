#pragma once
// Flaws of the remesh that local resampling can mend: triangles with bad angles (paper, section 5), triangles
// far from the surface.

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "fpo/features/curve_slides.h"
#include "fpo/penalties.h"
#include "fpo/remesh/sample_journal.h"
#include "fpo/surface/surface_domain.h"
#include "geom/indexed_heap.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

/// How bad the triangle at a circle of type C is; 0 if it is good. Where it is worse than `enough`, anything
/// worse than that and no worse than it is.
using FlawMeasure = std::function<double(const geom::EmptyCircle&, double enough)>;
/// The same of many at once.
using FlawMeasures = std::function<std::vector<double>(std::span<const CircleId>)>;

/// The bad triangles of the RRT under one measure, followed through removals and insertions.
class Flaws final : public Follower<geom::RestrictedDual::Change> {
 public:
  /// What a measure looks at: the triangle alone, or all that have a corner with it in common.
  enum class Sight { triangle, star };

  /// Keeps a reference to the domain, which must stay where it is. One measurement a triangle, by `at_first`
  /// if that is given.
  Flaws(SurfaceDomain& domain, FlawMeasure measure, Sight sight = Sight::triangle,
        const FlawMeasures& at_first = {});
  ~Flaws() override;

  /// What is new is measured when next somebody asks, so what exists between a removal and an insertion only
  /// costs nothing.
  void follow(const geom::RestrictedDual::Change& change) override;

  std::size_t number() { return catch_up(), penalties_.number(); }
  double penalty() { return catch_up(), penalties_.sum(); }  ///< the sum of all measures
  std::size_t changes() const { return changes_; }           ///< so far
  bool is_more_than(double limit);  ///< the penalty: measures no more of what is new than it takes to say so
  std::vector<CircleId> all();      ///< those that are bad. O(triangles)
  double penalty(CircleId c) const { return penalties_.of(c); }  ///< of one that take_worst() gave

  /// The worst that take_worst() has not given yet since try_all_again(); none if there is none.
  CircleId take_worst();
  void try_all_again();

 private:
  struct Order {
    const geom::RestrictedDual* dual;
    bool operator()(CircleId a, CircleId b) const { return circle_before(dual->circle(a), dual->circle(b)); }
  };

  void catch_up();
  void measure_again(CircleId c);
  double measure(CircleId c, double enough) const;
  void add(CircleId c, double bad);
  void forget(CircleId c);

  SurfaceDomain& domain_;
  FlawMeasure measure_;
  Sight sight_;
  std::vector<CircleId> unmeasured_;
  struct AtLeast {
    CircleId circle;
    double at_least = 0;
  };
  AtLeast known_;  ///< of one of them, that it is so bad
  std::size_t changes_ = 0;
  geom::IndexedHeap<CircleId, Order> untried_;
  std::set<std::array<SiteId, 3>> tried_;  ///< triangles: what is undone comes back as another circle
  Penalties<CircleId> penalties_;
};

/// Where else a sample may be tried.
struct Trial {
  SiteId sample;
  SurfaceSample place;
};

/// What a trial costs, or anything not below the limit if it costs as much.
using CostBelow = std::function<double(double limit)>;

/// Moves some samples and keeps that only if it betters things.
class LocalResampling {
 public:
  /// The first flaws are to become fewer, the others must not become more. With uniform sizing no sample may
  /// come closer to another than any is now, and closer than `enough` (normalized). Keeps references.
  LocalResampling(SurfaceDomain& domain, std::vector<Flaws*> flaws, double enough);

  /// Things are better if the first penalty is smaller by more than this: 0 at first.
  void require_gain(double gain) { gain_ = gain; }

  /// With any sizing no sample may come too close to another.
  void keep_spacing() { keeps_spacing_ = true; }

  /// Fixed samples on curves may be put elsewhere on these, by attempts to slide and nudges. Null: none.
  void let_slide(const CurveSlides* slides) { slides_ = slides; }

  /// Notes each sample before it is first moved. Null: none is noted.
  void keep(SampleJournal* journal) { journal_ = journal; }

  /// Multiplies the weights of samples[1] and [2] by `weight_share`, then resamples all in turn (Algorithm 1
  /// in the 2-ring), some times over, until things are better and, with uniform sizing, no sample is too
  /// close to another: true. Else puts everything back. Fixed samples stay.
  bool attempt(std::span<const SiteId> samples, double weight_share);
  /// The same with samples[0] put at a place first, where it stays.
  bool attempt_at(std::span<const SiteId> samples, const SurfaceSample& place);
  /// The same, with samples[0], which is on a curve, put at one place after the other of that curve until
  /// things are better. False if it cannot slide.
  bool attempt_to_slide(std::span<const SiteId> samples);
  /// Moves a corner of a triangle by a small step to where the first penalty is least, if that is less than
  /// now: what no empty circle mends this often does, for farthest points do not have the best angles.
  bool nudge(std::span<const SiteId> corners);
  /// Moves a sample as that trial says whose cost is least, if that is below `least` and all penalties but
  /// the first are no more. Those of one sample stand together.
  bool nudge(std::span<const Trial> trials, const CostBelow& cost, double least);
  /// As the first trial says of which that is true.
  bool nudge_as_first(std::span<const Trial> trials, const CostBelow& cost, double least);
  /// Gives x its full weight back unless that makes the first flaws worse. Whether it has it now.
  bool restore_weight(SiteId x);
  /// Removals with an insertion so far, and samples found in their places when all was put back: a bound of
  /// what it has cost.
  std::size_t moves() const { return moves_; }

 private:
  /// A sample as it was, to go back to.
  struct Backup {
    SiteId id;
    SurfaceSample place;
    double weight_share;
  };

  Backup backup(SiteId x) const { return {x, domain_.sample(x), domain_.weight_share(x)}; }
  std::vector<Backup> backups_of(std::span<const SiteId> samples) const;
  void move(const Backup& x);
  bool resample(SiteId x);  ///< whether it moved
  bool settle(std::span<const Backup> samples, std::span<const Backup> moving);
  bool better();
  bool others_no_worse();
  bool wide_enough(SiteId x);
  bool fits(SiteId x) { return others_no_worse() && wide_enough(x) && is_joined(x); }
  void remember_penalties();
  void note_that_all_is_back() { put_back_ = flaws_.front()->changes(); }
  bool can_slide(SiteId x) const { return slides_ && slides_->can_slide(x); }
  bool can_move(SiteId x) const { return !domain_.is_fixed(x) || can_slide(x); }
  /// Are the samples of curves around it still joined to those before and after them?
  bool is_joined(SiteId x) const { return !slides_ || slides_->has_its_edges(domain_, x); }
  std::vector<SurfaceSample> places_around(SiteId site);

  SurfaceDomain& domain_;
  std::vector<Flaws*> flaws_;
  std::vector<double> before_;           ///< penalty of each at the start of the attempt
  std::optional<std::size_t> put_back_;  ///< how many changes there were when all was as then
  double gain_ = 0;
  std::size_t moves_ = 0;
  std::optional<geom::AabbTree> tree_;  ///< made when first needed
  const CurveSlides* slides_ = nullptr;
  SampleJournal* journal_ = nullptr;
  bool keeps_spacing_;
  double delta_;  ///< no normalized spacing becomes smaller
};

/// The corners of a triangle and, ring by ring, those around them: larger and larger sets to resample, until
/// one succeeds or there are so many that everything touches everything. `attempt` gets the samples so far.
bool in_growing_sets(const SurfaceDomain& domain, std::array<SiteId, 3> triangle,
                     const std::function<bool(std::span<const SiteId>)>& attempt);

}  // namespace fpo
