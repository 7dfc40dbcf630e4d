// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/first_contact.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>

#include <trisect/bsp/detail/ball_motion.h>
#include <trisect/bsp/detail/contact_event.h>
#include <trisect/bsp/detail/contact_search.h>
#include <trisect/bsp/detail/interference_model_data.h>
#include <trisect/bsp/detail/motion_piece.h>
#include <trisect/bsp/detail/pair_events.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

std::size_t common_piece_count(const Motion& a, const Motion& b) {
    if (a.piece_count() == b.piece_count() || b.is_still()) return a.piece_count();
    if (a.is_still()) return b.piece_count();
    throw UsageError("motions of " + std::to_string(a.piece_count()) + " and " +
                     std::to_string(b.piece_count()) + " pieces do not run together");
}

const detail::MotionPiece& piece_of(const Motion& m, std::size_t i) {
    return m.piece(std::min(i, m.piece_count() - 1));
}

BoundaryFeature public_feature(const detail::ContactFeature& f) {
    BoundaryFeature r;
    r.vertex = f.vertex;
    r.edge = f.edge;
    if (!f.vertex.is_valid() && !f.edge.is_valid()) r.face = f.face;
    r.near_face = f.face;
    return r;
}

std::vector<ContactWitness> witnesses_of(const detail::EarliestEvents& events) {
    std::vector<ContactWitness> r;
    for (const detail::FeaturePair& p : events.pairs())
        r.push_back({public_feature(p.a), public_feature(p.b)});
    std::sort(r.begin(), r.end());
    // The same two features may have been met through several faces.
    const auto key = [](const BoundaryFeature& f) { return std::tie(f.vertex, f.edge, f.face); };
    const auto same = [&key](const ContactWitness& x, const ContactWitness& y) {
        return key(x.a) == key(y.a) && key(x.b) == key(y.b);
    };
    r.erase(std::unique(r.begin(), r.end(), same), r.end());
    return r;
}

void search_exactly(const detail::EventModel& a, const detail::EventModel& b,
                    detail::PairEvents& pairs, detail::EarliestEvents& events) {
    for (std::uint32_t i = 0; i < a.data().triangles.size(); ++i)
        for (std::uint32_t j = 0; j < b.data().triangles.size(); ++j)
            pairs.find_exactly(i, j, {0, 1}, events);
}

}  // namespace

FirstContact first_contact(const InterferenceModel& a, const Motion& motion_a,
                           const InterferenceModel& b, const Motion& motion_b) {
    const std::size_t pieces = common_piece_count(motion_a, motion_b);
    FirstContact result;
    if (a.is_empty() || b.is_empty()) return result;
    const detail::EventModel model_a(a.data());
    const detail::EventModel model_b(b.data());
    for (std::size_t i = 0; i < pieces; ++i) {
        const detail::RelativeMotion motion(piece_of(motion_a, i), a.lattice(),
                                            piece_of(motion_b, i), b.lattice());
        detail::PairEvents pairs(model_a, model_b, motion, i == 0);
        detail::EarliestEvents events;
        if (detail::BallMotion::fits(motion)) {
            detail::ContactSearch search(model_a, model_b, pairs);
            search.run(detail::BallMotion(motion), events);
            result.stats.intervals += search.counters().intervals;
            result.stats.box_tests += search.counters().box_tests;
            result.stats.triangle_pairs += search.counters().triangle_pairs;
        } else {
            search_exactly(model_a, model_b, pairs, events);
        }
        if (events.is_empty()) continue;
        result.time = AlgebraicNumber(events.time().shifted(static_cast<unsigned long>(i)));
        result.witnesses = witnesses_of(events);
        return result;
    }
    return result;
}

}  // namespace trisect
