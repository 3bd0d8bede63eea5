#include "fpo/remesh/dual.h"

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <tuple>

#include "fpo/farthest_move.h"
#include "geom/check.h"

namespace fpo {

using geom::FragmentId;
using geom::SiteId;
using geom::TriMesh;

std::vector<SurfaceSample> samples_of(const SurfaceDomain& domain) {
  std::vector<SurfaceSample> samples;
  samples.reserve(domain.num_samples());
  for (std::size_t i = 0; i < domain.num_samples(); ++i) samples.push_back(domain.sample(SiteId(i)));
  return samples;
}

bool has_triangle(const SurfaceDomain& domain, SiteId x) {
  return std::ranges::any_of(domain.dual().circles_of(x),
                             [&](geom::CircleId c) { return domain.dual().circle(c).sites[2].valid(); });
}

std::size_t Dual::num_faults() const {
  return type.ok() ? 0 : std::max(defects.size() + cell_faults.size() + type.parts.size(), std::size_t{1});
}

bool is_right(const Dual& dual) { return dual.type.ok() && dual.defects.empty(); }

std::vector<SiteId> samples_at_fault(const Dual& dual) {
  std::vector<SiteId> at;
  for (const Defect& defect : dual.defects) at.insert(at.end(), {defect.at, defect.towards});
  for (const CellFault& fault : dual.cell_faults) at.insert(at.end(), {fault.cell, fault.other});
  std::erase_if(at, [](SiteId x) { return !x.valid(); });
  return at;
}

std::set<SiteId> neighbourhood(SurfaceDomain& domain, const std::vector<SiteId>& of, int rings) {
  std::set<SiteId> all(of.begin(), of.end());
  std::vector<SiteId> link;
  for (int ring = 0; ring < rings; ++ring)
    for (const SiteId x : std::vector<SiteId>(all.begin(), all.end())) {
      domain.neighbours(x, link);
      all.insert(link.begin(), link.end());
    }
  return all;
}

namespace {

void look_at(Dual& dual, const SurfaceDomain& domain, const WantedType& type) {
  dual.defects = find_defects(dual.mesh, type.branch_edges);
  dual.type = check_type(type, dual.mesh, domain.samples().facets());
}

/// The remesh by the domain's circles, if it is right. Then each cell has all its corners in one cycle or
/// path: none has orphans but such as border one other cell alone, which have no triangle, whoever has them.
std::optional<Dual> right_dual(const SurfaceDomain& domain, const WantedType& type) {
  Dual dual;
  dual.mesh = extract(domain);
  look_at(dual, domain, type);
  if (!is_right(dual)) return {};
  dual.samples = samples_of(domain);  // only now: while the type is found out memory is at its most
  return dual;
}

}  // namespace

Dual dual_of(const SurfaceDomain& domain, const WantedType& type, bool keep_cells,
             const std::atomic<bool>* interrupted) {
  if (!keep_cells)
    if (std::optional<Dual> right = right_dual(domain, type)) return std::move(*right);
  Dual dual;
  dual.samples = samples_of(domain);
  const std::unique_ptr<geom::RestrictedPower> diagram = domain.diagram();
  dual.localization = localize(*diagram, dual.samples, interrupted);
  dual.mesh = extract(*diagram, dual.samples.size(), dual.localization.owners);
  look_at(dual, domain, type);
  if (!dual.type.ok() && !type.branches) dual.cell_faults = cell_faults(*diagram, dual.localization.owners);
  if (dual.defects.empty() && !type.branches)
    for (const CellFault& fault : dual.cell_faults) dual.defects.push_back({fault.cell, fault.other});
  if (keep_cells) dual.cells = cell_polygons(*diagram);
  return dual;
}

namespace {

/// The corner of the cell, of any type, that is farthest from its sample; on the border with the cell
/// `towards` if there is such a border.
SurfaceSample farthest_corner(SurfaceDomain& domain, const Defect& defect) {
  const SurfaceSample home = domain.sample(defect.at);
  const geom::EdgeLabel border = geom::EdgeLabel::bisector(defect.towards);
  SurfaceSample farthest = home;
  std::tuple<bool, double> most{false, 0};
  for (const geom::FacetPolygon& fragment : domain.cell(defect.at)) {
    const std::vector<geom::PolygonCorner>& corners = fragment.corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const bool on_border =
          defect.towards.valid() &&
          (corners[k].edge == border || corners[k == 0 ? corners.size() - 1 : k - 1].edge == border);
      const std::tuple rank{on_border, (corners[k].point.position - home.position).squaredNorm()};
      if (rank < most || (rank == most && !(fragment.facet < farthest.facet))) continue;
      most = rank;
      farthest = {corners[k].point.position, fragment.facet};
    }
  }
  return farthest;
}

constexpr double closest = 0.2;  // no sample is brought nearer to another one, in units of h

/// Would a sample there be far enough from whoever owns the place, and own it then?
bool has_room(const SurfaceDomain& domain, const SurfaceSample& place) {
  const double level = domain.dual().level_at(place.facet, place.position);
  const auto owner = domain.dual().nearest({place.position, level}, SiteId());
  const double least = closest * domain.sizing().at(place);
  return (domain.sample(owner.site).position - place.position).squaredNorm() >= least * least &&
         owner.radius2 > -domain.samples().weight_at(place);
}

}  // namespace

std::vector<CellPolygon> cells_of(const geom::TriMesh& surface, const Sizing& sizing,
                                  std::span<const SurfaceSample> samples, const SurfaceOptions& options) {
  return cell_polygons(*SurfaceDomain(surface, sizing, samples, options).diagram());
}

std::size_t refine_at(SurfaceDomain& domain, const std::vector<Defect>& defects) {
  // One place of each cluster of defects.
  std::vector<Defect> places;
  std::vector<SiteId> all;
  std::set<SiteId> taken;
  for (const Defect& defect : defects) {
    if (!domain.dual().has_cell(defect.at)) continue;
    all.push_back(defect.at);
    if (taken.contains(defect.at)) continue;
    places.push_back(defect);
    taken.merge(neighbourhood(domain, {defect.at}, 1));
  }

  std::vector<std::pair<double, SiteId>> donors;
  std::set<SiteId> kept = neighbourhood(domain, all, 2);
  for (SiteId x(0); x.index() < domain.num_samples(); x = SiteId(x.value + 1)) {
    if (domain.is_fixed(x) || kept.contains(x)) continue;
    const bool is_missed = domain.dual().has_cell(x);
    donors.emplace_back(is_missed ? domain.normalized_spacing(x) : 0, x);
  }
  std::ranges::sort(donors);

  std::size_t brought = 0;
  auto next = donors.begin();
  std::vector<SiteId> around;
  for (const Defect& place : places) {
    while (next != donors.end() && kept.contains(next->second)) ++next;
    if (next == donors.end()) break;
    const SiteId donor = next->second;
    const SurfaceSample target = farthest_corner(domain, place);
    if (!has_room(domain, target)) continue;
    domain.neighbours(donor, around);
    kept.merge(neighbourhood(domain, {donor}, 2));  // no second hole near this one
    domain.remove(donor);
    domain.insert_at(donor, target, 1);
    for (const SiteId x : around)
      if (!domain.is_fixed(x)) domain.move(x, Scope::two_ring);
    ++brought;
  }
  for (SiteId x(0); x.index() < domain.num_samples(); x = SiteId(x.value + 1))
    if (!domain.is_fixed(x) && !domain.dual().has_cell(x)) brought += move_to_farthest(domain, x);
  return brought;
}

}  // namespace fpo
