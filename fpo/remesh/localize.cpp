#include "fpo/remesh/localize.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "fpo/interruption.h"
#include "geom/mesh/edges.h"
#include "geom/sites/site_tree.h"

namespace fpo {

using geom::FacetId;
using geom::FragmentId;
using geom::SiteId;

namespace {

constexpr std::size_t orphans_a_sample = 2;  // given away at most; a plate of two sheets has one
constexpr int max_rounds = 16;               // an orphan given away can be an orphan of its new owner

using Component = std::vector<FragmentId>;

/// For each facet the sites that have given up a part of it.
using Excluded = std::map<FacetId, std::set<SiteId>>;

/// True if it found an heir.
bool give_away(geom::RestrictedPower& diagram, SiteId p, const Component& orphan, const geom::SiteTree& sites,
               Excluded& excluded) {
  std::set<SiteId> out{p};
  for (const FragmentId f : orphan) out.merge(std::set<SiteId>(excluded[diagram.fragments().facet(f)]));
  for (const FragmentId f : orphan) excluded[diagram.fragments().facet(f)] = out;
  const std::vector<SiteId> others(out.begin(), out.end());
  return diagram.abandon(p, orphan, others, sites);
}

}  // namespace

namespace {

/// The facets, one on each side of an edge or, where there are more, all of them, on which a cell goes on.
/// What it has of an edge is one segment.
class Continuations {
 public:
  Continuations(const geom::RestrictedPower& diagram, SiteId p) : mesh_(diagram.mesh()) {
    std::array<geom::PolygonCorner, 3> buffer;
    for (const FragmentId f : diagram.fragments().of_cell(p)) {
      const FacetId t = diagram.fragments().facet(f);
      for (const geom::PolygonCorner& corner : diagram.fragments().corners(f, buffer))
        if (!corner.edge.is_site() && !mesh_.across(t, corner.edge.edge()).valid())
          at_edge_[edge_of(t, corner.edge.edge())].push_back(t);
    }
  }

  template <class Visit>
  void for_each(FacetId t, int edge, const Visit& visit) const {
    const FacetId across = mesh_.across(t, edge);
    if (across.valid()) return visit(across);
    if (const auto found = at_edge_.find(edge_of(t, edge)); found != at_edge_.end())
      for (const FacetId other : found->second) visit(other);
  }

 private:
  geom::MeshEdge edge_of(FacetId t, int edge) const {
    const geom::TriMesh::Facet& f = mesh_.facet(t);
    const auto e = static_cast<std::size_t>(edge);
    return geom::mesh_edge(f[e], f[(e + 1) % 3]);
  }

