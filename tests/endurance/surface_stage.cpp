#include "tests/endurance/surface_stage.h"

#include <algorithm>
#include <array>
#include <limits>

#include "fpo/surface/surface_sample.h"
#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/shapes/shapes.h"
#include "geom/sites/triangulation_oracle.h"
#include "tests/oracle/restricted_dual_oracle.h"

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

std::unique_ptr<geom::NeighbourOracle> make_paper(bool search, const geom::Box3& box) {
  if (search) return nullptr;
  return std::make_unique<geom::TriangulationOracle>(box);
}

std::vector<oracle::KnownCircle> without_beyond(std::vector<oracle::KnownCircle> circles, FacetId t) {
  std::erase_if(circles, [&](const oracle::KnownCircle& c) { return c.name.facet != t; });
  for (oracle::KnownCircle& c : circles) c.beyond = {};
  return circles;
}

}  // namespace

SurfaceStage::SurfaceStage(const Place& place, bool search)
    : SurfaceStage(place, search, std::make_shared<const Surface>(make_mesh(place))) {}

SurfaceStage::SurfaceStage(const Place& place, bool search, std::shared_ptr<const Surface> surface)
    : place_(place),
      search_(search),
      surface_(std::move(surface)),
      paper_(make_paper(search, surface_->mesh.box())),
      dual_(std::make_unique<geom::RestrictedDual>(surface_->mesh, types(), paper_.get())),
      heap_(CircleOrder{dual_.get()}) {}

geom::CornerTypes SurfaceStage::types() const {
  return place_.all_corners ? geom::CornerTypes::all : geom::CornerTypes::c_only;
}

/// Some sites have none, and some points are on no facet.
FacetId SurfaceStage::home_of(SiteId s, const geom::WeightedPoint3& point) const {
  if (s.value % 8 == 7) return FacetId();
  const geom::AabbTree::Closest closest = surface_->tree.closest(point.position);
  return closest.distance2 <= 1e-18 ? closest.facet : FacetId();
}

/// A circle with that center and without that site, or none.
CircleId SurfaceStage::circle_at(const Vec3& center, SiteId not_of) const {
  for (std::size_t c = 0; c < most_circles_; ++c)
    if (heap_.contains(CircleId(c)) && dual_->circle(CircleId(c)).center == center &&
        !dual_->circle(CircleId(c)).touches(not_of))
      return CircleId(c);
  return {};
}

bool SurfaceStage::insert(SiteId s, const geom::WeightedPoint3& point) {
  if (s == removed_ && s.value % 2 == 0) {
    put_back_and_move(s, point);
  } else {
    const CircleId at = s.value % 4 == 1 ? circle_at(point.position, s) : CircleId();
    apply_change(dual_->insert(s, point, home_of(s, point), at));
  }
  return true;
}

/// The same by a move at once, if the site stays or comes to a circle's center.
void SurfaceStage::put_back_and_move(SiteId s, const geom::WeightedPoint3& point) {
  apply_change(dual_->insert(s, removed_point_, home_of(s, removed_point_)));
  if (auto plan = dual_->plan_removal(s)) {
    if (point.position == removed_point_.position && point.weight == removed_point_.weight)
      return apply_change(plan->cancel());
    geom::PlannedRemoval::Target target;
    const auto circles = plan->circles();
    const auto at = std::ranges::find(circles, point.position, &EmptyCircle::center);
    if (at != circles.end())
      target.planned = static_cast<std::size_t>(at - circles.begin());
    else
      target.circle = circle_at(point.position, s);
    if (target.circle.valid() || at != circles.end()) {
      const FacetId facet = target.circle.valid() ? dual_->circle(target.circle).facet : at->facet;
      return apply_change(plan->move(point, s.value % 8 == 0 ? FacetId() : facet, target));
    }
    apply_change(plan->cancel());
  }
  apply_change(dual_->remove(s));
  apply_change(dual_->insert(s, point, home_of(s, point)));
}

bool SurfaceStage::remove(SiteId s) {
  removed_ = s;
  removed_point_ = dual_->site(s);
  apply_change(dual_->remove(s));
  return true;
}

void SurfaceStage::apply_change(const geom::RestrictedDual::Change& change) {
  for (const CircleId c : change.circles_erased) {
    geom::ensure(heap_.contains(c), "a circle is erased that was not there");
    heap_.erase(c);
  }
  for (const CircleId c : change.circles_created) {
    geom::ensure(!heap_.contains(c), "a circle is created that is there");
    geom::ensure(surface_->mesh.box().contains(dual_->circle(c).center),
                 "a circle's center is outside of the mesh's box");
    heap_.push(c, dual_->circle(c).radius2);
    most_circles_ = std::max(most_circles_, c.index() + 1);
  }
  for (const CircleId c : change.circles_moved) {
    geom::ensure(heap_.contains(c), "a circle moves that is not there");
    heap_.update(c, dual_->circle(c).radius2);
  }
  last_created_ = change.circles_created;
}

bool SurfaceStage::farthest(bool of_last_change, Vec3& out) const {
  CircleId best;
  if (!of_last_change && !heap_.empty()) best = heap_.top().slot;
  if (of_last_change)
    for (const CircleId c : last_created_)
      if (!best.valid() || dual_->circle(c).radius2 > dual_->circle(best).radius2) best = c;
  if (best.valid()) out = dual_->circle(best).center;
  return best.valid();
}

