#pragma once
// A chart (chart.h) of sites that are where they are said to be only within some distance.
//
// Let site i be at most off_i from its place. A difference e of two sites is at most a = off_i + off_k off,
// each of its components too, so (1) holds if it does with a less to one side and a more to the other. For
// e and e' of three sites, off by a and b, n = e x e' is off by
//
//     E = a |e'| + b |e| + a b
//
// at most, and |n_z| - su |n_u| - sv |n_v| by the root of 1 + su^2 + sv^2 times that, its Lipschitz constant.
//
// The axis of three sites is far if some combination of the two bisectors, L = |z - p_i|^2 - |z - p_k|^2 and
// L' of j (weights being equal), does not vanish in the ball about the origin: then they do not vanish
// together. With f = |d_i|^2 - |d_k|^2, f' of j, and |e'| L + sigma |e| L', sigma against the sign of e.e',
// so that gradients cancel where the three are in line:
//
//     | |e'| f + sigma |e| f' | > 2 radius | |e'| e + sigma |e| e' | + |e'| h_ik + |e| h_jk,
//
// where h_ik bounds by how much L is off, as |z - p|^2 changes by at most 2 off |z - p| + off^2: the sum of
// 2 off (radius + |d|) + off^2 for i and k.
//
// Rounding: an off is .005 spacings or more (leeway_proof.cpp), and a hundredth is added to each, .00005.
// Places here are within 3 spacings of the origin: in single precision they are off by 3e-7, in double, as
// differences of coordinates of at most 1e5 spacings (site_search.cpp), by 3e-11.

#include <array>

#include "geom/dual/sheet_axes.h"

namespace geom {

class SlackChart {
 public:
  static constexpr int most = 16;

  /// `radius`: all that is spoken of is that near to the origin.
  void begin(const Sheet& sheet, double radius);
  /// A site at most `off` from that place.
  void add(const Vec3& d, double off);
  int size() const { return size_; }

  /// Is it simple whatever the sites' places are: (1) for all pairs, and (2) for all triples?
  bool is_simple();
  /// The same, given that, of one more site and these.
  bool is_simple_with(const Vec3& d, double off);
  /// A bound of how steep the bisectors of all are (Chart::steepest).
  double steepest() const;

 private:
  struct Difference {
    double x, y, z, length, off;
  };
  Difference difference(int i, int k) const;
  /// Sets differences from k to those before it. False: (1) does not hold for one.
  bool is_monotone(int k);
  bool meets_axis_once(int i, int j, int k) const;

  SheetAxes axes_;
  double steep_ = 1;  ///< the Lipschitz constant
  double radius_ = 0;
  int size_ = 0;
  double tau2_ = 0;  ///< the largest |a| / |e_h|, squared
  std::array<double, most> x_, y_, z_, off_, far2_, lead_off_;
  std::array<Difference, most> to_;
};

}  // namespace geom
