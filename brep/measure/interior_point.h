// SPDX-License-Identifier: Apache-2.0
//
// Rational points strictly inside a boundary, close to one of its vertices.
#pragma once

#include <memory>
#include <optional>

#include <trisect/brep/brep.h>
#include <trisect/brep/winding_number.h>

namespace trisect::detail {

class InteriorPoints {
public:
    /// O(n) fractions. The Brep must live as long.
    explicit InteriorPoints(const Brep& brep);
    InteriorPoints(const InteriorPoints&) = delete;
    InteriorPoints& operator=(const InteriorPoints&) = delete;
    ~InteriorPoints();

    /// A point of the interior: from the inside of a face at the vertex straight into the solid,
    /// half of the way to the next face. The larger `shrink`, the closer to the vertex: the
    /// distance is below 2^(1 - shrink) of the face's size. In the user's units. O(n).
    [[nodiscard]] ExactPoint near(VertexId v, unsigned shrink) const;

private:
    struct Data;
    std::unique_ptr<const Data> data_;
};

}  // namespace trisect::detail
