#include "tests/endurance/surface_stage.h"

#include <algorithm>
#include <tuple>

#include "fpo/surface_sample.h"
#include "geom/check.h"
#include "geom/scaling.h"
#include "geom/shapes.h"
#include "geom/site_tree.h"
#include "geom/triangulation_source.h"

namespace endurance {

using geom::CircleId;
using geom::EmptyCircle;
using geom::FacetId;
using geom::SiteId;
using geom::Vec3;

namespace {

/// A trailing "-tilted" turns the shape.
geom::TriMesh make_mesh(const Place& place) {
  constexpr std::string_view turned = "-tilted";
  std::string name = place.shape;
  const bool tilt = name.ends_with(turned);
  if (tilt) name.resize(name.size() - turned.size());
  const geom::TriMesh mesh = geom::make_shape(name, place.size);
  return geom::scaled_to_unit_box(tilt ? geom::tilted(mesh) : mesh, 1);
}

std::unique_ptr<geom::NeighbourSource> make_source(bool search, const geom::Box3& box) {
  if (search) return std::make_unique<geom::SiteTree>();
  return std::make_unique<geom::TriangulationSource>(box);
}

auto key(const EmptyCircle& c) {
  return std::tuple(c.facet, c.place, c.sites, c.radius2, c.center.x(), c.center.y(), c.center.z());
}

}  // namespace

SurfaceStage::SurfaceStage(const Place& place, bool search)
    : SurfaceStage(place, search, std::make_shared<const geom::TriMesh>(make_mesh(place))) {}

SurfaceStage::SurfaceStage(const Place& place, bool search, Mesh mesh)
    : place_(place),
      search_(search),
      mesh_(std::move(mesh)),
      source_(make_source(search, mesh_->box())),
      diagram_(std::make_unique<geom::RestrictedPower>(
          *mesh_, *source_, place.all_corners ? geom::CornerTypes::all : geom::CornerTypes::c_only)),
      heap_(CircleOrder{diagram_.get()}) {}

SiteId SurfaceStage::some_other() const {
  return present().empty() ? SiteId() : present()[present().size() / 2];
}

bool SurfaceStage::insert(SiteId s, const geom::WeightedPoint3& point) {
  if (s == removed_ && s.value % 2 == 0) return put_back_and_move(s, point);
  source_->insert(s, point, some_other());
  apply_change(diagram_->after_insert(s, point));
  return true;
}

/// The same by a move at once.
bool SurfaceStage::put_back_and_move(SiteId s, const geom::WeightedPoint3& point) {
  source_->insert(s, removed_point_, some_other());
  apply_change(diagram_->after_insert(s, removed_point_));
  source_->remove(s);
  const bool planned = diagram_->plan_removal(s).has_value();
  if (!planned) apply_change(diagram_->after_remove(s));
  source_->insert(s, point, some_other());
  apply_change(planned ? diagram_->after_move(s, point) : diagram_->after_insert(s, point));
  return true;
}

bool SurfaceStage::remove(SiteId s) {
  removed_ = s;
  removed_point_ = diagram_->site(s);
  source_->remove(s);
  apply_change(diagram_->after_remove(s));
  return true;
}

void SurfaceStage::apply_change(const geom::RestrictedPower::Change& change) {
  for (const CircleId c : change.circles_erased) {
    geom::ensure(heap_.contains(c), "a circle is erased that was not there");
    heap_.erase(c);
  }
  for (const CircleId c : change.circles_created) {
    geom::ensure(!heap_.contains(c), "a circle is created that is there");
    geom::ensure(mesh_->box().contains(diagram_->circle(c).center),
                 "a circle's centre is outside of the mesh's box");
    heap_.push(c, diagram_->circle(c).radius2);
    most_circles_ = std::max(most_circles_, c.index() + 1);
  }
  for (const CircleId c : change.circles_moved) {
    geom::ensure(heap_.contains(c), "a circle moves that is not there");
    heap_.update(c, diagram_->circle(c).radius2);
  }
  last_created_ = change.circles_created;
}

bool SurfaceStage::farthest(bool of_last_change, Vec3& out) const {
  CircleId best;
  if (!of_last_change && !heap_.empty()) best = heap_.top().slot;
  if (of_last_change)
    for (const CircleId c : last_created_)
      if (!best.valid() || diagram_->circle(c).radius2 > diagram_->circle(best).radius2) best = c;
  if (best.valid()) out = diagram_->circle(best).center;
  return best.valid();
}

Vec3 SurfaceStage::anywhere(bool special, geom::Rng& rng) const {
  const FacetId t(static_cast<std::size_t>(rng.below(mesh_->num_facets())));
  if (!special) {
    const double u = rng.uniform(), v = rng.uniform();
    return fpo::location_in_facet(*mesh_, t, std::min(u, 1 - u), std::min(v, 1 - v) * std::max(u, 1 - u))
        .position;
  }
  switch (rng.below(4)) {
    case 0:
      return mesh_->corner(t, 0);
    case 1:
      return fpo::location_in_facet(*mesh_, t, 0.5, 0).position;
    case 2:  // a lattice on each facet
      return fpo::location_in_facet(*mesh_, t, 0.25 * static_cast<double>(rng.below(3)),
                                    0.25 * static_cast<double>(rng.below(3)))
          .position;
    default:
      if (present().empty()) return mesh_->corner(t, 1);
      return point(present()[rng.below(present().size())]).position;
  }
}

void SurfaceStage::check() const {
  diagram_->check();
  heap_.check();
  if (const auto* tree = dynamic_cast<const geom::SiteTree*>(source_.get())) tree->check();
}

/// The fragments of one facet are those that clipping it for every site by every other one gives.
void SurfaceStage::check_facet(FacetId t) const {
  geom::Clipper::Sites sites;
  if (!present().empty()) sites.resize(present().back().index() + 1);
  for (const SiteId s : present()) sites[s] = point(s);
  const double extent = 10 * mesh_->box().min().cwiseAbs().cwiseMax(mesh_->box().max().cwiseAbs()).maxCoeff();
  geom::Clipper clipper(*mesh_, sites, extent);
  geom::FacetPolygon polygon;
  std::vector<std::pair<SiteId, std::size_t>> expected, found;
  for (const SiteId i : present()) {
    clipper.start(polygon, t, i);
    for (const SiteId j : present())
      if (j != i && !polygon.corners.empty()) clipper.clip(polygon, j);
    if (!polygon.corners.empty()) expected.emplace_back(i, polygon.corners.size());
  }
  std::array<geom::PolygonCorner, 3> buffer;
  const geom::FragmentStore& store = diagram_->fragments();
  for (const geom::FragmentId f : store.of_facet(t))
    found.emplace_back(store.site(f), store.corners(f, buffer).size());
  std::ranges::sort(found);
  geom::ensure(found == expected, "brute force finds other fragments on a facet");
}

void SurfaceStage::check_by_brute_force(geom::Rng& rng) const {
  check_facet(FacetId(static_cast<std::size_t>(rng.below(mesh_->num_facets()))));
  if (present().empty()) return;
  // The nearest site to a location, and the largest circle is empty.
  const Vec3 x = anywhere(rng.below(2) == 0, rng);
  const SiteId without = present()[rng.below(present().size())];
  const auto nearest = source_->nearest(x, without, present().front());
  SiteId best;
  for (const SiteId s : present())
    if (s != without && (!best.valid() || geom::power(x, point(s)) < geom::power(x, point(best)))) best = s;
  geom::ensure(nearest.site == best, "brute force finds another nearest site");
  if (heap_.empty()) return;
  const EmptyCircle& c = diagram_->circle(heap_.top().slot);
  const double slack = 1e-12 * (mesh_->diagonal() * mesh_->diagonal() + std::abs(c.radius2));
  for (const SiteId s : present()) {
    const double allowed = slack + 1e-12 * std::abs(point(s).weight);
    geom::ensure(geom::power(c.center, point(s)) >= c.radius2 - allowed, "the largest circle is not empty");
  }
}

std::unique_ptr<Stage> SurfaceStage::rebuilt() const {
  std::unique_ptr<SurfaceStage> other(new SurfaceStage(place_, !search_, mesh_));
  copy_sites_to(*other);
  return other;
}

std::vector<EmptyCircle> SurfaceStage::circles() const {
  std::vector<EmptyCircle> result;
  for (std::size_t c = 0; c < most_circles_; ++c)
    if (heap_.contains(CircleId(c))) result.push_back(diagram_->circle(CircleId(c)));
  std::ranges::sort(result, {}, key);
  return result;
}

void SurfaceStage::compare(const Stage& other) const {
  const auto& that = dynamic_cast<const SurfaceStage&>(other);
  geom::ensure(diagram_->canonical() == that.diagram_->canonical(), "the diagram built from nothing differs");
  geom::ensure(std::ranges::equal(circles(), that.circles(), {}, key, key),
               "the circles of the diagram built from nothing differ");
}

}  // namespace endurance
