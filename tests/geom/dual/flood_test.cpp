// Cells and holes traced over facets against brute force, and every premise broken in turn.

#include "geom/dual/flood.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "doctest.h"
#include "geom/rng.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/effort.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/levels.h"
#include "tests/fixtures/placed_samples.h"
#include "tests/oracle/restricted_dual_oracle.h"

using namespace geom;
using fixtures::Weights;

namespace {

/// A circle, or an old corner: where edges end between sites i and j of the frame.
struct End {
  FacetId facet;
  int i, j;
  auto operator<=>(const End&) const = default;
};

/// What there is to know of the cell of a site, by brute force, of it and the sites around it alone.
struct Task {
  SiteId p;
  std::vector<SiteId> rim;
  std::vector<FacetId> starts;  ///< of the cell's circles
  std::vector<End> cell;        ///< its ends
  std::vector<End> hole;        ///< those of its division among the rim, old corners first
  std::set<FacetId> facets;     ///< of the cell
  std::set<VertexId> vertices;  ///< that it has
  std::size_t num_points = 0;   ///< where its border crosses edges of the surface
  double radius2 = 0;           ///< of these corners
  bool touches_gap = false;     ///< an edge without exactly two facets that run oppositely
};

int place_of(const std::vector<SiteId>& rim, SiteId s) {
  const auto at = std::ranges::find(rim, s);
  return at == rim.end() ? Frame::none : static_cast<int>(at - rim.begin());
}

bool is_gap(const TriMesh& mesh, FacetId t, int e) {
  const FacetId across = mesh.across(t, e);
  if (!across.valid()) return true;
  const auto at = [](const TriMesh::Facet& f, int i) { return f[static_cast<std::size_t>(i % 3)]; };
  const TriMesh::Facet &f = mesh.facet(t), &g = mesh.facet(across);
  for (int i = 0; i < 3; ++i)
    if (at(g, i) == at(f, e + 1) && at(g, i + 1) == at(f, e)) return false;
  return true;
}

/// None if p has no circle, or too many neighbours.
std::optional<Task> task_of(const TriMesh& mesh, const Clipper::Sites& sites, std::span<const SiteId> present,
                            SiteId p) {
  const oracle::BruteDiagram all(mesh, sites, present);
  Task task;
  task.p = p;
  for (const auto& [key, polygon] : all.polygons())
    if (key.second == p)
      for (const PolygonCorner& c : polygon.corners)
        if (c.edge.is_site() && place_of(task.rim, c.edge.site()) == Frame::none)
          task.rim.push_back(c.edge.site());
  if (task.rim.empty() || task.rim.size() > Frame::most) return {};
  std::vector<SiteId> few = task.rim;
  few.push_back(p);
  std::ranges::sort(few);
  const oracle::BruteDiagram with(mesh, sites, few), without(mesh, sites, task.rim);
  std::set<std::tuple<FacetId, int, SiteId>> points;
  std::vector<End> old_corners;
  const Clipper clipper(mesh, sites, extent_of(mesh));
  for (const auto& [key, polygon] : with.polygons()) {
    if (key.second != p) continue;
    const FacetId t = polygon.facet;
    task.facets.insert(t);
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
      const EdgeLabel before = polygon.edge_before(k), after = polygon.corners[k].edge;
      if (!after.is_site()) task.touches_gap |= is_gap(mesh, t, after.edge());
      if (before.is_site() && after.is_site()) {
        const int i = place_of(task.rim, before.site()), j = place_of(task.rim, after.site());
        task.starts.push_back(t);
        task.cell.insert(task.cell.end(), {{t, i, Frame::none}, {t, j, Frame::none}});
        old_corners.push_back({t, std::min(i, j), std::max(i, j)});
        continue;
      }
      const Vec3& z = polygon.corners[k].point.position;
      const Location3 location(z, clipper.levels().at(t, z));
      task.radius2 = std::max(task.radius2, power(location, {sites[p].position, 0, sites[p].level}));
      if (!before.is_site() && !after.is_site()) {
        task.vertices.insert(mesh.facet(t)[static_cast<std::size_t>(after.edge())]);
      } else {
        const int e = before.is_site() ? after.edge() : before.edge();
        const FacetId across = mesh.across(t, e);
        if (!across.valid() || t < across)
          points.insert({t, e, before.is_site() ? before.site() : after.site()});
      }
    }
  }
  task.num_points = points.size();
  if (task.starts.empty()) return {};
  task.hole = old_corners;
  for (const auto& [key, polygon] : without.polygons())
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
      const EdgeLabel before = polygon.edge_before(k), after = polygon.corners[k].edge;
      if (!before.is_site() || !after.is_site()) continue;
      if (!clipper.beats_at(polygon, k, p, clipper.bisector_of(polygon.owner, p))) continue;
      // Seen from each of three cells: that of the owner adds the edge opposite.
      const int i = place_of(task.rim, before.site()), j = place_of(task.rim, after.site());
      task.hole.push_back({polygon.facet, std::min(i, j), std::max(i, j)});
    }
  return task;
}

