// SPDX-License-Identifier: Apache-2.0
//
// Plain types and constants that programs for Manifold use.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include <manifold/linalg.h>

// NOLINTBEGIN(readability-identifier-naming): names are those of another library
namespace manifold {

namespace la = linalg;

using vec2 = la::vec<double, 2>;
using vec3 = la::vec<double, 3>;
using vec4 = la::vec<double, 4>;
using quat = la::vec<double, 4>;
using ivec2 = la::vec<int, 2>;
using ivec3 = la::vec<int, 3>;
using ivec4 = la::vec<int, 4>;
using mat2 = la::mat<double, 2, 2>;
using mat3 = la::mat<double, 3, 3>;
using mat4 = la::mat<double, 4, 4>;
using mat2x3 = la::mat<double, 2, 3>;
using mat3x4 = la::mat<double, 3, 4>;

inline constexpr double kPi = 3.141592653589793;
inline constexpr double kTwoPi = 2 * kPi;
inline constexpr double kHalfPi = kPi / 2;

constexpr double radians(double degrees) { return degrees / 180 * kPi; }
constexpr double degrees(double radians) { return radians / kPi * 180; }

/// Of degrees; exact at multiples of 90.
double sind(double degrees);
double cosd(double degrees);
/// 0 up to `from`, 1 beyond `to`, and between them the cubic that is flat at both.
double smoothstep(double from, double to, double x);

using SimplePolygon = std::vector<vec2>;
/// Outlines are counter-clockwise, holes clockwise, in any order.
using Polygons = std::vector<SimplePolygon>;

struct Smoothness {
    std::size_t halfedge = 0;
    double smoothness = 1;
};

struct RayHit {
    std::uint64_t faceID = 0;
    double distance = 0;  ///< 0 at the origin, 1 at the end point
    vec3 position;
    vec3 normal;
};

/// A box along the axes; from infinity to minus infinity where nothing is in it.
struct Box {
    vec3 min = vec3(std::numeric_limits<double>::infinity());
    vec3 max = vec3(-std::numeric_limits<double>::infinity());

    Box() = default;
    Box(const vec3& a, const vec3& b) : min(la::min(a, b)), max(la::max(a, b)) {}

    [[nodiscard]] vec3 Size() const { return max - min; }
    [[nodiscard]] vec3 Center() const { return (min + max) * 0.5; }
    /// The largest absolute coordinate.
    [[nodiscard]] double Scale() const { return la::maxelem(la::max(la::abs(min), la::abs(max))); }
    [[nodiscard]] bool Contains(const vec3& p) const {
        return la::min(min, p) == min && la::max(max, p) == max;
    }
    [[nodiscard]] bool Contains(const Box& b) const { return Contains(b.min) && Contains(b.max); }
    [[nodiscard]] bool DoesOverlap(const Box& b) const {
        const vec3 low = la::max(min, b.min);
        return la::min(low, la::min(max, b.max)) == low;
    }
    [[nodiscard]] bool IsFinite() const {
        return std::isfinite(la::minelem(min)) && std::isfinite(la::maxelem(max)) &&
               std::isfinite(la::maxelem(min)) && std::isfinite(la::minelem(max));
    }
    void Union(const vec3& p) {
        min = la::min(min, p);
        max = la::max(max, p);
    }
    [[nodiscard]] Box Union(const Box& b) const {
        Box both = *this;
        both.min = la::min(min, b.min);
        both.max = la::max(max, b.max);
        return both;
    }
    /// Of a map that keeps the axes.
    [[nodiscard]] Box Transform(const mat3x4& m) const {
        return {m * vec4(min, 1.0), m * vec4(max, 1.0)};
    }
    Box operator+(const vec3& by) const { return {min + by, max + by}; }
    Box& operator+=(const vec3& by) { return *this = *this + by; }
    Box operator*(const vec3& by) const { return {min * by, max * by}; }
    Box& operator*=(const vec3& by) { return *this = *this * by; }
    friend bool operator==(const Box&, const Box&) = default;
};

/// The same in the plane.
struct Rect {
    vec2 min = vec2(std::numeric_limits<double>::infinity());
    vec2 max = vec2(-std::numeric_limits<double>::infinity());

    Rect() = default;
    Rect(const vec2& a, const vec2& b) : min(la::min(a, b)), max(la::max(a, b)) {}

    [[nodiscard]] vec2 Size() const { return max - min; }
    [[nodiscard]] double Area() const { return Size().x * Size().y; }
    [[nodiscard]] vec2 Center() const { return (min + max) * 0.5; }
    [[nodiscard]] double Scale() const { return la::maxelem(la::max(la::abs(min), la::abs(max))); }
    [[nodiscard]] bool IsEmpty() const { return !(min.x < max.x && min.y < max.y); }
    [[nodiscard]] bool Contains(const vec2& p) const {
        return la::min(min, p) == min && la::max(max, p) == max;
    }
    /// An empty rectangle is within all.
    [[nodiscard]] bool Contains(const Rect& r) const {
        return la::min(min, r.min) == min && la::max(max, r.max) == max;
    }
    [[nodiscard]] bool DoesOverlap(const Rect& r) const {
        return min.x <= r.max.x && min.y <= r.max.y && max.x >= r.min.x && max.y >= r.min.y;
    }
    void Union(const vec2& p) {
        min = la::min(min, p);
        max = la::max(max, p);
    }
    friend bool operator==(const Rect&, const Rect&) = default;
};

enum class OpType : char { Add, Subtract, Intersect };
enum class JoinType : std::uint8_t { Square, Round, Miter, Bevel };

/// How many sides circles have by default.
class Quality {
public:
    static void SetMinCircularAngle(double angle);
    static void SetMinCircularEdgeLength(double length);
    static void SetCircularSegments(int number);
    static int GetCircularSegments(double radius);
    static void ResetToDefaults();
};

/// Switches of their debug build. Kept and never looked at.
struct ExecutionParams {
    bool intermediateChecks = false;
    bool selfIntersectionChecks = false;
    bool processOverlaps = true;
    bool suppressErrors = false;
    bool cleanupTriangles = true;
    int verbose = 0;
};

class Manifold;
template <class Number, class Index = std::uint32_t>
struct MeshGLP;
using MeshGL = MeshGLP<float>;
using MeshGL64 = MeshGLP<double, std::uint64_t>;

/// Cancels what is computed with it, once and for all. Booleans here are computed when they are
/// called, so only a context that was cancelled before has an effect; progress is 0 or 1.
class ExecutionContext {
public:
    ExecutionContext();
    void Cancel();
    [[nodiscard]] bool Cancelled() const;
    [[nodiscard]] double Progress() const;
    Manifold FromMeshGL(const MeshGL& mesh);
    Manifold FromMeshGL(const MeshGL64& mesh);

    struct Impl;
    std::shared_ptr<Impl> impl_;  ///< theirs is public, too
};

}  // namespace manifold
// NOLINTEND(readability-identifier-naming)
