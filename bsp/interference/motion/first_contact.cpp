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

#include <trisect/bsp/interference/first_contact.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/interference/motion/ball_motion.h>
#include <trisect/bsp/interference/motion/contact_event.h>
#include <trisect/bsp/interference/motion/contact_search.h>
#include <trisect/bsp/interference/motion/facing_cones.h>
#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/bsp/interference/motion/pair_events.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

using detail::EarliestEvents;
using detail::RealRoot;

std::size_t common_piece_count(const Motion& a, const Motion& b) {
    if (a.piece_count() == b.piece_count() || b.is_still()) return a.piece_count();
    if (a.is_still()) return b.piece_count();
    throw UsageError("motions of " + std::to_string(a.piece_count()) + " and " +
                     std::to_string(b.piece_count()) + " pieces do not run together");
}

// A motion that stands still may have less pieces.
std::size_t index_of(const Motion& m, std::size_t i) { return std::min(i, m.piece_count() - 1); }

Pose pose_in_piece(const Motion& m, std::size_t i, const mpq_class& s) {
    return m.pose_at(detail::from_gmp(s + static_cast<unsigned long>(index_of(m, i))));
}

BoundaryEntity entity_of(const detail::ContactFeature& f, const detail::InterferenceModelData& d) {
    if (f.vertex.is_valid()) return d.place[f.vertex.index];
    if (!f.edge.is_valid()) return f.face;
    const auto copies = d.brep.copies(f.edge);
    return copies.empty() ? f.edge : *std::min_element(copies.begin(), copies.end());
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

class ContactQuery {
public:
    ContactQuery(const InterferenceModel& a, const Motion& motion_a, const InterferenceModel& b,
                 const Motion& motion_b)
        : a_(a),
          motion_a_(motion_a),
          b_(b),
          motion_b_(motion_b),
          events_a_(detail::data_of(a)),
          events_b_(detail::data_of(b)) {}

    FirstContact run(const FirstContactOptions& options) {
        const ContactEvent event = options.event;
        const std::size_t pieces = common_piece_count(motion_a_, motion_b_);
        if (a_.is_empty() || b_.is_empty()) return result_;
        result_.at_start = relation_at(0, 0);
        const bool is_event_at_start = event == ContactEvent::Touch
                                           ? result_.at_start != Relation::Disjoint
                                           : interiors_meet(result_.at_start);
        if (is_event_at_start) {
            answer_with_contacts(0);
            return std::move(result_);
        }
        bool apart = result_.at_start == Relation::Disjoint;
        // Where solids touch already they may come apart, and that is an event, too.
        if (event == ContactEvent::Touch && options.leave_out_receding) {
            cones_a_ = std::make_unique<detail::FacingCones>(events_a_);
            cones_b_ = std::make_unique<detail::FacingCones>(events_b_);
            separating_ = std::make_unique<detail::RecedingFaces>(*cones_a_, *cones_b_, events_b_);
        }
        for (std::size_t i = 0; i < pieces && !result_.exists(); ++i) {
            if (event == ContactEvent::Touch)
                touch_in_piece(i);
            else
                overlap_in_piece(i, apart);
        }
        return std::move(result_);
    }

    [[nodiscard]] const FirstContactCounters& counters() const { return counters_; }

private:
    Relation relation_at(std::size_t piece, const mpq_class& s) const {
        return interfere(a_, pose_in_piece(motion_a_, piece, s), b_,
                         pose_in_piece(motion_b_, piece, s))
            .relation;
    }

    void touch_in_piece(std::size_t i) {
        enter_piece(i);
        EarliestEvents events;
        search(events);
        if (!events.is_empty()) answer(i, events.events().front());
    }

    // `apart`: the solids have no common point just before. Events are fetched in growing numbers:
    // most motions end at the first ones, slides along many features have hundreds.
    void overlap_in_piece(std::size_t i, bool& apart) {
        enter_piece(i);
        detail::EventsAtATime last{RealRoot(mpq_class(0)), {}};
        std::size_t times = 1;
        for (;;) {
            const bool is_first = last.pairs.empty();
            EarliestEvents next(apart && is_first ? std::nullopt : std::optional(last.time), times);
            search(next);
            for (detail::EventsAtATime& e : next.events()) {
                if (overlap_between(i, last, e.time, apart)) return;
                last = std::move(e);
                apart = false;
            }
            if (!next.is_full()) break;
            times = std::min<std::size_t>(2 * times, 256);
        }
        (void)overlap_between(i, last, RealRoot(mpq_class(1)), apart);
    }

    // Whether interiors meet between two neighbouring events, or the ends of a piece; then that is
    // the answer.
    bool overlap_between(std::size_t i, detail::EventsAtATime& last, const RealRoot& end,
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

    void enter_piece(std::size_t i) {
        motion_ = std::make_unique<detail::RelativeMotion>(
            detail::piece_of(motion_a_, index_of(motion_a_, i)), a_.lattice(),
            detail::piece_of(motion_b_, index_of(motion_b_, i)), b_.lattice());
        pairs_ = std::make_unique<detail::PairEvents>(events_a_, events_b_, *motion_);
        filter_.reset();
        if (detail::BallMotion::fits(*motion_))
            filter_ = std::make_unique<detail::BallMotion>(*motion_);
    }

    void search(EarliestEvents& events) {
        if (filter_ == nullptr) {
            for (std::uint32_t i = 0; i < a_.triangle_count(); ++i)
                for (std::uint32_t j = 0; j < b_.triangle_count(); ++j)
                    pairs_->find_exactly(i, j, {0, 1}, events);
            return;
        }
        detail::ContactSearch search(events_a_, events_b_, *pairs_, separating_.get());
        search.run(*filter_, events);
        counters_.intervals += search.counters().intervals;
        counters_.box_tests += search.counters().box_tests;
        counters_.triangle_pairs += search.counters().triangle_pairs;
        if (separating_ != nullptr) counters_.separating_pairs = separating_->left_out();
    }

    void answer(std::size_t piece, const detail::EventsAtATime& events) {
        result_.time = detail::number_of(events.time.shifted(static_cast<unsigned long>(piece)));
        for (const detail::FeaturePair& p : events.pairs)
            result_.witnesses.push_back(
                {entity_of(p.a, detail::data_of(a_)), entity_of(p.b, detail::data_of(b_))});
        sort_witnesses();
    }

    // At the beginning of a piece.
    void answer_with_contacts(std::size_t piece) {
        result_.time = AlgebraicNumber(ExactRational(static_cast<std::int64_t>(piece)));
        InterferenceOptions options;
        options.contacts = true;
        const InterferenceResult r = interfere(a_, pose_in_piece(motion_a_, piece, 0), b_,
                                               pose_in_piece(motion_b_, piece, 0), options);
        for (const Contact& c : r.contacts) result_.witnesses.push_back({c.a, c.b});
        sort_witnesses();
    }

    void sort_witnesses() {
        auto& w = result_.witnesses;
        std::sort(w.begin(), w.end());
        w.erase(std::unique(w.begin(), w.end()), w.end());
    }

    const InterferenceModel& a_;
    const Motion& motion_a_;
    const InterferenceModel& b_;
    const Motion& motion_b_;
    detail::EventModel events_a_;
    detail::EventModel events_b_;
    std::unique_ptr<detail::RelativeMotion> motion_;
    std::unique_ptr<detail::PairEvents> pairs_;
    std::unique_ptr<detail::BallMotion> filter_;  // null when degrees are too high
    std::unique_ptr<detail::FacingCones> cones_a_;
    std::unique_ptr<detail::FacingCones> cones_b_;
    std::unique_ptr<detail::RecedingFaces> separating_;  // null when nothing may be left out
    FirstContact result_;
    FirstContactCounters counters_;
};

}  // namespace

FirstContactCounters& FirstContactCounters::operator+=(const FirstContactCounters& o) {
    intervals += o.intervals;
    box_tests += o.box_tests;
    triangle_pairs += o.triangle_pairs;
    separating_pairs += o.separating_pairs;
    return *this;
}

FirstContactCounters& FirstContactCounters::operator-=(const FirstContactCounters& o) {
    intervals -= o.intervals;
    box_tests -= o.box_tests;
    triangle_pairs -= o.triangle_pairs;
    separating_pairs -= o.separating_pairs;
    return *this;
}

FirstContact first_contact(const InterferenceModel& a, const Motion& motion_a,
                           const InterferenceModel& b, const Motion& motion_b,
                           const FirstContactOptions& options) {
    ContactQuery query(a, motion_a, b, motion_b);
    FirstContact result = query.run(options);
    detail::counters_of_thread<FirstContactCounters> += query.counters();
    return result;
}

}  // namespace trisect
