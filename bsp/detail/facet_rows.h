// SPDX-License-Identifier: Apache-2.0
//
// FacetRows: triangles and their planes in single precision, four at a time, to find out quickly
// what surely does not meet.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <trisect/bsp/detail/plain_facets.h>

namespace trisect::detail {

/// Facets of a leaf in the order in which they are added. All answers are on the safe side; what
/// they leave open is for doubles.
class FacetRows {
public:
    /// For a leaf whose points differ by no more than this, see PlainFacets::extent().
    void start(const Vector3& extent);
    void add(const std::array<Vector3, 3>& corners, const PlainPlane& plane);

    /// A facet to be compared with the others.
    struct Probe {
        std::array<std::array<float, 3>, 3> corners;
        std::array<float, 3> normal;
        float offset;
        float bound;
    };
    [[nodiscard]] Probe probe(std::size_t facet) const;
    /// Which facets of a row lie beside the probe's plane, or have the probe beside theirs: a bit
    /// for each. Such a facet and the probe have no point in common.
    [[nodiscard]] unsigned parted(std::size_t row, const Probe& probe) const;

    /// A segment between two points of the leaf.
    struct Segment {
        std::array<std::array<float, 3>, 2> ends;
        float error;
    };
    [[nodiscard]] Segment segment(const Approximation& a, const Approximation& b) const;
    /// Which facets of a row have both ends surely on one side of their plane, or the whole line
    /// surely beside them.
    [[nodiscard]] unsigned parted(std::size_t row, const Segment& segment) const;

private:
    using Four = std::array<float, 4>;
    // Coordinates are scaled so that no two points of the leaf differ by more than 1. The plane of
    // a facet has `normal` · p - `offset` = 0, the largest component of the normal is 1 or -1, and
    // values at points of the leaf are off by less than `bound`.
    struct alignas(16) Row {
        std::array<std::array<Four, 3>, 3> corners{};
        std::array<Four, 3> normal{};
        Four offset{};
        Four bound{};
    };
    std::vector<Row> rows_;
    std::size_t size_ = 0;
    double scale_ = 1;  // a power of 2
    Vector3 extent_{};
};

}  // namespace trisect::detail
