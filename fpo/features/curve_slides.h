#pragma once
// Samples on feature curves may slide along them after the optimization: "1D FPO" (paper, section 5) sees the
// curve only, not the triangles on both sides.

#include <array>
#include <span>
#include <vector>

#include "fpo/features/curve_domain.h"
#include "fpo/features/feature_samples.h"
#include "fpo/surface/surface_domain.h"

namespace fpo {

class CurveSlides {
 public:
  /// Keeps a reference to the mesh. Ends of curves and points of the user do not slide.
  CurveSlides(const geom::TriMesh& mesh, const Features& features, const FeatureSamples& samples,
              const Sizing& sizing);

  bool can_slide(SiteId x) const { return x.index() < tracks_.size() && tracks_[x].before.valid(); }
  /// Places on the curve of x at both sides of it, at most a third of the wanted length away, where the
  /// samples before and after it are neither closer than .6 nor farther than 1.3 of the wanted length, unless
  /// that gets better. Requires can_slide(x). O(length of the curve in mesh edges).
  std::vector<SurfaceSample> places(const SurfaceDomain& domain, SiteId x) const;
  /// The same for x being here, and its neighbours there.
  std::vector<SurfaceSample> places(SiteId x, const SurfaceSample& now,
                                    const std::array<geom::Vec3, 2>& beside) const;
  /// Those of them that are these steps away along the curve, in wanted lengths.
  std::vector<SurfaceSample> places(SiteId x, const SurfaceSample& now,
                                    const std::array<geom::Vec3, 2>& beside,
                                    std::span<const double> steps) const;
  /// Before it and after it on the curve. Requires can_slide(x).
  std::array<SiteId, 2> neighbours(SiteId x) const { return {tracks_[x].before, tracks_[x].after}; }
  /// Are the edges of the chains at x and at its neighbours edges of the RRT?
  bool has_its_edges(const SurfaceDomain& domain, SiteId x) const;

 private:
  /// Of a sample within a curve.
  struct Track {
    std::size_t curve = 0;
    SiteId before, after;  ///< none: it does not slide
  };
  Sizing sizing_;
  std::vector<CurveMetric> metrics_;
  std::vector<bool> loops_;
  geom::Table<SiteId, Track> tracks_;
  geom::Table<SiteId, std::vector<SiteId>> beside_;  ///< on the curves of each sample of the features
};

}  // namespace fpo