Vec3 SurfaceStage::anywhere(bool special, geom::Rng& rng) const {
  const FacetId t(static_cast<std::size_t>(rng.below(surface_->mesh.num_facets())));
  if (!special) {
    const double u = rng.uniform(), v = rng.uniform();
    return fpo::location_in_facet(surface_->mesh, t, std::min(u, 1 - u),
                                  std::min(v, 1 - v) * std::max(u, 1 - u))
        .position;
  }
  switch (rng.below(4)) {
    case 0:
      return surface_->mesh.corner(t, 0);
    case 1:
      return fpo::location_in_facet(surface_->mesh, t, 0.5, 0).position;
    case 2:  // a lattice on each facet
      return fpo::location_in_facet(surface_->mesh, t, 0.25 * static_cast<double>(rng.below(3)),
                                    0.25 * static_cast<double>(rng.below(3)))
          .position;
    default:
      if (present().empty()) return surface_->mesh.corner(t, 1);
      return point(present()[rng.below(present().size())]).position;
  }
}

void SurfaceStage::check() const {
  dual_->check();
  heap_.check();
}

geom::Clipper::Sites SurfaceStage::sites() const {
  geom::Clipper::Sites sites;
  if (!present().empty()) sites.resize(present().back().index() + 1);
  for (const SiteId s : present()) sites[s] = point(s);
  return sites;
}

/// The circles of one facet are those that clipping it for every site by every other one gives.
void SurfaceStage::check_facet(FacetId t) const {
  const geom::Clipper::Sites sites = this->sites();
  const oracle::BruteDiagram brute(surface_->mesh, sites, present(), std::array{t});
  geom::ensure(without_beyond(oracle::circles_of(*dual_, present()), t) == brute.circles_on(t, types()),
               "brute force finds other circles on a facet");
}

/// The polygons of a cell, and how far it reaches.
void SurfaceStage::check_cell(SiteId p) const {
  const geom::TriMesh& mesh = surface_->mesh;
  const geom::Clipper::Sites sites = this->sites();
  geom::Clipper clipper(mesh, sites, geom::extent_of(mesh));
  double reach = -std::numeric_limits<double>::infinity();
  std::vector<std::pair<FacetId, std::size_t>> expected, found;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const geom::FacetPolygon part = oracle::part_of(clipper, t, p, present());
    if (!part.corners.empty()) expected.emplace_back(t, part.corners.size());
    for (const geom::PolygonCorner& corner : part.corners)
      reach = std::max(reach, geom::power(corner.point.position, point(p)));
  }
  geom::ensure(dual_->has_cell(p) == !expected.empty(),
               "brute force finds a cell, or none, where it is not so");
  geom::ensure(
      expected.empty() || dual_->reach_bound(p) >= reach - 1e-8 * (std::abs(reach) + point(p).weight),
      "a cell reaches farther than its bound says");
  for (const geom::FacetPolygon& part : dual_->cell(p)) found.emplace_back(part.facet, part.corners.size());
  geom::ensure(found == expected, "brute force finds another cell");
}

void SurfaceStage::check_by_brute_force(geom::Rng& rng) const {
  check_facet(FacetId(static_cast<std::size_t>(rng.below(surface_->mesh.num_facets()))));
  if (present().empty()) return;
  check_cell(present()[rng.below(present().size())]);
  // The nearest site to a location, and the largest circle is empty.
  const Vec3 x = anywhere(rng.below(2) == 0, rng);
  const SiteId without = present()[rng.below(present().size())];
  const auto nearest = dual_->nearest(x, without);
  SiteId best;
  for (const SiteId s : present())
    if (s != without && (!best.valid() || geom::power(x, point(s)) < geom::power(x, point(best)))) best = s;
  geom::ensure(nearest.site == best, "brute force finds another nearest site");
  if (heap_.empty()) return;
  const EmptyCircle& c = dual_->circle(heap_.top().slot);
  const double diagonal = surface_->mesh.diagonal(),
               slack = 1e-12 * (diagonal * diagonal + std::abs(c.radius2));
  for (const SiteId s : present()) {
    const double allowed = slack + 1e-12 * std::abs(point(s).weight);
    geom::ensure(geom::power(c.center, point(s)) >= c.radius2 - allowed, "the largest circle is not empty");
  }
}

std::unique_ptr<Stage> SurfaceStage::rebuilt() const {
  std::unique_ptr<SurfaceStage> other(new SurfaceStage(place_, !search_, surface_));
  copy_sites_to(*other);
  return other;
}

/// With one built at once, where the sites have ids without gaps.
void SurfaceStage::compare_with_built() const {
  if (present().empty()) return;
  geom::RestrictedDual other(surface_->mesh, types());
  std::vector<geom::WeightedPoint3> points;
  std::vector<FacetId> homes;
  std::vector<SiteId> order;
  for (const SiteId s : present()) {
    order.emplace_back(points.size());
    points.push_back(point(s));
    homes.push_back(home_of(s, point(s)));
  }
  other.build(points, homes, order, 2);
  std::vector<oracle::KnownCircle> circles = oracle::circles_of(other, order);
  for (oracle::KnownCircle& c : circles)
    for (oracle::CircleName* name : {&c.name, &c.beyond[0], &c.beyond[1], &c.beyond[2]})
      for (SiteId& s : name->sites)
        if (s.valid()) s = present()[s.index()];
  geom::ensure(oracle::circles_of(*dual_, present()) == circles, "the dual built at once differs");
}

void SurfaceStage::compare(const Stage& other) const {
  const auto& that = dynamic_cast<const SurfaceStage&>(other);
  geom::ensure(oracle::circles_of(*dual_, present()) == oracle::circles_of(*that.dual_, present()),
               "the dual that insertions lead to differs");
  compare_with_built();
}

}  // namespace endurance
