// SPDX-License-Identifier: Apache-2.0
#include "clash_answer.h"

#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_overlap.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <cmath>

#include "clash_id.h"

namespace trisect::app {
namespace {

Json point_json(const Point3d& p) { return Json::array({p[0], p[1], p[2]}); }

Json regions_json(const InterferenceResult& result) {
    Json out = Json::array();
    for (const ContactRegion& region : result.regions) {
        Json r;
        r["dimension"] = region.dimension;
        if (region.dimension == 2) r["opposite"] = region.opposite;
        r["loops"] = Json::array();
        for (const auto& loop : region.loops) {
            Json points = Json::array();
            for (const ContactPoint& p : loop) points.push_back(point_json(p.nearest));
            r["loops"].push_back(std::move(points));
        }
        out.push_back(std::move(r));
    }
    return out;
}

Json volume_json(const PlacedPart& a, const PlacedPart& b) {
    const Overlap common = overlap(a.model, a.pose, b.model, b.pose);
    Json out;
    out["value"] = common.volume.to_double();
    out["exact"] = common.volume.to_string();
    out["is_exact"] = common.is_exact;
    if (!common.is_exact) out["max_move"] = common.max_move;
    return out;
}

// Of what is asked once for all sets.
class PairAnswer {
public:
    PairAnswer(const PlacedPart& a, const PlacedPart& b, const ClashQuestions& questions)
        : a_(a), b_(b), questions_(questions) {
        InterferenceOptions options;
        options.regions = questions.regions;
        result_ = interfere(a.model, a.pose, b.model, b.pose, options);
    }

    [[nodiscard]] bool is_clash(const ClashSet& set) const {
        if (interiors_meet(result_.relation)) return true;
        if (set.mode == ClashMode::Intersection) return false;
        if (result_.relation == Relation::Touching) return true;
        return set.mode == ClashMode::Clearance &&
               are_nearer_than(a_.model, a_.pose, b_.model, b_.pose, set.clearance);
    }

    /// Made at the first clash.
    [[nodiscard]] const Json& facts() {
        if (!facts_.is_null()) return facts_;
        facts_["relation"] = to_string(result_.relation);
        add_place();
        if (result_.relation == Relation::Disjoint) add_distance();
        if (questions_.volumes && interiors_meet(result_.relation))
            facts_["volume"] = volume_json(a_, b_);
        if (questions_.regions) facts_["regions"] = regions_json(result_);
        return facts_;
    }

private:
    void add_place() {
        Point3d middle{};
        double diagonal = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double lo = std::max(a_.box.lo[k], b_.box.lo[k]);
            const double hi = std::min(a_.box.hi[k], b_.box.hi[k]);
            middle[k] = lo + (hi - lo) / 2;
            diagonal += (hi - lo) * (hi - lo);
        }
        facts_["point"] = point_json(middle);
        facts_["size"] = std::sqrt(diagonal);
    }
    void add_distance() {
        const auto distance = boundary_distance(a_.model, a_.pose, b_.model, b_.pose);
        if (!distance) return;
        Json d;
        d["lower"] = distance->lower;
        d["upper"] = distance->upper;
        d["on_a"] = point_json(distance->on_a);
        d["on_b"] = point_json(distance->on_b);
        facts_["distance"] = std::move(d);
    }

    const PlacedPart& a_;
    const PlacedPart& b_;
    ClashQuestions questions_;
    InterferenceResult result_;
    Json facts_;
};

}  // namespace

std::vector<Json> clash_records(std::span<const ClashSet> sets, const PlacedPart& a,
                                const PlacedPart& b, const ClashQuestions& questions) {
    PairAnswer answer(a, b, questions);
    std::vector<Json> out;
    for (const ClashSet& set : sets) {
        if (!set.has(a.group, b.group) || !answer.is_clash(set)) continue;
        Json record;
        record["id"] = clash_id({set.name, a.id, b.id});
        record["set"] = set.name;
        record["a"] = a.id;
        record["b"] = b.id;
        record.update(answer.facts());
        out.push_back(std::move(record));
    }
    return out;
}

std::vector<Json> clash_records_or_error(std::span<const ClashSet> sets, const PlacedPart& a,
                                         const PlacedPart& b, const ClashQuestions& questions) {
    try {
        return clash_records(sets, a, b, questions);
    } catch (const Error& e) {
        if (e.code() == ErrorCode::Cancelled || e.code() == ErrorCode::Internal) throw;
        Json record;
        record["a"] = a.id;
        record["b"] = b.id;
        record["error"] = e.what();
        return {record};
    }
}

}  // namespace trisect::app
