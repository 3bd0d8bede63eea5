#include "fpo/features/curve_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "geom/check.h"

namespace fpo {

using geom::Vec3;

// With h = h0 + (h1 - h0) u on a piece of size L the length up to the share u is L times the integral of 1/h,
// L log(h / h0) / (h1 - h0) = L u / h0 * log(1 + x) / x with x = u (h1 - h0) / h0.
double CurveMetric::Piece::length_to(double share) const {
  const double x = share * (h_to - h_from) / h_from;
  return scale() * share / h_from * (std::abs(x) < 1e-8 ? 1 - x / 2 : std::log1p(x) / x);
}

double CurveMetric::Piece::share_at(double t) const {
  const double size = scale();
  if (!(size > 0)) return 0;
  const double y = t * (h_to - h_from) / size;  // log of h / h0
  const double share = t * h_from / size * (std::abs(y) < 1e-8 ? 1 + y / 2 : std::expm1(y) / y);
  return std::clamp(share, 0.0, 1.0);
}

CurveMetric::CurveMetric(const geom::TriMesh& mesh, const FeatureCurve& curve, const Sizing& sizing)
    : up_to_{0} {
  for (std::size_t i = 0; i < curve.facets.size(); ++i) {
    const geom::VertexId a = curve.vertices[i], b = curve.vertices[(i + 1) % curve.vertices.size()];
    pieces_.push_back({mesh.position(a), mesh.position(b), sizing.at(a), sizing.at(b), curve.facets[i]});
    up_to_.push_back(up_to_.back() + pieces_.back().length_to(1));
  }
}

SurfaceSample CurveMetric::at(double t) const {
  const auto after = std::ranges::upper_bound(up_to_, t);
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - up_to_.begin() - 1, 0, std::ssize(pieces_) - 1));
  const Piece& piece = pieces_[i];
  const double u = piece.share_at(t - up_to_[i]);
  const Vec3 x = u == 1 ? piece.to : Vec3(piece.from + u * (piece.to - piece.from));
  return {x.cwiseMax(piece.from.cwiseMin(piece.to)).cwiseMin(piece.from.cwiseMax(piece.to)), piece.facet};
}

CurveMetric::Nearest CurveMetric::nearest(const Vec3& x) const {
  Nearest best{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    const Vec3 along = piece.to - piece.from;
    const double size2 = along.squaredNorm();
    const double u = size2 > 0 ? std::clamp((x - piece.from).dot(along) / size2, 0.0, 1.0) : 0;
    const double distance2 = (piece.from + u * along - x).squaredNorm();
    if (distance2 < best.distance2) best = {up_to_[i] + piece.length_to(u), distance2};
  }
  return best;
}

CurveDomain::CurveDomain(double length, bool loop, std::vector<double> positions)
    : length_(length), loop_(loop), positions_(positions.begin(), positions.end()) {
  geom::ensure(!positions.empty() && length > 0, "a curve without length or samples cannot be optimized");
  std::vector<SiteId> ring;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    geom::ensure(positions[i] >= 0 && positions[i] <= length, "a sample is not on its curve");
    ring.emplace_back(i);
  }
  std::ranges::sort(ring, {}, [&](SiteId x) { return std::pair(positions_[x], x); });
  if (!loop) ring.insert(ring.begin(), start());
  next_.resize(positions.size() + 1), previous_.resize(positions.size() + 1);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const SiteId next = ring[(i + 1) % ring.size()];
    next_[ring[i]] = next, previous_[next] = ring[i];
  }
  for (const SiteId x : ring) refresh(x);
}

double CurveDomain::gap_after(SiteId x) const {
  const SiteId y = next_[x];
  if (!loop_ && y == start()) return length_ - place(x);
  const double gap = place(y) - place(x);
  return x == y ? length_ : gap < 0 ? gap + length_ : gap;
}

void CurveDomain::refresh(SiteId x) {
  const CircleId gap(x.value);
  if (gaps_.contains(gap))
    gaps_.update(gap, radius2(x));
  else
    gaps_.push(gap, radius2(x));
}

double CurveDomain::separation(SiteId x) {
  if (next_[x] == x) return std::numeric_limits<double>::infinity();
  const double d = std::min(gap_after(x), gap_after(previous_[x]));
  return d * d;
}

void CurveDomain::remove(SiteId x) {
  removed_separation_ = separation(x);
  before_removed_ = previous_[x];
  next_[previous_[x]] = next_[x], previous_[next_[x]] = previous_[x];
  gaps_.erase(CircleId(x.value));
  if (before_removed_ == x)
    before_removed_ = SiteId();
  else
    refresh(before_removed_);
}

Circle CurveDomain::largest_empty(Scope scope) {
  if (gaps_.empty()) return {-std::numeric_limits<double>::infinity(), CircleId()};
  if (scope == Scope::global) return {gaps_.top().key, gaps_.top().slot};
  Circle best{-std::numeric_limits<double>::infinity(), CircleId()};
  for (const SiteId x : {before_removed_, previous_[before_removed_], next_[before_removed_]})
    if (radius2(x) > best.radius2) best = {radius2(x), CircleId(x.value)};
  return best;
}

void CurveDomain::insert_at(SiteId x, const Circle& c) {
  before_removed_ = SiteId(c.id.value);
  double middle = place(before_removed_) + gap_after(before_removed_) / 2;
  if (loop_ && middle >= length_) middle -= length_;
  positions_[x] = middle;
  put_back(x);
}

void CurveDomain::put_back(SiteId x) {
  const SiteId before = before_removed_.valid() ? before_removed_ : x;
  const SiteId after = before == x ? x : next_[before];
  next_[before] = x, previous_[x] = before;
  next_[x] = after, previous_[after] = x;
  refresh(before), refresh(x);
}

double CurveDomain::normalized_spacing(SiteId x) {
  return std::sqrt(separation(x)) * static_cast<double>(positions_.size() + (loop_ ? 0 : 1)) / length_;
}

void CurveDomain::neighbours(SiteId x, std::vector<SiteId>& out) {
  out.clear();
  for (const SiteId y : {previous_[x], next_[x]})
    if (y != start() && y != x) out.push_back(y);
}

void CurveDomain::check() const {
  gaps_.check();
  double sum = 0;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const SiteId x(i);
    geom::ensure(previous_[next_[x]] == x && next_[previous_[x]] == x, "curve: the ring is broken");
    geom::ensure(gaps_.key(CircleId(x.value)) == radius2(x), "curve: a gap is not what it was");
    sum += gap_after(x);
  }
  if (!loop_) sum += gap_after(start());
  geom::ensure(std::abs(sum - length_) <= 1e-9 * length_, "curve: the gaps do not add up");
}

}  // namespace fpo
