#include "tests/fuzz/mutator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "geom/check.h"
#include "geom/shapes/shapes.h"
#include "io/numbers.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/stl.h"
#include "tests/fixtures/spoilt.h"
#include "tests/io/binary_off_samples.h"

namespace fuzz {

using geom::Rng;
using geom::Vec3;

namespace {

/// A mesh that need not be sound.
struct Soup {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 3>> facets;
};

template <class T>
T& any_of(std::vector<T>& items, Rng& rng) {
  return items[rng.below(items.size())];
}

Soup random_shape(Rng& rng) {
  constexpr struct {
    const char* name;
    int max_size;
  } shapes[] = {{"sphere", 4}, {"torus", 8},      {"blob", 4},     {"cube", 4},     {"l-block", 2},
                {"frame", 2},  {"thin-plate", 4}, {"cylinder", 8}, {"cone", 8},     {"two-spheres", 2},
                {"square", 5}, {"triangle", 4},   {"tube", 8},     {"moebius", 12}, {"wave-disk", 5}};
  const auto& [name, max_size] = shapes[rng.below(std::size(shapes))];
  const int least = max_size >= 8 ? 3 : 1;
  geom::TriMesh mesh = geom::make_shape(name, least + static_cast<int>(rng.below(max_size - least + 1)), 1);
  if (rng.below(2) == 0) mesh = geom::tilted(mesh);
  Soup soup;
  soup.vertices.assign(mesh.vertices().begin(), mesh.vertices().end());
  for (const auto& f : mesh.facets()) soup.facets.push_back({f[0].value, f[1].value, f[2].value});
  return soup;
}

double odd_number(Rng& rng) {
  constexpr double odd[] = {0,      -0.0,     5e-324, -5e-324, 2.3e-308, 1e-300, -1e-300, 1e-160,
                            1e-100, 0x1p-160, 1e-50,  1e-20,   1e-16,    0.5,    1,       -1,
                            3,      1e9,      1e16,   1e47,    -1e48,    1e100,  1e300,   -1e308};
  switch (rng.below(4)) {
    case 0:
      return rng.uniform(-1, 1);
    case 1:
      return std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.below(2000)) - 1000);
    case 2:
      return std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.below(300)) - 200);
    default:
      return odd[rng.below(std::size(odd))];
  }
}

void spoil_coordinates(Soup& soup, Rng& rng) {
  const std::size_t count = 1 + rng.below(rng.below(3) == 0 ? soup.vertices.size() : 3);
  for (std::size_t i = 0; i < count; ++i)
    any_of(soup.vertices, rng)[static_cast<int>(rng.below(3))] = odd_number(rng);
}

void nudge(Soup& soup, Rng& rng) {
  for (Vec3& p : soup.vertices)
    for (double& x : p)
      if (rng.below(3) == 0) x = std::nextafter(x, rng.below(2) == 0 ? -1e300 : 1e300);
}

/// All of it, or one axis alone: flat, or a needle.
void scale(Soup& soup, Rng& rng) {
  const auto power_of_ten = [&](int low, int high) {
    return std::pow(10, low + static_cast<int>(rng.below(static_cast<std::uint64_t>(high - low))));
  };
  Vec3 factor(1, 1, 1);
  if (rng.below(2) == 0)
    factor *= power_of_ten(-320, 60);
  else
    for (double& f : factor)
      if (rng.below(2) == 0) f = power_of_ten(-80, 20);
  for (Vec3& p : soup.vertices) p = p.cwiseProduct(factor);
}

void move_far(Soup& soup, Rng& rng) {
  const double far = std::pow(10, static_cast<int>(rng.below(20)));
  const Vec3 shift(far, rng.uniform(-far, far), rng.below(2) == 0 ? 0 : far);
  for (Vec3& p : soup.vertices) p += shift;
}

void round_to_grid(Soup& soup, Rng& rng) {
  const double unit = std::ldexp(1, -static_cast<int>(rng.below(6)));
  for (Vec3& p : soup.vertices)
    for (double& x : p) x = unit * std::nearbyint(x / unit);
}

void coincide(Soup& soup, Rng& rng) {
  const std::size_t count = 1 + rng.below(1 + soup.vertices.size() / 2);
  for (std::size_t i = 0; i < count; ++i) any_of(soup.vertices, rng) = any_of(soup.vertices, rng);
}

