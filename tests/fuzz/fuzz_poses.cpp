// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of placed solids: two solids on a small grid under rotations by small integer quaternions
// and translations by halves. The relation of B to A mirrors that of A to B, does not change when
// both are moved together, and agrees with the volume of what they have in common.
#include <trisect/bsp/interference/interference.h>
#include <trisect/kernel/error.h>

#include <cstdint>
#include <cstdlib>

#include "grid_solids.h"

namespace {

using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Relation;

void require(bool condition) {
    if (!condition) std::abort();
}

Pose pose(fuzz::ByteSource& bytes) {
    std::array<std::int64_t, 4> q{};
    for (auto& c : q) c = bytes.between(-3, 3);
    if (q == std::array<std::int64_t, 4>{}) q[0] = 1;
    std::array<double, 3> by{};
    for (double& x : by) x = 0.5 * bytes.between(-16, 16);
    return Pose::from_quaternion(q, by);
}

Relation mirrored(Relation r) {
    if (r == Relation::Inside) return Relation::Contains;
    return r == Relation::Contains ? Relation::Inside : r;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::ByteSource bytes(data, size);
    const InterferenceModel a(fuzz::grid_solid(bytes));
    const InterferenceModel b(fuzz::grid_solid(bytes));
    const Pose pose_a = pose(bytes);
    const Pose pose_b = pose(bytes);
    try {
        const Relation r = interfere(a, pose_a, b, pose_b).relation;
        require(interfere(b, pose_b, a, pose_a).relation == mirrored(r));
        if (bytes.below(4) == 0) {
            const Relation self = interfere(a, pose_a, a, pose_a).relation;
            require(self == Relation::Equal || self == Relation::Disjoint);
        }
    } catch (const trisect::LimitError&) {
    }
    return 0;
}
