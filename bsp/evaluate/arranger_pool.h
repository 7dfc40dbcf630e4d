// SPDX-License-Identifier: Apache-2.0
//
// ArrangerPool: scratch memory of leaves, reused by later evaluations.
#pragma once

#include <cstddef>
#include <memory>

#include <trisect/bsp/leaf/doubles/filtered_leaf.h>
#include <trisect/bsp/leaf/exact/exact_leaf.h>
#include <trisect/bsp/leaf/grid/axis_leaf.h>
#include <trisect/bsp/leaf/prism/prism_leaf.h>

namespace trisect::detail {

/// All arrangements of leaves, for one thread.
struct LeafArrangers {
    AxisLeaf grid;
    FilteredLeaf doubles;
    PrismLeaf prisms;
    ExactLeaf exact;
    std::size_t largest_leaf = 0;  ///< polygons of the largest leaf so far
};

/// Arrangers that evaluations have done with. A cut that arranges a dozen leaves would make some
/// two hundred vectors for that and give them back. Keeps a few arrangers, and none that has seen
/// a large leaf. Safe to use from many threads.
class ArrangerPool {
public:
    /// As good as new.
    [[nodiscard]] static std::unique_ptr<LeafArrangers> take();
    static void give_back(std::unique_ptr<LeafArrangers> arrangers) noexcept;
};

}  // namespace trisect::detail
