// SPDX-License-Identifier: Apache-2.0
//
// A complaint about hierarchies is that they must be rebuilt when things change. Two answers: a
// tree of boxes that is repaired where boxes enter, leave and move; and trees of volumes that keep
// their nodes and are refitted, when a solid moves or changes its shape.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/hierarchies/structures.h>
#include <trisect/bsp/interference/scene/dynamic_tree.h>

#include "hierarchy_tables.h"
#include "scenes/question_runs.h"

using namespace trisect;
using namespace trisect::hierarchies;
using scenes::processor_seconds;

namespace {

class Uniform {
public:
    double operator()() {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return static_cast<double>(state_ >> 11) * 0x1p-53;
    }

private:
    std::uint64_t state_ = 99;
};

detail::BodyBox somewhere(Uniform& uniform) {
    detail::BodyBox b;
    for (std::size_t k = 0; k < 3; ++k) {
        b.lo[k] = 100 * uniform();
        b.hi[k] = b.lo[k] + 1 + 3 * uniform();
    }
    return b;
}

enum class Change : std::uint8_t { SmallMove, Anywhere, LeaveAndEnter };

// A tree and what is in it.
class Crowd {
public:
    explicit Crowd(std::uint32_t n) {
        for (std::uint32_t i = 0; i < n; ++i) {
            boxes_.push_back(somewhere(uniform_));
            tree.insert(i, boxes_[i]);
        }
        tree.rebuild();
    }
    void change(Change kind) {
        const auto i = static_cast<std::uint32_t>(static_cast<double>(boxes_.size()) * uniform_());
        if (kind == Change::SmallMove) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double by = 4 * uniform_() - 2;
                boxes_[i].lo[k] += by;
                boxes_[i].hi[k] += by;
            }
        } else {
            boxes_[i] = somewhere(uniform_);
        }
        if (kind == Change::LeaveAndEnter) {
            tree.remove(i);
            tree.insert(i, boxes_[i]);
        } else {
            tree.update(i, boxes_[i]);
        }
    }
    /// Tests of a query with a box of the crowd.
    [[nodiscard]] double tests() const {
        CostCounters count;
        for (const detail::BodyBox& b : boxes_)
            tree.find(
                b, [](std::uint32_t) {}, count);
        return static_cast<double>(count.volume_tests) / static_cast<double>(boxes_.size());
    }

    DynamicTree tree;

private:
    Uniform uniform_;
    std::vector<detail::BodyBox> boxes_;
};

// A torus that is bent and twisted, more with every step, under fixed numbers of its faces.
InterferenceModel bent(double amount) {
    PolygonMesh mesh = make_torus(4, 1.2, 100, 25);
    for (auto& p : mesh.points) {
        const double angle = amount * p[0] / 4;
        const double y = p[1];
        p[1] = std::cos(angle) * y - std::sin(angle) * p[2];
        p[2] = std::sin(angle) * y + std::cos(angle) * p[2] + 0.15 * amount * p[0] * p[0];
    }
    return InterferenceModel(Solid::from_mesh(mesh));
}

struct Asked {
    double volume_tests = 0;
    double primitive_tests = 0;
    double seconds = 0;  // a frame
};

// Both questions at poses where solids are near and where they cross.
Asked ask(PairStructure& s) {
    std::vector<Pose> poses;
    for (int i = 0; i < 12; ++i)
        poses.push_back(Pose::from_quaternion({9, i % 4, 5, i % 3}, {3.4 + 0.2 * i, 0.1 * i, 0.5}));
    Asked r;
    for (const scenes::Question q : {scenes::Question::Faces, scenes::Question::Distance}) {
        const CostCounters n = scenes::run(s, poses, q);
        r.volume_tests += static_cast<double>(n.volume_tests) / 12;
        r.primitive_tests += static_cast<double>(n.primitive_tests) / 12;
        r.seconds += scenes::least_time(s, poses, q, 0.02) / 12;
    }
    return r;
}

}  // namespace

void print_changes() {
    std::printf(
        "| boxes | changes | kind | us a change | us rebuilding | sum of areas, changed | rebuilt "
        "| "
        "ratio | tests a query, changed | rebuilt | Nu a change |\n"
        "|---:|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    constexpr std::array names{"small moves", "anywhere", "leave and enter"};
    constexpr std::uint32_t n = 2000;
    for (const int changes : {1000, 10000})
        for (const Change kind : {Change::SmallMove, Change::Anywhere, Change::LeaveAndEnter}) {
            Crowd crowd(n);
            const std::uint64_t before = crowd.tree.updates();
            double begin = processor_seconds();
            for (int c = 0; c < changes; ++c) crowd.change(kind);
            const double changing = (processor_seconds() - begin) / changes;
            const double updates =
                static_cast<double>(crowd.tree.updates() - before) / static_cast<double>(changes);
            const double changed = crowd.tree.quality();
            const double changed_tests = crowd.tests();
            begin = processor_seconds();
            crowd.tree.rebuild();
            const double rebuilding = processor_seconds() - begin;
            std::printf(
                "| %u | %d | %s | %.2f | %.0f | %.1f | %.1f | %.3f | %.1f | %.1f | %.1f |\n", n,
                changes, names[static_cast<std::size_t>(kind)], 1e6 * changing, 1e6 * rebuilding,
                changed, crowd.tree.quality(), changed / crowd.tree.quality(), changed_tests,
                crowd.tests(), updates);
        }
}

void print_deformation() {
    std::printf(
        "| structure | bent by | building ms | refitting ms | Nbv, refitted | rebuilt | Np, "
        "refitted | rebuilt | us a frame, refitted | rebuilt |\n"
        "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    const InterferenceModel fixed(Solid::from_mesh(make_torus(4, 1.2, 100, 25)));
    const InterferenceModel start = bent(0.02);  // no faces are coplanar
    constexpr std::array amounts{0.1, 0.4, 1.6};
    std::vector<InterferenceModel> shapes;
    for (const double a : amounts) shapes.push_back(bent(a));
    for (const StructureInfo& kind : all_structures()) {
        const auto s = make_structure(kind.kind, fixed, start);
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            CostCounters unused;
            const double begin = processor_seconds();
            if (!s->deform_b(shapes[i], unused)) break;
            const double refitting = processor_seconds() - begin;
            const Asked refitted = ask(*s);
            const double begin_anew = processor_seconds();
            const auto anew = make_structure(kind.kind, fixed, shapes[i]);
            const double building = 0.5 * (processor_seconds() - begin_anew);  // of two trees
            const Asked rebuilt = ask(*anew);
            std::printf("| %s | %.1f | %.2f | %.2f | %.0f | %.0f | %.0f | %.0f | %.1f | %.1f |\n",
                        std::string(kind.name).c_str(), amounts[i], 1e3 * building, 1e3 * refitting,
                        refitted.volume_tests, rebuilt.volume_tests, refitted.primitive_tests,
                        rebuilt.primitive_tests, 1e6 * refitted.seconds, 1e6 * rebuilt.seconds);
            std::fflush(stdout);
        }
    }
}
