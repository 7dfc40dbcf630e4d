// SPDX-License-Identifier: Apache-2.0
//
// Exact intersection of two triangles of posed solids, with its features.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/pose/moved_predicates.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect::detail {

/// A triangle in its own solid's lattice, counter-clockwise seen from above its plane, which is the
/// outward one of its face.
struct PosedTriangle {
    std::array<const Point*, 3> corner{};
    const Plane* plane = nullptr;
};

/// A part of a triangle: corners 0, 1, 2, sides 3, 4, 5 (from corner i to the next), the interior.
class Feature {
public:
    constexpr Feature() = default;
    [[nodiscard]] static constexpr Feature corner(std::size_t i) { return Feature(i); }
    [[nodiscard]] static constexpr Feature side(std::size_t i) { return Feature(3 + i); }
    [[nodiscard]] static constexpr Feature interior() { return Feature(6); }

    [[nodiscard]] constexpr bool is_corner() const { return code_ < 3; }
    [[nodiscard]] constexpr bool is_side() const { return code_ >= 3 && code_ < 6; }
    [[nodiscard]] constexpr bool is_interior() const { return code_ == 6; }
    /// Of a corner or side.
    [[nodiscard]] constexpr std::size_t index() const { return code_ < 3 ? code_ : code_ - 3U; }
    /// Whether it is side i or one of its ends.
    [[nodiscard]] constexpr bool is_on_side(std::size_t i) const {
        return is_side() ? index() == i : is_corner() && (index() == i || index() == (i + 1) % 3);
    }
    friend constexpr bool operator==(const Feature&, const Feature&) = default;

private:
    constexpr explicit Feature(std::size_t code) : code_(static_cast<std::uint8_t>(code)) {}
    std::uint8_t code_ = 6;
};

/// The feature that a point of the plane is on, from its signs towards the three sides, inside
/// positive; nothing when it is outside.
[[nodiscard]] std::optional<Feature> feature_from_signs(const std::array<int, 3>& s);

/// A point where the triangles meet, as the smallest features of both that it lies on.
struct MeetingPoint {
    Feature a;
    Feature b;
    friend constexpr bool operator==(const MeetingPoint&, const MeetingPoint&) = default;
};

/// The intersection of two triangles is convex: nothing, a point, a segment or a polygon of up to
/// six corners. These are its corners, in no order.
struct TriangleContact {
    std::array<MeetingPoint, 6> points{};
    std::uint8_t count = 0;
    bool coplanar = false;
    /// Coplanar with outward normals that point in opposite directions.
    bool opposite = false;
    /// The interiors of both triangles pass through each other along a segment: the solids'
    /// interiors meet, and neither solid contains the other.
    bool crossing = false;

    [[nodiscard]] bool meets() const { return count != 0; }
    /// Of the intersection: 0, 1 or 2. \pre meets()
    [[nodiscard]] int dimension() const { return count > 2 ? 2 : count - 1; }
    [[nodiscard]] std::span<const MeetingPoint> corners() const {
        return std::span(points).first(count);
    }
};

/// Finds contacts of triangles of A with triangles of B. Remembers planes seen from the other side
/// and the last two that were found to be one, so runs of pairs near each other are cheaper.
/// 150 KB, for one thread.
class TrianglePairTest {
public:
    explicit TrianglePairTest(const PosedPair& poses) : poses_(&poses) {}

    /// Planes must live as long as this, points until the call ends.
    [[nodiscard]] TriangleContact operator()(const PosedTriangle& a, const PosedTriangle& b);

private:
    // Pulled planes by the addresses of planes.
    class Planes {
    public:
        [[nodiscard]] const PulledPlane& get(const Plane& plane, const RelativePose& pose);

    private:
        struct Entry {
            const Plane* plane = nullptr;
            std::optional<PulledPlane> pulled;
        };
        std::vector<Entry> entries_ = std::vector<Entry>(16);
    };

    const PosedPair* poses_;
    Planes planes_a_;
    Planes planes_b_;
    const Plane* coplanar_a_ = nullptr;
    const Plane* coplanar_b_ = nullptr;
    int sense_ = 1;
};

}  // namespace trisect::detail
