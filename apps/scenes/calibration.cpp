// SPDX-License-Identifier: Apache-2.0
//
// Unit costs, from poses of two tori at many distances.
//
// Pairs of triangles first, alone: the pairs that the structure visits are written down and played
// back, so that what is measured is leaf tests and nothing else, of such pairs and in such an order
// as they come in: loose volumes leave pairs that are far apart, which are seen to be so at once.
// Least squares over the poses part them into kinds. With these known, the time of the structure is
// divided among updates, volumes and poses in the same way.
//
// Poses take turns. One pose asked again and again is learnt by heart by the branch predictor, and
// a structure that decides something for every triangle at every pose looks twice as fast as it is.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/torus.h>

#include "comparison.h"
#include "question_runs.h"

namespace scenes {

using namespace trisect;
using namespace trisect::hierarchies;

namespace {

// Tori whose tubes are at many distances, crossing among them: four ways to lie, six steps of each,
// since frames of a motion are near each other too.
std::vector<Pose> calibration_poses() {
    std::vector<Pose> poses;
    for (int i = 0; i < 24; ++i)
        poses.push_back(Pose::from_quaternion({7, 3 - 2 * (i / 6), i / 6 * 2, 2},
                                              {0.05 + 0.11 * i, 0.013 * (i / 6), 0.02 * (i % 4)}));
    return poses;
}

const std::vector<InterferenceModel>& calibration_models() {
    static const std::vector<InterferenceModel> models{
        InterferenceModel(Solid::from_mesh(make_torus(1, 0.3, 40, 20))),
        InterferenceModel(Solid::from_mesh(make_torus(1, 0.3, 80, 32)))};
    return models;
}

// Least squares of relative errors, Σ (1 - (Σ_j count_j x_j + known) / seconds)², all unknowns >=
// 0: the best of all subsets of unknowns that are not zero.
template <std::size_t N>
class Fit {
public:
    using Row = std::array<double, N>;

    void add(const Row& counts, double known, double seconds) {
        Row row;
        for (std::size_t i = 0; i < N; ++i) row[i] = counts[i] / seconds;
        rows_.push_back(row);
        right_.push_back((seconds - known) / seconds);
    }
    [[nodiscard]] Row solve() const {
        Row best{};
        double least = std::numeric_limits<double>::infinity();
        for (unsigned used = 0; used < 1U << N; ++used) {
            Row x{};
            if (!solve_with(used, x) || std::ranges::any_of(x, [](double v) { return !(v >= 0); }))
                continue;
            if (const double e = error_of(x); e < least) {
                least = e;
                best = x;
            }
        }
        return best;
    }

private:
    // Normal equations of the used unknowns, by Gauss and Jordan, the largest pivot first.
    [[nodiscard]] bool solve_with(unsigned used, Row& x) const {
        std::array<std::array<double, N + 1>, N> m{};
        for (std::size_t i = 0; i < N; ++i) {
            if ((used >> i & 1U) == 0) {
                m[i][i] = 1;
                continue;
            }
            for (std::size_t r = 0; r < rows_.size(); ++r) {
                for (std::size_t j = 0; j < N; ++j)
                    if ((used >> j & 1U) != 0) m[i][j] += rows_[r][i] * rows_[r][j];
                m[i][N] += rows_[r][i] * right_[r];
            }
        }
        for (std::size_t c = 0; c < N; ++c) {
            std::size_t p = c;
            for (std::size_t i = c + 1; i < N; ++i)
                if (std::abs(m[i][c]) > std::abs(m[p][c])) p = i;
            if (!(std::abs(m[p][c]) > 0)) return false;
            std::swap(m[c], m[p]);
            for (std::size_t i = 0; i < N; ++i) {
                if (i == c) continue;
                const double f = m[i][c] / m[c][c];
                for (std::size_t j = c; j <= N; ++j) m[i][j] -= f * m[c][j];
            }
        }
        for (std::size_t i = 0; i < N; ++i) x[i] = m[i][N] / m[i][i];
        return true;
    }
    [[nodiscard]] double error_of(const Row& x) const {
        double error = 0;
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            double e = right_[r];
            for (std::size_t i = 0; i < N; ++i) e -= x[i] * rows_[r][i];
            error += e * e;
        }
        return error;
    }

