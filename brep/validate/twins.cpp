// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/validate/twins.h>

#include <algorithm>
#include <utility>

namespace trisect::detail {

namespace {

using Triangle = Twins::Triangle;

constexpr auto none = static_cast<std::uint32_t>(-1);

// A triangle at one of its corners: the other two, and the half-edge that leaves the corner.
struct TwinCorner {
    std::uint32_t next, previous;
    std::uint32_t halfedge;
};

std::uint32_t halfedge_before(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

// All triangles dealt to their corners.
class TwinCorners {
public:
    TwinCorners(std::size_t point_count, std::span<const Triangle> triangles)
        : begin_(point_count + 2, 0), corners_(3 * triangles.size()) {
        for (const Triangle& t : triangles)
            for (const std::uint32_t c : t) ++begin_[std::size_t{c} + 2];
        for (std::size_t v = 2; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
        std::uint32_t h = 0;
        for (const Triangle& t : triangles)
            for (std::size_t i = 0; i < 3; ++i)
                corners_[begin_[std::size_t{t[i]} + 1]++] = {t[(i + 1) % 3], t[(i + 2) % 3], h++};
    }
    [[nodiscard]] std::span<TwinCorner> at(std::size_t v) {
        return {corners_.data() + begin_[v], begin_[v + 1] - begin_[v]};
    }

private:
    std::vector<std::uint32_t> begin_;
    std::vector<TwinCorner> corners_;
};

// The triangles around one corner, in their circular order. The neighbour over the edge to `next`
// is the one that has its own `previous` there: an edge is seen from both of its ends, so that all
// twins are found, each of them once.
class Fan {
public:
    /// False unless they form one fan of three or more. Sorts them.
    [[nodiscard]] bool link(std::span<TwinCorner> corners) {
        if (corners.empty()) return true;  // no triangle names the corner
        // Two would be one another's neighbours over all three edges.
        if (corners.size() < 3) return false;
        if (corners.size() > short_list) std::ranges::sort(corners, {}, &TwinCorner::previous);
        neighbour_.clear();
        for (const TwinCorner& c : corners) {
            const std::uint32_t other = only_before(corners, c.next);
            if (other == none || c.next == c.previous) return false;
            neighbour_.push_back(other);
        }
        std::size_t count = 0;
        std::uint32_t at = 0;
        do {
            at = neighbour_[at];
            ++count;
        } while (at != 0 && count < corners.size());
        return at == 0 && count == corners.size();
    }
    /// By corner, after link().
    [[nodiscard]] std::span<const std::uint32_t> neighbour() const { return neighbour_; }

private:
    // Longer lists are sorted before they are searched.
    static constexpr std::size_t short_list = 32;

    // The only one with this previous corner.
    static std::uint32_t only_before(std::span<const TwinCorner> corners, std::uint32_t previous) {
        if (corners.size() > short_list) {
            const auto before = [](const TwinCorner& c, std::uint32_t v) { return c.previous < v; };
            const auto first = std::lower_bound(corners.begin(), corners.end(), previous, before);
            const auto is_it = [&](auto at) {
                return at != corners.end() && at->previous == previous;
            };
            if (!is_it(first) || is_it(first + 1)) return none;
            return static_cast<std::uint32_t>(first - corners.begin());
        }
        std::uint32_t found = none;
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            if (corners[i].previous != previous) continue;
            if (found != none) return none;
            found = i;
        }
        return found;
    }

    std::vector<std::uint32_t> neighbour_;
};

}  // namespace

std::optional<Twins> Twins::of(std::size_t point_count, std::span<const Triangle> triangles) {
    TwinCorners table(point_count, triangles);
    std::vector<std::uint32_t> twin(3 * triangles.size());
    Fan fan;
    for (std::size_t v = 0; v < point_count; ++v) {
        const std::span<TwinCorner> corners = table.at(v);
        if (!fan.link(corners)) return std::nullopt;
        for (std::size_t i = 0; i < corners.size(); ++i)
            twin[corners[i].halfedge] = halfedge_before(corners[fan.neighbour()[i]].halfedge);
    }
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
