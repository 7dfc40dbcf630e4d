// SPDX-License-Identifier: Apache-2.0
//
// A corner of a polygon may be above a plane by rounding, or by no more than 2^-20 of the cell:
// then no polygon reaches into what is above the plane by more than that. A point that is asked
// about is above the plane by 2^-18 at least when its sign is taken for sure (LeafPlanes). So
// neighbours, which have corners in the plane, do not disturb, and nothing is assumed.
//
// What is above a plane in a box contains the corner of the box that is farthest up, if it contains
// anything; it is convex and free of polygons, so that corner's membership holds for all of it.

#include <trisect/bsp/detail/index_sheets.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

namespace trisect::detail {

namespace {

using Vector = std::array<double, 3>;

constexpr double allowed = 0x1p-20;

class Sheets {
public:
    Sheets(const IndexBase& index, const IndexTree::Cell& cell, const IndexGrid::Position& at)
        : polygons_(index.polygons), tree_(index.tree), leaf_(index.tree.leaf(cell.leaf)) {
        const double edge = static_cast<double>(std::uint32_t{1} << cell.shift);
        for (std::size_t k = 0; k < 3; ++k) {
            origin_[k] = cell.grid->wall(k, at.fine[k] >> cell.shift << cell.shift);
            scale_[k] = 1 / (cell.grid->fine[k] * edge);
        }
    }

