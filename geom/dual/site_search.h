#pragma once
// Who is near: the sites that are in, by place. Where their density is even a grid answers, else a tree.

#include <vector>

#include "geom/dual/empty_circles.h"
#include "geom/power/clip.h"
#include "geom/sites/site_grid.h"
#include "geom/sites/site_tree.h"

namespace geom {

class SiteSearch {
 public:
  /// None is in. Keeps references to the points of the sites and to their circles.
  SiteSearch(const Clipper::Sites& sites, const EmptyCircles& circles)
      : sites_(sites), circles_(circles), tree_(sites) {}
  SiteSearch(const SiteSearch&) = delete;

  /// From now on a site of that weight may come in.
  void allow(double weight) { heaviest_ = std::max(heaviest_, weight); }
  // A site comes in, goes out, or was elsewhere. Its point is where it is, or was when it went.
  void enter(SiteId p);
  void leave(SiteId p);
  void follow(SiteId p, const Vec3& from);
  /// All sites are in, on a surface of that area: looks for a grid. Returns the root of the area of a
  /// cell, or 0 if there is none. `extent` bounds all coordinates.
  double choose(double area, double extent);

  /// Appends all sites that may own a location of the vacancy, and some more (NeighbourOracle::heirs()).
  void near(const Vacancy& vacancy, std::vector<SiteId>& out) const;
  /// Appends all sites that near a location if that is a quick search; else false.
  bool find_near(const Vec3& x, double distance, std::vector<SiteId>& out) const;
  /// NeighbourOracle::nearest().
  NeighbourOracle::Nearest nearest(const Location3& x, SiteId without) const;

  const SiteTree& tree() const { return tree_; }
  SiteTree& tree() { return tree_; }
  /// How many are in.
  std::size_t size() const { return size_; }
  /// An upper bound of all weights.
  double heaviest() const { return heaviest_; }

 private:
  const Clipper::Sites& sites_;
  const EmptyCircles& circles_;
  SiteTree tree_;
  SiteGrid grid_;
  std::size_t size_ = 0;
  double heaviest_ = 0;
  mutable std::vector<SiteId> found_;  // workspace
};

}  // namespace geom
