// SPDX-License-Identifier: Apache-2.0
//
// Connected pieces of the boundary in a cell: polygons with a common corner in the open cell hang
// together there. Corners are compared as exact coordinates, where they are doubles; those that
// operations made are left out, so some pieces are found in parts. More points than pieces do no
// harm (see solid_sides.h).

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include <trisect/bsp/interference/tree/leaf_boxes.h>
#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

namespace {

class Pieces {
public:
    explicit Pieces(std::size_t count) : above_(count) {
        std::iota(above_.begin(), above_.end(), std::uint32_t{0});
    }
    [[nodiscard]] std::uint32_t of(std::uint32_t i) {
        while (above_[i] != i) i = above_[i] = above_[above_[i]];
        return i;
    }
    void join(std::uint32_t i, std::uint32_t j) {
        above_[std::max(of(i), of(j))] = std::min(of(i), of(j));
    }

private:
    std::vector<std::uint32_t> above_;
};

// By the numbers of corners, which are good for the whole mesh.
std::vector<BoundaryPoint> pieces_of_mesh(const Source& source) {
    const auto points = static_cast<std::uint32_t>(source.mesh().points.size());
    Pieces pieces(points);
    for (std::uint32_t t = 0; t < source.facet_count(); ++t)
        for (int i = 1; i < 3; ++i)
            pieces.join(source.corner_index(t, 0), source.corner_index(t, i));
    std::vector<BoundaryPoint> out;
    std::vector<bool> done(points, false);
    for (std::uint32_t t = 0; t < source.facet_count(); ++t) {
        const std::uint32_t piece = pieces.of(source.corner_index(t, 0));
        if (done[piece]) continue;
        done[piece] = true;
        out.push_back({t, 0, source.corner(t, 0).doubles()});
    }
    return out;
}

// The first polygon with a corner at each place, in an open table.
class FirstAt {
public:
    explicit FirstAt(std::size_t corners) : slots_(std::bit_ceil(2 * corners + 1), none) {
        entries_.reserve(corners);
    }
    /// The polygon that came first with this corner, maybe this one.
    std::uint32_t insert(const std::array<double, 3>& at, std::uint32_t polygon) {
        std::size_t slot = hash(at);
        for (;; ++slot) {
            slot &= slots_.size() - 1;
            if (slots_[slot] == none) break;
            const Entry& e = entries_[slots_[slot]];
            if (e.at == at) return e.polygon;
        }
        slots_[slot] = static_cast<std::uint32_t>(entries_.size());
        entries_.push_back({at, polygon});
        return polygon;
    }

private:
    struct Entry {
        std::array<double, 3> at{};
        std::uint32_t polygon = 0;
    };
    static constexpr std::uint32_t none = 0xffffffffU;

    // Equal numbers have equal hashes: + 0.0 makes the two zeros one.
    [[nodiscard]] static std::size_t hash(const std::array<double, 3>& at) {
        std::uint64_t h = 0;
        for (const double c : at)
            h = (h ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15U;
        return static_cast<std::size_t>(h >> 32U);
    }

    std::vector<Entry> entries_;
    std::vector<std::uint32_t> slots_;
};

}  // namespace

std::vector<BoundaryPoint> LeafBoxes::find_pieces() const {
    const IndexPolygons& all = polygons();
    if (const Source* const mesh = all.only_source()) return pieces_of_mesh(*mesh);
    std::vector<BoundaryPoint> found(all.size());
    std::vector<bool> enters(all.size(), false);
    std::vector<TriangleCorners> parts;
    for (std::uint32_t t = 0; t < triangle_count(); ++t) {
        const Id id = polygon_of(t);
        if (enters[id]) continue;
        parts.clear();
        add_parts(t, parts);
        if (parts.empty()) continue;
        found[id] = {id, BoundaryPoint::none, parts.front()[0]};
        enters[id] = true;
    }
    // A corner of its source, of each polygon that has one in the cell.
    std::vector<bool> has_corner(all.size(), false);
    Pieces pieces(all.size());
    FirstAt first(3 * std::size_t{all.size()});
    const Cell& cell = all.cell();
    for (Id id = 0; id < all.size(); ++id) {
        if (!enters[id]) continue;
        if (all.is_triangle(id)) {
            for (int i = 0; i < 3; ++i) {
                if (all.reaches_out(id) && !cell.contains(Box::of(all.corner(id, i)))) continue;
                const std::array<double, 3> at = all.corner(id, i).doubles();
                pieces.join(id, first.insert(at, id));
                if (!has_corner[id]) found[id] = {id, static_cast<std::uint8_t>(i), at};
                has_corner[id] = true;
            }
        } else {
            for (const Approximation& a : all.approximate_corners(id)) {
                if (a.error != 0) continue;
                const LatticePoint p{Coordinate(a.c[0]), Coordinate(a.c[1]), Coordinate(a.c[2])};
                if (!all.reaches_out(id) || cell.contains(Box::of(p)))
                    pieces.join(id, first.insert(a.c, id));
            }
        }
    }
    std::vector<BoundaryPoint> out;
    for (Id id = 0; id < all.size(); ++id)
        if (enters[id] && pieces.of(id) == id) out.push_back(found[id]);
    return out;
}

std::span<const BoundaryPoint> LeafBoxes::pieces() const {
    work_once(pieces_once_, [this] {
        pieces_ = find_pieces();
        pieces_.shrink_to_fit();
    });
    return pieces_;
}

}  // namespace trisect::detail
