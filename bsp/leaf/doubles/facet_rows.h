// SPDX-License-Identifier: Apache-2.0
//
// FacetRows: quick rejection of triangle pairs, four at a time.
// Triangles and their planes are in single precision.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/leaf/doubles/filtered_facets.h>

namespace trisect::detail {

/// Facets of a leaf in the order in which they are added. All answers are on the safe side; what
/// they leave open is for doubles.
class FacetRows {
public:
    /// For a leaf whose points differ by no more than this, see FilteredFacets::extent().
    void start(const Vector3& extent);
    void add(const std::array<Vector3, 3>& corners, const FilteredPlane& plane);
    using Four = std::array<float, 4>;
    /// Of corners as single_of() has them, aligned to 16 bytes.
    void add(const std::array<Four, 3>& corners, const FilteredPlane& plane);
    [[nodiscard]] static Four single_of(const Vector3& corner) {
        return {static_cast<float>(corner[0]), static_cast<float>(corner[1]),
                static_cast<float>(corner[2]), 0};
    }
    /// A place for a facet that is never looked at.
    void skip() {
        if (size_++ % 4 == 0) rows_.emplace_back();
        singles_.emplace_back();
    }

    /// A facet to be compared with the others: every number four times.
    struct alignas(16) Probe {
        std::array<std::array<Four, 3>, 3> corners;
        std::array<Four, 3> normal;
        Four offset;
        Four bound;
    };
    [[nodiscard]] Probe probe(std::size_t facet) const;
    /// Which facets of a row lie beside the probe's plane, or have the probe beside theirs: a bit
    /// for each of those `among` them, and perhaps for others. Such a facet and the probe have no
    /// point in common.
    [[nodiscard]] unsigned parted(std::size_t row, const Probe& probe, unsigned among = 15) const;

    /// How four pairs of facets lie to each other: a bit for each pair.
    struct Relation {
        unsigned apart = 0;    ///< have no point in common
        unsigned crosses = 0;  ///< cross in a segment; only for these is the rest set:
        /// By facet of the pair and by corner: above the other one's plane, else below.
        std::array<std::array<unsigned, 3>, 2> above{};
        /// In the direction of the normals' product, first × second, the segment starts, or ends,
        /// at an edge of the second one and not of the first one.
        unsigned starts = 0;
        unsigned ends = 0;
    };
    using Pair = std::array<std::uint32_t, 2>;
    /// What is neither apart nor crosses is for doubles.
    [[nodiscard]] Relation relate(const std::array<Pair, 4>& pairs) const;

    /// A segment between two points of the leaf.
    struct Segment {
        std::array<std::array<float, 3>, 2> ends;
        float error;
    };
    [[nodiscard]] Segment segment(const Approximation& a, const Approximation& b) const;
    /// Which facets of a row have both ends surely on one side of their plane, or the whole line
    /// surely beside them; of those `among` them, as above.
    [[nodiscard]] unsigned parted(std::size_t row, const Segment& segment,
                                  unsigned among = 15) const;

private:
    // Coordinates are scaled so that no two points of the leaf differ by more than 1. The plane of
    // a facet has `normal` · p - `offset` = 0, the largest component of the normal is 1 or -1, and
    // values at points of the leaf are off by less than `bound`.
    struct alignas(16) Row {
        std::array<std::array<Four, 3>, 3> corners{};
        std::array<Four, 3> normal{};
        Four offset{};
        Four bound{};
    };
    // The same of one facet, for those that are picked out of their rows: three corners with a
    // component of the normal behind each; then the offset, the bound and what the normal's
    // components are off by at most.
    struct alignas(64) Single {
        std::array<Four, 4> numbers;
    };
    struct PlaneInSingles {
        std::array<float, 3> normal{};
        float offset = 0;
        float bound = 0;
        float tilt = 0;
    };
    [[nodiscard]] PlaneInSingles in_singles(const FilteredPlane& plane) const;

    std::vector<Row> rows_;
    std::vector<Single> singles_;
    std::size_t size_ = 0;
    double scale_ = 1;  // a power of 2
    Vector3 extent_{};
};

}  // namespace trisect::detail