    std::vector<Row> rows_;
    std::vector<double> right_;
};

double count(std::uint64_t n) { return static_cast<double>(n); }

// What a question does at each pose and the least time that it took, poses in turns.
struct Sample {
    CostCounters n;
    double seconds = std::numeric_limits<double>::infinity();
};
// before(i) readies the structure for pose i.
template <class Before>
std::vector<Sample> sample(PairStructure& s, std::span<const Pose> poses, Question question,
                           Before&& before) {
    std::vector<Sample> samples(poses.size());
    double spent = 0;
    for (int round = 0; round < 3 || (round < 200 && spent < 0.1); ++round)
        for (std::size_t i = 0; i < poses.size(); ++i) {
            before(i);
            const double begin = processor_seconds();
            samples[i].n = run(s, poses.subspan(i, 1), question);
            const double took = processor_seconds() - begin;
            samples[i].seconds = std::min(samples[i].seconds, took);
            spent += took;
        }
    return samples;
}

// Visits pairs that were written down: leaf tests without a structure.
class PlayedBack final : public PairStructure {
public:
    using PairStructure::PairStructure;

    // What the other one visits for the question at each of the poses.
    void record(PairStructure& from, std::span<const Pose> poses, Question question) {
        recording_ = &from;
        lists_.clear();
        for (const Pose& pose : poses) {
            lists_.emplace_back();
            at_ = lists_.size() - 1;
            CostCounters unused;
            from.place(Pose(), pose, unused);
            place(Pose(), pose, unused);
            (void)run(*this, std::span(&pose, 1), question);
        }
        recording_ = nullptr;
        at_ = 0;
    }
    // From now on those of this pose.
    void choose(std::size_t pose) { at_ = pose; }

    std::string_view name() const override { return "played-back"; }
    BuildReport build_report() const override { return {}; }

protected:
    void update(CostCounters&) override {}
    bool find_candidates(PairVisit visit, CostCounters& counters) override {
        if (recording_ != nullptr)
            return recording_->candidates(
                [&](std::uint32_t a, std::uint32_t b) {
                    lists_[at_].emplace_back(a, b);
                    return visit(a, b);
                },
                counters);
        return std::ranges::any_of(lists_[at_],
                                   [&](const auto& p) { return visit(p.first, p.second); });
    }
    void find_near(double limit, NearVisit visit, CostCounters& counters) override {
        if (recording_ != nullptr) {
            recording_->near(
                limit,
                [&](std::uint32_t a, std::uint32_t b) {
                    lists_[at_].emplace_back(a, b);
                    return visit(a, b);
                },
                counters);
            return;
        }
        for (const auto& [a, b] : lists_[at_]) (void)visit(a, b);
    }

private:
    PairStructure* recording_ = nullptr;
    std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> lists_;
    std::size_t at_ = 0;
};

}  // namespace

double UnitCosts::predict(const CostCounters& n, std::size_t frames) const {
    return update * count(n.updates) + volume_test * count(n.volume_tests) +
           primitive_test * count(n.primitive_tests) + closest_test * count(n.closest_tests) +
           exact_test * count(n.exact_tests) + frame * static_cast<double>(frames);
}

UnitCosts calibrate(StructureKind kind, Question question) {
    const std::vector<Pose> poses = calibration_poses();
    // Without a structure there are too many pairs to write down, and one model is enough.
    const bool all = kind == StructureKind::AllPairs;
    const std::span models = std::span(calibration_models()).first(all ? 1 : 2);
    Fit<3> leaves;
    std::vector<Sample> samples;
    for (const InterferenceModel& m : models) {
        const auto s = make_structure(kind, m, m);
        for (const Sample& x : sample(*s, poses, question, [](std::size_t) {}))
            samples.push_back(x);
        PlayedBack played(m, m);
        played.record(all ? *make_structure(StructureKind::Kdop18, m, m) : *s, poses, question);
        for (const Sample& x :
             sample(played, poses, question, [&played](std::size_t i) { played.choose(i); }))
            leaves.add({count(x.n.primitive_tests), count(x.n.closest_tests), 1}, 0, x.seconds);
    }
    UnitCosts costs;
    const auto leaf = leaves.solve();
    costs.primitive_test = leaf[0];
    costs.closest_test = leaf[1];
    costs.exact_test = 2e-6;
    Fit<3> rest;
    for (const Sample& x : samples)
        rest.add({count(x.n.updates), count(x.n.volume_tests), 1}, costs.predict(x.n, 0),
                 x.seconds);
    const auto x = rest.solve();
    costs.update = x[0];
    costs.volume_test = x[1];
    costs.frame = x[2];
    return costs;
}

}  // namespace scenes
