#include "geom/regular/triangulation3.h"

#include <algorithm>
#include <utility>

#include "geom/check.h"
#include "geom/exact/pencil.h"
#include "geom/regular/facet_matcher.h"

namespace geom {

Triangulation3::Triangulation3(const Box3& around) : box(around) {
  require(!box.isEmpty() && box.min().allFinite() && box.max().allFinite(),
          "the box of a triangulation must be finite and not empty");
  // A box much smaller than its distance from the origin is surrounded as if it were 2^-20 of that, lest the
  // guards collapse in rounding; a single point at the origin as if it were of diagonal 1.
  const double magnitude = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  double unit = std::max(box.diagonal().norm(), 0x1p-20 * magnitude);
  if (unit == 0) unit = 1;
  points.resize(guard_count + 1);
  sites.resize(guard_count + 1);
  for (int k = 0; k < guard_count; ++k) {
    points[slot(guard(k))] = {guard_position(k, box.center(), unit), 0.0};
    site(guard(k)).state = State::visible;
  }
  triangulate_guards();
}

/// By the definition: those four of the eight whose orthosphere excludes the other four.
void Triangulation3::triangulate_guards() {
  FacetMatcher matcher;
  matcher.clear();
  const auto add_if_empty = [&](Simplex corner) {
    const int side = orientation(corner);
    if (side == 0) return;
    if (side < 0) std::swap(corner[0], corner[1]);
    const SimplexId t = create(corner);
    for (int k = 0; k < guard_count; ++k) {
      if (std::find(corner.begin(), corner.end(), guard(k)) != corner.end() || !in_conflict(t, guard(k)))
        continue;
      simplices.pop_back();
      change.created.pop_back();
      return;
    }
    for (int i = 0; i < 4; ++i) {
      const auto [a, b, c] = facet_corners(corner, i);
      const Facet twin(matcher.find_or_insert(a, b, c, Facet(t, i).code()));
      if (twin.valid()) glue({t, i}, twin);
    }
  };
  for (int a = 0; a < guard_count; ++a)
    for (int b = a + 1; b < guard_count; ++b)
      for (int c = b + 1; c < guard_count; ++c)
        for (int d = c + 1; d < guard_count; ++d) add_if_empty({guard(a), guard(b), guard(c), guard(d)});
  for (const SimplexId t : change.created) {
    for (const SiteId v : simplices[t].corner) site(v).simplex = t;
  }
  recent = change.created.front();
}

/// Those reachable from one of them through facets that contain v.
void Triangulation3::collect_star(SiteId v, std::vector<SimplexId>& out) const {
  const std::uint32_t seen = next_mark();
  out.push_back(site(v).simplex);
  simplices[out.back()].mark = seen;
  for (std::size_t k = out.size() - 1; k < out.size(); ++k) {
    const Tetrahedron& here = simplices[out[k]];
    for (int i = 0; i < 4; ++i) {
      const SimplexId next = here.mate[i].simplex();
      if (here.corner[i] == v || !next.valid() || simplices[next].mark == seen) continue;
      simplices[next].mark = seen;
      out.push_back(next);
    }
  }
}

/// A visibility walk: through any facet that separates it from x. Seen from
/// x, the tetrahedra of a regular triangulation are ordered without cycles (each step strictly lessens the
/// power of x to the orthosphere, infinitesimals included), so the walk ends whichever such facet is taken.
/// Guards' hull contains x strictly, so it never leaves.
SimplexId Triangulation3::locate(const Vec3& x, SimplexId start) const {
  SimplexId here = start, previous;
  for (;;) {
    const Tetrahedron& t = simplices[here];
    SimplexId next;
    for (int i = 0; i < 4 && !next.valid(); ++i) {
      if (!t.mate[i].valid() || t.mate[i].simplex() == previous) continue;
      const auto [a, b, c] = facet_corners(t.corner, i);
      if (orient3(point(a).position, point(b).position, point(c).position, x) < 0) next = t.mate[i].simplex();
    }
    if (!next.valid()) return here;
    previous = here;
    here = next;
  }
}

int Triangulation3::orientation(const Simplex& corner) const {
  return orient3(point(corner[0]).position, point(corner[1]).position, point(corner[2]).position,
                 point(corner[3]).position);
}

namespace {

/// Pencil::power_side of e with respect to the orthosphere of a positively oriented tetrahedron.
template <class Real>
int power_side(const WeightedPoint3& a, const WeightedPoint3& b, const WeightedPoint3& c,
               const WeightedPoint3& d, const WeightedPoint3& e) {
  const Pencil<Real> pencil(a, b, c);
  return pencil.power_side(pencil.place(d), pencil.place(e));
}

}  // namespace

bool Triangulation3::in_conflict(SimplexId t, SiteId e) const {
  const Simplex& corner = simplices[t].corner;
  const int first_guard =
      static_cast<int>(std::find_if(corner.begin(), corner.end(), is_guard) - corner.begin());
  const int apex = std::min(first_guard, 3);
  auto [a, b, c] = facet_corners(corner, apex);
  for (int turn = 0; turn < 2 && is_guard(a); ++turn) a = std::exchange(b, std::exchange(c, a));
  const SiteId d = corner[apex];
  int side = power_side<double>(point(a), point(b), point(c), point(d), point(e));
  if (side == 0) side = power_side<DoubleDouble>(point(a), point(b), point(c), point(d), point(e));
  if (side != 0) return side < 0;
  return conflicts3(ranked(a), ranked(b), ranked(c), ranked(d), ranked(e));
}

RegularChange Triangulation3::finish_change() {
  for (const SimplexId t : change.destroyed) {
    simplices[t].corner[0] = SiteId();
    free.push_back(t);
  }
  if (!change.created.empty()) recent = change.created.back();
  return change.view();
}

SimplexId Triangulation3::create(const Simplex& corner) {
  SimplexId t = simplices.next_id();
  if (free.empty()) {
    simplices.emplace_back();
  } else {
    t = free.back();
    free.pop_back();
  }
  simplices[t] = {corner, {}, SiteId(), 0};
  for (const SiteId v : corner) site(v).simplex = t;
  change.created.push_back(t);
  return t;
}

void Triangulation3::glue(Facet one, Facet other) {
  simplices[one.simplex()].mate[one.corner()] = other;
  if (other.valid()) simplices[other.simplex()].mate[other.corner()] = one;
}

std::uint32_t Triangulation3::next_mark() const {
  if (++mark != 0) return mark;
  for (const Tetrahedron& t : simplices) t.mark = 0;
  for (const Site& s : sites) s.mark = 0;
  return mark = 1;
}

void hide(Triangulation3& t, SiteId id, SimplexId witness) {
  Triangulation3::Site& s = t.site(id);
  SiteId& first = t.simplices[witness].first_hidden;
  s.simplex = witness;
  s.state = Triangulation3::State::hidden;
  s.previous_hidden = SiteId();
  s.next_hidden = first;
  if (first.valid()) t.site(first).previous_hidden = id;
  first = id;
}

void unhide(Triangulation3& t, SiteId id) {
  const Triangulation3::Site& s = t.site(id);
  if (s.next_hidden.valid()) t.site(s.next_hidden).previous_hidden = s.previous_hidden;
  if (s.previous_hidden.valid()) {
    t.site(s.previous_hidden).next_hidden = s.next_hidden;
  } else {
    t.simplices[s.simplex].first_hidden = s.next_hidden;
  }
}

void append_hidden(const Triangulation3& t, SimplexId witness, std::vector<SiteId>& out) {
  for (SiteId h = t.simplices[witness].first_hidden; h.valid(); h = t.site(h).next_hidden) out.push_back(h);
}

}  // namespace geom
