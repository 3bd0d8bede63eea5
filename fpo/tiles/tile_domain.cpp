#include "fpo/tiles/tile_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"

namespace fpo {
namespace {

using geom::Box3;
using geom::FacetId;
using geom::Vec3;

constexpr double first_reach = 2;        // M is the square of so many spacings at first
constexpr double reach_step = 1.5;       // and the reach grows by this factor
constexpr double room_for_removals = 2;  // how much more power than at first may be where a cell is vacated

double square(double x) { return x * x; }

/// Of some facets, in space and in the frame of the tiles.
FacetBoxes boxes_of(const geom::TriMesh& mesh, std::span<const FacetId> facets, const Frame& frame) {
  FacetBoxes boxes;
  boxes.frame = frame;
  for (const FacetId t : facets)
    for (int i = 0; i < 3; ++i) {
      boxes.in_space.extend(mesh.corner(t, i));
      boxes.in_frame.extend(in_frame(frame, mesh.corner(t, i)));
    }
  return boxes;
}

}  // namespace

TiledSurface::TiledSurface(const geom::TriMesh& mesh, const Sizing& sizing,
                           std::span<const SurfaceSample> samples, const SurfaceOptions& options,
                           std::vector<Tile> tiles)
    : mesh_(mesh), sizing_(sizing), samples_(samples), options_(options), tiles_(std::move(tiles)) {
  const bool weighted = !sizing.is_uniform() && options.weighted;
  if (weighted) weights_.resize(samples.size());
  for (const Tile& tile : tiles_) {
    double weight = 0, spacing = 0;
    for (const SiteId x : tile.samples) {
      const double h = sizing.at(sample(x));
      spacing = std::max(spacing, h);
      if (weighted)
        weight = std::max(weight, weights_[x.index()] = square(options.weight_factor * h) * (1 + 1e-9));
    }
    tile_weights_.push_back(weight);
    spacings_.push_back(spacing);
  }
}

std::vector<SiteId> TiledSurface::samples_near(const FacetBoxes& boxes, double M) const {
  constexpr double less = 1 - 1e-9;  // for the rounding of distances
  const Box3& box = boxes.in_space;
  const Vec3 off = Vec3::Constant(1e-12 * std::max(mesh_.box().min().lpNorm<Eigen::Infinity>(),
                                                   mesh_.box().max().lpNorm<Eigen::Infinity>()));
  const Box3 turned(boxes.in_frame.min() - off, boxes.in_frame.max() + off);
  const auto is_near = [&](SiteId x) {
    const Vec3& at = sample(x).position;
    const double most = M + weight(x);
    return box.squaredExteriorDistance(at) * less <= most &&
           turned.squaredExteriorDistance(in_frame(boxes.frame, at)) * less <= most;
  };
  std::vector<SiteId> result;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    if (tiles_[t].samples.empty() ||
        box.squaredExteriorDistance(tiles_[t].sample_box) * less - tile_weights_[t] > M)
      continue;
    for (const SiteId x : tiles_[t].samples)
      if (is_near(x)) result.push_back(x);
  }
  std::ranges::sort(result);
  return result;
}

TileDomain::TileDomain(const TiledSurface& whole, std::size_t tile)
    : whole_(whole),
      number_(tile),
      tile_(whole.tiles()[tile]),
      part_(geom::submesh(whole.mesh(), tile_.facets)),
      guard_(tile_, 1e-12 * std::max(whole.mesh().box().min().lpNorm<Eigen::Infinity>(),
                                     whole.mesh().box().max().lpNorm<Eigen::Infinity>())) {
  const FacetBoxes boxes = boxes_of(whole.mesh(), part_.facets, tile_.frame);
  std::size_t all = 0;
  for (const Tile& t : whole.tiles()) all += t.samples.size();
  for (double reach = first_reach * whole.largest_spacing(tile);; reach *= reach_step) {
    sites_ = whole.samples_near(boxes, square(reach));
    guard_.set_most_power(sites_.size() == all ? std::numeric_limits<double>::infinity() : square(reach));
    build();
    if (room_for_removals * largest_reach() <= guard_.most_power()) break;
  }
}

/// The sizing for the samples, whose facets become those of sizing_mesh_: first the facets of the part, then
/// those of samples outside.
Sizing TileDomain::local_sizing(std::vector<SurfaceSample>& samples) {
  for (SurfaceSample& x : samples) x.facet = part_.here(x.facet);
  if (whole_.sizing().is_uniform()) return whole_.sizing();
  std::vector<FacetId> facets = part_.facets;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].facet.valid()) continue;
    samples[i].facet = FacetId(facets.size());
    facets.push_back(whole_.sample(sites_[i]).facet);
  }
  geom::Table<geom::VertexId, Vec3> corners;
  geom::Table<FacetId, geom::TriMesh::Facet> renamed;
  VertexField h;
  for (const FacetId t : facets) {
    geom::TriMesh::Facet& facet = renamed.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const geom::VertexId v = whole_.mesh().facet(t)[i];
      facet[i] = corners.next_id();
      corners.push_back(whole_.mesh().position(v));
      h.push_back(whole_.sizing().at(v));
    }
  }
  geom::TriMesh::Across across(renamed.size());
  sizing_mesh_ =
      geom::TriMesh(std::move(corners), std::move(renamed), std::move(across), whole_.mesh().box());
  return {sizing_mesh_, std::move(h)};
}

