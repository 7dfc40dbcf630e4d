// SPDX-License-Identifier: Apache-2.0
//
// Touch: the static query says how the solids lie at the start. If they are apart, the first event
// of the search is the first touch, because before it no boundary reaches the other.
//
// Overlap: between two neighbouring events nothing changes in how the boundaries meet, so whether
// interiors meet is the same all over the open interval between them, and one static query at a
// rational time in it decides. The first interval with an overlap begins at the answer. No sign of
// a derivative is looked at: what a sliding contact of many features does next would take the
// comparison of cones that the static query makes anyway.

#include <trisect/bsp/interference/motion/contact_query.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/interference/motion/contact_search.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

std::size_t common_piece_count(const Motion& a, const Motion& b) {
    if (a.piece_count() == b.piece_count() || b.is_still()) return a.piece_count();
    if (a.is_still()) return b.piece_count();
    throw UsageError("motions of " + std::to_string(a.piece_count()) + " and " +
                     std::to_string(b.piece_count()) + " pieces do not run together");
}

// A motion that stands still may have less pieces.
std::size_t index_of(const Motion& m, std::size_t i) { return std::min(i, m.piece_count() - 1); }

Pose pose_in_piece(const Motion& m, std::size_t i, const mpq_class& s) {
    return m.pose_at(from_gmp(s + static_cast<unsigned long>(index_of(m, i))));
}

// The fraction with the smallest power of two for denominator in an open interval.
mpq_class simplest_between(const mpq_class& low, const mpq_class& high) {
    for (mpz_class denominator = 1;; denominator *= 2) {
        const mpq_class scaled = low * denominator;
        mpz_class n;
        mpz_fdiv_q(n.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
        mpq_class candidate(mpz_class(n + 1), denominator);
        candidate.canonicalize();
        if (candidate < high) return candidate;
    }
}

// A time strictly between two.
mpq_class time_between(RealRoot low, RealRoot high) {
    while (low.upper() >= high.lower()) {
        low.halve();
        high.halve();
    }
    return simplest_between(low.upper(), high.lower());
}

}  // namespace

void ContactQuery::run(ContactEvent event) {
    const std::size_t pieces = common_piece_count(motion_a_, motion_b_);
    if (a_.boundary().boxes.is_empty() || b_.boundary().boxes.is_empty()) return;
    at_start_ = relation_at(0, 0);
    const bool is_event_at_start =
        event == ContactEvent::Touch ? at_start_ != Relation::Disjoint : interiors_meet(at_start_);
    if (is_event_at_start) {
        answer_with_contacts(0);
        return;
    }
    bool apart = at_start_ == Relation::Disjoint;
    // Where solids touch already they may come apart, and that is an event, too.
    if (event == ContactEvent::Touch) receding_ = receding();
    for (std::size_t i = 0; i < pieces && !time_; ++i) {
        if (event == ContactEvent::Touch)
            touch_in_piece(i);
        else
            overlap_in_piece(i, apart);
    }
}

Relation ContactQuery::relation_at(std::size_t piece, const mpq_class& s) {
    return relation_at(pose_in_piece(motion_a_, piece, s), pose_in_piece(motion_b_, piece, s));
}

void ContactQuery::touch_in_piece(std::size_t i) {
    enter_piece(i);
    EarliestEvents events;
    search(events);
    if (!events.is_empty()) answer(i, events.events().front());
}

// `apart`: the solids have no common point just before. Events are fetched in growing numbers: most
// motions end at the first ones, slides along many features have hundreds, and then each search
// comes to the same pairs, whose events are kept.
void ContactQuery::overlap_in_piece(std::size_t i, bool& apart) {
    enter_piece(i);
    EventsAtATime last{RealRoot(mpq_class(0)), {}};
    std::size_t times = 1;
    for (;;) {
        const bool is_first = last.pairs.empty();
        EarliestEvents next(apart && is_first ? std::nullopt : std::optional(last.time), times);
        search(next, apart && is_first ? nullptr : solved_.get());
        for (EventsAtATime& e : next.events()) {
            if (overlap_between(i, last, e.time, apart)) return;
            last = std::move(e);
            apart = false;
        }
        if (!next.is_full()) break;
        times = std::min<std::size_t>(2 * times, 256);
    }
    (void)overlap_between(i, last, RealRoot(mpq_class(1)), apart);
}

// Whether interiors meet between two neighbouring events, or the ends of a piece; then that is the
// answer.
bool ContactQuery::overlap_between(std::size_t i, EventsAtATime& last, const RealRoot& end,
                                   bool& apart) {
    if (apart && last.pairs.empty()) return false;
    if (last.time.compare(mpq_class(1)) == 0) return false;
    RealRoot later = end;
    if (last.time.compare(later) == 0) return false;
    const Relation r = relation_at(i, time_between(last.time, later));
    apart = r == Relation::Disjoint;
    if (!interiors_meet(r)) return false;
    if (last.pairs.empty())
        answer_with_contacts(i);
    else
        answer(i, last);
    return true;
}

void ContactQuery::enter_piece(std::size_t i) {
    motion_ = std::make_unique<RelativeMotion>(
        piece_of(motion_a_, index_of(motion_a_, i)), a_.boundary().lattice,
        piece_of(motion_b_, index_of(motion_b_, i)), b_.boundary().lattice);
    pairs_ = std::make_unique<PairEvents>(a_, b_, *motion_);
    solved_.reset();
    filter_.reset();
    if (!BallMotion::fits(*motion_)) return;
    filter_ = std::make_unique<BallMotion>(*motion_);
    solved_ = std::make_unique<SolvedPairs>(a_, b_, *pairs_, *filter_);
}

void ContactQuery::search(EarliestEvents& events, SolvedPairs* solved) {
    if (filter_ == nullptr) {
        search_exactly(events);
        return;
    }
    ContactSearch search(a_, b_, *pairs_, receding_, solved);
    search.run(*filter_, events);
    counters_.intervals += search.counters().intervals;
    counters_.box_tests += search.counters().box_tests;
    counters_.triangle_pairs += search.counters().triangle_pairs;
    if (receding_ != nullptr) counters_.separating_pairs = receding_->left_out();
}

void ContactQuery::search_exactly(EarliestEvents& events) {
    const auto triangles_of = [](EventModel& model) {
        std::vector<std::uint32_t> parts;
        const std::uint32_t count = model.open_all();
        for (std::uint32_t t = 0; t < count; ++t) parts.push_back(model.part_of(t));
        std::ranges::sort(parts);
        parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
        std::vector<std::uint32_t> triangles;
        for (const std::uint32_t part : parts) {
            const EventModel::Range r = model.triangles_of(part);
            for (std::uint32_t t = r.begin; t < r.end; ++t) triangles.push_back(t);
        }
        return triangles;
    };
    const std::vector<std::uint32_t> of_b = triangles_of(b_);
    for (const std::uint32_t i : triangles_of(a_))
        for (const std::uint32_t j : of_b) pairs_->find_exactly(i, j, {0, 1}, events);
}

void ContactQuery::answer(std::size_t piece, const EventsAtATime& events) {
    time_ = number_of(events.time.shifted(static_cast<unsigned long>(piece)));
    take_witnesses(events, *motion_);
}

// At the beginning of a piece.
void ContactQuery::answer_with_contacts(std::size_t piece) {
    time_ = AlgebraicNumber(ExactRational(static_cast<std::int64_t>(piece)));
    take_witnesses_at(pose_in_piece(motion_a_, piece, 0), pose_in_piece(motion_b_, piece, 0));
}

}  // namespace trisect::detail
