#include "io/points.h"

#include "doctest.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/scratch_folder.h"

using fixtures::complaint;
using fixtures::ScratchFolder;
using geom::WeightedPoint2;
using geom::WeightedPoint3;

namespace {

template <class Point>
bool equal(const std::vector<Point>& a, const std::vector<Point>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Point& p, const Point& q) {
    return p.position == q.position && p.weight == q.weight;
  });
}

}  // namespace

TEST_CASE("points: every bit survives, with and without weights") {
  const ScratchFolder folder;
  const geom::TriMesh source = fixtures::random_soup(3, false);
  for (const double weight : {0.0, 1. / 3}) {
    std::vector<WeightedPoint3> points;
    std::vector<WeightedPoint2> flat;
    for (const geom::Vec3& p : source.vertices()) {
      points.push_back({p, weight * p.x()});
      flat.push_back({p.head<2>(), weight * p.z()});
    }
    for (const char* name : {"a.xyz", "a.ply"}) {
      io::write_points(folder / name, points);
      CHECK(equal(io::read_points3(folder / name), points));
    }
    io::write_points(folder / "a.TXT", flat);
    CHECK(equal(io::read_points2(folder / "a.TXT"), flat));
  }
}

TEST_CASE("points: lines without weights have no extra column; comments and mesh files are read") {
  const ScratchFolder folder;
  io::write_points(folder / "a.xyz", std::vector<WeightedPoint3>{{{1, 2, 3}, 0}, {{0.5, 0, -1}, 0}});
  CHECK(ScratchFolder::read(folder / "a.xyz") == "1 2 3\n0.5 0 -1\n");
  io::write_points(folder / "a.txt", std::vector<WeightedPoint2>{{{1, 2}, 3}, {{0.5, 0}, 0}});
  CHECK(ScratchFolder::read(folder / "a.txt") == "1 2 3\n0.5 0 0\n");
  folder.write("b.xyz", "# x y z w\r\n1 2 3\r\n\r\n4 5 6 7 # weighted\r\n");
  CHECK(equal(io::read_points3(folder / "b.xyz"), {{{1, 2, 3}, 0}, {{4, 5, 6}, 7}}));
}

TEST_CASE("points: each fault is named") {
  const ScratchFolder folder;
  const auto fault = [&](const char* name, const char* text) {
    const auto path = folder.write(name, text);
    const std::string message = complaint([&] { io::read_points3(path); });
    REQUIRE(message.starts_with(path.string()));
    return message.substr(path.string().size());
  };
  CHECK(fault("a.xyz", "1 2 3\n1 2\n") == ":2: a coordinate is missing");
  CHECK(fault("a.xyz", "1 2 3\n1 2 nan\n") == ":2: a coordinate is not a number (NaN)");
  CHECK(fault("a.xyz", "1 2 3 4 5\n") == ":1: '5' after 3 coordinates and a weight");
  CHECK(fault("a.xyz", "\n") == ": no points");
  CHECK(fault("a.xyz", "") == ": the file is empty");
  CHECK(fault("a.txt", "1 2\n") == ": points in space are kept in .xyz or .ply");
  CHECK(fault("a.csv", "1 2\n") == ": unknown extension '.csv' (points are .xyz, .ply or .txt)");
  CHECK(fault("a.ply", "1 2 3\n") == ":1: no PLY header ('ply' on the first line)");
  CHECK(complaint([&] {
          io::write_points(folder / "no" / "a.xyz", std::vector<WeightedPoint3>{{{1, 2, 3}, 0}});
        }) == "cannot write " + (folder / "no/a.xyz").string() + ": No such file or directory");
}
