// Clipped facets against exact arithmetic: every answer of the clipper, filtered or not, and every corner.

#include "geom/power/clip.h"

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "doctest.h"
#include "geom/power/lazy_polygon.h"
#include "tests/fixtures/weighted_points.h"
#include "tests/oracle/predicates_oracle.h"

using fixtures::Hardship;
using geom::Bisector;
using geom::Clip;
using geom::Clipper;
using geom::EdgeLabel;
using geom::FacetId;
using geom::FacetPolygon;
using geom::PolygonCorner;
using geom::Rng;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;
using oracle::ExactSite;
using oracle::HomogeneousPoint;
using oracle::Rational;

namespace {

constexpr int clip_draws = 120;  // of each hardship
constexpr int num_sites = 9;
const FacetId facet(0);

using Exact = std::map<SiteId, ExactSite>;

/// One facet and some sites, all of one hardship.
struct ClipScene {
  TriMesh mesh;
  Clipper::Sites sites;
  double extent = 0;

  ClipScene(Hardship hardship, Rng& rng) {
    const auto points = draw(hardship, num_sites + 3, false, rng);
    sites.assign(points.begin(), points.end() - 3);
    geom::Table<VertexId, Vec3> corners;
    for (std::size_t i = num_sites; i < points.size(); ++i) corners.push_back(points[i].position);
    mesh = TriMesh(corners, {TriMesh::Facet{VertexId(1), VertexId(0), VertexId(2)}});
    for (const auto& p : points) extent = std::max(extent, p.position.lpNorm<Eigen::Infinity>());
  }
  ClipScene(const ClipScene&) = delete;

  const Vec3& q(int i) const { return mesh.corner(facet, i); }

  /// The sites as they are.
  Exact exact(const std::vector<SiteId>& ids) const {
    Exact result;
    for (const SiteId s : ids) result[s] = oracle::exact_site(sites[s]);
    return result;
  }
  /// The sites with weights that are perturbed in fact, in the order of their ids.
  Exact perturbed(const std::vector<SiteId>& ids) const {
    oracle::Scale scale;
    for (const SiteId s : ids) scale.cover(sites[s]);
    for (int i = 0; i < 3; ++i)
      for (const double x : q(i)) scale.cover_coordinate(x);
    Exact result = exact(ids);
    int rank = 0;
    for (auto& [id, s] : result) s = lifted(s, scale.epsilon(rank++));
    return result;
  }
};

/// A corner by the labels that meet there.
struct Labels {
  EdgeLabel before, after;
  bool on(SiteId j) const { return before == EdgeLabel::bisector(j) || after == EdgeLabel::bisector(j); }
  std::vector<SiteId> sites() const {
    std::vector<SiteId> result;
    for (const EdgeLabel l : {before, after})
      if (l.is_site()) result.push_back(l.site());
    return result;
  }
};

Labels labels_at(const FacetPolygon& polygon, std::size_t k) {
  return {polygon.edge_before(k), polygon.corners[k].edge};
}

HomogeneousPoint locate(const ClipScene& s, const Labels& l, SiteId owner, Exact& sites) {
  if (l.before.is_site() && l.after.is_site())
    return in_facet({&s.q(0), &s.q(1), &s.q(2)}, sites[owner], sites[l.before.site()], sites[l.after.site()]);
  if (!l.before.is_site() && !l.after.is_site()) return oracle::at(s.q(l.after.edge()));
  const int e = l.before.is_site() ? l.after.edge() : l.before.edge();
  return on_edge(s.q(e), s.q((e + 1) % 3), sites[owner], sites[l.sites().front()]);
}

/// Does j beat the owner at the corner, by exact numbers alone?
bool beats(const ClipScene& s, const Labels& corner, SiteId owner, SiteId j) {
  std::vector<SiteId> ids = corner.sites();
  ids.insert(ids.end(), {owner, j});
  const auto sign_with = [&](Exact sites) {
    return compare_powers(locate(s, corner, owner, sites), sites[owner], sites[j]);
  };
  int sign = sign_with(s.exact(ids));
  if (sign == 0) sign = sign_with(s.perturbed(ids));
  REQUIRE(sign != 0);
  return sign < 0;
}

/// Is the rounded corner as near to the exact one as stated?
bool is_near(const ClipScene& s, const Labels& corner, SiteId owner, const geom::RoundedPoint& rounded) {
  std::vector<SiteId> ids = corner.sites();
  ids.push_back(owner);
  Exact sites = s.exact(ids);
  const HomogeneousPoint p = locate(s, corner, owner, sites);
  REQUIRE(p.w.sign() != 0);
  if (rounded.tolerance == std::numeric_limits<double>::infinity()) return true;
  const Rational dx = p.w * Rational(rounded.position.x()) - p.x,
                 dy = p.w * Rational(rounded.position.y()) - p.y,
                 dz = p.w * Rational(rounded.position.z()) - p.z, r = p.w * Rational(rounded.tolerance);
  return (dx * dx + dy * dy + dz * dz - r * r).sign() <= 0;
}

void check_corners(const ClipScene& s, const FacetPolygon& polygon, const std::vector<SiteId>& rivals) {
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    const Labels corner = labels_at(polygon, k);
    CHECK(is_near(s, corner, polygon.owner, polygon.corners[k].point));
    for (const SiteId j : rivals)
      if (!corner.on(j)) CHECK(!beats(s, corner, polygon.owner, j));
  }
}

