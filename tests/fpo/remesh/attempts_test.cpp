// Which of several remeshes is kept.

#include "fpo/remesh/attempts.h"

#include <memory>

#include "doctest.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/cage.h"

using namespace fpo;

namespace {

RemeshResult measured(bool right_type, double theta_min, std::size_t broken) {
  RemeshResult result;
  result.type.bare_samples = right_type ? 0 : 1;
  result.measures.theta_min = theta_min;
  result.feature_edges = 200;
  result.broken_feature_edges = broken;
  return result;
}

}  // namespace

TEST_CASE("attempts: the type comes first, a tenth of the edges weighs as much as all angles") {
  CHECK(measured(true, 40, 0).type.ok());
  CHECK(!measured(false, 40, 0).type.ok());
  CHECK(is_better(measured(true, 1, 100), measured(false, 40, 0)));
  CHECK(is_better(measured(true, 5, 0), measured(true, 12, 50)));  // a quarter of the edges lost
  CHECK(is_better(measured(true, 28, 5), measured(true, 1, 0)));   // few of them
  CHECK(is_better(measured(true, 31, 0), measured(true, 40, 1)));  // angles above 30 are all good,
  CHECK(
      is_better(measured(true, 40, 0), measured(true, 31, 0)));  // and the better for it if all else is equal
  CHECK(!is_better(measured(true, 31, 1), measured(true, 31, 1)));
}

TEST_CASE(
    "attempts: what there is instead counts where it is better, a right diagram before it unless all is "
    "well") {
  const auto with_resort = [](RemeshResult result, const RemeshResult& instead) {
    result.last_resort = std::make_shared<const RemeshResult>(instead);
    return result;
  };
  const RemeshResult right = measured(true, 20, 0), wrong = measured(false, 40, 0);
  const RemeshResult saved = with_resort(wrong, measured(true, 31, 0));
  const RemeshResult helped = with_resort(wrong, measured(true, 25, 0));
  CHECK(&as_it_will_be(right) == &right);
  CHECK(&as_it_will_be(saved) == saved.last_resort.get());
  const RemeshResult worse = with_resort(right, measured(true, 10, 0));
  CHECK(&as_it_will_be(worse) == &worse);
  CHECK(is_better_in_the_end(saved, right));
  CHECK(is_better_in_the_end(right, helped));
  CHECK(is_better_in_the_end(helped, wrong));
  CHECK(is_better_in_the_end(measured(true, 32, 0), saved));
  CHECK(!is_better_in_the_end(right, right));
}

TEST_CASE("attempts: hundreds of small angles are worse than one that is smaller") {
  RemeshResult one = measured(true, 17, 0), hundreds = measured(true, 20, 0);
  for (RemeshResult* r : {&one, &hundreds}) r->mesh = geom::make_shape("sphere", 10);
  const std::size_t facets = one.mesh.num_facets();
  CHECK(is_better(hundreds, one));
  one.measures.angles_below_30 = 1;
  hundreds.measures.angles_below_30 = facets / 8;
  CHECK(is_better(one, hundreds));
  hundreds.measures.angles_below_30 = 2;
  CHECK(is_better(hundreds, one));
}

TEST_CASE("attempts: of two remeshes of another type that with fewer faults and edges lost is better") {
  RemeshResult few = measured(false, 5, 2), many = measured(false, 30, 0);
  few.advice.places.resize(3);
  many.advice.places.resize(6);
  CHECK(is_better(few, many));
  CHECK(!is_better(many, few));
  CHECK(is_better(measured(true, 1, 100), few));
  few.broken_feature_edges = 3;
  CHECK(is_better(many, few));
}

TEST_CASE("attempts: creases are given up for the type, or if neither has it for half of the faults") {
  RemeshResult few = measured(false, 5, 0), many = measured(false, 30, 0);
  few.advice.places.resize(3);
  many.advice.places.resize(7);
  CHECK(is_worth_creases(few, many));
  CHECK(!is_worth_creases(many, few));
  many.advice.places.resize(6);
  CHECK(!is_worth_creases(few, many));
  many.advice.places.clear();
  CHECK(is_worth_creases(measured(true, 5, 0), many));
  CHECK(!is_worth_creases(few, measured(true, 5, 0)));
}