void double_facets(Soup& soup, Rng& rng) {
  const std::size_t count = 1 + rng.below(4);
  for (std::size_t i = 0; i < count; ++i) soup.facets.push_back(std::array(any_of(soup.facets, rng)));
}

void turn_facets(Soup& soup, Rng& rng) {
  const bool most = rng.below(2) == 0;
  for (auto& f : soup.facets)
    if (rng.below(most ? 2 : 10) == 0) std::swap(f[0], f[1]);
}

void drop_facets(Soup& soup, Rng& rng) {
  const std::size_t keep = 1 + rng.below(soup.facets.size());
  rng.shuffle(std::span(soup.facets));
  soup.facets.resize(keep);
}

void join_foreign_vertices(Soup& soup, Rng& rng) {
  const std::size_t count = 1 + rng.below(6);
  for (std::size_t i = 0; i < count; ++i) {
    auto& f = any_of(soup.facets, rng);
    f[rng.below(3)] = static_cast<std::int32_t>(rng.below(soup.vertices.size()));
  }
}

/// Every facet its own vertices, some of them moved a little.
void tear_apart(Soup& soup, Rng& rng) {
  Soup torn;
  const double by = rng.below(2) == 0 ? 0 : std::pow(10, -1 - static_cast<double>(rng.below(17)));
  for (const auto& f : soup.facets) {
    const auto first = static_cast<std::int32_t>(torn.vertices.size());
    for (const std::int32_t v : f)
      torn.vertices.push_back(soup.vertices[static_cast<std::size_t>(v)] +
                              by * Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), 0));
    torn.facets.push_back({first, first + 1, first + 2});
  }
  soup = torn;
}

/// Something that no reader can accept.
void break_rules(Soup& soup, Rng& rng) {
  switch (rng.below(4)) {
    case 0:
      any_of(soup.facets, rng)[rng.below(3)] = static_cast<std::int32_t>(soup.vertices.size() + rng.below(3));
      break;
    case 1:
      any_of(soup.facets, rng)[rng.below(3)] = static_cast<std::int32_t>(rng.below(0x7fffffff));
      break;
    case 2:
      any_of(soup.vertices, rng)[0] = std::numeric_limits<double>::quiet_NaN();
      break;
    default:
      any_of(soup.vertices, rng)[1] = std::numeric_limits<double>::infinity();
  }
}

/// Do all facets name vertices that there are?
bool has_its_vertices(const Soup& soup) {
  const auto known = [&](std::int32_t v) {
    return v >= 0 && static_cast<std::size_t>(v) < soup.vertices.size();
  };
  return std::ranges::all_of(soup.facets, [&](const auto& f) { return std::ranges::all_of(f, known); });
}

void spoil(Soup& soup, Rng& rng) {
  if (!has_its_vertices(soup)) return;  // rules are broken already
  constexpr void (*kinds[])(Soup&, Rng&) = {
      spoil_coordinates, spoil_coordinates,     nudge,     scale,         scale,
      move_far,          round_to_grid,         coincide,  double_facets, turn_facets,
      drop_facets,       join_foreign_vertices, tear_apart};
  kinds[rng.below(std::size(kinds))](soup, rng);
  if (rng.below(30) == 0) break_rules(soup, rng);
}

std::string as_text(const Soup& soup, bool off) {
  std::string text;
  if (off)
    text = "OFF\n" + std::to_string(soup.vertices.size()) + " " + std::to_string(soup.facets.size()) + " 0\n";
  for (const Vec3& p : soup.vertices) {
    text += off ? "" : "v";
    for (const double x : p) io::append_shortest(text += " ", x);
    text += "\n";
  }
  for (const auto& f : soup.facets) {
    text += off ? "3" : "f";
    for (const std::int32_t v : f) text += " " + std::to_string(off ? v : v + 1);
    text += "\n";
  }
  return text;
}

bool fits_single_precision(const Soup& soup) {
  const auto too_large = [](double x) {
    return std::isfinite(x) && std::abs(x) > std::numeric_limits<float>::max();
  };
  return std::ranges::none_of(soup.vertices,
                              [&](const Vec3& p) { return std::ranges::any_of(p, too_large); });
}

