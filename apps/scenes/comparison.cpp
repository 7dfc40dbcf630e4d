// SPDX-License-Identifier: Apache-2.0
//
// Times are processor times of whole sequences of poses, place and question together, and the least
// of several rounds: what disturbs a machine only ever adds. The cost function is linear in three
// counters, so three unit costs would do if a test always cost the same; it does not, because of
// caches and of tests that end early, and the difference between prediction and measurement is just
// that.

#include "comparison.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>

#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/interference.h>

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

double UnitCosts::predict(const CostCounters& n, std::size_t frames) const {
    return update * static_cast<double>(n.updates) +
           volume_test * static_cast<double>(n.volume_tests) +
           primitive_test * static_cast<double>(n.primitive_tests) +
           exact_test * static_cast<double>(n.exact_tests) + frame * static_cast<double>(frames);
}

namespace {

// Of this thread: what else the machine does is no part of it.
double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void ask(PairStructure& s, Question question, CostCounters& counters) {
    switch (question) {
        case Question::Meet:
            (void)boundaries_meet(s, counters);
            break;
        case Question::Faces:
            (void)meeting_faces(s, counters);
            break;
        case Question::Distance:
            (void)distance(s, counters);
            break;
    }
}

CostCounters run(PairStructure& s, std::span<const Pose> poses, Question question) {
    CostCounters counters;
    for (const Pose& pose : poses) {
        s.place(Pose(), pose, counters);
        ask(s, question, counters);
    }
    return counters;
}

// The least time of as many rounds as fit, at least two.
double least_time(PairStructure& s, std::span<const Pose> poses, Question question,
                  double seconds) {
    double least = std::numeric_limits<double>::infinity();
    const double start = processor_seconds();
    double begin = start;
    for (int round = 0; round < 2 || (round < 1000 && begin - start < seconds); ++round) {
        (void)run(s, poses, question);
        const double end = processor_seconds();
        least = std::min(least, end - begin);
        begin = end;
    }
    return least;
}

struct Sample {
    CostCounters n;
    double seconds = 0;
};

// Tori whose tubes are at many distances, crossing among them.
std::vector<Pose> calibration_poses() {
    std::vector<Pose> poses;
    for (int i = 0; i < 24; ++i)
        poses.push_back(Pose::from_quaternion({7, 3 - i % 5, i % 7, 2},
                                              {0.05 + 0.11 * i, 0.013 * (i % 6), 0.02 * (i % 4)}));
    return poses;
}

constexpr std::size_t unknowns = 4;
using Row = std::array<double, unknowns>;

// Least squares of relative errors, all unknowns >= 0: the best of all subsets of unknowns that are
// not zero.
Row fit(const std::vector<Row>& rows, const std::vector<double>& right) {
    Row best{};
    double least = std::numeric_limits<double>::infinity();
    for (unsigned used = 0; used < 1U << unknowns; ++used) {
        std::array<std::array<double, unknowns + 1>, unknowns> m{};
        for (std::size_t i = 0; i < unknowns; ++i) {
            if ((used >> i & 1U) == 0) {
                m[i][i] = 1;
                continue;
            }
            for (std::size_t r = 0; r < rows.size(); ++r) {
                for (std::size_t j = 0; j < unknowns; ++j)
                    if ((used >> j & 1U) != 0) m[i][j] += rows[r][i] * rows[r][j];
                m[i][unknowns] += rows[r][i] * right[r];
            }
        }
        // Gauss and Jordan, the largest pivot first.
        Row x{};
        bool solved = true;
        for (std::size_t c = 0; c < unknowns; ++c) {
            std::size_t p = c;
            for (std::size_t i = c + 1; i < unknowns; ++i)
                if (std::abs(m[i][c]) > std::abs(m[p][c])) p = i;
            if (!(std::abs(m[p][c]) > 0)) {
                solved = false;
                break;
            }
            std::swap(m[c], m[p]);
            for (std::size_t i = 0; i < unknowns; ++i) {
                if (i == c) continue;
                const double f = m[i][c] / m[c][c];
                for (std::size_t j = c; j <= unknowns; ++j) m[i][j] -= f * m[c][j];
            }
        }
        for (std::size_t i = 0; i < unknowns && solved; ++i) x[i] = m[i][unknowns] / m[i][i];
        if (!solved || std::ranges::any_of(x, [](double v) { return !(v >= 0); })) continue;
        double error = 0;
        for (std::size_t r = 0; r < rows.size(); ++r) {
            double e = right[r];
            for (std::size_t i = 0; i < unknowns; ++i) e -= x[i] * rows[r][i];
            error += e * e;
        }
        if (error < least) {
            least = error;
            best = x;
        }
    }
    return best;
}

std::vector<InterferenceModel> calibration_models() {
    return {InterferenceModel(Solid::from_mesh(make_torus(1, 0.3, 40, 20))),
            InterferenceModel(Solid::from_mesh(make_torus(1, 0.3, 128, 50)))};
}

// Cp: all pairs of two tori apart, where every pair takes the way of the many.
double primitive_cost(Question question, const InterferenceModel& torus) {
    const auto all = make_structure(StructureKind::AllPairs, torus, torus);
    const std::vector<Pose> poses{Pose::from_quaternion({7, 2, 1, 3}, {0.9, 0.2, 0.3})};
    const CostCounters n = run(*all, poses, question);
    return least_time(*all, poses, question, 0) / static_cast<double>(n.primitive_tests);
}

}  // namespace

UnitCosts calibrate(StructureKind kind, Question question) {
    static const std::vector<InterferenceModel> models = calibration_models();
    static const std::array<double, 2> primitive{primitive_cost(Question::Meet, models[0]),
                                                 primitive_cost(Question::Faces, models[0])};
    UnitCosts costs;
    // The closest points of near triangles cost ten times what it takes to see that others are far:
    // how much a pair costs on the average, the fit says.
    const bool fits_primitive = question == Question::Distance;
    costs.primitive_test = fits_primitive ? 0 : primitive[static_cast<std::size_t>(question)];
    costs.exact_test = 2e-6;
    const std::vector<Pose> poses = calibration_poses();
    std::vector<Row> rows;
    std::vector<double> right;
    for (const InterferenceModel& m : models) {
        const auto s = make_structure(kind, m, m);
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const std::span one = std::span(poses).subspan(i, 1);
            const CostCounters n = run(*s, one, question);
            const double t = least_time(*s, one, question, 0.004);
            const double known = costs.primitive_test * static_cast<double>(n.primitive_tests) +
                                 costs.exact_test * static_cast<double>(n.exact_tests);
            rows.push_back({static_cast<double>(n.updates) / t,
                            static_cast<double>(n.volume_tests) / t, 1 / t,
                            fits_primitive ? static_cast<double>(n.primitive_tests) / t : 0});
            right.push_back((t - known) / t);
        }
    }
    const Row x = fit(rows, right);
    costs.update = x[0];
    costs.volume_test = x[1];
    costs.frame = x[2];
    costs.primitive_test += x[3];
    return costs;
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
            cost.counters = run(*s, poses, q);
            cost.measured = least_time(*s, poses, q, options.seconds_per_cell);
            if (options.predict)
                cost.predicted = calibrate(kind, q).predict(cost.counters, poses.size());
        }
    }
    return r;
}

}  // namespace scenes
