// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/validate/twins.h>

#include <utility>

namespace trisect::detail {

namespace {

using Triangle = Twins::Triangle;

constexpr auto none = static_cast<std::uint32_t>(-1);

// A triangle at one of its corners: the other two, and the half-edges that leave and enter it
// there.
struct TwinCorner {
    std::uint32_t next, previous;
    std::uint32_t leaving, arriving;
};

// All triangles dealt to their corners.
class TwinCorners {
public:
    TwinCorners(std::size_t point_count, std::span<const Triangle> triangles)
        : begin_(point_count + 2, 0), corners_(3 * triangles.size()) {
        for (const Triangle& t : triangles)
            for (const std::uint32_t c : t) ++begin_[std::size_t{c} + 2];
        for (std::size_t v = 2; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
        std::uint32_t h = 0;
        for (const Triangle& t : triangles) {
            add(t[0], {t[1], t[2], h, h + 2});
            add(t[1], {t[2], t[0], h + 1, h});
            add(t[2], {t[0], t[1], h + 2, h + 1});
            h += 3;
        }
    }
    [[nodiscard]] std::uint32_t begin(std::size_t v) const { return begin_[v]; }
    [[nodiscard]] std::uint32_t end(std::size_t v) const { return begin_[v + 1]; }
    [[nodiscard]] const TwinCorner& operator[](std::uint32_t i) const { return corners_[i]; }

private:
    void add(std::uint32_t v, const TwinCorner& corner) {
        corners_[begin_[std::size_t{v} + 1]++] = corner;
    }

    std::vector<std::uint32_t> begin_;
    std::vector<TwinCorner> corners_;
};

// Links the triangles around one corner after the other. The neighbour over the edge to `next` is
// the one that has its own `previous` there: an edge is seen from both of its ends, so that all
// twins are found, each of them once.
class FanLinker {
public:
    FanLinker(std::size_t point_count, const TwinCorners& corners, std::span<std::uint32_t> twin)
        : corners_(corners), after_(point_count, 0), twin_(twin) {}

    // False unless the triangles at v form one fan of three or more. Corners in rising order.
    [[nodiscard]] bool link(std::size_t v) {
        const std::uint32_t begin = corners_.begin(v);
        const std::uint32_t end = corners_.end(v);
        if (begin == end) return true;  // no triangle names the corner
        // Two would be one another's neighbours over all three edges.
        return end - begin >= 3 && note_previous(begin, end) && walk(begin, end - begin);
    }

private:
    [[nodiscard]] bool note_previous(std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t i = begin; i < end; ++i) {
            std::uint32_t& after = after_[corners_[i].previous];
            if (after > begin) return false;
            after = i + 1;
        }
        return true;
    }
    // As no two have the same `previous`, a walk that is back after `count` steps met all of them.
    [[nodiscard]] bool walk(std::uint32_t begin, std::uint32_t count) {
        std::uint32_t at = begin;
        for (std::uint32_t steps = 1; steps <= count; ++steps) {
            const std::uint32_t after = after_[corners_[at].next];
            if (after <= begin) return false;
            twin_[corners_[at].leaving] = corners_[after - 1].arriving;
            at = after - 1;
            if (at == begin) return steps == count;
        }
        return false;
    }

    const TwinCorners& corners_;
    // By corner, one more than the place of the triangle that has it as `previous`. Places rise, so
    // that those of former fans are below the present one.
    std::vector<std::uint32_t> after_;
    std::span<std::uint32_t> twin_;
};

}  // namespace

std::optional<Twins> Twins::of(std::size_t point_count, std::span<const Triangle> triangles) {
    const TwinCorners corners(point_count, triangles);
    std::vector<std::uint32_t> twin(3 * triangles.size());
    FanLinker linker(point_count, corners, twin);
    for (std::size_t v = 0; v < point_count; ++v)
        if (!linker.link(v)) return std::nullopt;
    return Twins(std::move(twin));
}

Twins::Shells Twins::shells() const {
    Shells out;
    out.of_triangle.assign(triangle_count(), none);
    std::vector<std::uint32_t> stack;
    for (std::uint32_t seed = 0; seed < triangle_count(); ++seed) {
        if (out.of_triangle[seed] != none) continue;
        out.of_triangle[seed] = out.count;
        stack.push_back(seed);
        while (!stack.empty()) {
            const std::uint32_t t = stack.back();
            stack.pop_back();
            for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
                const std::uint32_t next = twin_[h] / 3;
                if (out.of_triangle[next] != none) continue;
                out.of_triangle[next] = out.count;
                stack.push_back(next);
            }
        }
        ++out.count;
    }
    return out;
}

}  // namespace trisect::detail
