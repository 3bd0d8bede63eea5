#pragma once
// A few sites near a place on a sheet of the surface: where their cells are those of the plane, but for
// bends.
//
// Let the surface near be the graph of a function h over a convex part W of a plane (sheets.h). "Horizontal"
// is along that plane, m its normal; u, v are directions along it such that the gradient of h is within su
// and sv of 0 along them, and at most s in all, s < 1. A bisector is where a plane of space meets the
// surface, and the three bisectors of three sites meet where a line does, their axis.
//
//   (1) For sites i, j let e = p_j - p_i, with horizontal part e_h and height a. From z to z' on the surface
//   the lead of i
//       over j changes by -2 (e_h + a t).(z' - z)_h, with t an average of gradients. If |e_u| > su |a| or
//       |e_v| > sv |a|, it falls all the way in direction u, -u, v or -v: where j has a lead over i it keeps
//       one in that direction, up to the end of W.
//   (2) If z and z' are both on the axis of i, j, k, then z' - z is along n = e x e', so its rise is n_z /
//   |n_h| of its run.
//       If |n_z| > su |n_u| + sv |n_v|, the surface is nowhere so steep that way: the axis meets it at most
//       once, and on the bisector of i and j, k begins or ceases to be nearer once at most. Never, if the
//       axis is far: farther from a place than all that is spoken of.
//
// A chart is simple if (1) holds for all pairs and (2) for all triples. Let edges of a division be drawn
// between circles that are known to be empty, each on the bisector of the two sites that the circles share.
//
//   - All of such an edge belongs to it: a site that were nearer somewhere would be nearer at an end, by (2)
//     for the two sites of the edge and that one.
//   - What is surrounded by edges and arcs on which i is nearest belongs to i: if j were nearer inside, it
//     would be so in one direction up to the border, by (1).
//
// Removal of x: its cell H is a disc (x is regular), its border is known. The circles that fill the hole and
// the edges between them, and to the old circles, make a tree in H with an end at each old circle: x is
// nearer than the two sites of an edge inside of it, as it is at the ends, by (2) for the three. The tree
// divides H into as many parts as there are neighbours, the sites turn counterclockwise around each circle,
// so each part has one owner along its border, hence inside. A site from beyond the rim that is farther at
// all circles has nothing there by (2), with the sites of each edge, and (1), with each of the rim.
//
// Insertion of p: the edges around it are a closed curve of the lengths between its circles, and what it
// surrounds belongs to p. That it has p inside, and that p has nothing beyond: see sheets.h.
//
// How far is what a site has? Distances grow along horizontal lines (t^2 + h^2 has derivative at least 2t (1
// - s^2)), so the farthest location of a cell, or of a part of it, is on its border. An edge runs in the
// plane of the bisector, with slopes of at most some k there, those of its chords as well, so between A and B
// it is in the parallelogram of sides with slopes k and -k that has A and B as opposite corners. Distance is
// convex, so it is largest at a corner. The other two are above and below the points that divide the chord
// from A to B, of length L, as y : 1 - y for some y, by at most 2 k L y (1 - y). If A and B are within R of a
// site, such a point is within the root of R^2 - y (1 - y) L^2, at most R - y (1 - y) L^2 / (2 R), and the
// corner within
//
//     R + y (1 - y) (2 k L - L^2 / (2 R)) <= R + k / 2 min(L, k R)
//
// of it, as y (1 - y) <= 1 / 4 (farthest_on_edge). A bound from the places of A and B is farthest2.
//
// Rounding: coordinates here are off by some 1e-15 of the largest distance of two sites, and the code asks
// for a millionth more than the bounds say, and for 1e-9 of the largest where a difference is small.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "geom/dual/frame.h"
#include "geom/dual/sheet_axes.h"

namespace geom {

/// How far from a site an edge comes whose ends are that near to it and so far apart, with such slopes.
inline double farthest_on_edge(double R, double L, double k) { return R + 0.5 * k * std::min(L, k * R); }

class Chart {
 public:
  static constexpr int most_sites = Frame::most + 2;

  void begin(const Sheet& sheet);
  /// Of a site: its place and c from some origin, the same for all (frame.h).
  void add(const Vec3& d, double c) { set(size_++, d, c); }
  void replace(int i, const Vec3& d, double c) { set(i, d, c); }
  void take_back() { --size_; }
  int size() const { return size_; }
  /// Along the plane.
  double x(int i) const { return x_[static_cast<std::size_t>(i)]; }
  double y(int i) const { return y_[static_cast<std::size_t>(i)]; }

  /// (2) for that site and both sites of each of these edges.
  struct Edge {
    int first, second;
  };
  bool meets_axes_once(int site, std::span<const Edge> edges, double radius) const;
  /// (1) and (2) for all pairs and triples of the first so many sites, and (2) for those edges and the site
  /// after them. `radius`: all that is spoken of is that near to the origin.
  bool is_simple(int count, std::span<const Edge> edges, double radius) const;
  /// The same for those pairs and triples that have that site, of it and those before.
  bool is_simple_with(int last, double radius) const;
  /// (1) for two, and (2) for three of the sites.
  bool is_monotone(int first, int second) const;
  bool meets_axis_once(int first, int second, int third, double radius) const;
  /// Of the sites before the last, in counterclockwise order around that one, the origin, whose cell is in
  /// the ball of that radius: bounds of the power to the nearest of them there, and of the distance of a site
  /// that may be nearer there, if its weight is at most that of the heaviest. Infinite if they do not
  /// surround it.
  struct Gain {
    double power, range;
  };
  Gain most_gain(int count, double radius, double weight, double heaviest) const;
  /// k, for the bisectors of all these pairs. Infinite unless s|a| < |e_h|.
  double steepest(std::span<const Edge> edges) const;
  /// A bound, squared, of how far an edge of two sites is from the origin of two locations on it. Infinite
  /// unless s|a| < |e_h|, which is a little more than (1) asks.
  double farthest2(int first, int second, const Vec3& from, const Vec3& to) const;

 private:
  void set(int i, const Vec3& d, double c);
  bool is_far(int first, int second, int third, double radius) const;
  double largest() const { return std::sqrt(largest2_); }
  /// The largest differences of components among the first so many sites, and what follows from them: beyond
  /// `enough` n_z surely is more than (2) asks, beyond `aside_u`, `aside_v` a difference than (1) does.
  struct Spread {
    double enough, aside_u, aside_v;
  };
  Spread spread(int count) const;
  bool is_pair_fine(int first, int second, const Spread& spread) const {
    const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
    return std::abs(x_[i] - x_[j]) > spread.aside_u || std::abs(y_[i] - y_[j]) > spread.aside_v ||
           is_monotone(first, second);
  }

  SheetAxes axes_;
  double largest2_ = 0;  ///< |d|^2 or |c|
  int size_ = 0;
  std::array<double, most_sites> x_, y_, z_, c_;  ///< z: the height
};

}  // namespace geom
