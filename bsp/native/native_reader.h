// SPDX-License-Identifier: Apache-2.0
//
// Reader of native files.
#pragma once

#include <cstdint>
#include <memory>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/native/native_view.h>

namespace trisect::detail {

/// All of a file. What is read is consistent: every number names something that is there, cells lie
/// in each other as the tree says, references lie in their cells, corners of fragments are where
/// their planes meet. Whether the polygons bound a set is not checked.
/// \throw InputError with the place; LimitError for a tree that is deeper than `depth`
[[nodiscard]] std::shared_ptr<const SolidState> read_native_state(const NativeView& view,
                                                                  bool fresh_names,
                                                                  std::uint64_t depth,
                                                                  std::uint32_t threads);

/// The cell of a leaf, and the number of its node, on the way from the root.
struct NativeLeafPlace {
    std::uint64_t node = 0;
    Cell cell;
    bool complemented = false;
};
/// \pre the file has such a leaf. \throw InputError
[[nodiscard]] NativeLeafPlace find_leaf(const NativeView& view, std::uint64_t leaf);

}  // namespace trisect::detail
