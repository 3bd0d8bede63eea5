#include "geom/fragment_store.h"

#include <algorithm>

#include "geom/check.h"

namespace geom {
namespace {

constexpr std::size_t block = 4;  // capacities are multiples of it: polygons have 3 to 8 corners, rarely more
constexpr std::size_t max_corners = 65532;

}  // namespace

FragmentStore::FragmentStore(const TriMesh& mesh) : mesh_(mesh), facets_(mesh.num_facets()) {}

FragmentId FragmentStore::create(SiteId site, FacetId facet) {
  FragmentId f;
  if (free_.empty()) {
    f = fragments_.next_id();
    fragments_.emplace_back();
  } else {
    f = free_.back();
    free_.pop_back();
  }
  if (site.index() >= cells_.size()) cells_.resize(site.index() + 1);
  Fragment& fragment = fragments_[f];
  fragment = {};
  fragment.site = site;
  fragment.facet = facet;
  fragment.next_in_cell = cells_[site];
  fragment.next_in_facet = facets_[facet];
  if (fragment.next_in_cell.valid()) fragments_[fragment.next_in_cell].previous_in_cell = f;
  if (fragment.next_in_facet.valid()) fragments_[fragment.next_in_facet].previous_in_facet = f;
  cells_[site] = facets_[facet] = f;
  ++live_;
  return f;
}

void FragmentStore::erase(FragmentId f) {
  Fragment& fragment = fragments_[f];
  release_block(fragment);
  if (fragment.previous_in_cell.valid())
    fragments_[fragment.previous_in_cell].next_in_cell = fragment.next_in_cell;
  else
    cells_[fragment.site] = fragment.next_in_cell;
  if (fragment.next_in_cell.valid())
    fragments_[fragment.next_in_cell].previous_in_cell = fragment.previous_in_cell;
  if (fragment.previous_in_facet.valid())
    fragments_[fragment.previous_in_facet].next_in_facet = fragment.next_in_facet;
  else
    facets_[fragment.facet] = fragment.next_in_facet;
  if (fragment.next_in_facet.valid())
    fragments_[fragment.next_in_facet].previous_in_facet = fragment.previous_in_facet;
  fragment.site = SiteId();
  free_.push_back(f);
  --live_;
}

FragmentId FragmentStore::find(SiteId s, FacetId t) const {
  FragmentId in_cell = first_of_cell(s), in_facet = first_of_facet(t);
  while (in_cell.valid() && in_facet.valid()) {
    if (facet(in_cell) == t) return in_cell;
    if (site(in_facet) == s) return in_facet;
    in_cell = next_in_cell(in_cell);
    in_facet = next_in_facet(in_facet);
  }
  return {};
}

std::span<const PolygonCorner> FragmentStore::corners(FragmentId f) const {
  const Fragment& fragment = fragments_[f];
  if (fragment.polygon < 0) return {};
  return {corners_.data() + fragment.polygon, fragment.size};
}

std::span<const PolygonCorner> FragmentStore::corners(FragmentId f,
                                                      std::array<PolygonCorner, 3>& buffer) const {
  if (!whole(f)) return corners(f);
  for (int i = 0; i < 3; ++i)
    buffer[static_cast<std::size_t>(i)] = {
        {mesh_.corner(facet(f), i), 0}, EdgeLabel::facet_edge(i), CircleId()};
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
    const std::size_t blocks = (corners.size() + block - 1) / block;
    if (blocks >= free_blocks_.size()) free_blocks_.resize(blocks + 1);
    if (free_blocks_[blocks].empty()) {
      ensure(corners_.size() + blocks * block <= std::size_t{0x7fffffff},
             "fragment store: too many corners in all");
      fragment.polygon = static_cast<std::int32_t>(corners_.size());
      corners_.resize(corners_.size() + blocks * block);
    } else {
      fragment.polygon = free_blocks_[blocks].back();
      free_blocks_[blocks].pop_back();
    }
    fragment.capacity = static_cast<std::uint16_t>(blocks * block);
  }
  fragment.size = static_cast<std::uint16_t>(corners.size());
  std::ranges::copy(corners, corners_.begin() + fragment.polygon);
}

void FragmentStore::release_block(Fragment& f) {
  if (f.polygon < 0) return;
  free_blocks_[f.capacity / block].push_back(f.polygon);
  f.polygon = -1;
  f.size = f.capacity = 0;
}

void FragmentStore::check() const {
  std::size_t in_cells = 0, in_facets = 0;
  for (SiteId s(0); s.index() < cells_.size(); s = SiteId(s.value + 1)) {
    FragmentId previous;
    for (FragmentId f = cells_[s]; f.valid(); previous = f, f = next_in_cell(f), ++in_cells)
      ensure(site(f) == s && fragments_[f].previous_in_cell == previous,
             "fragment store: the list of a cell is broken");
  }
  for (FacetId t(0); t.index() < facets_.size(); t = FacetId(t.value + 1)) {
    FragmentId previous;
    for (FragmentId f = facets_[t]; f.valid(); previous = f, f = next_in_facet(f), ++in_facets)
      ensure(facet(f) == t && fragments_[f].previous_in_facet == previous,
             "fragment store: the list of a facet is broken");
  }
  ensure(in_cells == live_ && in_facets == live_, "fragment store: a fragment is missing from a list");
}

}  // namespace geom
