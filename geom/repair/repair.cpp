#include "geom/repair/repair.h"

#include <cstdio>

#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/repair/clean.h"
#include "geom/repair/copies.h"
#include "geom/repair/dents.h"
#include "geom/repair/flat_facets.h"
#include "geom/repair/holes.h"
#include "geom/repair/orient.h"
#include "geom/repair/parts.h"
#include "geom/repair/repeated.h"
#include "geom/repair/spikes.h"
#include "geom/repair/split.h"
#include "geom/repair/t_junctions.h"
#include "geom/repair/weld.h"

namespace geom {
namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// A mesh in the unit box, step by step.
class Work {
 public:
  Work(const TriMesh& mesh, double factor)
      : vertices_(mesh.vertices()), facets_(mesh.facets()), factor_(factor) {}

  void run(const RepairSteps& steps) {
    if (steps.spikes) flatten();
    if (steps.weld)
      weld(*steps.weld < 0 ? usual_tolerance(vertices_, facets_) : factor_ * *steps.weld, steps.copies);
    if (steps.split) split(Fans::keep_open);
    if (steps.crumbs) drop_crumbs(*steps.crumbs);
    if (steps.orient) orient();
    if (steps.copies) drop_copies();
    if (steps.holes) fill_holes(*steps.holes);
    if (steps.dents) fill_dents();
    if (steps.split) split(Fans::split);
  }

  std::vector<std::string> lines;

  bool changed(const TriMesh& mesh) const { return mesh.vertices() != vertices_ || mesh.facets() != facets_; }

  /// The vertices that are used, in the file's unit.
  TriMesh take() {
    Table<VertexId, VertexId> name(vertices_.size());
    for (const TriMesh::Facet& f : facets_)
      for (const VertexId v : f) name[v] = VertexId(0);
    Table<VertexId, Vec3> used;
    for (VertexId v(0); v.index() < vertices_.size(); v = VertexId(v.value + 1)) {
      if (!name[v].valid()) continue;
      name[v] = used.next_id();
      used.push_back(vertices_[v] / factor_);
    }
    for (TriMesh::Facet& f : facets_)
      for (VertexId& v : f) v = name[v];
    return TriMesh(std::move(used), std::move(facets_));
  }

 private:
  void flatten() {
    const std::size_t count = flatten_spikes(vertices_, facets_);
    if (count > 0) lines.push_back("flattened " + counted(count, "spike", "spikes"));
  }

  void drop_faulty(const Places& places) {
    const std::size_t count = drop_collapsed(places, facets_) + drop_repeated(facets_);
    if (count > 0)
      lines.push_back("dropped " + counted(count, "facet", "facets") + " that collapsed or coincide");
  }

  /// `leave_copies`: what lies on another part goes later.
  void weld(double tolerance, bool leave_copies) {
    const Table<VertexId, Vec3>* vertices = leave_copies ? &vertices_ : nullptr;
    const Places places = near_places(vertices_, facets_, tolerance);
    drop_faulty(places);
    const std::size_t doubled = drop_doubled(places, facets_);
    if (doubled > 0) lines.push_back("dropped " + counted(doubled, "doubled facet", "doubled facets"));
    std::size_t pairs = weld_borders(places, facets_, Crowds::weld, vertices).pairs;
    const std::size_t cuts = zip_t_junctions(vertices_, facets_, tolerance);
    if (cuts > 0)
      pairs +=
          weld_borders(near_places(vertices_, facets_, tolerance), facets_, Crowds::weld, vertices).pairs;
    if (pairs > 0) lines.push_back("welded " + counted(pairs, "pair", "pairs") + " of border edges");
    if (cuts > 0) lines.push_back("zipped " + counted(cuts, "T-junction", "T-junctions"));
    drop_faulty(exact_places(vertices_));
    const Flattening flat = mend_flat(vertices_, facets_);
    if (flat.dropped + flat.flipped > 0)
      lines.push_back("removed " + counted(flat.dropped + flat.flipped, "facet", "facets") + " without area");
  }

