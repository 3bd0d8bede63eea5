#include "io/binary_off.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/byte_order.h"
#include "io/mesh_builder.h"

namespace io {

namespace {

constexpr std::size_t number_size = 4;

struct OffLayout {
  std::endian order;
  bool colours;  ///< each facet ends with a number of colour components, and these
};

constexpr OffLayout off_layouts[] = {
    {std::endian::big, true}, {std::endian::little, true}, {std::endian::little, false}};

/// Where a layout ceases to explain the file, and why.
struct OffFault {
  std::size_t place;
  std::string what;
};

/// The body of a file, taken to be of one layout.
class OffBody {
 public:
  OffBody(const InputFile& file, std::size_t begin, std::size_t extras, OffLayout layout)
      : file_(&file), begin_(begin), vertex_length_(3 + extras), layout_(layout) {}

  /// None if the layout explains all of the file.
  std::optional<OffFault> fault() const;
  /// Vertices and facets together; 0 if the file ends before their numbers.
  std::size_t promised() const { return holds_counts() ? num_vertices() + num_facets() : 0; }
  /// The mesh of a file without such a fault.
  geom::TriMesh mesh(std::size_t* repeated) const;

 private:
  std::size_t room(std::size_t at) const { return (file_->bytes.size() - at) / number_size; }  ///< in numbers
  template <class T>
  T number(std::size_t at) const {
    return load_number<T>(file_->bytes.data() + at, layout_.order);
  }
  std::size_t count(std::size_t at) const { return number<std::uint32_t>(at); }

  bool holds_counts() const { return room(begin_) >= 3; }
  std::size_t num_vertices() const { return count(begin_); }
  std::size_t num_facets() const { return count(begin_ + number_size); }
  std::size_t vertex(std::size_t i) const { return begin_ + (3 + i * vertex_length_) * number_size; }

  /// Behind the list that begins with its length there.
  std::size_t past_list(std::size_t at) const { return at + (1 + count(at)) * number_size; }
  std::size_t past_facet(std::size_t at) const {
    return layout_.colours ? past_list(past_list(at)) : past_list(at);
  }
  std::optional<OffFault> header_fault() const;
  std::optional<OffFault> facet_fault(std::size_t at, std::size_t index) const;
  std::string bytes_behind(std::size_t at) const {
    return ", only " + std::to_string(file_->bytes.size() - at) + " bytes follow";
  }

  const InputFile* file_;
  std::size_t begin_;
  std::size_t vertex_length_;  ///< in numbers
  OffLayout layout_;
};

std::optional<OffFault> OffBody::header_fault() const {
  if (!holds_counts()) return OffFault{begin_, "truncated: the file ends before the counts"};
  const std::size_t left = room(vertex(0)), facet_length = 2;  // at least
  if (num_vertices() <= left / vertex_length_ &&
      num_facets() <= (left - num_vertices() * vertex_length_) / facet_length)
    return std::nullopt;
  return OffFault{begin_, "truncated: the header promises " + std::to_string(num_vertices()) +
                              " vertices and " + std::to_string(num_facets()) + " facets" +
                              bytes_behind(vertex(0))};
}

/// A facet without corners is a number of colours, where there are none: taken for facets, the first half of
/// a file with colours would be a whole one without.
std::optional<OffFault> OffBody::facet_fault(std::size_t at, std::size_t index) const {
  const auto facet = [&] {
    return "facet " + std::to_string(index + 1) + " of " + std::to_string(num_facets());
  };
  if (room(at) == 0) return OffFault{at, "truncated: the file ends before " + facet()};
  if (count(at) >= room(at))
    return OffFault{at, "truncated: " + facet() + " has " + std::to_string(count(at)) + " corners" +
                            bytes_behind(at + number_size)};
  if (!layout_.colours) {
    if (count(at) > 0) return std::nullopt;
    return OffFault{at, facet() + " has no corners"};
  }
  const std::size_t colours = past_list(at);
  if (room(colours) == 0) return OffFault{at, "truncated: the file ends inside " + facet()};
  if (count(colours) < room(colours)) return std::nullopt;
  return OffFault{at, "truncated: " + facet() + " has " + std::to_string(count(colours)) +
                          " colour components" + bytes_behind(colours + number_size)};
}

std::optional<OffFault> OffBody::fault() const {
  if (auto fault = header_fault()) return fault;
  std::size_t at = vertex(num_vertices());
  for (std::size_t i = 0; i < num_facets(); ++i) {
    if (auto fault = facet_fault(at, i)) return fault;
    at = past_facet(at);
  }
  if (at == file_->bytes.size()) return std::nullopt;
  return OffFault{at, "more data than the header announces"};
}

geom::TriMesh OffBody::mesh(std::size_t* repeated) const {
  MeshBuilder mesh(*file_, Unit::byte);
  const auto coordinate = [this](std::size_t at, std::size_t k) {
    return static_cast<double>(number<float>(at + k * number_size));
  };
  for (std::size_t i = 0; i < num_vertices(); ++i) {
    const std::size_t at = vertex(i);
    mesh.add_vertex({coordinate(at, 0), coordinate(at, 1), coordinate(at, 2)}, at);
  }
  std::vector<std::int64_t> corners;
  std::size_t at = vertex(num_vertices());
  for (std::size_t i = 0; i < num_facets(); ++i) {
    corners.resize(count(at));
    for (std::size_t k = 0; k < corners.size(); ++k)
      corners[k] = number<std::int32_t>(at + (1 + k) * number_size);
    mesh.add_facet(corners, at);
    at = past_facet(at);
  }
  return std::move(mesh).finish(repeated);
}

}  // namespace

/// Where none explains the file, the layout is meant that explains most of it; among those that do not even
/// explain the counts the one that promises least, for in the wrong byte order small numbers are huge.
geom::TriMesh parse_binary_off(const InputFile& file, std::size_t body, std::size_t extras,
                               std::size_t* repeated) {
  std::optional<OffFault> nearest;
  std::size_t promised = 0;
  for (const OffLayout layout : off_layouts) {
    const OffBody candidate(file, body, extras, layout);
    std::optional<OffFault> fault = candidate.fault();
    if (!fault) return candidate.mesh(repeated);
    if (nearest && (fault->place < nearest->place ||
                    (fault->place == nearest->place && candidate.promised() > promised)))
      continue;
    nearest = std::move(fault);
    promised = candidate.promised();
  }
  file.fail({nearest->place, Unit::byte}, nearest->what);
}

}  // namespace io
