// SPDX-License-Identifier: Apache-2.0
//
// TriangleBoxes: boxes around the triangles of a model, possibly moved.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/pair_structure.h>
#include <trisect/bsp/interference/boxes/broad_phase.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect::hierarchies {

using Box = trisect::detail::BodyBox;

/// Boxes by the numbers of triangles; they contain their triangles provably. Value type.
class TriangleBoxes {
public:
    TriangleBoxes() = default;
    /// In the model's own lattice units.
    explicit TriangleBoxes(const detail::InterferenceModelData& model);

    /// Of a moved model, in lattice units of the other one. One update of a box a triangle.
    void move(const detail::InterferenceModelData& model, const Placement& placement);

    [[nodiscard]] std::size_t size() const { return boxes_.size(); }
    [[nodiscard]] const Box& operator[](std::size_t i) const { return boxes_[i]; }
    [[nodiscard]] std::span<const Box> all() const { return boxes_; }
    /// Around all of them.
    [[nodiscard]] const Box& bounds() const { return bounds_; }
    /// Where the doubles put a vertex, by its number; within error() of where it is.
    [[nodiscard]] const std::array<double, 3>& corner(std::size_t vertex) const {
        return corners_[vertex];
    }
    [[nodiscard]] double error() const { return error_; }
    [[nodiscard]] std::size_t bytes() const {
        return boxes_.size() * sizeof(Box) + corners_.size() * sizeof(corners_[0]);
    }

private:
    void fit(const detail::InterferenceModelData& model);

    std::vector<std::array<double, 3>> corners_;
    std::vector<Box> boxes_;
    Box bounds_;
    double error_ = 0;
};

}  // namespace trisect::hierarchies