std::string as_binary_off(const Soup& soup, Rng& rng) {
  fixtures::BinaryOff file({rng.below(2) == 0 ? std::endian::big : std::endian::little, rng.below(2) == 0});
  file.add_counts(soup.vertices.size(), soup.facets.size());
  for (const Vec3& p : soup.vertices) file.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& f : soup.facets) file.add_facet({f[0], f[1], f[2]});
  return file.bytes();
}

/// In a format of chance; as text if it is not sound enough for another.
Mutant as_file(const Soup& soup, Rng& rng) {
  const bool off = rng.below(2) == 0;
  const std::uint64_t format = rng.below(4);
  if (format == 3 && off && fits_single_precision(soup)) return {"mutant.off", as_binary_off(soup, rng)};
  if (format >= 2) try {
      geom::Table<geom::VertexId, Vec3> vertices;
      geom::Table<geom::FacetId, geom::TriMesh::Facet> facets;
      for (const Vec3& p : soup.vertices) vertices.push_back(p);
      for (const auto& [a, b, c] : soup.facets)
        facets.push_back({geom::VertexId(a), geom::VertexId(b), geom::VertexId(c)});
      const geom::TriMesh mesh(std::move(vertices), std::move(facets));
      return format == 2 ? Mutant{"mutant.ply", io::to_ply(mesh)} : Mutant{"mutant.stl", io::to_stl(mesh)};
    } catch (const geom::InputError&) {
    }
  return {off ? "mutant.off" : "mutant.obj", as_text(soup, off)};
}

/// Line `i` of the bytes with its end, as a stretch.
struct Stretch {
  std::size_t at, length;
};
Stretch random_line(const std::string& bytes, Rng& rng) {
  const std::size_t middle = rng.below(bytes.size());
  const std::size_t before = middle == 0 ? std::string::npos : bytes.rfind('\n', middle - 1);
  const std::size_t at = before == std::string::npos ? 0 : before + 1;
  return {at, std::min(bytes.find('\n', at), bytes.size() - 1) + 1 - at};
}

}  // namespace

std::string damaged(std::string bytes, Rng& rng) {
  if (bytes.empty()) return bytes;
  const std::size_t at = rng.below(bytes.size()),
                    length = 1 + rng.below(std::min<std::size_t>(bytes.size() - at, 40));
  const Stretch line = random_line(bytes, rng);
  switch (rng.below(7)) {
    case 0:
      bytes.resize(at);
      break;
    case 1:
      bytes.erase(at, length);
      break;
    case 2:
      bytes.insert(rng.below(bytes.size()), bytes.substr(at, length));
      break;
    case 3:
      bytes.erase(line.at, line.length);
      break;
    case 4:
      bytes.insert(line.at, bytes.substr(line.at, line.length));
      break;
    case 5:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << rng.below(8)));
      break;
    default:
      for (std::uint64_t i = 0, count = 1 + rng.below(4); i < count; ++i) {
        constexpr std::string_view likely("0123456789-+.e \n\r/\\#nai\0\xff\x7f", 27);
        bytes[rng.below(bytes.size())] =
            rng.below(2) == 0 ? likely[rng.below(likely.size())] : static_cast<char>(rng.below(256));
      }
  }
  return bytes;
}

Mutant mutant(std::uint64_t seed) {
  Rng rng(seed);
  Soup soup = random_shape(rng);
  for (std::uint64_t i = 0, count = 1 + rng.below(3); i < count; ++i) spoil(soup, rng);
  Mutant result = as_file(soup, rng);
  if (rng.below(4) == 0) result.bytes = damaged(std::move(result.bytes), rng);
  return result;
}

Mutant export_fault(std::uint64_t seed) {
  Rng rng(seed);
  constexpr std::pair<const char*, int> shapes[] = {{"sphere", 4}, {"torus", 16},      {"blob", 4},
                                                    {"cube", 5},   {"two-spheres", 3}, {"l-block", 3}};
  const auto& [name, size] = shapes[rng.below(std::size(shapes))];
  const geom::TriMesh mesh = geom::tilted(geom::make_shape(name, size, 1));
  const std::size_t way = rng.below(fixtures::ways_to_spoil.size());
  return {"export.ply", io::to_ply(fixtures::spoilt(mesh, way, rng.bits()))};
}

}  // namespace fuzz
