// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/interference/boxes/broad_phase.h>
#include <trisect/bsp/interference/scene/broad_phases.h>
#include <trisect/bsp/interference/scene/chain_boxes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "reference/random_solids.h"

namespace {

using reference::Random;
using trisect::detail::BodyBox;
using trisect::detail::BodyPair;
using trisect::detail::BroadPhase;

struct Kind {
    const char* name;
    std::unique_ptr<BroadPhase> (*make)();

    friend std::ostream& operator<<(std::ostream& out, const Kind& k) { return out << k.name; }
};

class BroadPhaseTest : public testing::TestWithParam<Kind> {
protected:
    std::unique_ptr<BroadPhase> phase_ = GetParam().make();
    std::map<std::uint32_t, BodyBox> boxes_;

    void insert(std::uint32_t slot, const BodyBox& box) {
        phase_->insert(slot, box);
        boxes_[slot] = box;
    }
    void update(std::uint32_t slot, const BodyBox& box) {
        phase_->update(slot, box);
        boxes_[slot] = box;
    }
    void remove(std::uint32_t slot) {
        phase_->remove(slot);
        boxes_.erase(slot);
    }
    [[nodiscard]] std::vector<BodyPair> pairs() const {
        std::vector<BodyPair> out;
        phase_->pairs(out);
        return out;
    }
    [[nodiscard]] std::vector<BodyPair> brute_force() const {
        std::vector<BodyPair> out;
        for (const auto& [i, a] : boxes_)
            for (const auto& [j, b] : boxes_)
                if (i < j && a.meets(b)) out.push_back({i, j});
        return out;
    }
};

/// Small integers, so that boxes touch and coincide all the time; some boxes are flat.
BodyBox random_box(Random& random, std::int64_t extent) {
    BodyBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = static_cast<double>(random.between(0, extent));
        box.hi[k] = box.lo[k] + static_cast<double>(random.between(0, 3));
    }
    return box;
}

TEST_P(BroadPhaseTest, NothingMeetsNothing) {
    EXPECT_TRUE(pairs().empty());
    insert(7, {{0, 0, 0}, {1, 1, 1}});
    EXPECT_TRUE(pairs().empty());
    remove(7);
    EXPECT_TRUE(pairs().empty());
}

TEST_P(BroadPhaseTest, BoxesThatTouchInAFaceAnEdgeOrACornerMeet) {
    insert(0, {{0, 0, 0}, {1, 1, 1}});
    insert(1, {{1, 0, 0}, {2, 1, 1}});
    insert(2, {{1, 1, 0}, {2, 2, 1}});
    insert(3, {{1, 1, 1}, {2, 2, 2}});
    insert(4, {{3, 3, 3}, {4, 4, 4}});
    const std::vector<BodyPair> expected{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    EXPECT_EQ(pairs(), expected);
}

TEST_P(BroadPhaseTest, BoxesOnALineAlongEachAxis) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::uint32_t i = 0; i < 20; ++i) {
            BodyBox box{{0, 0, 0}, {1, 1, 1}};
            box.lo[axis] = 2.0 * i;
            box.hi[axis] = 2.0 * i + 2;
            if (axis == 0) {
                insert(i, box);
            } else {
                update(i, box);
            }
        }
        EXPECT_EQ(pairs(), brute_force()) << axis;
        EXPECT_EQ(pairs().size(), 19U) << axis;
    }
}

TEST_P(BroadPhaseTest, MovingInsertedAndRemovedBoxesAsBruteForce) {
    Random random(1);
    for (std::uint32_t i = 0; i < 40; ++i) insert(i, random_box(random, 12));
    for (int frame = 0; frame < 300; ++frame) {
        for (std::uint32_t slot = 0; slot < 60; ++slot) {
            const bool present = boxes_.count(slot) != 0;
            if (present && random.chance(1, 20)) {
                remove(slot);
            } else if (!present && random.chance(1, 20)) {
                insert(slot, random_box(random, 12));
            } else if (present && random.chance(frame % 10, 10)) {
                BodyBox box = boxes_[slot];
                const auto axis = random.below(3);
                const auto step = static_cast<double>(random.between(-1, 1));
                box.lo[axis] += step;
                box.hi[axis] += step;
                update(slot, box);
            }
        }
        ASSERT_EQ(pairs(), brute_force()) << frame;
    }
}

TEST_P(BroadPhaseTest, BoxesThatAllJumpAsBruteForce) {
    Random random(2);
    for (std::uint32_t i = 0; i < 200; ++i) insert(i, random_box(random, 20));
    for (int frame = 0; frame < 20; ++frame) {
        for (std::uint32_t i = 0; i < 200; ++i) update(i, random_box(random, 20));
        ASSERT_EQ(pairs(), brute_force()) << frame;
    }
}

TEST_P(BroadPhaseTest, SizesOverThirtyPowersOfTwoAsBruteForce) {
    Random random(3);
    const auto random_size_box = [&random] {
        BodyBox box;
        const double size = std::ldexp(1.0, static_cast<int>(random.between(-20, 10)));
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] = std::ldexp(static_cast<double>(random.between(-4000, 4000)), -6) * 1.7;
            box.hi[k] = box.lo[k] + size * static_cast<double>(random.between(0, 9)) / 8;
        }
        return box;
    };
    for (std::uint32_t i = 0; i < 150; ++i) insert(i, random_size_box());
    for (int frame = 0; frame < 20; ++frame) {
        for (std::uint32_t i = 0; i < 150; ++i)
            if (random.chance(1, 3)) update(i, random_size_box());
        ASSERT_EQ(pairs(), brute_force()) << frame;
    }
}

TEST_P(BroadPhaseTest, UnboundedFlatAndFarBoxes) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    insert(0, {{0, 0, 0}, {1, 1, 1}});
    insert(1, {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}});
    insert(2, {{5, 5, 5}, {5, 5, 5}});
    insert(3, {{5, 5, 5}, {5, 5, 5}});
    insert(4, {{1e300, 0, 0}, {1e301, 1e-300, 1}});
    insert(5, {{-infinity, 5, 5}, {5, 5, 5}});
    insert(6, {{1e300, 1e-300, 1}, {1e300, 1e-300, 1}});
    insert(7, {{1e18, 1e18, 1e18}, {1e18, 1e18, 1e18 + 256}});
    EXPECT_EQ(pairs(), brute_force());
    remove(1);
    EXPECT_EQ(pairs(), brute_force());
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, BroadPhaseTest,
    testing::Values(Kind{"Sweep", trisect::detail::make_sweep_and_prune},
                    Kind{"Tree", trisect::detail::make_box_tree},
                    Kind{"HashGrid", trisect::hierarchies::make_hash_grid},
                    Kind{"HierarchicalGrid", trisect::hierarchies::make_hierarchical_grid},
                    Kind{"Octree", trisect::hierarchies::make_octree_phase},
                    Kind{"KdTree", trisect::hierarchies::make_kd_tree_phase},
                    Kind{"ChainBoxes", trisect::hierarchies::make_chain_boxes}),
    [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
