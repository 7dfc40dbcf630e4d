// SPDX-License-Identifier: Apache-2.0
//
// Six flags decide the relation (boundary_flags.h). They come from three places:
//   crossings   two faces that pass through each other set four flags at once, and the relation is
//               Overlapping whatever else there is. The walk stops there unless contacts are
//               requested. This is how nearly all overlaps are found.
//   contacts    without a crossing the boundaries may still touch, lie in each other and pass
//               through each other at edges. The cones at contact vertices decide
//               (contact_places.cpp); coplanar faces that share area say by their normals what they
//               are.
//   shells      a shell that meets nothing lies wholly inside, outside or in a cavity of the other
//               solid: one of its vertices is located there.
// Where doubles see a crossing, or see the boundaries apart, none of that is needed
// (quick_relation.cpp). Where meshes fall together, contacts follow from names
// (coincident_triangles.cpp).
//
// Comparing interiors where the boundaries meet, not at sampled points, is what makes flush
// placements come out right.

#include <trisect/bsp/interference/interference.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/relation/boundary_flags.h>
#include <trisect/bsp/interference/relation/coincident_triangles.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/meeting_pairs.h>
#include <trisect/bsp/interference/relation/quick_relation.h>
#include <trisect/kernel/contract.h>

namespace trisect {

using detail::BoundaryFlags;
using detail::InterferenceModelData;
using detail::MeetingPair;
using detail::PairVerdict;
using detail::PosedModels;
using detail::RelativePose;
using detail::TriangleContact;

// Where a boundary touches itself, an edge may lie in one of its faces, and another solid's face
// may pass through that face just there, with nothing but itself on the far side.
bool detail::MeetingCollector::tells(std::uint32_t a, std::uint32_t b) const {
    return (models_.a.is_clear(a) && models_.b.is_clear(b)) ||
           (!models_.a.touches_itself() && !models_.b.touches_itself());
}

bool detail::MeetingCollector::operator()(std::uint32_t a, std::uint32_t b, PairVerdict verdict) {
    if (verdict == PairVerdict::Crossing && !all_ && tells(a, b)) {
        flags.set_crossing();
        return true;
    }
    const TriangleContact c = test_(posed_triangle(models_.a, a), posed_triangle(models_.b, b));
    if (!c.meets()) return false;
    flags.meet = true;
    if (c.crossing && tells(a, b)) flags.set_crossing();
    if (c.dimension() == 2) (c.opposite ? flags.opposite : flags.same) = true;
    pairs.push_back({a, b, c});
    return !all_ && flags.is_decided();
}

std::vector<MeetingPair> detail::meeting_pairs(const PosedModels& models, bool all,
                                               BoundaryFlags& flags) {
    MeetingCollector collect(models, all);
    for_candidate_pairs(models, collect);
    flags = collect.flags;
    return std::move(collect.pairs);
}

namespace {

std::vector<bool> shells_in_contact(const InterferenceModelData& model,
                                    const std::vector<MeetingPair>& pairs,
                                    std::uint32_t MeetingPair::*triangle) {
    std::vector<bool> r(model.shell_vertex.size(), false);
    for (const MeetingPair& pair : pairs)
        r[model.shell_of(model.triangles[pair.*triangle]).index] = true;
    return r;
}

// Where a vertex is with respect to another solid, when it is not on its boundary.
bool is_inside(const InterferenceModelData& model, VertexId v, const RelativePose& to_other,
               const InterferenceModelData& other) {
    const Point& p = model.brep.point(v);
    if (to_other.has_doubles()) {
        const Approximation x = to_other.move(p.approximation());
        for (std::size_t k = 0; k < 3; ++k)
            if (x.c[k] - x.error > other.hi[k] || x.c[k] + x.error < other.lo[k]) return false;
    }
    std::array<ExactRational, 3> x = moved(detail::exact_place(p), to_other).c;
    for (ExactRational& c : x) c = c.scaled(other.brep.lattice().exponent);
    const Location location = other.model.index().locate(x).location;
    TRISECT_EXPECTS(location == Location::Inside || location == Location::Outside,
                    "a shell without contact has a vertex on the other boundary");
    return location == Location::Inside;
}

}  // namespace

void detail::add_flags_of_shells(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                                 BoundaryFlags& flags) {
    const auto touched_a = shells_in_contact(models.a, pairs, &MeetingPair::a);
    const auto touched_b = shells_in_contact(models.b, pairs, &MeetingPair::b);
    for (std::size_t s = 0; s < touched_a.size() && !flags.is_decided(); ++s)
        if (!touched_a[s])
            (is_inside(models.a, models.a.shell_vertex[s], models.poses.to_b, models.b)
                 ? flags.a_in
                 : flags.a_out) = true;
    for (std::size_t s = 0; s < touched_b.size() && !flags.is_decided(); ++s)
        if (!touched_b[s])
            (is_inside(models.b, models.b.shell_vertex[s], models.poses.to_a, models.a)
                 ? flags.b_in
                 : flags.b_out) = true;
}

const char* to_string(Relation relation) {
    switch (relation) {
        case Relation::Disjoint:
            return "disjoint";
        case Relation::Touching:
            return "touching";
        case Relation::Overlapping:
            return "overlapping";
        case Relation::Inside:
            return "inside";
        case Relation::Contains:
            return "contains";
        case Relation::Equal:
            return "equal";
    }
    return "";
}

namespace {

// Whether both are one model in one place. Comparing all its triangles with themselves would take
// a while.
bool is_same_in_place(const InterferenceModel& a, const Pose& pose_a, const InterferenceModel& b,
                      const Pose& pose_b) {
    if (&detail::data_of(a) != &detail::data_of(b)) return false;
    const RelativePose r = detail::relative_pose(pose_a, a.lattice(), pose_b, b.lattice());
    return r.is_translation() &&
           std::ranges::all_of(r.translation(), [](const auto& t) { return t.is_zero(); });
}

// Pairs for the relation, which doubles decide in part or not at all.
void collect_pairs(const PosedModels& models, const detail::CandidatePairs& candidates,
                   detail::MeetingCollector& collect) {
    if (candidates.is_complete) {
        (void)std::ranges::any_of(candidates.pairs, [&collect](const detail::CandidatePair& p) {
            return collect(p.a, p.b, p.verdict);
        });
    } else if (candidates.may_coincide && models.poses.to_a.has_doubles() &&
               !models.a.touches_itself() && !models.b.touches_itself()) {
        const detail::CoincidentTriangles coincident(models);
        coincident.add_flags(collect.flags);
        coincident.for_other_candidates(collect);
        if (!collect.flags.is_decided()) coincident.add_pairs(collect.pairs);
    } else {
        for_candidate_pairs(models, collect);
    }
}

}  // namespace

InterferenceResult interfere(const InterferenceModel& a, const Pose& pose_a,
                             const InterferenceModel& b, const Pose& pose_b,
                             const InterferenceOptions& options) {
    InterferenceResult result;
    if (a.is_empty() || b.is_empty()) return result;
    const bool all = options.contacts || options.regions;
    if (!all && is_same_in_place(a, pose_a, b, pose_b)) {
        result.relation = Relation::Equal;
        return result;
    }
    detail::CandidatePairs candidates;
    if (!all) {
        detail::ObbWalk::Stack stack;
        stack.reserve(256);
        if (const auto quick =
                detail::quick_relation(detail::data_of(a), pose_a, detail::data_of(b), pose_b,
                                       stack, nullptr, &candidates)) {
            result.relation = *quick;
            return result;
        }
    }
    const PosedModels models{detail::data_of(a), detail::data_of(b),
                             detail::PosedPair(pose_a, a.lattice(), pose_b, b.lattice())};
    detail::MeetingCollector collect(models, all);
    if (all)
        for_candidate_pairs(models, collect);
    else
        collect_pairs(models, candidates, collect);
    BoundaryFlags& flags = collect.flags;
    const std::vector<MeetingPair>& pairs = collect.pairs;
    if (!flags.is_decided()) add_flags_at_contacts(models, pairs, flags);
    if (!flags.is_decided()) add_flags_of_shells(models, pairs, flags);
    result.relation = flags.relation();
    if (options.contacts) result.contacts = contacts_of(models, pairs);
    if (options.regions) result.regions = regions_of(models, pairs, pose_a);
    return result;
}

}  // namespace trisect