std::vector<EdgeLabel> clip_canonical(const FacetPolygon& polygon) {
  std::vector<EdgeLabel> result;
  for (const PolygonCorner& corner : polygon.corners) result.push_back(corner.edge);
  if (!result.empty()) std::rotate(result.begin(), std::ranges::min_element(result), result.end());
  return result;
}

template <class Test>
void clip_for_each_scene(std::uint64_t seed, Test test) {
  Rng rng(seed);
  for (const Hardship hardship : fixtures::all_hardships) {
    INFO("hardship: " << fixtures::name_of(hardship));
    for (int i = 0; i < clip_draws; ++i) test(ClipScene(hardship, rng), rng);
  }
}

}  // namespace

TEST_CASE("clip: what a ball about the facet says of two sites is true") {
  int decided = 0;
  clip_for_each_scene(1, [&](const ClipScene& s, Rng&) {
    const Clipper clipper(s.mesh, s.sites, s.extent);
    for (int j = 1; j < num_sites; ++j) {
      const Clip answer = clipper.compare_on_facet(facet, clipper.bisector_of(SiteId(0), SiteId(j)));
      if (answer == Clip::cut) continue;
      ++decided;
      for (int i = 0; i < 3; ++i) {
        const Labels corner{EdgeLabel::facet_edge((i + 2) % 3), EdgeLabel::facet_edge(i)};
        CHECK(beats(s, corner, SiteId(0), SiteId(j)) == (answer == Clip::swallowed));
      }
    }
  });
  CHECK(decided > clip_draws);
}

TEST_CASE("clip: every corner test is answered as in exact arithmetic") {
  std::size_t asked = 0, corners_c = 0;
  clip_for_each_scene(2, [&](const ClipScene& s, Rng&) {
    Clipper clipper(s.mesh, s.sites, s.extent);
    FacetPolygon polygon;
    clipper.start(polygon, facet, SiteId(0));
    for (int j = 1; j < num_sites && !polygon.corners.empty(); ++j) {
      const Bisector b = clipper.bisector_of(SiteId(0), SiteId(j));
      for (std::size_t k = 0; k < polygon.corners.size(); ++k, ++asked) {
        const Labels corner = labels_at(polygon, k);
        corners_c += corner.sites().size() == 2;
        CHECK(clipper.beats_at(polygon, k, SiteId(j), b) == beats(s, corner, SiteId(0), SiteId(j)));
      }
      clipper.clip(polygon, SiteId(j), b);
    }
  });
  CHECK(asked > 10 * clip_draws);
  CHECK(corners_c > clip_draws);
}

// Only (owner, labels) decide what is left, so the order of clipping does not matter.
TEST_CASE("clip: the polygon left has exactly the corners that no site takes, in any order of clipping") {
  clip_for_each_scene(3, [](const ClipScene& s, Rng& rng) {
    Clipper clipper(s.mesh, s.sites, s.extent);
    std::vector<SiteId> rivals;
    for (int j = 1; j < num_sites; ++j) rivals.emplace_back(j);
    FacetPolygon first, second;
    for (FacetPolygon* polygon : {&first, &second}) {
      clipper.start(*polygon, facet, SiteId(0));
      for (const SiteId j : rivals)
        if (!polygon->corners.empty()) clipper.clip(*polygon, j);
      rng.shuffle(std::span(rivals));
    }
    CHECK(clip_canonical(first) == clip_canonical(second));
    check_corners(s, first, rivals);
  });
}

