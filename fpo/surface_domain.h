#pragma once
// Farthest point optimization on a surface (paper, section 4): the samples, their restricted power diagram,
// and the heap of empty circles.

#include <memory>
#include <span>

#include "fpo/domain.h"
#include "fpo/initial_samples.h"
#include "fpo/localize.h"
#include "geom/indexed_heap.h"
#include "geom/restricted_power.h"

namespace fpo {

/// Where neighbours come from: the regular triangulation (the paper's way) or a spatial search. Same results.
enum class Engine { search, triangulation };

struct SurfaceOptions {
  Engine engine = Engine::search;
  geom::CornerTypes corners = geom::CornerTypes::c_only;
  std::uint64_t seed =
      1;  ///< of the order in which the first diagram is built (the result does not depend on it)
};

class SurfaceDomain final : public Domain {
 public:
  /// Keeps a reference to the mesh. Builds the diagram of the samples by inserting them in random order: O(F
  /// + n log n) expected. Throws InputError if there is no sample or no facet.
  SurfaceDomain(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples,
                const SurfaceOptions& options = {});

  std::size_t num_samples() const override { return samples_.size(); }
  double separation(SiteId x) override;
  void remove(SiteId x) override;
  Circle largest_empty(Scope scope) override;
  void insert_at(SiteId x, const Circle& c) override;
  void put_back(SiteId x) override;
  double normalized_spacing(SiteId x) override;
  void check() const override;

  const SurfaceSample& sample(SiteId x) const { return samples_[x]; }
  const geom::RestrictedPower& diagram() const { return *diagram_; }
  /// Gives orphans away (localize.h) for the extraction. Ends the optimization: no move may follow.
  Localization localize();
  const geom::TriMesh& mesh() const { return mesh_; }
  /// What the last removal or insertion changed.
  const geom::RestrictedPower::Change& last_change() const { return *last_change_; }
  const geom::NeighbourSource& neighbours() const { return *neighbours_; }

 private:
  struct CircleOrder {
    const geom::RestrictedPower* diagram;
    bool operator()(CircleId a, CircleId b) const { return diagram->circle_before(a, b); }
  };

  void insert(SiteId x, SiteId hint);
  void apply(const geom::RestrictedPower::Change& change);

  const geom::TriMesh& mesh_;
  geom::Table<SiteId, SurfaceSample> samples_;
  double hexagonal_spacing_;  ///< d_max of section 2.1
  std::unique_ptr<geom::NeighbourSource> neighbours_;
  std::unique_ptr<geom::RestrictedPower> diagram_;
  geom::IndexedHeap<CircleId, CircleOrder> circles_;
  const geom::RestrictedPower::Change* last_change_ = nullptr;
};

/// d_max of section 2.1: the spacing of n samples in hexagonal arrangement on the given area.
double hexagonal_spacing(double area, std::size_t n);

}  // namespace fpo
