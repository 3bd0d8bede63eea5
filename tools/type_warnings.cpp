#include "tools/type_warnings.h"

#include <algorithm>
#include <cmath>

#include "geom/mesh/surface_type.h"
#include "tools/feature_words.h"
#include "tools/worded.h"

namespace tools {
namespace {

/// Two digits: the number is an estimate.
std::size_t rounded_up(std::size_t count) {
  const double unit = std::pow(10, std::max(std::floor(std::log10(static_cast<double>(count))) - 1, 0.0));
  return static_cast<std::size_t>(std::ceil(static_cast<double>(count) / unit) * unit);
}

constexpr std::size_t most_for_kept_edges = 2;  // times as many as there are
constexpr std::size_t most_for_type = 3;        // times as many as keep all edges, if most are missing
constexpr std::size_t most_told = 100;          // times as many as there are: more are of no use to anybody

/// The number from which on all edges of features are kept; 0: none that is worth being told.
std::size_t told_for_features(const fpo::RemeshResult& result) {
  const std::size_t needed = result.feature_bound.samples;
  return needed <= most_told * result.samples.size() ? needed : 0;
}

}  // namespace

std::size_t enough_samples(const fpo::RemeshResult& result) {
  const std::size_t n = result.samples.size(), kept_from = told_for_features(result);
  std::size_t enough = kept_from > n ? kept_from : 0;
  if (!result.advice.places.empty()) {
    std::size_t for_type = result.advice.samples;
    if (kept_from > n && 2 * result.broken_feature_edges > result.feature_edges)
      for_type = std::min(for_type, most_for_type * kept_from);
    const bool is_of_bars = kept_from > n && 2 * result.feature_samples > n;  // what keeps curves keeps all
    if (!is_of_bars) enough = std::max(enough, rounded_up(for_type));
  }
  if (result.broken_feature_edges == 0 || kept_from > n) return enough;
  std::size_t for_edges = result.edge_advice.samples;
  if (kept_from > 0) for_edges = std::min(for_edges, most_for_kept_edges * n);
  return std::max(enough, rounded_up(for_edges));
}

namespace {

std::string what_to_do(const geom::Topology& in, const fpo::RemeshResult& result,
                       const fpo::RemeshOptions& options) {
  const fpo::TypeAdvice& advice = result.advice;
  if (advice.places.empty()) return {};
  const geom::Vec3& first = advice.places.front();
  const char* repair = in.nonmanifold_edges > 0 ? "--repair, which splits non-manifold edges, or " : "";
  std::string text =
      worded("%zu place%s at fault, the first at (%.6g, %.6g, %.6g); try %s-n %zu or --at-least",
             advice.places.size(), advice.places.size() == 1 ? "" : "s", first.x(), first.y(), first.z(),
             repair, enough_samples(result));
  if (options.sizing == fpo::SizingKind::uniform) text += ", or --sizing lfs";
  return text;
}

void add_parts(const fpo::TypeCheck& type, std::vector<std::string>& lines) {
  const auto add = [&](std::size_t count, const char* one, const char* more) {
    if (count > 0) lines.push_back(worded("%zu %s", count, count == 1 ? one : more));
  };
  add(type.lost_parts, "component of the input is lost", "components of the input are lost");
  add(type.joined_parts, "component of the remesh joins several of the input",
      "components of the remesh join several of the input each");
  add(type.doubled_facets, "facet lies upon another", "facets lie upon each other");
  add(type.split_parts, "component of the input is several of the remesh",
      "components of the input are several of the remesh each");
}

/// What stands between the input and a manifold of its own type, in words; empty: nothing.
std::string set_apart(const geom::Topology& in, const geom::SurfaceType& split) {
  if (in.nonmanifold_edges > 0)
    return counted(in.nonmanifold_edges, "non-manifold edge", "non-manifold edges");
  if (split.split_vertices == 0) return {};
  return counted(split.split_vertices, "non-manifold vertex split", "non-manifold vertices split");
}

/// What the remesh has against what was wanted: the input's numbers, with its vertices split.
std::string numbers_told(const geom::Topology& in, const geom::Topology& out,
                         const geom::SurfaceType& split) {
  const std::string apart = set_apart(in, split);
  return worded("Euler number %ld, %zu components, %zu boundary loops; the input%s has %ld, %zu, %zu",
                out.euler, out.components, out.boundary_loops,
                apart.empty() ? "" : (", with " + apart + ",").c_str(), split.whole().euler,
                split.parts.size(), split.whole().border_loops);
}

/// Of an input that meets itself in vertices, of which the remesh makes several each.
std::string splitting_told(const geom::Topology& in, const geom::Topology& out,
                           const geom::SurfaceType& split) {
  std::string changes;
  const auto add = [&](const char* name, long from, long to) {
    if (from != to) changes += worded("%s%s %ld -> %ld", changes.empty() ? "" : ", ", name, from, to);
  };
  add("Euler number", in.euler, out.euler);
  add("components", static_cast<long>(in.components), static_cast<long>(out.components));
  add("boundary loops", static_cast<long>(in.boundary_loops), static_cast<long>(out.boundary_loops));
  if (changes.empty()) return {};
  return changes + ", as " + counted(split.split_vertices, "vertex was split", "vertices were split");
}

void add_small_angles(const fpo::RemeshResult& result, const fpo::RemeshOptions& options,
                      std::vector<std::string>& lines) {
  if (result.measures.angles_below_30 == 0) return;
  std::string line = counted(result.measures.angles_below_30, "angle is", "angles are") +
                     worded(" below 30 degrees, the smallest is %.1f", result.measures.theta_min);
  if (result.corner_angle < 30)
    line +=
        "; " +
        counted(result.sharp_corners, "between creases of the input is", "between creases of the input are") +
        worded(", the smallest is %.1f", result.corner_angle);
  if (told_for_features(result) > result.samples.size())
    line += worded("; %s, from about -n %zu on that does not matter", feature_need(result.feature_bound.need),
                   enough_samples(result));
  if (options.features && !options.features->marked.empty())
    line += "; lines that were asked for are not given up for them";
  lines.push_back(line);
}

}  // namespace

std::vector<std::string> type_warnings(const geom::TriMesh& input, const fpo::RemeshResult& result,
                                       const fpo::RemeshOptions& options) {
  const fpo::TypeCheck& type = result.type;
  std::vector<std::string> lines;
  const geom::Topology in = geom::topology(input);
  if (type.ok() && in.manifold()) return lines;
  const geom::Topology out = geom::topology(result.mesh);
  const geom::SurfaceType split = geom::surface_type(input);
  if (type.ok()) {
    const std::string told = splitting_told(in, out, split);
    if (!told.empty()) lines.push_back(told);
    return lines;
  }
  if (!type.is_manifold())
    lines.push_back("the remesh is not a manifold: " +
                    counted(type.nonmanifold_edges, "non-manifold edge", "non-manifold edges") + ", " +
                    counted(type.nonmanifold_vertices, "non-manifold vertex", "non-manifold vertices"));
  if (type.bare_samples > 0)
    lines.push_back(counted(type.bare_samples, "sample has", "samples have") + " no triangle");
  add_parts(type, lines);
  if (!type.same_pieces())
    lines.push_back(
        worded("between edges of more than two facets %zu pieces of the input are lost, and %zu are new",
               type.lost_pieces, type.new_pieces));
  const geom::PartType wanted = split.whole();
  if (wanted.euler != out.euler || split.parts.size() != out.components ||
      wanted.border_loops != out.boundary_loops || type.changed_parts > 0)
    lines.push_back(numbers_told(in, out, split));
  const std::string advice = what_to_do(in, result, options);
  if (!advice.empty()) lines.push_back(advice);
  return lines;
}

namespace {

void add_far_part(const fpo::RemeshResult& result, const fpo::RemeshOptions& options,
                  std::vector<std::string>& lines) {
  const fpo::FarPart& part = result.far_part;
  if (part.of_wanted == 0) return;
  std::string line = worded(
      "the input is up to %.6g away from the remesh, %.2f wanted lengths, at (%.6g, %.6g, %.6g), as if cut "
      "off; try more samples",
      part.distance, part.of_wanted, part.at.x(), part.at.y(), part.at.z());
  if (options.surface.corners != geom::CornerTypes::all) line += ", or --corners all";
  if (options.sizing == fpo::SizingKind::uniform) line += ", or --sizing lfs";
  lines.push_back(line);
}

constexpr double short_edge = 0.5;  // of the length that is wanted, or of an even spacing

void add_short_edge(const geom::TriMesh& input, const fpo::RemeshResult& result,
                    const fpo::RemeshOptions& options, std::vector<std::string>& lines) {
  const fpo::FinalMeasures& m = result.measures;
  if (result.mesh.num_facets() == 0) return;
  const auto told = [](double length, const char* unit, const geom::Vec3& at) {
    return worded("the shortest edge is %.3f %s long, at (%.6g, %.6g, %.6g)", length, unit, at.x(), at.y(),
                  at.z());
  };
  if (m.least_edge < short_edge) {
    lines.push_back(told(m.least_edge, "wanted lengths", m.least.middle) +
                    (m.least.is_fixed ? ": features are that close there" : ""));
    return;
  }
  const double even = fpo::hexagonal_spacing(input.area(), result.samples.size());
  if (options.sizing == fpo::SizingKind::uniform && m.shortest.length < short_edge * even)
    lines.push_back(told(m.shortest.length / even, "even spacings", m.shortest.middle) +
                    ": lengths are less there, on a blend, beside close curves or on a thin part");
}

}  // namespace

std::vector<std::string> shape_warnings(const geom::TriMesh& input, const fpo::RemeshResult& result,
                                        const fpo::RemeshOptions& options) {
  std::vector<std::string> lines;
  if (result.features_missed) lines.push_back(result.given_up);
  add_far_part(result, options, lines);
  add_short_edge(input, result, options, lines);
  add_small_angles(result, options, lines);
  if (result.broken_feature_edges > 0)
    lines.push_back(worded(
        "%zu of %zu feature edges are no edges of the remesh, the first at (%.6g, %.6g, %.6g): curves are "
        "closer there than samples; about -n %zu would do",
        result.broken_feature_edges, result.feature_edges, result.edge_advice.first.x(),
        result.edge_advice.first.y(), result.edge_advice.first.z(), enough_samples(result)));
  return lines;
}

}  // namespace tools