  void split(Fans fans) {
    const Splitting done = split_sheets(vertices_, facets_, fans);
    if (done.edges + done.vertices == 0) return;
    const std::string where =
        done.edges > 0 ? counted(done.edges, "non-manifold edge", "non-manifold edges") : "vertices";
    lines.push_back("split " + where + ", " + counted(done.vertices, "new vertex", "new vertices"));
  }

  void drop_crumbs(double share) {
    CrumbLimits limits;
    if (share >= 0) limits = {share, share, 0, 1};
    const std::size_t before = facets_.size(), parts = geom::drop_crumbs(vertices_, facets_, limits);
    if (parts > 0)
      lines.push_back("dropped " + counted(parts, "crumb", "crumbs") + " of " +
                      counted(before - facets_.size(), "facet", "facets"));
  }

  void orient() {
    const Orientation done = geom::orient(vertices_, facets_);
    if (done.turned > 0) lines.push_back("turned " + counted(done.turned, "facet", "facets"));
    if (done.one_sided > 0)
      lines.push_back(counted(done.one_sided, "part is", "parts are") + " one-sided and cannot be oriented");
  }

  void drop_copies() {
    const double distance = usual_copy_distance * diagonal();
    const std::size_t parts = geom::drop_copies(vertices_, facets_, distance);
    if (parts > 0)
      lines.push_back("dropped " + counted(parts, "part that lies", "parts that lie") + " on another");
  }

  double diagonal() const {
    Box3 box;
    for (const TriMesh::Facet& f : facets_)
      for (const VertexId v : f) box.extend(vertices_[v]);
    return facets_.empty() ? 0 : box.diagonal().norm();
  }

  void fill_holes(double length) {
    const double area = area_of(mesh_parts(vertices_, facets_));
    HoleLimits limits{factor_ * length, 0};
    if (length < 0) limits = usual_holes(diagonal(), area);
    const HoleFilling done = geom::fill_holes(vertices_, facets_, limits);
    if (done.filled > 0)
      lines.push_back("filled " + counted(done.filled, "hole", "holes") + " with " +
                      counted(done.facets, "facet", "facets") + " and " +
                      counted(done.vertices, "new vertex", "new vertices"));
    if (done.left > 0) {
      char longest[40];
      std::snprintf(longest, sizeof longest, "%.6g", done.longest_left / factor_);
      lines.push_back("left " + counted(done.left, "border", "borders") + " open, the longest of length " +
                      longest);
    }
  }

  void fill_dents() {
    const std::size_t dents = geom::fill_dents(vertices_, facets_, {});
    if (dents > 0) lines.push_back("filled " + counted(dents, "dent in a border", "dents in borders"));
  }

  Table<VertexId, Vec3> vertices_;
  Table<FacetId, TriMesh::Facet> facets_;
  double factor_;
};

}  // namespace

RepairSteps all_steps() { return {-1, true, -1, true, true, -1, true, true}; }

Repaired repaired(const TriMesh& mesh, const RepairSteps& steps) {
  const double factor = factor_to_unit_box(mesh);
  Table<FacetId, TriMesh::Facet> facets = mesh.facets();
  const std::size_t walls = steps.split ? drop_walls(facets) : 0;
  require(!facets.empty(), "nothing is left of the surface when it is repaired");
  const Cleaned clean = cleaned(walls > 0 ? TriMesh(mesh.vertices(), std::move(facets)) : mesh);
  const TriMesh unit = scaled(clean.mesh, factor);
  Work work(unit, factor);
  if (walls > 0)
    work.lines.push_back("dropped " + counted(walls, "facet", "facets") + " between bodies welded together");
  if (clean.done.any()) work.lines.push_back(in_words(clean.done));
  work.run(steps);
  if (walls == 0 && !clean.done.any() && !work.changed(unit)) return {mesh, std::move(work.lines)};
  Repaired result{work.take(), std::move(work.lines)};
  require(result.mesh.num_facets() > 0, "nothing is left of the surface when it is repaired");
  return result;
}

}  // namespace geom
