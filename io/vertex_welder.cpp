#include "io/vertex_welder.h"

#include <bit>
#include <cstdint>

namespace io {

using geom::Vec3;
using geom::VertexId;

namespace {

std::uint64_t hash(const Vec3& p) {
  std::uint64_t h = 0;
  for (const double x : p) {
    h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u;  // 2^64 / golden ratio
    h ^= h >> 32;
  }
  return h;
}

}  // namespace

std::size_t VertexWelder::slot_of(const Vec3& position) const {
  std::size_t slot = hash(position) & (slots_.size() - 1);
  while (slots_[slot].valid() && mesh_->vertices()[slots_[slot]] != position)
    slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

VertexId VertexWelder::id_of(const Vec3& position, std::size_t place) {
  const Vec3 canonical = position.unaryExpr([](double x) { return x + 0.0; });  // -0 + 0 = +0
  const std::size_t slot = slot_of(canonical);
  if (slots_[slot].valid()) return slots_[slot];
  const VertexId id = slots_[slot] = mesh_->add_vertex(canonical, place);
  if (2 * mesh_->num_vertices() >= slots_.size()) grow();
  return id;
}

void VertexWelder::grow() {
  slots_.assign(4 * slots_.size(), VertexId());
  for (std::size_t i = 0; i < mesh_->num_vertices(); ++i) {
    const VertexId v(i);
    slots_[slot_of(mesh_->vertices()[v])] = v;
  }
}

}  // namespace io
