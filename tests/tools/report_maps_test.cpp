#include "tools/report_maps.h"

#include <algorithm>

#include "doctest.h"
#include "fpo/measure/hausdorff.h"
#include "geom/check.h"
#include "geom/shapes/shapes.h"

namespace {

/// All facets from `first` on.
io::Scene picture_of(const geom::TriMesh& mesh, std::size_t first) {
  io::Scene scene;
  scene.places.assign(mesh.vertices().begin(), mesh.vertices().end());
  for (geom::FacetId t(first); t.index() < mesh.num_facets(); t = geom::FacetId(t.value + 1)) {
    io::SceneTriangle triangle{{}, mesh.normal(t)};
    for (std::size_t k = 0; k < 3; ++k)
      triangle.corners[k] = static_cast<std::uint32_t>(mesh.facet(t)[k].index());
    scene.triangles.push_back(triangle);
  }
  return scene;
}

}  // namespace

TEST_CASE("remesh_maps: red where the distance is largest and angles are small; labels in people's units") {
  const geom::TriMesh coarse = geom::make_shape("sphere", 3), fine = geom::make_shape("sphere", 20);
  for (const std::size_t first : {0, 7}) {
    const io::Scene picture = picture_of(coarse, first);
    const std::vector<io::Scene> maps = tools::remesh_maps(picture, coarse, {fine, 1000.0, 1});
    REQUIRE(maps.size() == 2);
    for (const io::Scene& map : maps) {
      REQUIRE(map.triangles.size() == picture.triangles.size());
      CHECK(map.scale.colours == map.palette);
      CHECK(map.scale.labels.size() == 3);
      for (std::size_t i = 0; i < map.triangles.size(); ++i) {
        CHECK(map.triangles[i].corners == picture.triangles[i].corners);
        CHECK(map.triangles[i].colour < map.palette.size());
      }
    }
    const double most = std::stod(maps[0].scale.labels.back());
    const fpo::SurfaceDistance distance = fpo::surface_distance(coarse, fine);
    CHECK(most <= 1001 * distance.max_bound);
    CHECK(most >= 900 * distance.max);
    // Large triangles of a coarse sphere are farther from it than small ones.
    const auto colour_of_area = [&](auto extreme) {
      const auto area = [&](std::size_t i) { return coarse.area(geom::FacetId(first + i)); };
      std::size_t found = 0;
      for (std::size_t i = 1; i < picture.triangles.size(); ++i)
        if (extreme(area(i), area(found))) found = i;
      return maps[0].triangles[found].colour;
    };
    CHECK(colour_of_area(std::greater<>()) >= colour_of_area(std::less<>()));
  }
}

TEST_CASE("remesh_maps: an equilateral triangle is blue, one of 20 degrees red") {
  const double h = std::sqrt(3.0) / 2;
  geom::Table<geom::VertexId, geom::Vec3> v;
  for (const geom::Vec3& p : {geom::Vec3(0, 0, 0), geom::Vec3(1, 0, 0), geom::Vec3(0.5, h, 0),
                              geom::Vec3(0.5, -0.5 * std::tan(0.35), 0)})
    v.push_back(p);
  geom::Table<geom::FacetId, geom::TriMesh::Facet> f;
  const auto id = [](int i) { return geom::VertexId(i); };
  f.push_back({id(0), id(1), id(2)});
  f.push_back({id(0), id(3), id(1)});
  const geom::TriMesh mesh(v, f);
  const std::vector<io::Scene> maps = tools::remesh_maps(picture_of(mesh, 0), mesh, {mesh, 1, 1});
  const io::Scene& angles = maps[1];
  const io::Colour blue = angles.palette[angles.triangles[0].colour],
                   red = angles.palette[angles.triangles[1].colour];
  CHECK(blue.blue > blue.red + 50);
  CHECK(red.red > red.blue + 50);
  CHECK(maps[0].triangles[0].colour == 0);
  CHECK(tools::remesh_maps({}, mesh, {mesh, 1, 1}).empty());
}
