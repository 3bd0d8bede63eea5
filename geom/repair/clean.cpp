#include "geom/repair/clean.h"

#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/repair/flat_facets.h"
#include "geom/repair/parts.h"
#include "geom/repair/repeated.h"
#include "geom/repair/weld.h"

namespace geom {
namespace {

void append(std::string& text, std::size_t count, const std::string& before, const std::string& one,
            const std::string& many) {
  if (count == 0) return;
  text += (text.empty() ? "" : ", ") + before + std::to_string(count) + " " + (count == 1 ? one : many);
}

/// `mesh`: in the unit box.
Cleaning clean(const TriMesh& mesh, Table<FacetId, TriMesh::Facet>& facets) {
  Cleaning done;
  const Places places = exact_places(mesh.vertices());
  done.flat = drop_collapsed(places, facets);
  done.repeated = drop_repeated(facets);
  done.doubled = drop_doubled(places, facets);
  const Welding welding = weld_borders(places, facets, Crowds::leave);
  done.welded = welding.pairs + weld_rounded(mesh.vertices(), facets).pairs;
  done.crowded = welding.crowded;
  done.repeated += drop_repeated(facets);
  const Flattening flat = mend_flat(mesh.vertices(), facets);
  done.flat += flat.dropped + flat.flipped;
  done.hanging = drop_hanging_crumbs(mesh.vertices(), facets);
  return done;
}

}  // namespace

std::string in_words(const Cleaning& done) {
  std::string text;
  append(text, done.welded, "welded ", "pair of border edges", "pairs of border edges");
  append(text, done.repeated, "dropped ", "repeated facet", "repeated facets");
  append(text, done.doubled, "dropped ", "doubled facet", "doubled facets");
  append(text, done.flat, "removed ", "facet without area", "facets without area");
  append(text, done.hanging, "dropped ", "crumb that hangs on vertices", "crumbs that hang on vertices");
  return text;
}

Cleaned cleaned(const TriMesh& mesh) {
  double factor = 1;
  try {
    factor = factor_to_unit_box(mesh);
  } catch (const InputError&) {  // who computes with it will say so
    return {mesh, {}};
  }
  Table<FacetId, TriMesh::Facet> facets = mesh.facets();
  const Cleaning done = clean(scaled_to_unit_box(mesh, factor), facets);
  if (!done.any() || facets.empty()) return {mesh, {}};
  return {TriMesh(mesh.vertices(), std::move(facets)), done};
}

}  // namespace geom