struct Tracer {
  explicit Tracer(const TriMesh& mesh) : vertices(mesh, frame), flood(mesh, vertices) {}
  void begin(const Task& task, const Clipper::Sites& sites) {
    frame.begin(sites[task.p]);
    vertices.clear();
    for (const SiteId s : task.rim) frame.add(sites[s]);
  }
  bool accepts(std::span<const End> ends) {
    return std::ranges::all_of(ends, [&](const End& e) { return flood.add_end(e.facet, e.i, e.j); }) &&
           flood.is_complete();
  }
  Frame frame;
  FrameVertices vertices;
  Flood flood;
};

struct Count {
  std::size_t tasks = 0, traced = 0, cells = 0, holes = 0, refused = 0;
};

/// Traces, and checks all that is told; then leaves out an end, or tells it twice.
void check_task(const TriMesh& mesh, const Clipper::Sites& sites, const Task& task, Rng& rng, Count& count) {
  Tracer tracer(mesh);
  Flood& flood = tracer.flood;
  ++count.tasks;
  for (const bool division : {false, true}) {
    CAPTURE(division);
    tracer.begin(task, sites);
    const bool traced = flood.trace(task.starts, division);
    if (task.touches_gap) {
      // The part of the cell that is not reached from these circles may be elsewhere.
      bool meets_gap = false;
      for (const FacetId t : task.facets)
        for (int e = 0; e < 3 && traced && flood.facets().has(t); ++e)
          if (is_gap(mesh, t, e)) {
            const oracle::BruteDiagram part(
                mesh, sites,
                [&] {
                  std::vector<SiteId> few = task.rim;
                  few.push_back(task.p);
                  std::ranges::sort(few);
                  return few;
                }(),
                std::array{t});
            const FacetPolygon& polygon = part.polygons().at({t, task.p});
            meets_gap |=
                std::ranges::count(polygon.corners, EdgeLabel::facet_edge(e), &PolygonCorner::edge) > 0;
          }
      CHECK(!meets_gap);
      if (traced) ++count.traced;
    }
    if (!traced) continue;
    ++count.traced;
    const std::vector<End>& ends = division ? task.hole : task.cell;
    const bool accepted = tracer.accepts(ends);
    if (accepted) {
      (division ? count.holes : count.cells) += 1;
      std::size_t met = 0;
      for (const FacetId t : task.facets) met += flood.facets().has(t);
      CHECK(flood.facets().size() == met);  // no other facet
      double farthest2 = 0;
      for (const Flood::Corner& corner : flood.corners()) {
        const Vec3 place = sites[task.p].position + corner.at.y;
        const Location3 z(place, sites[task.p].level + corner.at.rise);
        const double slack = 1e-9 + 4 * corner.off;
        double least = std::numeric_limits<double>::infinity();
        for (const SiteId s : task.rim) least = std::min(least, power(z, sites[s]));
        CHECK(power(z, sites[task.p]) <= least + slack);  // in the cell
        if (division)
          CHECK(power(z, sites[task.rim[static_cast<std::size_t>(corner.site)]]) <= least + slack);
        if (!division) CHECK(corner.site == Frame::none);
        farthest2 = std::max(farthest2, corner.at.squaredNorm());
      }
      CHECK(farthest2 <= flood.radius2() * (1 + 1e-12));
      if (met == task.facets.size()) {
        if (!division) CHECK(flood.corners().size() == task.vertices.size() + task.num_points);
        CHECK(flood.radius2() >= task.radius2 * (1 - 1e-9));
        CHECK(flood.radius2() <= task.radius2 * (1 + 1e-6) + 1e-12);
      }
    }
    if (!accepted) continue;
    for (int trial = 0; trial < 4; ++trial) {
      std::vector<End> wrong = ends;
      const std::size_t i = rng.below(wrong.size());
      if (trial % 2 == 0)
        wrong.erase(wrong.begin() + static_cast<std::ptrdiff_t>(i));
      else
        wrong.push_back(wrong[i]);
      REQUIRE(flood.trace(task.starts, division));
      CHECK(!tracer.accepts(wrong));
      ++count.refused;
    }
    // All circles of a facet; the old corners of the hole are known in any case.
    const std::size_t num_old = division ? task.starts.size() : 0;
    if (ends.size() == num_old) continue;
    const FacetId t = ends[num_old + rng.below(ends.size() - num_old)].facet;
    std::vector<End> wrong(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(num_old));
    for (std::size_t i = num_old; i < ends.size(); ++i)
      if (ends[i].facet != t) wrong.push_back(ends[i]);
    REQUIRE(flood.trace(task.starts, division));
    CHECK(!tracer.accepts(wrong));
  }
}

