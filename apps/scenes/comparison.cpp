// SPDX-License-Identifier: Apache-2.0
//
// Times are processor times of whole sequences of poses, place and question together, and the least
// of several rounds: what disturbs a machine only ever adds. The cost function is linear in its
// counters; tests do not always cost the same, because of caches and of tests that end early, and
// the difference between prediction and measurement is just that.

#include "comparison.h"

#include <algorithm>
#include <limits>
#include <memory>

#include <trisect/bsp/interference/interference.h>

#include "question_runs.h"

namespace scenes {

using namespace trisect;
using namespace trisect::hierarchies;

const char* to_string(Question question) {
    switch (question) {
        case Question::Meet:
            return "meet";
        case Question::Faces:
            return "faces";
        case Question::Distance:
            return "distance";
    }
    return "";
}

Comparison compare(const InterferenceModel& a, const InterferenceModel& b,
                   std::span<const Pose> poses, const ComparisonOptions& options) {
    std::vector<StructureKind> kinds = options.kinds;
    if (kinds.empty())
        for (const StructureInfo& i : all_structures())
            if (i.kind != StructureKind::AllPairs) kinds.push_back(i.kind);

    Comparison r;
    r.frames = poses.size();
    std::vector<std::vector<FacePair>> faces;
    std::vector<Relation> relations;
    std::vector<DistanceInterval> distances;
    r.answers.least_distance = std::numeric_limits<double>::infinity();
    for (const Pose& pose : poses) {
        relations.push_back(interfere(a, Pose(), b, pose).relation);
        ++r.answers.relations[trisect::to_string(relations.back())];
    }
    for (const StructureKind kind : kinds) {
        StructureCost& row = r.structures.emplace_back();
        row.kind = kind;
        const auto s = make_structure(kind, a, b);
        row.name = s->name();
        row.build = s->build_report();
        const auto disagree = [&](std::size_t frame, const char* about) {
            if (r.disagreement.empty())
                r.disagreement =
                    row.name + " disagrees about " + about + " in frame " + std::to_string(frame);
        };
        CostCounters unused;
        for (std::size_t f = 0; f < poses.size(); ++f) {
            s->place(Pose(), poses[f], unused);
            if (relation(*s, unused) != relations[f]) disagree(f, "the relation");
            const std::vector<FacePair> found = meeting_faces(*s, unused);
            if (faces.size() <= f) {
                faces.push_back(found);
                r.answers.face_pairs += found.size();
                if (!found.empty()) ++r.answers.meeting_frames;
            }
            if (found != faces[f]) disagree(f, "the faces that meet");
            const DistanceInterval d = distance(*s, unused);
            // Intervals around one number have a common point.
            if (distances.size() <= f) distances.push_back(d);
            distances[f].lower = std::max(distances[f].lower, d.lower);
            distances[f].upper = std::min(distances[f].upper, d.upper);
            if (distances[f].lower > distances[f].upper || (d.lower > 0 && !faces[f].empty()))
                disagree(f, "the distance");
            r.answers.least_distance = std::min(r.answers.least_distance, d.upper);
        }
        for (const Question q : options.questions) {
            QuestionCost& cost = row.questions.emplace_back();
            cost.question = q;
            const double begin = processor_seconds();
            cost.counters = run(*s, poses, q);
            cost.measured = processor_seconds() - begin;
            // What takes long is measured well by one round.
            if (cost.measured < 1)
                cost.measured = least_time(*s, poses, q, options.seconds_per_cell);
            if (options.predict)
                cost.predicted = calibrate(kind, q).predict(cost.counters, poses.size());
        }
    }
    return r;
}

}  // namespace scenes
