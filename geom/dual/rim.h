#pragma once
// The sites around a place of the diagram, where a site is or is to come: one cycle, counterclockwise.
//
//          outer            The edge of the diagram between two of them, j and j + 1, crosses the border of
//        r2 ____ r1         that place. It ends at a circle inside, which goes with the place, and at one
//         /|inner|\         outside, which stays.
//        / |     | \ .

#include <array>
#include <span>

#include "geom/dual/frame.h"
#include "geom/dual/state.h"

namespace geom {

class Rim {
 public:
  static constexpr int most = Frame::most - 2;  ///< sites

  /// That of the cell of p, if the circles of p are one cycle; else false.
  bool open_star(const DualState& state, SiteId p);
  /// That of the circles which the point beats, from one of them on, if that is certain of all and they hang
  /// together; else false.
  bool find_conflict(const DualState& state, const WeightedPoint3& point, CircleId first);

  int size() const { return size_; }
  int next(int j) const { return j + 1 == size_ ? 0 : j + 1; }
  int previous(int j) const { return j == 0 ? size_ - 1 : j - 1; }
  SiteId operator[](int j) const { return sites_[static_cast<std::size_t>(j)]; }
  std::span<const SiteId> sites() const { return {sites_.data(), static_cast<std::size_t>(size_)}; }
  /// At the ends of the edge between j and j + 1.
  CircleId inner(int j) const { return inner_[static_cast<std::size_t>(j)]; }
  CircleId outer(int j) const { return outer_[static_cast<std::size_t>(j)]; }
  std::span<const CircleId> outer_circles() const { return {outer_.data(), static_cast<std::size_t>(size_)}; }
  /// All circles inside, each once. Of a star: in the order of inner().
  std::span<const CircleId> inside() const { return {inside_.data(), num_inside_}; }

 private:
  /// An edge of the border, as it is found.
  struct Edge {
    SiteId from, to;
    CircleId outer, inner;
  };
  bool put_in_order(std::span<const Edge> edges);
  void clear() { size_ = 0, num_inside_ = 0; }

  int size_ = 0;
  std::size_t num_inside_ = 0;
  std::array<SiteId, most> sites_;
  std::array<CircleId, most> inner_, outer_;
  std::array<CircleId, 2 * most> inside_;
};

}  // namespace geom
