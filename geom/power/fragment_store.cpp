#include "geom/power/fragment_store.h"

#include <algorithm>

#include "geom/check.h"

namespace geom {
namespace {

constexpr std::size_t block =
    2;  // capacities from 4 on are multiples of it: polygons have 3 to 8 corners, rarely more
constexpr std::size_t max_corners = 32764;

}  // namespace

FragmentStore::FragmentStore(const TriMesh& mesh) : mesh_(mesh), cells_(0), facets_(mesh.num_facets()) {}

FragmentId FragmentStore::create(SiteId site, FacetId facet) {
  FragmentId f;
  if (free_.empty()) {
    f = fragments_.next_id();
    fragments_.emplace_back();
  } else {
    f = free_.back();
    free_.pop_back();
  }
  Fragment& fragment = fragments_[f];
  fragment = {};
  fragment.site = site;
  fragment.facet = facet;
  fragment.place_in_cell = cells_.push(site, f);
  fragment.place_in_facet = facets_.push(facet, f);
  ++live_;
  return f;
}

void FragmentStore::erase(FragmentId f) {
  Fragment& fragment = fragments_[f];
  release_block(fragment);
  const FragmentId in_cell = cells_.erase(fragment.site, fragment.place_in_cell),
                   in_facet = facets_.erase(fragment.facet, fragment.place_in_facet);
  if (in_cell.valid()) fragments_[in_cell].place_in_cell = fragment.place_in_cell;
  if (in_facet.valid()) fragments_[in_facet].place_in_facet = fragment.place_in_facet;
  fragment.site = SiteId();
  free_.push_back(f);
  --live_;
}

FragmentId FragmentStore::find(SiteId s, FacetId t) const {
  const std::span<const FragmentId> cell = of_cell(s), on_facet = of_facet(t);
  const std::span<const FragmentId> shorter = cell.size() < on_facet.size() ? cell : on_facet;
  const auto found =
      std::ranges::find_if(shorter, [&](FragmentId f) { return facet(f) == t && site(f) == s; });
  return found == shorter.end() ? FragmentId() : *found;
}

std::span<const PolygonCorner> FragmentStore::corners(FragmentId f) const {
  if (whole(f)) return {};
  return {corners_[fragments_[f].polygon], fragments_[f].size};
}

std::span<const PolygonCorner> FragmentStore::corners(FragmentId f,
                                                      std::array<PolygonCorner, 3>& buffer) const {
  if (!whole(f)) return corners(f);
  for (int i = 0; i < 3; ++i)
    buffer[static_cast<std::size_t>(i)] = {{mesh_.corner(facet(f), i), 0}, EdgeLabel::facet_edge(i)};
  return buffer;
}

void FragmentStore::set_corners(FragmentId f, std::span<const PolygonCorner> corners) {
  Fragment& fragment = fragments_[f];
  const bool is_whole = corners.size() == 3 && std::ranges::none_of(corners, [](const PolygonCorner& c) {
                          return c.edge.is_site();
                        });
  if (is_whole) return release_block(fragment);
  ensure(corners.size() <= max_corners, "fragment store: a polygon has too many corners");
  if (corners.size() > fragment.capacity) {
    release_block(fragment);
    const std::size_t capacity = corners.size() == 3 ? 3 : (corners.size() + block - 1) / block * block;
    fragment.polygon = corners_.take(capacity, capacity);
    fragment.capacity = static_cast<std::uint16_t>(capacity) & 0x7fff;
  }
  fragment.size = static_cast<std::uint16_t>(corners.size());
  std::ranges::copy(corners, corners_[fragment.polygon]);
}

void FragmentStore::release_block(Fragment& f) {
  if (f.capacity > 0) corners_.give_back(f.polygon, f.capacity);
  f.size = 0;
  f.capacity = 0;
}

void FragmentStore::check() const {
  std::size_t in_cells = 0, in_facets = 0;
  for (SiteId s(0); s.index() < cells_.num_keys(); s = SiteId(s.value + 1))
    for (std::size_t i = 0; i < of_cell(s).size(); ++i, ++in_cells)
      ensure(site(of_cell(s)[i]) == s && fragments_[of_cell(s)[i]].place_in_cell == i,
             "fragment store: the list of a cell is broken");
  for (FacetId t(0); t.index() < facets_.num_keys(); t = FacetId(t.value + 1))
    for (std::size_t i = 0; i < of_facet(t).size(); ++i, ++in_facets)
      ensure(facet(of_facet(t)[i]) == t && fragments_[of_facet(t)[i]].place_in_facet == i,
             "fragment store: the list of a facet is broken");
  ensure(in_cells == live_ && in_facets == live_, "fragment store: a fragment is missing from a list");
}

}  // namespace geom
