#pragma once
// How long edges should be where on a surface (paper, section 3.2: the sizing function rho; section 4 on
// surfaces).

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "fpo/surface/spots.h"
#include "fpo/surface/surface_sample.h"
#include "geom/mesh/trimesh.h"

namespace fpo {

/// One number per vertex of a mesh.
using VertexField = geom::Table<geom::VertexId, double>;

/// The wanted edge length h: positive, linear on each facet. The density of samples that it calls for is that
/// of a hexagonal arrangement, 2 / (sqrt(3) h^2).
class Sizing {
 public:
  /// The same everywhere. Throws InputError if h is not positive and finite.
  static Sizing uniform(double h);
  /// Throws InputError (naming the vertex) unless each length is positive and finite. Keeps a reference to
  /// the mesh.
  Sizing(const geom::TriMesh& mesh, VertexField h);

  /// The same times `scale`, but nowhere more than the spots want, and those of before if it was lowered
  /// already: within a facet no more linear.
  Sizing lowered(double scale, std::shared_ptr<const Spots> spots, const geom::TriMesh& mesh) const;

  bool is_uniform() const { return mesh_ == nullptr && !spots_; }
  /// Uniform but for spots.
  bool is_even() const { return mesh_ == nullptr; }
  double at(geom::VertexId v) const;
  double at(const SurfaceSample& x) const;

 private:
  explicit Sizing(double h) : uniform_(h) {}
  double unlowered_at(const SurfaceSample& x) const;

  const geom::TriMesh* mesh_ = nullptr;  ///< null: uniform
  VertexField at_vertices_;
  double uniform_ = 0;
  double scale_ = 1;                        ///< of all but the spots
  std::shared_ptr<const Spots> spots_;      ///< null: none
  const geom::TriMesh* spotted_ = nullptr;  ///< the mesh, if there are spots
};

/// A part of a facet on which h varies little, or for which it calls for a thousandth of a sample at most.
struct SizedPatch {
  geom::FacetId facet;
  std::array<geom::Vec2, 3> corners;  ///< facet coordinates (u, v): q0 + u (q1 - q0) + v (q2 - q0)
  double least_h;
  double num_samples;  ///< that the sizing calls for: the integral of 2 / (sqrt(3) h^2)
};

/// The whole surface in patches; on those with more the largest h is less than 1.2 times the smallest, unless
/// they are a 65536th of their facet. O(patches).
std::vector<SizedPatch> sized_patches(const geom::TriMesh& mesh, const Sizing& sizing);

/// The number of samples that the sizing calls for, or some number larger than `enough`. O(patches).
double num_samples(const geom::TriMesh& mesh, const Sizing& sizing,
                   double enough = std::numeric_limits<double>::infinity());

/// Bounds of h. Lengths in units of the spacing that n samples would have if they were spread evenly.
struct SizingLimits {
  double gradation = 0.12;  ///< |h(u) - h(v)| <= gradation * |uv| along each mesh edge
  double smallest = 0.1, largest = 10;
};

/// The sizing proportional to rho, as far as the limits allow, that calls for n samples: h = s rho, clamped,
/// then lowered until the gradation holds (Dijkstra over mesh edges), with s found by secants. rho may be
/// +infinity (no wish). O(F log F) about ten times. Throws InputError, naming the vertex, on a rho that is
/// NaN or not positive; on limits that are senseless; if the surface has no area.
Sizing fit_sizing(const geom::TriMesh& mesh, const VertexField& rho, std::size_t n,
                  const SizingLimits& limits = {});

/// The largest sizing of at most h that changes by at most `gradation` per length along mesh edges. h may be
/// +infinity, but not everywhere. O(F log F). Throws InputError, naming the vertex, as fit_sizing does.
Sizing graded_sizing(const geom::TriMesh& mesh, VertexField h, double gradation);

/// d_max of section 2.1: the spacing of n samples in hexagonal arrangement on the given area.
double hexagonal_spacing(double area, std::size_t n);

}  // namespace fpo
