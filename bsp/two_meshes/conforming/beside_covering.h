// SPDX-License-Identifier: Apache-2.0
//
// BesideCovering: facets beside a common part of a plane.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/two_meshes/conforming/corner_names.h>
#include <trisect/bsp/two_meshes/conforming/patches.h>

namespace trisect::detail {

/// Facets around what patches of both meshes cover in one plane, as the side faces around the cap
/// on which a can stands. All boxes of a cap's long facets meet those of hundreds of side faces,
/// and no pair of them needs a comparison: a facet that has a corner of both meshes' patches in the
/// plane, or an edge of theirs, and its other corners on one side, has nothing else in common with
/// them.
class BesideCovering {
public:
    /// \pre find_covering() has found the patches to be covering. Exact. O(n log n)
    BesideCovering(const CornerNames& names, const Patches& patches);

    /// Whether the items, one of them covered, meet in corners and edges of both alone. No where it
    /// is not known.
    [[nodiscard]] bool meets_properly(std::uint32_t a, std::uint32_t b) const {
        if (beside_.empty()) return false;
        return is_beside(a, b) || is_beside(b, a);
    }
    /// Whether an item that is not covered needs no comparison with any that is.
    [[nodiscard]] bool is_clear(std::uint32_t item) const;

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    // All that is covered in one plane.
    struct Part {
        std::uint32_t item = 0;  // one of it
        std::array<double, 3> lo{}, hi{};
    };

    [[nodiscard]] bool is_beside(std::uint32_t item, std::uint32_t covered) const {
        return beside_[item] != none && beside_[item] == part_of_[patches_.root(covered)];
    }
    void list_covered();
    void add(std::uint32_t item);
    [[nodiscard]] std::uint32_t part_of(std::uint32_t item);
    [[nodiscard]] std::uint32_t part_beside(std::uint32_t item) const;
    [[nodiscard]] bool meets_in_edge(std::uint32_t item, std::uint32_t part) const;
    [[nodiscard]] int side_of(std::uint32_t part, std::uint32_t name) const;
    [[nodiscard]] bool is_of_both(std::uint32_t name, std::uint32_t part) const {
        return around_[0][name] == part && around_[1][name] == part;
    }

    const CornerNames& names_;
    const Patches& patches_;
    std::vector<Part> parts_;
    std::vector<std::uint32_t> part_of_;                // by root
    std::array<std::vector<std::uint32_t>, 2> around_;  // by mesh and corner: the part
    std::array<std::vector<std::array<std::uint32_t, 2>>, 2> edges_;  // of parts, by mesh; sorted
    std::vector<std::uint32_t> beside_;                               // by item: a part
};

}  // namespace trisect::detail