std::vector<SiteId> first_ids(std::size_t n) {
  std::vector<SiteId> ids;
  for (std::size_t i = 0; i < n; ++i) ids.emplace_back(i);
  return ids;
}

Count check_surface(const TriMesh& mesh, std::size_t n, Weights weights, std::uint64_t seed) {
  const FacetLevels levels(mesh);
  Clipper::Sites sites;
  for (const fixtures::Placed& placed : fixtures::placed_samples(mesh, n, n, weights, seed))
    sites.push_back(
        {placed.point.position, placed.point.weight, levels.at(placed.home, placed.point.position)});
  Rng rng(seed);
  Count count;
  for (std::size_t p = 0; p < n; p += 1 + n / fixtures::effort<std::size_t>(7, 12))
    if (const std::optional<Task> task = task_of(mesh, sites, first_ids(n), SiteId(p))) {
      CAPTURE(p);
      check_task(mesh, sites, *task, rng, count);
    }
  return count;
}

}  // namespace

TEST_CASE(
    "flood: on smooth surfaces each cell and each hole is traced, and no end may be missing or told twice") {
  Count all;
  for (const TriMesh& mesh : {make_shape("sphere", 4), make_shape("sphere", 2), fixtures::blob(6),
                              fixtures::torus(1, 0.4, {20, 12, true, true, 0.3})})
    for (const Weights weights : {Weights::none, Weights::gentle})
      for (const std::size_t n : {40u, 200u}) {
        const Count count = check_surface(mesh, n, weights, n);
        CHECK(count.traced == 2 * count.tasks);
        CHECK(10 * count.cells >= 9 * count.tasks);
        CHECK(10 * count.holes >= 9 * count.tasks);
        all.refused += count.refused;
      }
  CHECK(all.refused > fixtures::effort<std::size_t>(500, 1000));
}

TEST_CASE("flood: on surfaces with levels, steep or not, cells and holes are traced in four coordinates") {
  Count all;
  for (const TriMesh& flat : {make_shape("sphere", 4), fixtures::torus(1, 0.4, {20, 12, true, true, 0.3})})
    for (const fixtures::Levels kind : fixtures::all_levels)
      for (const double height : {0.1, 0.6})
        for (const Weights weights : {Weights::none, Weights::gentle}) {
          CAPTURE(static_cast<int>(kind));
          CAPTURE(height);
          const Count count = check_surface(fixtures::with_levels(flat, kind, height), 150, weights, 5);
          all.tasks += count.tasks, all.traced += count.traced, all.cells += count.cells,
              all.holes += count.holes, all.refused += count.refused;
        }
  CHECK(all.traced == 2 * all.tasks);
  CHECK(10 * all.cells >= 8 * all.tasks);
  CHECK(10 * all.holes >= 8 * all.tasks);
  CHECK(all.refused > fixtures::effort<std::size_t>(300, 600));
}

