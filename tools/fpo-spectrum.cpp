// fpo-spectrum: power spectrum, radial mean and anisotropy of samples (paper, section 6, figures 7 to 9).

#include <algorithm>
#include <cmath>
#include <memory>

#include "fpo/spectrum/periodogram.h"
#include "geom/mesh/scaling.h"
#include "io/atomic_file.h"
#include "io/extension.h"
#include "io/input_file.h"
#include "io/points.h"
#include "io/values.h"
#include "tools/interrupt.h"
#include "tools/picture_of_spectrum.h"
#include "tools/spectrum_arguments.h"
#include "tools/spectrum_warnings.h"
#include "tools/summary.h"
#include "tools/surface_input.h"
#include "tools/worded.h"

namespace {

using fpo::PowerSpectrum;
using tools::SpectrumArguments;

/// The surface that all sets were drawn from, if one was given.
struct GivenSurface {
  std::unique_ptr<fpo::SpectrumSurface> surface;
  double factor = 1;       ///< by which it is scaled
  fpo::VertexField sizes;  ///< scaled, too; empty: none
};

/// Complaints name the file. No spectrum depends on the unit of length; in this one no square under- or
/// overflows.
GivenSurface at_unit_size(const std::filesystem::path& path, const geom::TriMesh& mesh) try {
  GivenSurface result;
  result.factor = geom::factor_to_unit_box(mesh);
  result.surface = std::make_unique<fpo::SpectrumSurface>(geom::scaled_to_unit_box(mesh, result.factor));
  return result;
} catch (const geom::InputError& error) {
  throw geom::InputError(io::display_name(path) + ": " + error.what());
}

GivenSurface read_surface(const SpectrumArguments& a) {
  if (a.surface.empty()) return {};
  const geom::TriMesh mesh = tools::read_cleaned(a.surface);
  GivenSurface given = at_unit_size(a.surface, mesh);
  if (!a.sizes.empty())
    for (const double h : io::read_positive_values(a.sizes, mesh.num_vertices()))
      given.sizes.push_back(given.factor * h);
  return given;
}

PowerSpectrum plane_spectrum(const SpectrumArguments& a, const std::filesystem::path& input) {
  const std::vector<geom::WeightedPoint2> points = io::read_points2(input);
  if (a.plain) {
    std::vector<geom::Vec2> positions;
    positions.reserve(points.size());
    for (const geom::WeightedPoint2& p : points) positions.push_back(p.position);
    // A little more, so that rings are full up to there.
    return fpo::periodogram(positions, geom::FlatTorus(a.region.size), 1.05 * a.spectrum.max_frequency,
                            a.spectrum.threads);
  }
  const fpo::SpacingRule rule =
      a.spacing.value_or(fpo::rule_for(std::span<const geom::WeightedPoint2>(points)));
  return fpo::differential_spectrum(fpo::plane_set(points, a.region, rule, a.spectrum.radius), a.spectrum);
}

PowerSpectrum surface_spectrum(const SpectrumArguments& a, const GivenSurface& given,
                               const std::filesystem::path& input) {
  std::vector<geom::WeightedPoint3> points;
  const std::string extension = io::lower_extension(input);
  GivenSurface own;
  if (given.surface && (extension == ".xyz" || extension == ".ply")) {
    points = io::read_points3(input);
  } else {
    geom::require(extension != ".xyz", "points in space need --surface");
    const geom::TriMesh mesh = tools::read_cleaned(input);
    for (const geom::Vec3& x : mesh.vertices()) points.push_back({x, 0});
    if (!given.surface) own = at_unit_size(input, mesh);
  }
  const double factor = given.surface ? given.factor : own.factor;
  for (geom::WeightedPoint3& p : points) {
    p.position *= factor;
    p.weight *= factor;  // twice, for the square of a small factor underflows
    p.weight *= factor;
  }
  const fpo::SpectrumSurface& surface = given.surface ? *given.surface : *own.surface;
  if (!given.sizes.empty())
    for (geom::WeightedPoint3& p : points)
      p.weight = std::pow(surface.interpolated(p.position, given.sizes), 2);
  const fpo::SpacingRule rule =
      a.spacing.value_or(fpo::rule_for(std::span<const geom::WeightedPoint3>(points)));
  if (given.surface) tools::warn_if_elsewhere(input, points, surface);
  if (!a.spacing && rule == fpo::SpacingRule::uniform) tools::warn_if_adaptive(input, points, surface);
  return fpo::differential_spectrum(fpo::surface_set(points, surface, rule), a.spectrum);
}

/// The spectra of all sets, or of those that were done when a signal came.
std::vector<PowerSpectrum> all_spectra(const SpectrumArguments& a) {
  const std::atomic<bool>& interrupted = tools::interrupt_flag();
  const GivenSurface given = read_surface(a);
  std::vector<PowerSpectrum> spectra;
  for (const std::filesystem::path& input : a.inputs) {
    if (interrupted) break;
    try {
      spectra.push_back(a.in_plane ? plane_spectrum(a, input) : surface_spectrum(a, given, input));
    } catch (const geom::InputError& error) {
      const std::string text = error.what();
      if (text.starts_with(input.string())) throw;
      throw geom::InputError(input.string() + ": " + text);
    }
    const PowerSpectrum &first = spectra.front(), &last = spectra.back();
    geom::require(first.half_x == last.half_x && first.half_y == last.half_y && first.step == last.step,
                  input.string() + ": periodograms are averaged over sets of equally many samples only");
  }
  return spectra;
}

std::string table(const fpo::RadialCurve& curve) {
  std::string text = "frequency,radial_mean,anisotropy_db\n";
  for (std::size_t i = 0; i < curve.frequency.size(); ++i) {
    text += tools::worded("%.6g,%.6g,", curve.frequency[i], curve.mean[i]);
    const double decibels = fpo::decibel(curve.anisotropy[i]);
    if (std::isfinite(decibels)) text += tools::worded("%.4f", decibels);
    text += '\n';
  }
  return text;
}

void print_summary(const SpectrumArguments& a, const tools::MeanSpectrum& mean) {
  const fpo::RadialCurve& c = mean.curve;
  double low = 0, decibels = 0, rings = 0;
  std::size_t peak = 0;
  for (std::size_t i = 0; i < c.frequency.size(); ++i) {
    if (c.frequency[i] <= 0.5) low = std::max(low, c.mean[i]);
    if (c.mean[i] > c.mean[peak]) peak = i;
    if (c.frequency[i] < 0.5 || !(c.anisotropy[i] > 0)) continue;
    decibels += fpo::decibel(c.anisotropy[i]);
    rings += 1;
  }
  tools::Summary summary;
  summary.count("sets", mean.num_sets);
  summary.number("low_power", low, 4);
  summary.number("peak_power", c.mean.empty() ? 0 : c.mean[peak], 4);
  summary.number("peak_frequency", c.mean.empty() ? 0 : c.frequency[peak], 4);
  summary.number("anisotropy_db", rings > 0 ? decibels / rings : 0, 2);
  summary.text("wrote", a.picture.string() + " " + a.table.string());
  summary.print(a.json);
}

int spectrum(tools::CommandLine& cli) {
  tools::interrupt_flag();
  const SpectrumArguments a = tools::parse_spectrum_arguments(cli);
  const std::vector<PowerSpectrum> spectra = all_spectra(a);
  if (spectra.empty()) throw geom::Interrupted();
  tools::MeanSpectrum mean{fpo::mean_spectrum(spectra), {}, spectra.size()};
  mean.curve = fpo::radial_curve(mean.spectrum, fpo::ring_width(a.spectrum));
  const io::Svg picture = tools::draw_spectrum(mean);
  io::write_file(a.table, table(mean.curve));
  picture.save(a.picture);
  print_summary(a, mean);
  return tools::interrupt_flag() ? tools::exit_interrupted : tools::exit_done;  // maybe after the last set
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-spectrum", argc, argv, spectrum); }
