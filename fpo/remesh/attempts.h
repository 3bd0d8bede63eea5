#pragma once
// Which of several remeshes of one surface is kept, where there are ways to choose from: sheets together or
// apart, samples of close curves facing each other or staggered or not, creases kept or not.

#include <string>

#include "fpo/remesh/pipeline.h"

namespace fpo {

/// Of the input's type, with all edges of curves, and no angle below 30 degrees or, if that is less, the
/// smallest between features of the input.
bool has_wanted_angles(const RemeshResult& result);

/// The same, and either a corner of the input is the smallest angle, which nothing can better, or nothing was
/// mended on the mesh for it (without features one flip or move in a thousand samples may be: no sheets are
/// to blame for it): nothing else is tried.
bool is_fine(const RemeshResult& result);

/// Of the input's type, and no angle below 10 degrees or, if all edges of curves are there, the smallest
/// between features of the input: a part has what corners it has. Else it is tried with fewer creases.
bool is_useful(const RemeshResult& result);

/// Not of the input's type, or with angles below 10 degrees and without some edges of curves, or below 5 and
/// the smallest between features: then no crease at all is better.
bool is_useless(const RemeshResult& result);

/// Of another type in so many places, two wanted lengths from each other, that they make a tenth of the
/// samples, which is a third of the surface; or, before there is a mesh, with as many faults: what helps
/// single places is not tried.
bool is_hopeless(const RemeshResult& result);

/// Without some edges of curves where most samples are on curves: on bars, say. Samples that face each other
/// may help, wherever faults are.
bool may_be_faced(const RemeshResult& result);

/// Of another type with more than a tenth of the samples at fault, even after room was made for them: no
/// other sheets or lengths are tried with the same curves. Samples that face each other may help still.
bool is_in_ruins(const RemeshResult& result);

/// Of another type in many places, one for two hundred samples and ten at least, where a quarter of the
/// samples are on curves, most of these creases, and neither facing nor staggered samples are to blame: no
/// other way with the same creases is tried.
bool is_spoilt_by_creases(const RemeshResult& result);

/// Of the type, with all edges of curves, and small angles that one more try may do without: at most one for
/// a hundred triangles.
bool has_few_small_angles(const RemeshResult& result);

/// Of another type, with many small angles, and without a fourth of the edges of curves or with such an angle
/// for two triangles.
bool is_in_pieces(const RemeshResult& result);

/// Is the first remesh with creases, of another type and with many small angles, given up for one without, so
/// that other ways with them are not tried? This is to have the wanted angles; if that one is in pieces it is
/// only to be useful.
bool is_instead_of(const RemeshResult& first, const RemeshResult& without);

/// With creases, and an angle below 30 degrees for ten triangles: there are lines between which no good ones
/// have room.
bool has_many_small_angles(const RemeshResult& result);

/// What dropping the creases would spare, in words.
std::string harm_of_creases(const RemeshResult& result);

/// Of another type, or without most edges of curves, where samples of some are opposite to the middles of
/// another's edges (facing_curves.h): perhaps better without that, which takes fewer samples.
bool is_undone_by_staggering(const RemeshResult& result);

/// Of another type, with room made for thin parts, in a hundredth of the n samples and twice as many places
/// as the rival before it was mended: will it hardly become better than that?
bool is_left_behind(const ThinParts& thin_parts, std::size_t n, const RemeshResult& rival);

/// Of another type, with some faults after room was made for thin parts, a dozen at most: more rounds of that
/// may help, for a bar needs the more of them the thinner it is.
bool may_have_room(const RemeshResult& result);

/// Of another type, with room made for thin parts, in a hundredth of the n samples and more than 20 places:
/// of 39 such, of public meshes, mending made none right. Without that angles are of no use.
bool is_past_mending(const ThinParts& thin_parts, std::size_t n);

/// Of the type, or, as the other one is not either, at fault in less than half as many places: then some
/// creases may be given up for it.
bool is_worth_creases(const RemeshResult& with_fewer, const RemeshResult& with_all);

/// First by the type; if neither has it, by the places that are at fault and the edges of curves that are
/// lost. Then by the smallest angle, up to 30 degrees, in units of that, less twice the angles below 30 a
/// triangle and ten times the share of edges of curves that are lost: a tenth of the edges weighs as much as
/// 30 degrees, a tenth of the triangles as 6. Of a mesh by collapses (last_resort.h) whose longest edge is
/// more than five wanted lengths, so that parts are left out, each doubling of that weighs twice as much as
/// all triangles, and an angle of nothing as ten. Then by the smallest angle.
bool is_better(const RemeshResult& a, const RemeshResult& b);

/// As the other one was made, as far as that is left to us.
RemeshOptions in_the_way_of(const RemeshResult& other, RemeshOptions options);

/// The result, or what there is instead (last_resort.h), which is better.
const RemeshResult& as_it_will_be(const RemeshResult& result);

/// First by whether all is well in the end; then by whether the diagram is of the type; then as above.
bool is_better_in_the_end(const RemeshResult& a, const RemeshResult& b);

}  // namespace fpo
