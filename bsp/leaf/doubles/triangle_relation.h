// SPDX-License-Identifier: Apache-2.0
//
// TriangleRelation: the relation of two triangles in doubles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <trisect/bsp/cells/trace/interpolation.h>
#include <trisect/bsp/leaf/doubles/facet_rows.h>
#include <trisect/bsp/leaf/doubles/filtered_facets.h>

namespace trisect::detail {

/// The corner of a triangle that is alone on its side of a plane, and the edges that go through
/// that upwards and downwards.
class LonelyCorner {
public:
    /// \pre bit i: corner i is above; one or two are
    explicit LonelyCorner(unsigned above) : is_above_(above == 1 || above == 2 || above == 4) {
        constexpr std::array<std::uint8_t, 8> corner{0, 0, 1, 2, 2, 1, 0, 0};
        corner_ = corner[above];
    }
    [[nodiscard]] std::size_t corner() const { return corner_; }
    /// The other end of that edge.
    [[nodiscard]] std::size_t other(bool up) const {
        constexpr std::array<std::uint8_t, 3> next{1, 2, 0};
        return up == is_above_ ? next[next[corner_]] : next[corner_];
    }
    [[nodiscard]] std::int8_t edge(bool up) const {
        return static_cast<std::int8_t>(up == is_above_ ? other(up) : corner_);
    }

private:
    std::size_t corner_;
    bool is_above_;
};

/// Of two triangles, where their corners and the order of their edges along the line of both planes
/// are certain.
struct TriangleRelation {
    enum class Kind : std::uint8_t {
        Apart,      ///< no point in common
        Crossing,   ///< they cross in a segment; only then the rest is set
        NearPlane,  ///< a corner is too near the other one's plane
        NearEdges   ///< an edge is too near an edge of the other one
    };
    Kind kind = Kind::Apart;
    /// Bit i: corner i of that one is above the other one's plane, else below.
    std::array<unsigned, 2> above{};
    /// In the direction of the normals' product, first × second, the segment starts, or ends, at an
    /// edge of the second one and not of the first one.
    bool starts = false;
    bool ends = false;

    TriangleRelation() = default;
    /// Of a pair among four that surely cross.
    TriangleRelation(const FacetRows::Relation& four, unsigned i);
    /// The same with the second one first.
    [[nodiscard]] TriangleRelation turned() const {
        TriangleRelation out = *this;
        out.above = {above[1], above[0]};
        out.starts = !ends;
        out.ends = !starts;
        return out;
    }
    /// Which edge ends the segment.
    struct End {
        bool of_second = false;
        bool up = false;  ///< it goes up through the other one's plane
        LonelyCorner edge;
    };
    /// In that direction the first one begins where it goes up through the other plane, the second
    /// one where it goes down.
    [[nodiscard]] End end(std::size_t k) const {
        const bool of_second = k == 0 ? starts : ends;
        return {of_second, of_second == (k == 1), LonelyCorner(above[of_second ? 1 : 0])};
    }
};

struct TriangleAndPlane {
    const std::array<Vector3, 3>& corners;
    const FilteredPlane& plane;
};

/// Where an end is. False when doubles say too little.
[[nodiscard]] inline bool find_end(const TriangleAndPlane& first, const TriangleAndPlane& second,
                                   const TriangleRelation::End& end, Approximation& at) {
    const std::array<Vector3, 3>& corners = (end.of_second ? second : first).corners;
    const FilteredPlane& plane = (end.of_second ? first : second).plane;
    const Vector3& from = corners[end.edge.corner()];
    const Vector3& to = corners[end.edge.other(end.up)];
    return interpolate({from, 0.0}, plane.value(from), {to, 0.0}, plane.value(to), 2 * plane.bound,
                       at);
}

[[nodiscard]] TriangleRelation relate_triangles(const TriangleAndPlane& first,
                                                const TriangleAndPlane& second);

inline TriangleRelation::TriangleRelation(const FacetRows::Relation& four, unsigned i)
    : kind(Kind::Crossing), starts((four.starts >> i & 1U) != 0), ends((four.ends >> i & 1U) != 0) {
    for (std::size_t k = 0; k < 2; ++k)
        above[k] = (four.above[k][0] >> i & 1U) | (four.above[k][1] >> i & 1U) << 1 |
                   (four.above[k][2] >> i & 1U) << 2;
}

}  // namespace trisect::detail
