#pragma once
// Typed indices and the tables they index. An id is an int32; ids never move (free lists, no compaction).

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace geom {

/// An index that cannot be mistaken for an index into another table. Default: none (-1).
template <class Tag>
struct Id {
  std::int32_t value = -1;

  constexpr Id() = default;
  constexpr explicit Id(std::int32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::int32_t>(v)) {}
  constexpr bool valid() const { return value >= 0; }
  constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  constexpr auto operator<=>(const Id&) const = default;
};

using SiteId = Id<struct SiteTag>;        ///< a sample (the paper's x_i, p_i)
using VertexId = Id<struct VertexTag>;    ///< a vertex of the input mesh
using FacetId = Id<struct FacetTag>;      ///< a triangle of the input mesh
using SimplexId = Id<struct SimplexTag>;  ///< a simplex of a regular triangulation
using CircleId = Id<struct CircleTag>;    ///< an empty circle (section 3.2; on surfaces section 4.2)

/// A vector indexed by one kind of id only.
template <class I, class T>
class Table : private std::vector<T> {
  using Base = std::vector<T>;

 public:
  using Base::Base;
  using Base::begin, Base::end, Base::size, Base::empty, Base::resize, Base::assign, Base::reserve,
      Base::clear, Base::push_back, Base::emplace_back, Base::pop_back, Base::back, Base::data;
  typename Base::reference operator[](I i) { return Base::operator[](i.index()); }
  typename Base::const_reference operator[](I i) const { return Base::operator[](i.index()); }
  I next_id() const { return I(Base::size()); }
  bool operator==(const Table&) const = default;
};

}  // namespace geom

template <class Tag>
struct std::hash<geom::Id<Tag>> {
  std::size_t operator()(geom::Id<Tag> id) const noexcept { return std::hash<std::int32_t>{}(id.value); }
};
