#include "tools/spectrum_arguments.h"

#include "geom/regular/flat_torus.h"
#include "io/atomic_file.h"
#include "io/extension.h"
#include "tools/interrupt.h"
#include "tools/period.h"
#include "tools/shared_options.h"

namespace tools {
namespace {

void declare_domain(CommandLine& cli, SpectrumArguments& a, bool& bounded, bool& period_given) {
  cli.group("Domain");
  cli.path({.name = "surface", .value = "INPUT", .help = "the surface that the samples were drawn from"},
           a.surface);
  cli.custom({.name = "period", .value = "WxH", .help = "of .txt: width and height", .standard = "1x1"},
             [&](const std::string& text) {
               a.region.size = parse_period(text);
               period_given = true;
             });
  cli.flag({.name = "bounded", .help = "of .txt: a rectangle with a border, not a torus"}, bounded);
  cli.choice({.name = "spacing",
              .value = "uniform|weights|local",
              .help = "how far apart samples should be: the same everywhere, by their weights, or by the "
                      "density around them",
              .standard = "weights if they differ, else uniform"},
             a.spacing,
             {{"uniform", fpo::SpacingRule::uniform},
              {"weights", fpo::SpacingRule::weights},
              {"local", fpo::SpacingRule::local}});
  cli.path({.name = "sizes",
            .value = "FILE",
            .help = "the wanted edge length at each vertex of --surface (fpo-remesh --sizing-out), instead "
                    "of weights"},
           a.sizes);
}

void declare_spectrum(CommandLine& cli, SpectrumArguments& a) {
  cli.group("Spectrum");
  cli.number({.name = "radius",
              .value = "R",
              .help = "look at pairs of samples up to so many spacings apart: resolves 1/R"},
             a.spectrum.radius, 2, 100);
  cli.number({.name = "max-frequency", .value = "F", .help = "along each axis, in units of 1 / spacing"},
             a.spectrum.max_frequency, 0.5, 20);
  cli.flag({.name = "periodogram", .help = "the plain spectrum of uniform samples on a torus"}, a.plain);
}

/// What does not go together.
void check(const SpectrumArguments& a, bool bounded, bool period_given) {
  if (a.in_plane && !a.surface.empty()) throw UsageError("--surface is not for .txt, which lie in the plane");
  if (!a.in_plane && (bounded || period_given || a.plain))
    throw UsageError("--period, --bounded and --periodogram are for .txt, which lie in the plane");
  if (!a.sizes.empty() && a.surface.empty()) throw UsageError("--sizes is for --surface");
  if (!a.sizes.empty() && a.spacing && a.spacing != fpo::SpacingRule::weights)
    throw UsageError("--sizes and --spacing exclude each other");
  if (a.plain && (bounded || (a.spacing && a.spacing != fpo::SpacingRule::uniform)))
    throw UsageError("--periodogram is for uniform samples on a torus");
}

}  // namespace

SpectrumArguments parse_spectrum_arguments(CommandLine& cli) {
  SpectrumArguments a;
  std::filesystem::path prefix;
  bool bounded = false, period_given = false;
  cli.describe(
      "POINTS|MESH...",
      std::string(
          "Power spectrum, its radial mean and anisotropy, averaged over sets of samples: points in the "
          "plane (.txt), points on a surface (.xyz, .ply), or the vertices of meshes (without --surface "
          "each is its own surface). ") +
          interrupt_help);
  cli.path({.name = "output",
            .letter = 'o',
            .value = "PREFIX",
            .help = "PREFIX.svg: the pictures; PREFIX.csv: frequency, radial mean, anisotropy in dB",
            .required = true},
           prefix);
  declare_json(cli, a.json);
  declare_domain(cli, a, bounded, period_given);
  declare_spectrum(cli, a);
  for (const std::string& input : cli.parse(1, 10'000)) a.inputs.emplace_back(input);
  std::size_t in_plane = 0;
  for (const std::filesystem::path& input : a.inputs) in_plane += io::lower_extension(input) == ".txt";
  if (in_plane != 0 && in_plane != a.inputs.size())
    throw UsageError("samples in the plane (.txt) and on surfaces do not mix");
  a.in_plane = in_plane != 0;
  a.region.periodic = !bounded;
  a.spectrum.threads = cli.threads();
  check(a, bounded, period_given);
  const std::string ending = io::lower_extension(prefix);
  for (const char* other : {".png", ".pdf", ".csv", ".jpg", ".jpeg", ".eps", ".ps", ".txt", ".html"})
    geom::require(ending != other, "-o: " + prefix.string() + ": a prefix of .svg and .csv, not a " + ending);
  if (ending == ".svg") prefix.replace_extension();
  (a.picture = prefix) += ".svg";
  (a.table = prefix) += ".csv";
  for (const std::filesystem::path& path : {a.picture, a.table}) io::require_writable(path);
  return a;
}

}  // namespace tools
