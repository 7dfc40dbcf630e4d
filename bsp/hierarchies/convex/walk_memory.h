// SPDX-License-Identifier: Apache-2.0
//
// WalkMemory: end features of tree-node walks, as starts for later poses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include <trisect/bsp/hierarchies/convex/feature_walk.h>

namespace trisect::hierarchies {

/// Keeps pairs of nodes that were walked at this pose or at the last one, so memory is bounded by
/// what two poses need.
class WalkMemory {
public:
    /// The last features of these nodes; the first vertices if there are none.
    [[nodiscard]] FeaturePair start(std::uint32_t a, std::uint32_t b) const {
        if (const auto it = now_.find(key(a, b)); it != now_.end()) return it->second;
        if (const auto it = last_.find(key(a, b)); it != last_.end()) return it->second;
        return {};
    }
    void keep(std::uint32_t a, std::uint32_t b, const FeaturePair& pair) { now_[key(a, b)] = pair; }
    void next_pose() {
        last_.swap(now_);
        now_.clear();
    }
    [[nodiscard]] std::size_t size() const { return now_.size() + last_.size(); }

private:
    static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
        return std::uint64_t{a} << 32U | b;
    }
    std::unordered_map<std::uint64_t, FeaturePair> last_;
    std::unordered_map<std::uint64_t, FeaturePair> now_;
};

}  // namespace trisect::hierarchies
