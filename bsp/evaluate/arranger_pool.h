// SPDX-License-Identifier: Apache-2.0
//
// ArrangerPool: scratch memory of leaves, reused by later evaluations.
#pragma once

#include <memory>

#include <trisect/bsp/evaluate/leaf_arrangement.h>

namespace trisect::detail {

/// Arrangers that evaluations have done with. A cut that arranges a dozen leaves would make some
/// two hundred vectors for that and give them back. Keeps a few arrangers, and none that has seen
/// a large leaf. Safe to use from many threads.
class ArrangerPool {
public:
    /// One like new.
    [[nodiscard]] static std::unique_ptr<LeafArranger> take();
    static void give_back(std::unique_ptr<LeafArranger> arranger) noexcept;
};

}  // namespace trisect::detail
