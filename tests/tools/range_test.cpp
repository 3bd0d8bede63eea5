// Inputs of any size: the tools' results are those of the input scaled by a power of two, to the bit, or
// there is one line that says why not.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "doctest.h"
#include "geom/mesh/scaling.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "io/points.h"
#include "io/values.h"
#include "tests/fixtures/program.h"
#include "tests/io/scratch_folder.h"

using fixtures::ProgramResult;
using fixtures::ScratchFolder;

namespace {

/// A folder in which the tools run.
struct RangePlace {
  ProgramResult run(const std::string& program, const std::vector<std::string>& arguments) const {
    return fixtures::run_program(program, arguments, folder.path());
  }
  /// What a run that must succeed prints.
  std::string result(const std::string& program, const std::vector<std::string>& arguments) const {
    const ProgramResult done = run(program, arguments);
    CHECK_MESSAGE(done.code == 0, program << ": " << done.err);
    return done.out;
  }
  std::string read(const std::string& name) const { return ScratchFolder::read(folder / name); }
  ScratchFolder folder;
};

/// What the tools make of a shape of size 2^exponent, scaled back.
struct Results {
  geom::TriMesh remesh, cells;
  std::string map, picture, quality, spectrum;
};

Results results(int exponent) {
  const double factor = std::ldexp(1.0, exponent);
  const geom::TriMesh blob = geom::make_shape("blob", 3);
  const RangePlace at;
  io::write_mesh(at.folder / "in.obj", scaled(blob, factor));
  std::vector<double> rho;
  for (const geom::Vec3& p : blob.vertices()) rho.push_back(factor * (2 + p.x()));
  io::write_values(at.folder / "rho.txt", rho);
  io::write_points(at.folder / "fixed.xyz",
                   std::vector<geom::WeightedPoint3>{{factor * blob.position(geom::VertexId(5)), 0}});
  at.result("fpo-remesh", {"in.obj", "-n", "80", "-o", "out.obj", "--iterations", "3", "--sizing", "rho.txt",
                           "--map", "map.txt", "--picture", "picture.svg", "--rpd", "cells.obj",
                           "--sizing-out", "sizes.txt", "--fixed", "fixed.xyz"});
  Results r;
  r.remesh = scaled(io::read_mesh(at.folder / "out.obj"), 1 / factor);
  r.cells = scaled(io::read_mesh(at.folder / "cells.obj"), 1 / factor);
  r.map = at.read("map.txt"), r.picture = at.read("picture.svg");
  r.quality = at.result("fpo-quality", {"out.obj", "--reference", "in.obj"});
  at.result("fpo-spectrum",
            {"out.obj", "--surface", "in.obj", "--sizes", "sizes.txt", "--radius", "3", "-o", "of"});
  at.result("fpo-spectrum", {"out.obj", "--radius", "3", "-o", "own"});
  r.spectrum = at.read("of.csv") + at.read("own.csv");
  return r;
}

/// The same of the plane, with curves as the sizing.
struct PlaneResults {
  std::vector<geom::WeightedPoint2> samples, bounded;
  std::string picture, spectrum, plain;
};

PlaneResults plane_results(int exponent) {
  const double unit = std::ldexp(1.0, exponent);
  const RangePlace at;
  char period[64];
  std::snprintf(period, sizeof period, "%.17gx%.17g", unit, unit / 2);
  std::vector<geom::WeightedPoint2> curve;
  for (int i = 0; i < 20; ++i)
    curve.push_back({unit * geom::Vec2(0.2 + 0.03 * i, 0.2 + 0.1 * std::sin(0.4 * i)), 0});
  io::write_points(at.folder / "curve.txt", curve);
  const auto plane = [&](const std::string& out, std::vector<std::string> more) {
    more.insert(more.end(), {"-n", "100", "--iterations", "3", "--period", period, "-o", out});
    at.result("fpo-plane", more);
  };
  plane("samples.txt", {"--sizing", "curve.txt"});
  plane("bounded.txt", {"--bounded", "--sizing", "waves5"});
  plane("uniform.txt", {});
  plane("picture.svg", {"--sizing", "waves5", "--draw-cells", "--draw-sizing", "--draw-disks"});
  at.result("fpo-spectrum", {"samples.txt", "--period", period, "--radius", "3", "-o", "adaptive"});
  at.result("fpo-spectrum", {"uniform.txt", "--period", period, "--periodogram", "-o", "plain"});
  PlaneResults r{io::read_points2(at.folder / "samples.txt"), io::read_points2(at.folder / "bounded.txt"),
                 at.read("picture.svg"), at.read("adaptive.csv"), at.read("plain.csv")};
  for (auto* points : {&r.samples, &r.bounded})
    for (auto& [x, w] : *points) x /= unit, w /= unit * unit;
  return r;
}

bool same(const std::vector<geom::WeightedPoint2>& a, const std::vector<geom::WeightedPoint2>& b) {
  return std::ranges::equal(
      a, b, [](const auto& p, const auto& q) { return p.position == q.position && p.weight == q.weight; });
}

/// Exit code 2, one line that names the file, no output.
void check_refused(const RangePlace& at, const std::string& program,
                   const std::vector<std::string>& arguments, const std::string& line) {
  const ProgramResult refused = at.run(program, arguments);
  CHECK(refused.code == 2);
  CHECK(refused.out == "");
  CHECK(refused.err == program + ": " + line + "\n");
}

}  // namespace