TEST_CASE("attempts: creases spoil what is at fault in many places, if they have many samples") {
  RemeshResult spoilt = measured(false, 5, 0);
  spoilt.samples.resize(4000);
  spoilt.advice.places.resize(20);
  spoilt.feature_samples = 1001;
  spoilt.crease_edges = 101;
  CHECK(is_spoilt_by_creases(spoilt));
  const auto is_spoilt_with = [&](auto change) {
    RemeshResult other = spoilt;
    change(other);
    return is_spoilt_by_creases(other);
  };
  CHECK(!is_spoilt_with([](RemeshResult& r) { r.advice.places.resize(19); }));
  CHECK(!is_spoilt_with([](RemeshResult& r) { r.feature_samples = 1000; }));
  CHECK(!is_spoilt_with([](RemeshResult& r) { r.crease_edges = 100; }));  // borders are kept anyway
  CHECK(!is_spoilt_with([](RemeshResult& r) { r.type.bare_samples = 0; }));
  CHECK(!is_spoilt_with([](RemeshResult& r) { r.staggered_curves = 1; }));
  CHECK(!is_spoilt_with([](RemeshResult& r) { r.feature_samples = 2001, r.broken_feature_edges = 1; }));
  const auto is_small_spoilt = [&](std::size_t places) {
    return is_spoilt_with([&](RemeshResult& r) { r.samples.resize(400), r.advice.places.resize(places); });
  };
  CHECK(is_small_spoilt(10));
  CHECK(!is_small_spoilt(9));
}

TEST_CASE(
    "attempts: curves are in pieces where the type is wrong, angles small, and edges lost or most small") {
  RemeshResult result = measured(false, 5, 51);
  result.mesh = geom::make_shape("sphere", 6);
  result.crease_edges = 100;
  const std::size_t facets = result.mesh.num_facets();
  result.measures.angles_below_30 = facets / 10 + 1;
  CHECK(is_in_pieces(result));
  const auto is_with = [&](auto change) {
    RemeshResult other = result;
    change(other);
    return is_in_pieces(other);
  };
  CHECK(!is_with([](RemeshResult& r) { r.type.bare_samples = 0; }));
  CHECK(!is_with([](RemeshResult& r) { --r.measures.angles_below_30; }));
  CHECK(!is_with([](RemeshResult& r) { r.broken_feature_edges = 50; }));
  CHECK(!is_with([](RemeshResult& r) { r.crease_edges = 0; }));
  CHECK(is_with([=](RemeshResult& r) {
    r.broken_feature_edges = 0;
    r.measures.angles_below_30 = facets / 2 + 1;
  }));
}

TEST_CASE("attempts: without creases 10 degrees do instead of pieces, 30 instead of others") {
  RemeshResult pieces = measured(false, 5, 51);
  pieces.mesh = geom::make_shape("sphere", 6);
  pieces.crease_edges = 100;
  pieces.measures.angles_below_30 = pieces.mesh.num_facets() / 10 + 1;
  RemeshResult whole = pieces;
  whole.broken_feature_edges = 50;
  for (const double theta : {9.0, 11.0, 29.0, 31.0}) {
    CAPTURE(theta);
    CHECK(is_instead_of(pieces, measured(true, theta, 0)) == (theta > 10));
    CHECK(is_instead_of(whole, measured(true, theta, 0)) == (theta > 30));
    CHECK(!is_instead_of(pieces, measured(false, theta, 0)));
    CHECK(!is_instead_of(whole, measured(false, theta, 0)));
  }
}

TEST_CASE("attempts: small angles are few up to one for a hundred triangles, with the type and all edges") {
  RemeshResult result = measured(true, 20, 0);
  result.mesh = geom::make_shape("sphere", 10);
  result.measures.angles_below_30 = result.mesh.num_facets() / 100;
  CHECK(has_few_small_angles(result));
  ++result.measures.angles_below_30;
  CHECK(!has_few_small_angles(result));
  result.measures.angles_below_30 = 1;
  CHECK(has_few_small_angles(result));
  result.corner_angle = 20;  // the input's own
  CHECK(!has_few_small_angles(result));
  result = measured(true, 31, 0);
  CHECK(!has_few_small_angles(result));
  result = measured(true, 20, 1);
  CHECK(!has_few_small_angles(result));
}

