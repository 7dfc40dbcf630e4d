// SPDX-License-Identifier: Apache-2.0
//
// Pairs of a leaf's polygons that cut, overlap or touch each other.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/bsp/leaf/leaf_work.h>

namespace trisect::detail {

/// Compares the polygons whose boxes meet and that are not of one embedded operand. Finds their
/// contacts, fills in `cut` and `overlapped`, and declares planes the same that are.
///
/// Candidates come from a sweep along the axis on which the boxes are shortest; then the supports
/// separate most of them exactly, with signs that the filter decides. Scratch memory that is kept
/// from leaf to leaf.
class LeafPairs {
public:
    void relate_all(LeafWork& work);

private:
    /// What the sweep reads of an item, in one place: `box` has the axis of the sweep first.
    struct Candidate {
        std::array<std::int64_t, 3> lo;
        std::array<std::int64_t, 3> hi;
        LeafIndex item;
        LeafIndex operand;
        bool skips_own;  // of an embedded operand
    };
    /// A whole facet in doubles, which hold lattice points exactly; beside each candidate.
    struct Facet {
        std::array<std::array<double, 3>, 3> corners{};
        std::array<std::uint32_t, 3> vertices{};
        LeafIndex surface = -1;  // -1: not a whole facet
        std::array<double, 3> normal{};
        double offset = 0;
        double bound = -1;  // of the error of a side; -1: the plane is not made yet
    };
    void list_candidates(const LeafWork& work);
    [[nodiscard]] int best_axis(const LeafWork& work) const;
    void sort_along(const LeafWork& work, int axis);
    void sweep(LeafWork& work);
    void list_facets(const LeafWork& work);
    void make_plane(LeafWork& work, std::size_t i);
    [[nodiscard]] bool separates(LeafWork& work, std::size_t i, std::size_t j);
    [[nodiscard]] bool are_apart_otherwise(std::size_t i, std::size_t j) const;
    void relate(LeafWork& work, LeafIndex s, LeafIndex t);

    std::vector<Box> operand_boxes_;
    std::vector<Candidate> candidates_;
    std::vector<Facet> facets_;
    std::array<double, 3> largest_{};  // coordinates of the facets' corners
    std::vector<std::pair<LeafIndex, LeafContact>> contacts_;
};

}  // namespace trisect::detail
