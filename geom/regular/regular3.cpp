#include "geom/regular/regular3.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geom/check.h"
#include "geom/exact/pencil.h"
#include "geom/regular/regular3_corners.h"

namespace geom {

namespace {

/// Eight corners of a cube of half side 16 about the box, each pushed outwards by up to 1/16 of that, all by
/// different amounts; the unit is the diagonal.
///
/// In the octant of signs s the guard g has s.g >= 48 while any other corner has s.g <= 2 * 17 - 16, so each
/// guard is a corner of the hull whatever the weights: it cannot be hidden. In any direction u some guard
/// reaches as far as the cube's corner, so the hull contains the cube and with it the box, strictly. And |g -
/// x| >= 16 sqrt(3) - 1 > 10 for x in the box.
Vec3 guard_position(int k, const Vec3& center, double unit) {
  Vec3 at;
  for (int axis = 0; axis < 3; ++axis) {
    const double golden = 0.6180339887498949 * (3 * k + axis + 1);
    const double reach = 16 + (golden - std::floor(golden));
    at[axis] = center[axis] + ((k >> axis & 1) ? reach : -reach) * unit;
  }
  return at;
}

}  // namespace

Regular3::Regular3(const Box3& box) : box_(box) {
  require(!box.isEmpty() && box.min().allFinite() && box.max().allFinite(),
          "the box of a triangulation must be finite and not empty");
  // A box much smaller than its distance from the origin is surrounded as if it were 2^-20 of that, lest the
  // guards collapse in rounding; a single point at the origin as if it were of diagonal 1.
  const double magnitude = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  double unit = std::max(box.diagonal().norm(), 0x1p-20 * magnitude);
  if (unit == 0) unit = 1;
  points_.resize(guard_count + 1);
  sites_.resize(guard_count + 1);
  for (int k = 0; k < guard_count; ++k) {
    points_[slot(guard(k))] = {guard_position(k, box.center(), unit), 0.0};
    site(guard(k)).state = State::visible;
  }
  triangulate_guards();
}

/// By the definition: those four of the eight whose orthosphere excludes the other four.
void Regular3::triangulate_guards() {
  const auto add_if_empty = [&](Simplex corner) {
    const int side = orientation(corner);
    if (side == 0) return;
    if (side < 0) std::swap(corner[0], corner[1]);
    const SimplexId t = create(corner);
    for (int k = 0; k < guard_count; ++k) {
      if (std::find(corner.begin(), corner.end(), guard(k)) != corner.end() || !in_conflict(t, guard(k)))
        continue;
      simplices_.pop_back();
      created_.pop_back();
      return;
    }
    for (int i = 0; i < 4; ++i) {
      const auto [a, b, c] = facet_corners(corner, i);
      const Facet twin(matcher_.find_or_insert(a, b, c, Facet(t, i).code()));
      if (twin.valid()) glue({t, i}, twin);
    }
  };
  matcher_.clear();
  for (int a = 0; a < guard_count; ++a)
    for (int b = a + 1; b < guard_count; ++b)
      for (int c = b + 1; c < guard_count; ++c)
        for (int d = c + 1; d < guard_count; ++d) add_if_empty({guard(a), guard(b), guard(c), guard(d)});
  for (const SimplexId t : created_) {
    for (const SiteId v : simplices_[t].corner) site(v).simplex = t;
  }
  recent_ = created_.front();
}

// --- queries -------------------------------------------------------------------------------------

bool Regular3::contains(SiteId id) const {
  return id.valid() && slot(id) < sites_.size() && site(id).state != State::absent;
}

bool Regular3::is_hidden(SiteId id) const { return contains(id) && site(id).state == State::hidden; }

void Regular3::link(SiteId id, std::vector<SiteId>& out) const {
  out.clear();
  ensure(contains(id), "link of a site that is not in the triangulation");
  if (is_hidden(id)) return;
  star_.clear();
  collect_star(id, star_);
  const std::uint32_t seen = next_mark();
  site(id).mark = seen;
  for (const SimplexId t : star_) {
    for (const SiteId v : simplices_[t].corner) {
      if (site(v).mark == seen) continue;
      site(v).mark = seen;
      if (v.valid()) out.push_back(v);
    }
  }
}

void Regular3::link_and_hidden(SiteId id, std::vector<SiteId>& out) const {
  link(id, out);
  if (is_hidden(id)) return;
  for (const SimplexId t : star_)
    for (SiteId h = simplices_[t].first_hidden; h.valid(); h = site(h).next_hidden) out.push_back(h);
}

std::vector<Regular3::Simplex> Regular3::simplices() const {
  std::vector<Simplex> live;
  for (const Tetrahedron& t : simplices_) {
    if (t.corner[0] != SiteId()) live.push_back(t.corner);
  }
  return live;
}

/// Appends all tetrahedra with corner v: those reachable from one of them through facets that contain v.
void Regular3::collect_star(SiteId v, std::vector<SimplexId>& out) const {
  const std::uint32_t seen = next_mark();
  out.push_back(site(v).simplex);
  simplices_[out.back()].mark = seen;
  for (std::size_t k = out.size() - 1; k < out.size(); ++k) {
    const Tetrahedron& here = simplices_[out[k]];
    for (int i = 0; i < 4; ++i) {
      const SimplexId next = here.mate[i].simplex();
      if (here.corner[i] == v || !next.valid() || simplices_[next].mark == seen) continue;
      simplices_[next].mark = seen;
      out.push_back(next);
    }
  }
}

/// A tetrahedron that contains x, by a visibility walk: through any facet that separates it from x. Seen from
/// x, the tetrahedra of a regular triangulation are ordered without cycles (each step strictly lessens the
/// power of x to the orthosphere, infinitesimals included), so the walk ends whichever such facet is taken.
/// Guards' hull contains x strictly, so it never leaves.
SimplexId Regular3::locate(const Vec3& x, SimplexId start) const {
  SimplexId here = start, previous;
  for (;;) {
    const Tetrahedron& t = simplices_[here];
    SimplexId next;
    for (int i = 0; i < 4 && !next.valid(); ++i) {
      if (!t.mate[i].valid() || t.mate[i].simplex() == previous) continue;
      const auto [a, b, c] = facet_corners(t.corner, i);
      if (orient3(position(a), position(b), position(c), x) < 0) next = t.mate[i].simplex();
    }
    if (!next.valid()) return here;
    previous = here;
    here = next;
  }
}

int Regular3::orientation(const Simplex& corner) const {
  return orient3(position(corner[0]), position(corner[1]), position(corner[2]), position(corner[3]));
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

bool Regular3::in_conflict(SimplexId t, SiteId e) const {
  const Simplex& corner = simplices_[t].corner;
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

// --- pieces of both updates ----------------------------------------------------------------------

void Regular3::begin_change() {
  destroyed_.clear();
  created_.clear();
  hidden_.clear();
  exposed_.clear();
  displaced_.clear();
  boundary_.clear();
  open_.clear();
  candidates_.clear();
}

/// Frees the destroyed; only now, so that no id is destroyed and created in one change.
Regular3::Change Regular3::finish_change() {
  for (const SimplexId t : destroyed_) {
    simplices_[t].corner[0] = SiteId();
    free_.push_back(t);
  }
  if (!created_.empty()) recent_ = created_.back();
  return {destroyed_, created_, hidden_, exposed_};
}

SimplexId Regular3::create(const Simplex& corner) {
  SimplexId t = simplices_.next_id();
  if (free_.empty()) {
    simplices_.emplace_back();
  } else {
    t = free_.back();
    free_.pop_back();
  }
  simplices_[t] = {corner, {}, SiteId(), 0};
  for (const SiteId v : corner) site(v).simplex = t;
  created_.push_back(t);
  return t;
}

/// Makes two tetrahedra neighbours across a facet. `other` may be none.
void Regular3::glue(Facet one, Facet other) {
  simplices_[one.simplex()].mate[one.corner()] = other;
  if (other.valid()) simplices_[other.simplex()].mate[other.corner()] = one;
}

int Regular3::corner_of(SimplexId t, SiteId v) const {
  const Simplex& corner = simplices_[t].corner;
  return static_cast<int>(std::find(corner.begin(), corner.end(), v) - corner.begin());
}

/// A mark that no tetrahedron and no site carries.
std::uint32_t Regular3::next_mark() const {
  if (++mark_ != 0) return mark_;
  for (const Tetrahedron& t : simplices_) t.mark = 0;
  for (const Site& s : sites_) s.mark = 0;
  return mark_ = 1;
}

void Regular3::hide(SiteId id, SimplexId witness) {
  Site& s = site(id);
  SiteId& first = simplices_[witness].first_hidden;
  s.simplex = witness;
  s.state = State::hidden;
  s.previous_hidden = SiteId();
  s.next_hidden = first;
  if (first.valid()) site(first).previous_hidden = id;
  first = id;
}

void Regular3::unlink_hidden(SiteId id) {
  const Site& s = site(id);
  if (s.next_hidden.valid()) site(s.next_hidden).previous_hidden = s.previous_hidden;
  if (s.previous_hidden.valid()) {
    site(s.previous_hidden).next_hidden = s.next_hidden;
  } else {
    simplices_[s.simplex].first_hidden = s.next_hidden;
  }
}

/// Moves the sites that the dying tetrahedron t witnesses to the displaced.
void Regular3::take_hidden_of(SimplexId t) {
  for (SiteId h = simplices_[t].first_hidden; h.valid(); h = site(h).next_hidden) displaced_.push_back(h);
}

// --- verification --------------------------------------------------------------------------------

void Regular3::check() const {
  std::size_t live = 0;
  for (SimplexId t(0); t < simplices_.next_id(); ++t.value) {
    if (simplices_[t].corner[0] == SiteId()) continue;
    ++live;
    check_simplex(t);
  }
  ensure(live + free_.size() == simplices_.size(), "regular3: a tetrahedron is neither live nor free");
  for (int k = 0; k < guard_count; ++k) check_site(guard(k));
  for (SiteId id(0); slot(id) < sites_.size(); ++id.value) check_site(id);
}

void Regular3::check_simplex(SimplexId t) const {
  const Tetrahedron& here = simplices_[t];
  ensure(orientation(here.corner) > 0, "regular3: a tetrahedron is not positively oriented");
  for (const SiteId v : here.corner) {
    ensure(is_guard(v) || contains(v), "regular3: a corner is not a site");
    ensure(site(v).state == State::visible, "regular3: a corner is hidden");
  }
  for (int i = 0; i < 4; ++i) {
    const auto [a, b, c] = facet_corners(here.corner, i);
    const SimplexId next = here.mate[i].simplex();
    if (!next.valid()) {
      ensure(is_guard(a) && is_guard(b) && is_guard(c), "regular3: a facet of the hull is not of guards");
      continue;
    }
    const int j = here.mate[i].corner();
    ensure(simplices_[next].mate[j] == Facet(t, i), "regular3: adjacency is not symmetric");
    for (const SiteId v : {a, b, c}) {
      const int k = corner_of(next, v);
      ensure(k < 4 && k != j, "regular3: neighbours do not share their facet");
    }
    ensure(!in_conflict(t, simplices_[next].corner[j]), "regular3: a facet is not locally regular");
  }
}

void Regular3::check_site(SiteId id) const {
  const Site& s = site(id);
  if (s.state == State::absent) return;
  const Simplex& corner = simplices_[s.simplex].corner;
  ensure(corner[0] != SiteId(), "regular3: a site refers to a freed tetrahedron");
  if (s.state == State::visible) {
    ensure(corner_of(s.simplex, id) < 4, "regular3: a site is no corner of its tetrahedron");
    return;
  }
  for (int i = 0; i < 4; ++i) {
    const auto [a, b, c] = facet_corners(corner, i);
    ensure(orient3(position(a), position(b), position(c), position(id)) >= 0,
           "regular3: a hidden site is outside its witness");
  }
  ensure(!in_conflict(s.simplex, id), "regular3: a hidden site conflicts with its witness");
  SiteId h = simplices_[s.simplex].first_hidden;
  while (h.valid() && h != id) h = site(h).next_hidden;
  ensure(h == id, "regular3: a witness does not list its hidden site");
}

}  // namespace geom
