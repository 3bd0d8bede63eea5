#include "fpo/surface/near_sheets.h"

#include <algorithm>
#include <vector>

#include "geom/sites/site_tree.h"

namespace fpo {

using geom::SiteId;
using geom::Vec3;

namespace {

constexpr double cos_facing_away = -0.5;

}  // namespace

double share_on_near_sheets(const geom::TriMesh& mesh, const Sizing& sizing,
                            std::span<const SurfaceSample> samples, double near) {
  if (samples.empty()) return 0;
  geom::SiteTree tree;
  std::vector<Vec3> normals;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    tree.insert(SiteId(i), {samples[i].position});
    normals.push_back(mesh.normal(samples[i].facet).normalized());
  }
  std::size_t found = 0;
  std::vector<SiteId> around;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3& x = samples[i].position;
    const double radius = near * sizing.at(samples[i]);
    around.clear();
    tree.heirs({SiteId(i), x, radius, 0}, around);
    found += std::ranges::any_of(around, [&](SiteId y) {
      return (samples[y.index()].position - x).norm() < radius &&
             normals[y.index()].dot(normals[i]) < cos_facing_away;
    });
  }
  return static_cast<double>(found) / static_cast<double>(samples.size());
}

}  // namespace fpo