TEST_CASE("flood: on hard surfaces what is accepted is so") {
  Count all;
  for (const fixtures::NamedSurface& surface : fixtures::hard_surfaces())
    for (const Weights weights : fixtures::all_weights)
      for (const std::size_t n : {10u, 60u}) {
        CAPTURE(surface.name);
        CAPTURE(static_cast<int>(weights));
        CAPTURE(n);
        const Count count = check_surface(surface.mesh, n, weights, n + 1);
        all.tasks += count.tasks, all.traced += count.traced, all.cells += count.cells,
            all.holes += count.holes;
      }
  CHECK(all.tasks > fixtures::effort<std::size_t>(500, 1000));
  CHECK(all.traced > fixtures::effort<std::size_t>(250, 500));
  CHECK(all.cells > fixtures::effort<std::size_t>(100, 200));
  CHECK(all.holes > fixtures::effort<std::size_t>(50, 100));
}

//        ___             q is above the peak and has all of it down to a closed curve, which no circle tells
//      q/   \            of; p has the slope below. Without q in the frame, p has the peak.
//   ___/  p  \___
TEST_CASE("flood: an island in a cell is seen") {
  const TriMesh peak = fixtures::sheet(24, 1, [](double x, double y) {
    const double r2 = (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5);
    return 0.5 * std::exp(-30 * r2);
  });
  Clipper::Sites sites;
  sites.push_back({Vec3(0.5013, 0.4991, 0.05), 0});
  for (int i = 0; i < 6; ++i)
    sites.push_back({Vec3(0.5 + 0.38 * std::cos(i + 0.1), 0.5 + 0.38 * std::sin(i + 0.1), 0.011 * i), 0});
  sites.push_back({Vec3(0.4987, 0.5007, 0.5), 0});
  const SiteId p(0), q(7);
  for (const bool knows_island : {true, false}) {
    CAPTURE(knows_island);
    std::vector<SiteId> present = first_ids(7);
    if (knows_island) present.push_back(q);
    const std::optional<Task> task = task_of(peak, sites, present, p);
    REQUIRE(task);
    REQUIRE(task->rim.size() == (knows_island ? 7 : 6));
    REQUIRE(!task->touches_gap);
    Tracer tracer(peak);
    tracer.begin(*task, sites);
    REQUIRE(tracer.flood.trace(task->starts, false));
    CHECK(tracer.accepts(task->cell) == !knows_island);
  }
}

// A cell that has all of a closed surface but for two far cells has two borders, one around each. The circles
// of one do not tell of the other.
TEST_CASE("flood: a second border is seen") {
  const TriMesh tube = fixtures::parametric({40, 12, false, true, 0.1}, [](double u, double v) {
    const double a = 2 * std::numbers::pi * v;
    return Vec3(u, 0.1 * std::cos(a), 0.1 * std::sin(a));
  });
  Clipper::Sites sites;
  sites.push_back({Vec3(0.5, 0, 0.1), 0});
  for (int i = 0; i < 3; ++i) {
    const double a = 0.3 + 2 * std::numbers::pi * i / 3;
    sites.push_back({Vec3(0.2, 0.1 * std::cos(a), 0.1 * std::sin(a)), 0});
    sites.push_back({Vec3(0.81, 0.1 * std::cos(a), 0.1 * std::sin(a)), 0});
  }
  const std::optional<Task> task = task_of(tube, sites, first_ids(7), SiteId(0));
  REQUIRE(task);
  REQUIRE(!task->touches_gap);
  Tracer tracer(tube);
  tracer.begin(*task, sites);
  REQUIRE(tracer.flood.trace(task->starts, false));
  CHECK(tracer.accepts(task->cell));  // with all circles
  std::vector<FacetId> starts;
  std::vector<End> left;
  const auto is_left = [&](FacetId t) { return tube.corner(t, 0).x() < 0.5; };
  for (const FacetId t : task->starts)
    if (is_left(t)) starts.push_back(t);
  for (const End& e : task->cell)
    if (is_left(e.facet)) left.push_back(e);
  REQUIRE(!left.empty());
  REQUIRE(left.size() < task->cell.size());
  REQUIRE(tracer.flood.trace(starts, false));
  CHECK(!tracer.accepts(left));
}

