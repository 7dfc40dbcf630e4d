// SPDX-License-Identifier: Apache-2.0
//
// One leaf test for all structures. Doubles with error bounds sort candidate pairs into apart,
// crossing and unknown (triangle_filter.cpp), and decide nearly all; what they leave is decided in
// exact arithmetic, under an exact relative pose that is made when it is first needed. So a
// structure can only be slow, or wrong by leaving out a pair; it cannot be inexact.

#include <trisect/bsp/hierarchies/pairs/queries.h>

#include <algorithm>
#include <array>
#include <limits>

#include <trisect/bsp/interference/boxes/triangle_filter.h>
#include <trisect/bsp/interference/relation/boundary_flags.h>
#include <trisect/bsp/interference/relation/boundary_pairs.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/meeting_pairs.h>
#include <trisect/bsp/interference/relation/pair_distance.h>
#include <trisect/bsp/interference/relation/quick_relation.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::hierarchies {

namespace {

using detail::DistanceCandidate;
using detail::InterferenceModelData;
using detail::PairVerdict;
using detail::TriangleCorners;

struct TrianglePair {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
};

// Doubles at the leaves. Remembers the last triangle of B where it was moved to: most structures
// come with the same one several times.
class LeafTest {
public:
    explicit LeafTest(const PairStructure& s)
        : a_(detail::data_of(s.model_a())),
          b_(detail::data_of(s.model_b())),
          map_(s.placement().to_a),
          error_(a_.position_error + s.placement().b_error) {}

    PairVerdict operator()(std::uint32_t a, std::uint32_t b) {
        if (b != moved_) {
            for (std::size_t k = 0; k < 3; ++k)
                q_[k] = map_(b_.position(b_.triangles[b].vertex[k]));
            moved_ = b;
        }
        TriangleCorners p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = a_.position(a_.triangles[a].vertex[k]);
        return detail::compare_triangles(p, q_, error_);
    }

private:
    const InterferenceModelData& a_;
    const InterferenceModelData& b_;
    detail::ApproximateMap map_;
    double error_;
    std::uint32_t moved_ = std::numeric_limits<std::uint32_t>::max();
    TriangleCorners q_{};
};

// visit(a, b, verdict) for candidates that are not certainly apart, until it returns true.
template <class Visit>
bool compare_candidates(PairStructure& s, CostCounters& counters, Visit&& visit) {
    if (!s.has_doubles())
        return s.candidates(
            [&](std::uint32_t a, std::uint32_t b) {
                ++counters.primitive_tests;
                return visit(a, b, PairVerdict::Unknown);
            },
            counters);
    LeafTest test(s);
    std::uint64_t tests = 0;
    const bool stopped = s.candidates(
        [&](std::uint32_t a, std::uint32_t b) {
            ++tests;
            const PairVerdict verdict = test(a, b);
            return verdict != PairVerdict::Apart && visit(a, b, verdict);
        },
        counters);
    counters.primitive_tests += tests;
    return stopped;
}

// The exact contact of two triangles.
class ExactTest {
public:
    explicit ExactTest(const PairStructure& s)
        : pairs_(detail::data_of(s.model_a()), s.pose_a(), detail::data_of(s.model_b()), s.pose_b(),
                 stack_) {}
    bool meet(std::uint32_t a, std::uint32_t b, CostCounters& counters) {
        ++counters.exact_tests;
        return pairs_.exact(a, b).meets();
    }

private:
    detail::ObbWalk::Stack stack_;
    detail::BoundaryPairs pairs_;
};

// The relation from pairs where doubles could not decide it.
Relation relation_of_unknown(const PairStructure& s, const std::vector<TrianglePair>& unknown,
                             CostCounters& counters) {
    const detail::PosedModels models{
        detail::data_of(s.model_a()), detail::data_of(s.model_b()),
        detail::PosedPair(s.pose_a(), s.model_a().lattice(), s.pose_b(), s.model_b().lattice())};
    detail::MeetingCollector collect(models, false);
    for (const TrianglePair& p : unknown) {
        ++counters.exact_tests;
        if (collect(p.a, p.b, PairVerdict::Unknown)) break;
    }
    if (!collect.flags.is_decided()) add_flags_at_contacts(models, collect.pairs, collect.flags);
    if (!collect.flags.is_decided()) add_flags_of_shells(models, collect.pairs, collect.flags);
    return collect.flags.relation();
}

// All pairs that may be the closest, and bounds on the distance.
struct NearestPairs {
    DistanceInterval interval;
    std::vector<DistanceCandidate> pairs;
};

NearestPairs nearest(PairStructure& s, CostCounters& counters) {
    detail::PairDistance pairs(detail::data_of(s.model_a()), s.pose_a(),
                               detail::data_of(s.model_b()), s.pose_b());
    constexpr double infinite = std::numeric_limits<double>::infinity();
    NearestPairs r;
    double upper = infinite;
    double limit = infinite;
    s.near(
        infinite,
        [&](std::uint32_t a, std::uint32_t b) {
            ++counters.primitive_tests;
            const DistanceCandidate c = pairs.compare(a, b, upper);
            if (c.bounds.upper < infinite) ++counters.closest_tests;
            if (!(c.bounds.lower <= upper)) return limit;
            r.pairs.push_back(c);
            if (c.bounds.upper < upper) {
                upper = c.bounds.upper;
                // The margin pays for this division.
                if (pairs.least_stretch() > 0)
                    limit = upper / pairs.least_stretch() * detail::surely_more;
            }
            if (c.crossing) limit = -1;
            return limit;
        },
        counters);
    std::erase_if(r.pairs, [upper](const DistanceCandidate& c) { return c.bounds.lower > upper; });
    r.interval = {infinite, upper};
    for (const DistanceCandidate& c : r.pairs)
        r.interval.lower = std::min(r.interval.lower, c.bounds.lower);
    return r;
}

}  // namespace

