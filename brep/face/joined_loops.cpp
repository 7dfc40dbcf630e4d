// SPDX-License-Identifier: Apache-2.0
//
// Sides of triangles between two loops are bridges: they lie inside the face and cross nothing. A
// spanning tree of the loops takes one for each loop but the first. The polygon is the border of
// the triangles where those bridges are walls: from a halfedge one goes around its end, through the
// triangles there, to the next wall. So no angle is ever compared.
#include <trisect/brep/joined_loops.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace trisect {
namespace {

constexpr std::uint32_t no_corner = 0xFFFF'FFFFU;

/// A halfedge of a triangle, as a number that sorts.
constexpr std::uint64_t side_key(std::uint32_t from, std::uint32_t to) {
    return (std::uint64_t{from} << 32) | to;
}

/// What lies to the left of a halfedge.
class TriangleSides {
public:
    explicit TriangleSides(std::span<const IndexTriangle> triangles) {
        sides_.reserve(3 * triangles.size());
        for (const IndexTriangle& t : triangles)
            for (std::size_t i = 0; i < 3; ++i)
                sides_.emplace_back(side_key(t[i], t[(i + 1) % 3]), t[(i + 2) % 3]);
        std::sort(sides_.begin(), sides_.end());
    }

    [[nodiscard]] std::uint32_t apex(std::uint32_t from, std::uint32_t to) const {
        const auto found =
            std::lower_bound(sides_.begin(), sides_.end(), std::pair(side_key(from, to), 0U));
        return found != sides_.end() && found->first == side_key(from, to) ? found->second
                                                                           : no_corner;
    }

private:
    std::vector<std::pair<std::uint64_t, std::uint32_t>> sides_;
};

/// Corners that loops and bridges connect, by index.
class ConnectedCorners {
public:
    explicit ConnectedCorners(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    [[nodiscard]] std::uint32_t root(std::uint32_t a) {
        while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
        return a;
    }
    /// Whether they were not connected before.
    bool connect(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t x = root(a);
        const std::uint32_t y = root(b);
        parent_[x] = y;
        return x != y;
    }

private:
    std::vector<std::uint32_t> parent_;
};

/// The loops' halfedges and the bridges, sorted.
std::vector<std::uint64_t> walls_of(std::span<const IndexLoop> loops,
                                    std::span<const IndexTriangle> triangles) {
    std::uint32_t most = 0;
    for (const IndexLoop& loop : loops)
        for (const std::uint32_t c : loop) most = std::max(most, c);
    ConnectedCorners connected(std::size_t{most} + 1);
    std::vector<std::uint64_t> walls;
    for (const IndexLoop& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t next = loop[(i + 1) % loop.size()];
            walls.push_back(side_key(loop[i], next));
            connected.connect(loop[i], next);
        }
    }
    for (const IndexTriangle& t : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i];
            const std::uint32_t b = t[(i + 1) % 3];
            if (a > most || b > most || !connected.connect(a, b)) continue;
            walls.push_back(side_key(a, b));
            walls.push_back(side_key(b, a));
        }
    }
    std::sort(walls.begin(), walls.end());
    return walls;
}

/// The sides that no other one of the polygon runs against.
std::vector<std::uint64_t> single_sides(std::span<const std::uint32_t> polygon) {
    std::vector<std::uint64_t> sides;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sides.push_back(side_key(polygon[i], polygon[(i + 1) % polygon.size()]));
    std::sort(sides.begin(), sides.end());
    std::vector<std::uint64_t> single;
    for (const std::uint64_t side : sides) {
        const std::uint64_t opposite = (side << 32) | (side >> 32);
        if (!std::binary_search(sides.begin(), sides.end(), opposite)) single.push_back(side);
    }
    return single;
}

std::size_t distinct_corners(IndexLoop polygon) {
    std::sort(polygon.begin(), polygon.end());
    return static_cast<std::size_t>(std::unique(polygon.begin(), polygon.end()) - polygon.begin());
}

}  // namespace

std::optional<IndexLoop> joined_loops(std::span<const IndexLoop> loops,
                                      std::span<const IndexTriangle> triangles) {
    if (loops.empty() || loops[0].size() < 2) return std::nullopt;
    if (loops.size() == 1) return loops[0];
    const std::vector<std::uint64_t> walls = walls_of(loops, triangles);
    const TriangleSides sides(triangles);
    IndexLoop out;
    std::uint32_t from = loops[0][0];
    std::uint32_t to = loops[0][1];
    const std::uint64_t start = side_key(from, to);
    do {
        out.push_back(from);
        if (out.size() > walls.size()) return std::nullopt;
        std::uint32_t apex = sides.apex(from, to);
        from = to;
        std::size_t turns = 0;
        while (apex != no_corner &&
               !std::binary_search(walls.begin(), walls.end(), side_key(from, apex))) {
            if (++turns > triangles.size()) return std::nullopt;
            apex = sides.apex(apex, from);
        }
        if (apex == no_corner) return std::nullopt;
        to = apex;
    } while (side_key(from, to) != start);
    if (out.size() != walls.size()) return std::nullopt;
    return out;
}

std::vector<IndexLoop> parted_loops(std::span<const std::uint32_t> polygon) {
    const IndexLoop whole(polygon.begin(), polygon.end());
    std::vector<std::uint64_t> sides = single_sides(polygon);
    if (sides.size() == polygon.size() || sides.size() != distinct_corners(whole)) return {whole};
    for (std::size_t i = 0; i + 1 < sides.size(); ++i)
        if (sides[i] >> 32 == sides[i + 1] >> 32) return {whole};
    std::vector<IndexLoop> loops;
    std::vector<bool> used(sides.size(), false);
    for (std::size_t first = 0; first < sides.size(); ++first) {
        if (used[first]) continue;
        IndexLoop loop;
        for (std::size_t i = first; !used[i];) {
            used[i] = true;
            loop.push_back(static_cast<std::uint32_t>(sides[i] >> 32));
            const std::uint64_t next = (sides[i] & 0xFFFF'FFFFU) << 32;
            const auto found = std::lower_bound(sides.begin(), sides.end(), next);
            if (found == sides.end() || *found >> 32 != next >> 32) return {whole};
            i = static_cast<std::size_t>(found - sides.begin());
        }
        if (loop.size() < 3) return {whole};
        loops.push_back(std::move(loop));
    }
    return loops;
}

}  // namespace trisect
