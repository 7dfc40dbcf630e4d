// SPDX-License-Identifier: Apache-2.0
//
// Representations of a STEP file with shapes, and their places.
//
// Representations that a relationship ties together without a transformation are one frame. A frame
// is placed in another one by a relationship with a transformation between two placements, as
// assemblies are, or by a mapped item. What nothing places stands where it is.
#pragma once

#include <trisect/brep/io/models/step/text.h>
#include <trisect/brep/number/exact_affine.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace trisect::detail {

struct StepFrame {
    struct Child {
        std::size_t frame = 0;
        ExactAffine placement;
        const char* at = nullptr;
    };
    std::vector<std::uint64_t> shapes;    ///< entities, in the order of their numbers
    std::vector<std::uint64_t> contexts;  ///< of representations with shapes or placements
    std::vector<Child> children;
    std::string name;  ///< of the product
    bool is_placed = false;
};

/// \throw InputError for malformed structure, UnsupportedError for solids in representations and
/// for placements that are not read, by name
[[nodiscard]] std::vector<StepFrame> step_frames(const StepText& text);

}  // namespace trisect::detail