TEST_CASE("clip: some site owns each facet, and clip_beyond leaves what clip takes") {
  clip_for_each_scene(4, [](const ClipScene& s, Rng&) {
    Clipper clipper(s.mesh, s.sites, s.extent);
    bool owned = false;
    for (int i = 0; i < num_sites; ++i) {
      FacetPolygon polygon;
      clipper.start(polygon, facet, SiteId(i));
      for (int j = 0; j < num_sites && !polygon.corners.empty(); ++j)
        if (j != i) clipper.clip(polygon, SiteId(j));
      owned = owned || !polygon.corners.empty();
    }
    CHECK(owned);

    FacetPolygon kept, taken;
    clipper.start(kept, facet, SiteId(0));
    clipper.clip(kept, SiteId(1));
    if (kept.corners.empty()) return;
    taken = kept;
    const Bisector b = clipper.bisector_of(SiteId(0), SiteId(2));
    const std::size_t corners = kept.corners.size();
    const Clip outcome = clipper.clip(kept, SiteId(2), b);
    const Clip beyond = clipper.clip_beyond(taken, SiteId(2), b);
    CHECK((outcome == Clip::cut) == (beyond == Clip::cut));
    CHECK((outcome == Clip::untouched) == (beyond == Clip::swallowed));
    CHECK(kept.corners.size() + taken.corners.size() == corners + (outcome == Clip::cut ? 4 : 0));
  });
}

TEST_CASE("lazy polygon: what clip leaves, to the bit, also beyond a site") {
  int beyond = 0;
  clip_for_each_scene(6, [&](const ClipScene& s, Rng&) {
    Clipper clipper(s.mesh, s.sites, s.extent);
    geom::LazyPolygon lazy(clipper);
    FacetPolygon polygon, placed;
    for (int i = 0; i < num_sites; ++i) {
      clipper.start(polygon, facet, SiteId(i));
      lazy.start(facet, SiteId(i));
      for (int step = 1; step < num_sites && !polygon.corners.empty(); ++step) {
        const SiteId j((i + step) % num_sites);
        const Bisector b = clipper.bisector_of(SiteId(i), j);
        const bool is_beyond = step == 1 && i % 2 == 1;
        const Clip outcome = is_beyond ? clipper.clip_beyond(polygon, j, b) : clipper.clip(polygon, j, b);
        REQUIRE((is_beyond ? lazy.clip_beyond(j, b) : lazy.clip(j, b)) == outcome);
        if (polygon.corners.empty()) break;
        beyond += is_beyond;
        lazy.place(placed);
        REQUIRE(std::ranges::equal(polygon.corners, placed.corners, [](const auto& x, const auto& y) {
          return x.edge == y.edge && x.point.position == y.point.position &&
                 x.point.tolerance == y.point.tolerance;
        }));
      }
    }
  });
  CHECK(beyond > clip_draws);
}

TEST_CASE("clip: the corner of three cells is the same to the bit from each of them, and by itself") {
  std::size_t met = 0;
  clip_for_each_scene(5, [&](const ClipScene& s, Rng&) {
    Clipper clipper(s.mesh, s.sites, s.extent);
    std::map<std::array<SiteId, 3>, std::size_t> seen;
    for (int i = 0; i < num_sites; ++i) {
      FacetPolygon polygon;
      clipper.start(polygon, facet, SiteId(i));
      for (int j = 0; j < num_sites && !polygon.corners.empty(); ++j)
        if (j != i) clipper.clip(polygon, SiteId(j));
      for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
        const EdgeLabel before = polygon.edge_before(k), after = polygon.corners[k].edge;
        if (!before.is_site() || !after.is_site()) continue;
        std::array<SiteId, 3> sites{SiteId(i), before.site(), after.site()};
        std::ranges::sort(sites);
        const geom::RoundedPoint alone = clipper.meeting(facet, sites);
        CHECK(alone.position == polygon.corners[k].point.position);
        CHECK(alone.tolerance == polygon.corners[k].point.tolerance);
        CHECK(alone.tolerance <= clipper.most_tolerance());
        ++seen[sites];
      }
    }
    for (const auto& [sites, times] : seen) CHECK(times == 3);
    met += seen.size();
  });
  CHECK(met > clip_draws);
}