    [[nodiscard]] LeafSheets find() {
        LeafSheets out;
        // Many polygons in a cell are no smooth piece of a surface.
        if (leaf_.count > LeafSheets::polygons || !find_corners()) return out;
        for (std::uint32_t i = 0; i < leaf_.count; ++i) {
            // Planes without good coefficients are in the leaf as 0.
            const PolygonId id = tree_.listed(leaf_)[i];
            if (!polygons_.is_triangle(id) || !find_plane(id, kept_starts[i])) continue;
            bool above = false;
            bool below = false;
            for (std::size_t c = 0; c < kept_corners.size() && !(above && below); ++c) {
                const double v = at(kept_corners[c]);
                above = above || v > allowed;
                below = below || v < -allowed;
            }
            if (!above && farthest(1) == 0) out.outside_above |= std::uint64_t{1} << i;
            if (!below && farthest(-1) == 1) out.inside_below |= std::uint64_t{1} << i;
        }
        return out;
    }

private:
    [[nodiscard]] Vector local(const Vector& p) const {
        return {(p[0] - origin_[0]) * scale_[0], (p[1] - origin_[1]) * scale_[1],
                (p[2] - origin_[2]) * scale_[2]};
    }
    [[nodiscard]] Vector local(const LatticePoint& p) const {
        return local(
            Vector{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    }

    [[nodiscard]] bool find_corners() {
        largest_ = 4;
        kept_corners.clear();
        kept_starts.clear();
        for (const PolygonId id : tree_.listed(leaf_)) {
            kept_starts.push_back(kept_corners.size());
            if (polygons_.is_triangle(id)) {
                for (int i = 0; i < 3; ++i) kept_corners.push_back(local(polygons_.corner(id, i)));
                continue;
            }
            if (polygons_.is_unbounded(id)) return false;
            for (const Point& c : polygons_.corners(id)) {
                const Approximation& a = c.approximation();
                for (const double s : scale_)
                    if (!(a.error * s < 0x1p-24)) return false;
                kept_corners.push_back(local(a.c));
            }
        }
        for (const Vector& p : kept_corners)
            for (const double v : p) largest_ = std::max(largest_, std::fabs(v));
        return largest_ < 0x1p20;
    }

    // The outward plane in the cell's coordinates, its largest coefficient 1. With M the largest
    // coordinate and L that of edges, values err by less than 2^-42 L M^2 before the division.
    [[nodiscard]] bool find_plane(PolygonId id, std::size_t first) {
        const Vector& a = kept_corners[first];
        const Vector& b = kept_corners[first + 1];
        const Vector& c = kept_corners[first + 2];
        const Vector u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        const Vector v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        normal_ = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        double size = 0;
        double edge = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            size = std::max(size, std::fabs(normal_[k]));
            edge = std::max({edge, std::fabs(u[k]), std::fabs(v[k])});
        }
        if (!(0x1p-42 * edge * largest_ * largest_ < 0x1p-22 * size)) return false;
        const double f = (polygons_.is_flipped(id) ? -1 : 1) / size;
        for (double& x : normal_) x *= f;
        offset_ = -(normal_[0] * a[0] + normal_[1] * a[1] + normal_[2] * a[2]);
        return true;
    }
    [[nodiscard]] double at(const Vector& p) const {
        return normal_[0] * p[0] + normal_[1] * p[1] + normal_[2] * p[2] + offset_;
    }
    // Membership of the corner that is farthest up (down): 0, 1, or -1 when it is not known or too
    // near to the plane.
    [[nodiscard]] int farthest(double way) const {
        unsigned corner = 0;
        Vector p{};
        for (std::size_t k = 0; k < 3; ++k) {
            if (normal_[k] * way <= 0) continue;
            corner |= 1U << k;
            p[k] = 1;
        }
        if ((leaf_.known >> corner & 1U) == 0 || at(p) * way < 4 * allowed) return -1;
        return leaf_.inside >> corner & 1;
    }

    const IndexPolygons& polygons_;
    const IndexTree& tree_;
    const IndexLeaf& leaf_;
    Vector origin_{};
    Vector scale_{};
    // Kept by the thread, so that nothing is allocated.
    static inline thread_local std::vector<Vector> kept_corners;
    static inline thread_local std::vector<std::size_t> kept_starts;
    double largest_ = 0;
    Vector normal_{};
    double offset_ = 0;
};

}  // namespace

// A region is one word, so that threads never see half of one.
constexpr std::uint64_t region_inside = std::uint64_t{1} << 62U;

std::optional<bool> remembered(const IndexLeaf& leaf, std::uint64_t above) {
    for (std::uint64_t& word : leaf.regions) {
        const std::uint64_t v =
            std::atomic_ref<std::uint64_t>(word).load(std::memory_order_relaxed);
        if ((v | region_inside) == (LeafSheets::known | region_inside | above))
            return (v & region_inside) != 0;
    }
    return std::nullopt;
}

void remember(const IndexLeaf& leaf, std::uint64_t above, bool inside) {
    const std::uint64_t v = LeafSheets::known | (inside ? region_inside : 0) | above;
    const std::atomic_ref<std::uint64_t> first(leaf.regions[0]);
    const std::atomic_ref<std::uint64_t> second(leaf.regions[1]);
    second.store(first.load(std::memory_order_relaxed), std::memory_order_relaxed);
    first.store(v, std::memory_order_relaxed);
}

bool has_unknown_sheets(const IndexLeaf& leaf) {
    return std::atomic_ref<std::uint64_t>(leaf.outside_above).load(std::memory_order_relaxed) == 0;
}

LeafSheets sheets_of(const IndexBase& index, const IndexTree::Cell& cell,
                     const IndexGrid::Position& at) {
    // Each word is good by itself, so no order between them is needed.
    const IndexLeaf& leaf = index.tree.leaf(cell.leaf);
    const std::atomic_ref<std::uint64_t> above(leaf.outside_above);
    const std::atomic_ref<std::uint64_t> below(leaf.inside_below);
    const std::uint64_t a = above.load(std::memory_order_relaxed);
    const std::uint64_t b = below.load(std::memory_order_relaxed);
    if (a != 0 && b != 0) return {a & ~LeafSheets::known, b & ~LeafSheets::known};
    const LeafSheets found = Sheets(index, cell, at).find();
    above.store(found.outside_above | LeafSheets::known, std::memory_order_relaxed);
    below.store(found.inside_below | LeafSheets::known, std::memory_order_relaxed);
    return found;
}

}  // namespace trisect::detail
