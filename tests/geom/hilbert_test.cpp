#include "geom/hilbert.h"

#include <algorithm>
#include <cstdlib>

#include "doctest.h"

using geom::Vec3;

TEST_CASE("hilbert: a curve without jumps through all cells of space, coarse or fine") {
  struct Visit {
    std::uint64_t index;
    std::array<int, 3> cell;
  };
  constexpr std::uint32_t side = 16;
  for (const std::uint32_t step : {1u, 64u, (1u << 20) / side}) {
    const std::uint32_t origin = step == 1 ? 0x54320 : 0;
    std::vector<Visit> visits;
    for (std::uint32_t i = 0; i < side; ++i)
      for (std::uint32_t j = 0; j < side; ++j)
        for (std::uint32_t k = 0; k < side; ++k)
          visits.push_back({geom::hilbert_index({origin + i * step, origin + j * step, origin + k * step}),
                            {int(i), int(j), int(k)}});
    std::ranges::sort(visits, {}, &Visit::index);
    int jumps = 0;
    for (std::size_t n = 1; n < visits.size(); ++n) {
      int steps = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        steps += std::abs(visits[n].cell[axis] - visits[n - 1].cell[axis]);
      jumps += steps != 1;
    }
    CHECK(jumps == 0);
    if (step == 1) CHECK(visits.back().index - visits.front().index == side * side * side - 1);
  }
}

TEST_CASE("hilbert: an order of points in any box, flat ones included") {
  const std::vector<Vec3> points{{5, 1, 2}, {1, 1, 2}, {5, 1, 2}, {1.1, 1, 2}, {4.9, 1, 2}};
  geom::Box3 box;
  for (const Vec3& p : points) box.extend(p);
  const auto order = geom::hilbert_order(points, box);
  CHECK(order == std::vector<std::uint32_t>{1, 3, 4, 0, 2});
  CHECK(geom::hilbert_order({Vec3(3, 3, 3), Vec3(3, 3, 3)}, geom::Box3(Vec3(3, 3, 3))) ==
        std::vector<std::uint32_t>{0, 1});
}
