// SPDX-License-Identifier: Apache-2.0
//
// FlatRegion: a set of the plane by its outline, on a lattice.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

/// Directed segments of lines through two corners each. Ends are corners, or points where two of
/// the lines cross, so nothing about them is rounded, and names stay as short as those of an input
/// however long a chain of operations is.
struct FlatRegion {
    /// What is inside, by the winding number of the segments.
    enum class Rule : std::uint8_t { Positive, Odd };
    static constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);

    struct Line {
        FlatCorner a{};
        FlatCorner b{};
        FaceSource name;  ///< of the wall over it
    };
    struct Vertex {
        double u = 0;
        double v = 0;
        double error = 0;  ///< of both; 0 for a corner, which is exact
        std::array<std::uint32_t, 2> lines{none, none};  ///< that cross there; none: a corner

        [[nodiscard]] bool is_corner() const { return lines[0] == none; }
        [[nodiscard]] FlatCorner corner() const { return {Coordinate(u), Coordinate(v)}; }
    };
    /// The winding number is greater by one on its left.
    struct Segment {
        std::uint32_t from = 0;
        std::uint32_t to = 0;
        std::uint32_t line = 0;
        bool along = true;  ///< from the line's first corner towards its second
    };

    Lattice lattice;
    Rule rule = Rule::Positive;
    /// Segments meet in common ends only, those of one line are not consecutive where nothing
    /// else meets, and the winding number is 0 or 1.
    bool is_resolved = false;
    std::vector<Line> lines;
    std::vector<Vertex> vertices;
    std::vector<Segment> segments;
    /// Of a resolved region: where its loops begin among the segments, and the end of the last one.
    std::vector<std::uint32_t> loop_begin;
    std::array<FaceSource, 2> cap_names{};  ///< of the lower and the upper cap
    double largest = 0;                     ///< magnitude of a coordinate

    [[nodiscard]] bool is_empty() const { return segments.empty(); }
    [[nodiscard]] std::size_t loop_count() const {
        return loop_begin.empty() ? 0 : loop_begin.size() - 1;
    }
    [[nodiscard]] bool has_corners_only() const {
        for (const Vertex& v : vertices)
            if (!v.is_corner()) return false;
        return true;
    }
};

/// A region as it was given, and its outline, which is found when it is first needed. Immutable,
/// safe to use from any thread.
class FlatOperand {
public:
    using Resolve = FlatRegion (*)(const FlatRegion& region);

    FlatOperand(FlatRegion region, Resolve resolve)
        : given_(std::move(region)), resolve_(resolve) {}

    /// The outline, if it is known, else the region as it was given.
    [[nodiscard]] const FlatRegion& known() const {
        if (given_.is_resolved) return given_;
        const WorkLock lock(resolving_);
        return resolved_ != nullptr ? *resolved_ : given_;
    }
    [[nodiscard]] const FlatRegion& given() const { return given_; }
    [[nodiscard]] const FlatRegion& resolved() const {
        if (given_.is_resolved) return given_;
        const WorkLock lock(resolving_);
        if (resolved_ == nullptr) resolved_ = std::make_unique<const FlatRegion>(resolve_(given_));
        return *resolved_;
    }

private:
    FlatRegion given_;
    Resolve resolve_;
    mutable std::mutex resolving_;
    mutable std::unique_ptr<const FlatRegion> resolved_;
};

}  // namespace trisect::detail
