// bench-predicates: nanoseconds per call of each predicate and the share that the filter leaves to exact
// arithmetic, for harmless and for hard inputs (tests/fixtures/weighted_points.h).

#include <array>
#include <cstdio>
#include <ctime>

#include "geom/power/clip_filters.h"
#include "tests/fixtures/weighted_points.h"

namespace {

using geom::RankedPoint2;
using geom::RankedPoint3;
using geom::WeightedPoint2;
using geom::WeightedPoint3;

constexpr int rounds = 2000;

struct Scene {
  std::vector<WeightedPoint3> p;  ///< five sites, a facet
  std::array<WeightedPoint2, 4> flat;
  RankedPoint3 site(std::size_t i) const { return {&p[i], static_cast<int>(i * 3 % 5)}; }
  RankedPoint2 flat_site(std::size_t i) const { return {&flat[i], static_cast<int>(i * 3 % 5)}; }
  geom::FacetCorners facet() const { return {&p[5].position, &p[6].position, &p[7].position}; }
};

std::vector<Scene> scenes(fixtures::Hardship hardship) {
  geom::Rng rng(1);
  std::vector<Scene> result(rounds);
  for (Scene& s : result) {
    const auto flat = fixtures::draw(hardship, 4, true, rng);
    for (std::size_t i = 0; i < 4; ++i) s.flat[i] = {flat[i].position.head<2>(), flat[i].weight};
    s.p = fixtures::draw(hardship, 8, false, rng);
  }
  return result;
}

/// Prints the time per call of `test` and the share of scenes where `certain` is false.
template <class Test, class Certain>
void row(const char* name, const std::vector<Scene>& all, Test test, Certain certain) {
  int exact = 0, sum = 0;
  for (const Scene& s : all) exact += !certain(s);
  const std::clock_t start = std::clock();
  std::clock_t end = start;
  int runs = 0;
  do {
    for (const Scene& s : all) sum += test(s);
    ++runs;
    end = std::clock();
  } while (end - start < CLOCKS_PER_SEC / 20);
  const double nanoseconds = 1e9 * static_cast<double>(end - start) / CLOCKS_PER_SEC / runs / rounds;
  std::printf("  %-16s %9.1f ns %7.2f %% exact   (%+d)\n", name, nanoseconds, 100.0 * exact / rounds,
              sum / runs);
}

void measure(fixtures::Hardship hardship) {
  namespace filter = geom::filter;
  const std::vector<Scene> all = scenes(hardship);
  std::printf("%s\n", fixtures::name_of(hardship));
  row(
      "orient2", all,
      [](const Scene& s) {
        return geom::orient2(s.flat[0].position, s.flat[1].position, s.flat[2].position);
      },
      [](const Scene& s) {
        return filter::orient2(s.flat[0].position, s.flat[1].position, s.flat[2].position).certain();
      });
  row(
      "conflicts2", all,
      [](const Scene& s) {
        return conflicts2(s.flat_site(0), s.flat_site(1), s.flat_site(2), s.flat_site(3));
      },
      [](const Scene& s) {
        return filter::power_side2(s.flat[0], s.flat[1], s.flat[2], s.flat[3]).certain();
      });
  row(
      "orient3", all,
      [](const Scene& s) {
        return geom::orient3(s.p[0].position, s.p[1].position, s.p[2].position, s.p[3].position);
      },
      [](const Scene& s) {
        return filter::orient3(s.p[0].position, s.p[1].position, s.p[2].position, s.p[3].position).certain();
      });
  row(
      "conflicts3", all,
      [](const Scene& s) { return conflicts3(s.site(0), s.site(1), s.site(2), s.site(3), s.site(4)); },
      [](const Scene& s) { return filter::power_side3(s.p[0], s.p[1], s.p[2], s.p[3], s.p[4]).certain(); });
  row(
      "beats_at_vertex", all,
      [](const Scene& s) { return geom::beats_at_vertex(*s.facet().q0, s.site(0), s.site(1)); },
      [](const Scene& s) { return filter::at_vertex(*s.facet().q0, s.p[0], s.p[1]).certain(); });
  row(
      "beats_on_edge", all,
      [](const Scene& s) {
        return geom::beats_on_edge(*s.facet().q0, *s.facet().q1, s.site(0), s.site(1), s.site(2));
      },
      [](const Scene& s) {
        const auto e = filter::on_edge(*s.facet().q0, *s.facet().q1, s.p[0], s.p[1], s.p[2]);
        return e.numerator.certain() && e.denominator.certain();
      });
  row(
      "beats_in_facet", all,
      [](const Scene& s) { return beats_in_facet(s.facet(), s.site(0), s.site(1), s.site(2), s.site(3)); },
      [](const Scene& s) {
        const auto e = filter::in_facet(s.facet(), s.p[0], s.p[1], s.p[2], s.p[3]);
        return e.numerator.certain() && e.denominator.certain();
      });
}

}  // namespace

int main() {
  for (const fixtures::Hardship hardship : fixtures::all_hardships) measure(hardship);
}