TEST_CASE("attempts: more rounds for thin parts where the type is wrong and few faults are left") {
  RemeshResult result = measured(false, 30, 0);
  CHECK(!may_have_room(result));
  for (const std::size_t faults : {1, 12, 13}) {
    result.thin_parts.faults_after = faults;
    CHECK(may_have_room(result) == (faults < 13));
  }
  result.type = {};
  result.thin_parts.faults_after = 1;  // mended afterwards
  CHECK(!may_have_room(result));
}

TEST_CASE("attempts: small angles are many from one for ten triangles on, and only creases are to blame") {
  RemeshResult result = measured(true, 15, 0);
  result.mesh = geom::make_shape("sphere", 4);
  result.crease_edges = 1;
  result.measures.angles_below_30 = result.mesh.num_facets() / 10;
  CHECK(!has_many_small_angles(result));
  ++result.measures.angles_below_30;
  CHECK(has_many_small_angles(result));
  result.crease_edges = 0;
  CHECK(!has_many_small_angles(result));
}

TEST_CASE("attempts: fine is what has it all; corners or lost edges alone leave it useful") {
  CHECK(is_fine(measured(true, 30, 0)));
  for (const RemeshResult& r : {measured(false, 30, 0), measured(true, 29.9, 0), measured(true, 30, 1)})
    CHECK(!is_fine(r));
  RemeshResult wedge = measured(true, 15, 0);
  wedge.corner_angle = 15;  // a part has what corners it has
  CHECK(is_fine(wedge));
  wedge.finish.last_angles.mended = 20;  // nothing else would have larger angles
  CHECK(is_fine(wedge));
  wedge.corner_angle = 31;
  wedge.measures.theta_min = 30;
  CHECK(!is_fine(wedge));
  wedge.corner_angle = 15;
  wedge.finish.last_angles.mended = 0;
  wedge.measures.theta_min = 14;
  CHECK(!is_fine(wedge));
  CHECK(!is_useful(measured(true, 8, 0)));
  CHECK(!is_useless(measured(true, 8, 0)));
  CHECK(is_useless(measured(true, 4, 0)));
  CHECK(is_useless(measured(true, 8, 1)));
  CHECK(is_useless(measured(false, 40, 0)));
  wedge.measures.theta_min = wedge.corner_angle = 2;
  CHECK(is_useful(wedge));
  CHECK(!is_useless(wedge));
  wedge.broken_feature_edges = 1;
  CHECK(!is_useful(wedge));
  RemeshResult noisy = measured(true, 31, 0);
  noisy.finish.last_angles.mended = 1;
  noisy.mesh = geom::make_shape("sphere", 40);
  CHECK(noisy.mesh.num_vertices() > 1000);
  CHECK(!is_fine(noisy));
  noisy.feature_edges = 0;
  CHECK(is_fine(noisy));
  noisy.finish.last_angles.mended = noisy.mesh.num_vertices();
  CHECK(!is_fine(noisy));
  CHECK(has_wanted_angles(noisy));  // whatever was mended for it
  noisy.measures.theta_min = 29.9;
  CHECK(!has_wanted_angles(noisy));
  CHECK(!has_wanted_angles(measured(true, 31, 1)));
  CHECK(!has_wanted_angles(measured(false, 31, 0)));
  CHECK(is_useful(measured(true, 12, 50)));
  CHECK(!is_useful(measured(true, 2, 1)));
  CHECK(!is_useful(measured(false, 40, 0)));
}

TEST_CASE(
    "attempts: hopeless is what is at fault at every tenth sample; before there is a mesh, as many faults") {
  RemeshResult result = measured(false, 0, 0);
  result.mesh = geom::make_shape("cube");
  result.samples.resize(50);
  result.advice.places.resize(5);
  CHECK(!is_hopeless(result));
  result.advice.places.resize(6);
  CHECK(is_hopeless(result));
  result.type.bare_samples = 0;
  CHECK(!is_hopeless(result));
  RemeshResult begun;
  begun.samples.resize(50);
  begun.thin_parts.faults_before = 5;
  CHECK(!is_hopeless(begun));
  begun.thin_parts.faults_before = 6;
  CHECK(is_hopeless(begun));
}