TEST_CASE("flood: a border of the surface, an edge of three facets, a facet turned round: no trace") {
  const auto open = [](const TriMesh& mesh, const Vec3& middle) {
    Clipper::Sites sites;
    sites.push_back({middle, 0});
    for (int i = 0; i < 5; ++i)
      sites.push_back({middle + Vec3(0.3 * std::cos(1.2 * i + 0.1), 0.3 * std::sin(1.2 * i + 0.1), 0), 0});
    const std::optional<Task> task = task_of(mesh, sites, first_ids(6), SiteId(0));
    REQUIRE(task);
    Tracer tracer(mesh);
    tracer.begin(*task, sites);
    const bool cell = tracer.flood.trace(task->starts, false), hole = tracer.flood.trace(task->starts, true);
    CHECK(cell == hole);
    CHECK(task->touches_gap != cell);
    return cell;
  };
  const TriMesh flat = fixtures::sheet(
      9, 1, [](double, double) { return 0.0; }, 0.2);
  const Vec3 middle(0.5, 0.5, 0);
  CHECK(open(flat, middle));
  CHECK(!open(flat, Vec3(0.1, 0.5, 0)));
  Table<VertexId, Vec3> vertices = flat.vertices();
  FacetId home;
  for (FacetId t(0); t.index() < flat.num_facets(); t = FacetId(t.value + 1)) {
    const Vec3 center = (flat.corner(t, 0) + flat.corner(t, 1) + flat.corner(t, 2)) / 3;
    if (!home.valid() && (center - middle).norm() < 0.06) home = t;
  }
  REQUIRE(home.valid());
  Table<FacetId, TriMesh::Facet> turned = flat.facets();
  std::swap(turned[home][0], turned[home][1]);
  CHECK(!open(TriMesh(vertices, turned), middle));
  Table<FacetId, TriMesh::Facet> with_hole;
  for (FacetId t(0); t.index() < flat.num_facets(); t = FacetId(t.value + 1))
    if (t != home) with_hole.push_back(flat.facet(t));
  CHECK(!open(TriMesh(vertices, with_hole), middle));
  Table<FacetId, TriMesh::Facet> with_fin = flat.facets();
  vertices.push_back(middle + Vec3(0, 0, 0.2));
  with_fin.push_back({flat.facet(home)[0], flat.facet(home)[1], VertexId(vertices.size() - 1)});
  CHECK(!open(TriMesh(vertices, with_fin), middle));
}

TEST_CASE("flood: where a vertex is as near to one site as to another there is no certainty") {
  const TriMesh flat = fixtures::sheet(8, 1, [](double, double) { return 0.0; });
  for (const double nudge : {0.0, 1e-3}) {
    Clipper::Sites sites;
    sites.push_back({Vec3(0.5, 0.5, 0), 0});
    for (const auto& [dx, dy] : {std::pair(0.25, 0.0), {0.0, 0.25}, {-0.25, 0.0}, {0.0, -0.25}})
      sites.push_back({Vec3(0.5 + dx * (1 + nudge), 0.5 + dy * (1 + 2 * nudge), 0), 0});
    const std::optional<Task> task = task_of(flat, sites, first_ids(5), SiteId(0));
    REQUIRE(task);
    Tracer tracer(flat);
    tracer.begin(*task, sites);
    CHECK(tracer.flood.trace(task->starts, false) == (nudge > 0));
  }
}
