// SPDX-License-Identifier: Apache-2.0
//
// Open edges of a mesh by the names of their ends.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/mend/mend.h>
#include <trisect/brep/mend/mending_mesh.h>

namespace trisect::detail {

/// An edge whose uses do not cancel.
struct UnmatchedEdge {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::int64_t net = 0;    ///< uses from low to high less those back; not 0
    std::uint32_t uses = 0;  ///< odd: a face is missing; even: one is turned over
    std::uint32_t face = 0;  ///< the first one
    [[nodiscard]] bool is_odd() const { return uses % 2 == 1; }
    friend bool operator==(const UnmatchedEdge&, const UnmatchedEdge&) = default;
};

/// In lexicographic order. O(n).
[[nodiscard]] std::vector<UnmatchedEdge> unmatched_edges(const MendingMesh& mesh);
/// Those of an odd number of faces, whatever their orientation.
[[nodiscard]] std::vector<UnmatchedEdge> odd_edges(const MendingMesh& mesh);
/// Their ends, ascending, each once.
[[nodiscard]] std::vector<std::uint32_t> ends_of(std::span<const UnmatchedEdge> edges);

/// The faces at some vertices, side by side.
class FacesAtVertices {
public:
    /// `vertices` ascending. O(n).
    FacesAtVertices(const MendingMesh& mesh, std::span<const std::uint32_t> vertices);
    /// Ascending, each once. \param i index in `vertices`
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t i) const {
        return {faces_.data() + begin_[i], faces_.data() + begin_[i + 1]};
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> faces_;
};

/// Of two ascending lists.
[[nodiscard]] bool have_common(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b);

/// Notes what is open, and what is not oriented: edges that do not cancel with others of their line
/// either.
void report_open(const MendingMesh& mesh, Lattice lattice, MendReport& report);

}  // namespace trisect::detail
