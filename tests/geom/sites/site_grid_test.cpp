#include "geom/sites/site_grid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "doctest.h"
#include "geom/rng.h"

using namespace geom;

TEST_CASE("site grid: finds all sites near a place, and few others, while they come, go and move") {
  Rng rng(7);
  for (const double cell : {0.03, 0.2, 5.0})
    for (const double far : {0.0, 700.0}) {  // from the origin
      const auto place = [&] {
        return Vec3(far + rng.uniform(-1, 1), rng.uniform(-1, 1) - far, 0.2 * rng.uniform(-1, 1));
      };
      SiteGrid grid(cell, 10);
      std::vector<std::optional<Vec3>> sites(600);
      for (int step = 0; step < 2000; ++step) {
        const std::size_t i = rng.below(sites.size());
        const Vec3 to = place();
        if (!sites[i])
          grid.insert(SiteId(i), to);
        else if (step % 3 == 0)
          grid.remove(SiteId(i), *sites[i]);
        else
          grid.move(SiteId(i), *sites[i], to);
        if (sites[i] && step % 3 == 0)
          sites[i].reset();
        else
          sites[i] = to;
        if (step % 20 != 0) continue;
        const Vec3 x = place();
        const double distance = rng.uniform(0, 3 * std::min(cell, 0.3));
        std::vector<SiteId> found;
        grid.near(x, distance, found);
        std::ranges::sort(found);
        CHECK(std::ranges::adjacent_find(found) == found.end());
        for (std::size_t j = 0; j < sites.size(); ++j) {
          const bool is_found = std::ranges::binary_search(found, SiteId(j));
          if (!sites[j]) {
            CHECK(!is_found);
          } else {
            const double d = (*sites[j] - x).norm();
            if (d <= distance) CHECK(is_found);
            if (d > 1.01 * distance + 0.01) CHECK(!is_found);
          }
        }
      }
    }
}