bool boundaries_meet(PairStructure& structure, CostCounters& counters) {
    // What doubles cannot decide waits: a crossing may make it superfluous.
    std::vector<TrianglePair> unknown;
    const bool crossing = compare_candidates(
        structure, counters, [&](std::uint32_t a, std::uint32_t b, PairVerdict verdict) {
            if (verdict == PairVerdict::Crossing) return true;
            unknown.push_back({a, b});
            return false;
        });
    if (crossing || unknown.empty()) return crossing;
    ExactTest exact(structure);
    return std::ranges::any_of(
        unknown, [&](const TrianglePair& p) { return exact.meet(p.a, p.b, counters); });
}

std::vector<FacePair> meeting_faces(PairStructure& structure, CostCounters& counters) {
    const InterferenceModelData& a = detail::data_of(structure.model_a());
    const InterferenceModelData& b = detail::data_of(structure.model_b());
    std::optional<ExactTest> exact;
    std::vector<FacePair> faces;
    compare_candidates(structure, counters,
                       [&](std::uint32_t i, std::uint32_t j, PairVerdict verdict) {
                           const FacePair pair{a.triangles[i].face, b.triangles[j].face};
                           if (!faces.empty() && faces.back() == pair) return false;
                           if (verdict == PairVerdict::Unknown) {
                               if (!exact) exact.emplace(structure);
                               if (!exact->meet(i, j, counters)) return false;
                           }
                           faces.push_back(pair);
                           return false;
                       });
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

Relation relation(PairStructure& structure, CostCounters& counters) {
    if (!structure.has_doubles())
        return interfere(structure.model_a(), structure.pose_a(), structure.model_b(),
                         structure.pose_b())
            .relation;
    if (const auto early = structure.early_relation(counters)) return *early;
    std::vector<TrianglePair> unknown;
    const bool crossing = compare_candidates(
        structure, counters, [&](std::uint32_t a, std::uint32_t b, PairVerdict verdict) {
            if (verdict == PairVerdict::Crossing &&
                detail::data_of(structure.model_a()).is_clear(a) &&
                detail::data_of(structure.model_b()).is_clear(b))
                return true;
            unknown.push_back({a, b});
            return false;
        });
    if (crossing) return Relation::Overlapping;
    if (unknown.empty()) {
        const auto quick = detail::relation_of_apart(
            detail::data_of(structure.model_a()), structure.pose_a(),
            detail::data_of(structure.model_b()), structure.pose_b(), structure.placement().to_a);
        if (quick) return *quick;
    }
    return relation_of_unknown(structure, unknown, counters);
}

DistanceInterval distance(PairStructure& structure, CostCounters& counters) {
    return nearest(structure, counters).interval;
}

ClosestFeatures closest(PairStructure& structure, CostCounters& counters) {
    const InterferenceModelData& a = detail::data_of(structure.model_a());
    const InterferenceModelData& b = detail::data_of(structure.model_b());
    const NearestPairs found = nearest(structure, counters);
    if (std::ranges::any_of(found.pairs, &DistanceCandidate::crossing)) return {};
    std::optional<ClosestFeatures> best;
    for (const DistanceCandidate& c : found.pairs) {
        ++counters.exact_tests;
        const detail::ExactClosest exact =
            detail::exact_closest(a, structure.pose_a(), c.a, b, structure.pose_b(), c.b);
        if (exact.squared.sign() == 0) return {};
        if (best && best->squared < exact.squared) continue;
        if (!best || exact.squared < best->squared) best = ClosestFeatures{exact.squared, {}};
        for (const detail::MeetingPoint& p : exact.features) {
            const std::pair pair{entity_of(a, c.a, p.a), entity_of(b, c.b, p.b)};
            if (!best->features || pair < *best->features) best->features = pair;
        }
    }
    return *best;
}

}  // namespace trisect::hierarchies