void TileDomain::build() {
  std::vector<SurfaceSample> samples;
  for (const SiteId x : sites_) samples.push_back(whole_.sample(x));
  const Sizing sizing = local_sizing(samples);
  SurfaceOptions options = whole_.options();
  options.threads = 1;  // as other tiles have theirs
  options.num_fixed = static_cast<std::size_t>(
      std::ranges::lower_bound(sites_, SiteId(whole_.options().num_fixed)) - sites_.begin());
  const std::vector<geom::KnownCell> cells = known_cells(WeightedSamples(sizing, samples, options));
  const std::vector<geom::EmptyCircle> circles = known_circles(cells);
  std::vector<double> reaches;
  for (std::size_t i = 0; !circles.empty() && i < sites_.size(); ++i)
    reaches.push_back(whole_.known()->reaches()[sites_[i].index()]);
  options.known = {cells, circles, reaches, whole_.known() ? whole_.known()->power() : 0};
  domain_.emplace(part_.mesh, sizing, samples, options, &guard_);
}

std::vector<geom::KnownCell> TileDomain::known_cells(const WeightedSamples& samples) const {
  std::vector<geom::KnownCell> known(sites_.size());
  for (std::size_t i = 0; whole_.known() && i < sites_.size(); ++i)
    known[i] =
        whole_.known()->of(sites_[i], {samples[SiteId(i)].position, samples.weight(SiteId(i))}, guard_);
  return known;
}

/// Each by the first of its sites whose cell is known.
std::vector<geom::EmptyCircle> TileDomain::known_circles(std::span<const geom::KnownCell> cells) const {
  std::vector<geom::EmptyCircle> circles;
  if (!whole_.known() || !(whole_.known()->power() <= guard_.most_power())) return circles;
  const auto is_known = [&](SiteId x) { return cells[x.index()].shape == geom::CellShape::regular; };
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (!is_known(SiteId(i))) continue;
    for (const std::uint32_t place : whole_.known()->circles_of(sites_[i])) {
      geom::EmptyCircle circle = whole_.known()->circles()[place];
      for (SiteId& s : circle.sites) {
        const SiteId own = here(s);
        geom::ensure(own.index() < sites_.size() && whole_id(own) == s,
                     "tile: a known circle of none of its sites");
        s = own;
      }
      if (*std::ranges::find_if(circle.sites, is_known) != SiteId(i)) continue;
      circle.facet = part_.here(circle.facet);
      geom::ensure(circle.facet.valid(), "tile: a known circle on none of its facets");
      circles.push_back(circle);
    }
  }
  return circles;
}

/// As known_circles(), of the tile's own samples whose cells are in the tile.
void TileDomain::tell(KnownCells& known) const {
  const geom::RestrictedDual& dual = domain_->dual();
  const double power = largest_reach();
  std::vector<char> is_told(sites_.size(), 0);
  for (const SiteId x : tile_.samples) {
    const SiteId own = here(x);
    known.set(x, dual, own, guard_);
    const geom::WeightedPoint3& site = dual.site(own);
    const double radius = std::sqrt(std::max(power + site.weight, 0.0));
    is_told[own.index()] =
        dual.known_cell(own).shape == geom::CellShape::regular && radius < guard_.room_around(site.position);
  }
  std::vector<geom::EmptyCircle> circles;
  for (SiteId x(0); x.index() < sites_.size(); x = SiteId(x.value + 1)) {
    if (is_told[x.index()] == 0) continue;
    for (const CircleId c : dual.circles_of(x)) {
      geom::EmptyCircle circle = dual.circle(c);
      if (*std::ranges::find_if(circle.sites, [&](SiteId s) { return is_told[s.index()] != 0; }) != x)
        continue;
      for (SiteId& s : circle.sites) s = whole_id(s);
      circle.facet = whole_id(circle.facet);
      circles.push_back(circle);
    }
  }
  known.set_circles(number_, std::move(circles));
}

double TileDomain::largest_reach() const {
  double reach = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sites_.size(); ++i)
    reach = std::max(reach, domain_->dual().reach_bound(SiteId(i)));
  return reach;
}

SiteId TileDomain::here(SiteId of_whole) const {
  return SiteId(static_cast<std::size_t>(std::ranges::lower_bound(sites_, of_whole) - sites_.begin()));
}

SurfaceSample TileDomain::sample(SiteId x) const {
  const SurfaceSample& found = domain_->sample(here(x));
  return {found.position, whole_id(found.facet)};
}

std::vector<SiteId> TileDomain::restless(std::span<const SiteId> of_whole, double rest_spacing) {
  std::vector<SiteId> samples(of_whole.begin(), of_whole.end());
  for (SiteId& x : samples) x = here(x);
  samples = fpo::restless(*domain_, samples, rest_spacing);
  for (SiteId& x : samples) x = whole_id(x);
  return samples;
}

MoveOutcome TileDomain::move(SiteId of_whole, Scope scope) {
  const SiteId x = here(of_whole);
  if (domain_->num_samples() == 1 || !guard_.is_clear_of_cuts(*domain_, x)) return MoveOutcome::forbidden;
  return domain_->try_move(x, scope);
}

}  // namespace fpo