TEST_CASE("attempts: in ruins is what is at fault at more than every tenth sample when room was made") {
  RemeshResult result = measured(false, 0, 0);
  result.samples.resize(50);
  result.thin_parts.faults_before = 40;
  result.thin_parts.faults_after = 5;
  CHECK(!is_in_ruins(result));
  result.thin_parts.faults_after = 6;
  CHECK(is_in_ruins(result));
  result.type.bare_samples = 0;
  CHECK(!is_in_ruins(result));
}

TEST_CASE(
    "attempts: left behind is what has far more faults than there were, and more than few, with room made") {
  RemeshResult rival = measured(true, 30, 0);
  rival.thin_parts.faults_after = 12;
  ThinParts parts;
  parts.faults_after = 25;
  CHECK(is_left_behind(parts, 2000, rival));
  CHECK(!is_left_behind(parts, 2500, rival));  // a hundredth
  parts.faults_after = 24;
  CHECK(!is_left_behind(parts, 2000, rival));  // not more than twice as many
  parts.faults_after = 1000;
  parts.right_type = true;
  CHECK(!is_left_behind(parts, 2000, rival));
  CHECK(!is_left_behind(ThinParts(), 2000, rival));  // not looked at
}

TEST_CASE("attempts: past mending is what has more than 20 faults, and in a hundredth of the samples") {
  ThinParts parts;
  parts.faults_after = 21;
  CHECK(is_past_mending(parts, 2000));
  CHECK(!is_past_mending(parts, 2100));
  parts.right_type = true;
  CHECK(!is_past_mending(parts, 2000));
  parts = {};
  parts.faults_after = 20;
  CHECK(!is_past_mending(parts, 50));
  CHECK(!is_past_mending(ThinParts(), 50));  // not looked at
}

TEST_CASE("attempts: without staggered samples it is tried if the type is wrong or most edges are lost") {
  RemeshResult result = measured(false, 30, 0);
  CHECK(!is_undone_by_staggering(result));
  result.staggered_curves = 1;
  CHECK(is_undone_by_staggering(result));
  result = measured(true, 30, 101);
  CHECK(!is_undone_by_staggering(result));
  result.staggered_curves = 1;
  CHECK(is_undone_by_staggering(result));
  result.broken_feature_edges = 100;
  CHECK(!is_undone_by_staggering(result));
}

TEST_CASE("attempts: a mesh by collapses that leaves parts out is worse than one with small angles") {
  RemeshResult whole = measured(true, 5, 1), part = measured(true, 20, 0);
  CHECK(is_better(part, whole));
  part.measures.greatest_edge = 16;
  whole.measures.greatest_edge = 3;
  CHECK(is_better(part, whole));  // of a diagram: as it is
  part.by_collapses = whole.by_collapses = true;
  CHECK(is_better(whole, part));
  part.measures.greatest_edge = 3;
  CHECK(is_better(part, whole));
  part.measures.theta_min = 0;  // two samples at the same place
  whole.measures.theta_min = 0.1;
  CHECK(is_better(whole, part));
}

TEST_CASE("attempts: a comb is of its type where staggered samples spoil it") {
  RemeshOptions options = default_options(1100, SizingKind::uniform);
  options.improve_fidelity = false;
  options.features->yielding = false;
  const RemeshResult result = remesh(geom::make_shape("comb"), options);
  CHECK(result.type.ok());
  CHECK(result.staggered_curves == 0);
  CHECK(result.crease_curves == 144);
  CHECK(result.broken_feature_edges == 0);
  CHECK(result.mesh.num_vertices() == 1100);
}

TEST_CASE("attempts: on bars samples face each other where edges are lost, wherever faults are") {
  RemeshResult result = measured(false, 40, 1);
  result.samples.resize(500);
  result.feature_samples = 251;
  CHECK(may_be_faced(result));
  result.feature_samples = 250;
  CHECK(!may_be_faced(result));
  result = measured(false, 40, 0);
  CHECK(!may_be_faced(result));
  const geom::TriMesh bars = fixtures::cage(3, 0.05);
  for (const std::size_t n : {500u, 900u}) {
    CAPTURE(n);
    RemeshOptions options = default_options(n, SizingKind::uniform);
    options.features = automatic_features();
    options.optimize.max_iterations = 10;
    const RemeshResult remeshed = remesh(bars, options);
    CHECK(remeshed.type.ok());
    CHECK(remeshed.broken_feature_edges == 0);
    CHECK(remeshed.samples.size() == n);
  }
}