TEST_CASE("range: a surface scaled by a power of two gives the same results, scaled, to the bit") {
  const Results unit = results(0);
  for (const int exponent : {-890, -600, 157}) {
    CAPTURE(exponent);
    const Results r = results(exponent);
    CHECK(r.remesh.vertices() == unit.remesh.vertices());
    CHECK(r.remesh.facets() == unit.remesh.facets());
    CHECK(r.cells.vertices() == unit.cells.vertices());
    CHECK(r.map == unit.map);
    CHECK(r.picture == unit.picture);
    CHECK(r.quality == unit.quality);
    CHECK(r.spectrum == unit.spectrum);
  }
}

TEST_CASE("range: a rectangle scaled by a power of two gives the same results, scaled, to the bit") {
  const PlaneResults unit = plane_results(0);
  for (const int exponent : {-48, 49}) {
    CAPTURE(exponent);
    const PlaneResults r = plane_results(exponent);
    CHECK(same(r.samples, unit.samples));
    CHECK(same(r.bounded, unit.bounded));
    CHECK(r.picture == unit.picture);
    CHECK(r.spectrum == unit.spectrum);
    CHECK(r.plain == unit.plain);
  }
}

TEST_CASE("range: beyond it, every tool refuses in one line that names the file and the line") {
  const RangePlace at;
  at.folder.write("huge.obj", "v 0 0 0\nv 1e200 0 0\nv 0 1 0\nf 1 2 3\n");
  at.folder.write("mixed.obj", "v 0 0 0\nv 1e-200 0 0\nv 0 -1e49 0\nf 1 2 3\n");
  at.folder.write("tiny.obj", "v 0 0 0\nv 1e-280 0 0\nv 0 1e-280 0\nf 1 2 3\n");
  at.folder.write("huge.txt", "0 0\n1e200 0\n0 1\n");
  const std::string beyond = ": a coordinate is beyond 1e48, the range of the exact arithmetic";
  const std::string tiny = "tiny.obj: the surface is too small: no coordinate reaches 1.2e-271";
  for (const std::string program : {"fpo-remesh", "fpo-quality", "fpo-spectrum", "fpo-trace"}) {
    CAPTURE(program);
    const auto refused = [&](const std::string& file, const std::string& line) {
      std::vector<std::string> arguments{file};
      if (program != "fpo-quality") arguments.insert(arguments.end(), {"-o", "out.obj"});
      if (program == "fpo-remesh") arguments.insert(arguments.end(), {"-n", "10"});
      if (program == "fpo-trace") arguments.insert(arguments.end(), {"-n", "10", "--move", "1"});
      check_refused(at, program, arguments, line);
    };
    refused("huge.obj", "huge.obj:2" + beyond);
    refused("mixed.obj", "mixed.obj:3" + beyond);
    refused("tiny.obj", program == "fpo-trace"
                            ? "tiny.obj: the largest coordinate must be between 1e-12 and 1e12 here"
                            : tiny);
  }
  check_refused(at, "fpo-spectrum", {"huge.txt", "-o", "out"}, "huge.txt:2" + beyond);
  check_refused(at, "fpo-plane", {"-n", "50", "-o", "out.txt", "--sizing", "huge.txt"},
                "huge.txt:2" + beyond);
  check_refused(at, "fpo-plane", {"-n", "50", "-o", "out.txt", "--period", "1e-200x1e-200"},
                "--period: 1e-200 is not between 1e-15 and 1e+15");
  CHECK(!std::filesystem::exists(at.folder / "out.obj"));
}