  const geom::TriMesh& mesh_;
  std::map<geom::MeshEdge, std::vector<FacetId>> at_edge_;  ///< that have no one facet across them
};

}  // namespace

std::vector<Component> cell_components(const geom::RestrictedPower& diagram, SiteId p, FacetId home) {
  const geom::FragmentStore& fragments = diagram.fragments();
  const Continuations continuations(diagram, p);
  std::map<FacetId, FragmentId> unseen;
  for (const FragmentId f : fragments.of_cell(p)) unseen.emplace(fragments.facet(f), f);
  std::vector<Component> components;
  std::array<geom::PolygonCorner, 3> buffer;
  while (!unseen.empty()) {
    Component component{unseen.begin()->second};
    unseen.erase(unseen.begin());
    for (std::size_t i = 0; i < component.size(); ++i)
      for (const geom::PolygonCorner& corner : fragments.corners(component[i], buffer)) {
        if (corner.edge.is_site()) continue;
        continuations.for_each(fragments.facet(component[i]), corner.edge.edge(), [&](FacetId t) {
          const auto next = unseen.find(t);
          if (next == unseen.end()) return;
          component.push_back(next->second);
          unseen.erase(next);
        });
      }
    components.push_back(std::move(component));
  }
  const auto rank = [&](const Component& c) {
    const bool is_home = std::ranges::any_of(c, [&](FragmentId f) { return fragments.facet(f) == home; });
    return std::pair(is_home, c.size());
  };
  const auto own = std::ranges::max_element(components, {}, rank);
  if (own != components.end()) std::swap(components.front(), *own);
  return components;
}

namespace {

/// The cell with the longest border to the component, fragments of other waiting components left out; none if
/// there is no border.
SiteId longest_neighbour(const geom::RestrictedPower& diagram, const Component& component,
                         const std::set<FragmentId>& waiting, const FragmentOwners& owners) {
  const geom::FragmentStore& fragments = diagram.fragments();
  std::map<SiteId, double> border;
  std::array<geom::PolygonCorner, 3> buffer;
  for (const FragmentId f : component) {
    const SiteId p = fragments.site(f);
    const auto corners = fragments.corners(f, buffer);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (!corners[k].edge.is_site()) continue;
      const FragmentId beyond = fragments.find(corners[k].edge.site(), fragments.facet(f));
      if (waiting.contains(beyond)) continue;
      const auto owner = owners.find(beyond);
      const SiteId k_owner = owner == owners.end() ? corners[k].edge.site() : owner->second;
      if (k_owner == p) continue;
      border[k_owner] +=
          (corners[(k + 1) % corners.size()].point.position - corners[k].point.position).norm();
    }
  }
  if (border.empty()) return SiteId();
  return std::ranges::max_element(border, {}, [](const auto& b) { return b.second; })->first;
}

/// Adds each orphan that is left to a cell beside it, from outside inwards.
void merge_orphans(const geom::RestrictedPower& diagram, std::span<const SurfaceSample> samples,
                   Localization& result) {
  std::vector<Component> orphans;
  std::set<FragmentId> waiting;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::vector<Component> components = cell_components(diagram, SiteId(i), samples[i].facet);
    for (std::size_t k = 1; k < components.size(); ++k) {
      waiting.insert(components[k].begin(), components[k].end());
      orphans.push_back(std::move(components[k]));
    }
  }
  for (bool progress = true; progress && !orphans.empty();) {
    const std::size_t before = orphans.size();
    std::erase_if(orphans, [&](const Component& orphan) {
      const SiteId k = longest_neighbour(diagram, orphan, waiting, result.owners);
      if (!k.valid()) return false;
      for (const FragmentId f : orphan) {
        result.owners[f] = k;
        waiting.erase(f);
      }
      return true;
    });
    progress = orphans.size() < before;
    result.merged += before - orphans.size();
  }
  result.remaining = orphans.size();
}

}  // namespace

Localization localize(geom::RestrictedPower& diagram, std::span<const SurfaceSample> samples,
                      const std::atomic<bool>* interrupted) {
  Localization result;
  const std::size_t most = orphans_a_sample * samples.size();
  geom::SiteTree sites;
  Excluded excluded;
  std::size_t given = 0, given_before = std::numeric_limits<std::size_t>::max();
  const auto goes_on = [&] { return result.orphans + given < most && !fpo::interrupted(interrupted); };
  for (int round = 0; round < max_rounds && goes_on(); ++round, given_before = given) {
    result.remaining = given = 0;
    for (std::size_t i = 0; i < samples.size() && goes_on(); ++i) {
      const SiteId p(i);
      const std::vector<Component> components = cell_components(diagram, p, samples[i].facet);
      // Fragments of p keep their ids while others change.
      for (std::size_t k = 1; k < components.size(); ++k) {
        if (excluded.empty())  // the first orphan: most surfaces have none, and need no tree
          for (std::size_t j = 0; j < samples.size(); ++j) sites.insert(SiteId(j), diagram.site(SiteId(j)));
        if (give_away(diagram, p, components[k], sites, excluded))
          ++given;
        else
          ++result.remaining;
      }
    }
    result.orphans += given;
    if (given == 0 || given >= given_before) break;  // they are handed on, and do not become fewer
  }
  if (result.remaining > 0 || given > 0 || !goes_on()) merge_orphans(diagram, samples, result);
  return result;
}

}  // namespace fpo
