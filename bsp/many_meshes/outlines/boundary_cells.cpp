// SPDX-License-Identifier: Apache-2.0
//
// Places of coordinates do not decrease along an axis, however they are rounded. So boxes in
// different cells do not meet. Small cells are found by the same places, those of a cell by the
// last two bits.

#include <trisect/bsp/many_meshes/outlines/boundary_cells.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace trisect::detail {

namespace {

using CellPart = BoundaryCells::Part;
using SmallCells = std::uint64_t;

constexpr double cells_a_facet = 2;
constexpr double most_along = 512;
constexpr double most_cells = 0x1p26;

constexpr CellPart unknown_part = ~CellPart{0};
// Of a cell with small ones; the rest is its number.
constexpr CellPart divided_mark = CellPart{1} << 31;

constexpr std::size_t small_bits = 2;
constexpr std::size_t small_along = std::size_t{1} << small_bits;
constexpr std::size_t last_small = small_along - 1;
// The first small cell in each row, along x, and of each layer, along z; how far to the next.
constexpr std::array<std::size_t, 3> small_steps{1, small_along, small_along* small_along};

// From one number to another one, in each of which are 0 to 3: bits one step apart.
constexpr SmallCells along(std::size_t first, std::size_t last, std::size_t step) {
    SmallCells out = 0;
    for (std::size_t i = first; i <= last; ++i) out |= SmallCells{1} << i * step;
    return out;
}

constexpr SmallCells block(const std::array<std::size_t, 3>& first,
                           const std::array<std::size_t, 3>& last) {
    SmallCells out = 1;
    for (std::size_t k = 0; k < 3; ++k) out *= along(first[k], last[k], small_steps[k]);
    return out;
}

// The same by table: by axis, first and last.
using Blocks = std::array<std::array<std::array<SmallCells, small_along>, small_along>, 3>;
constexpr Blocks blocks_along_axes() {
    Blocks out{};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < small_along; ++i)
            for (std::size_t j = i; j < small_along; ++j)
                out[k][i][j] = along(i, j, small_steps[k]);
    return out;
}
constexpr Blocks small_blocks = blocks_along_axes();

// At the beginning or the end along an axis.
constexpr SmallCells side(std::size_t axis, std::size_t at) {
    std::array<std::size_t, 3> first{0, 0, 0};
    std::array<std::size_t, 3> last{last_small, last_small, last_small};
    first[axis] = last[axis] = at;
    return block(first, last);
}

constexpr std::array<SmallCells, 3> first_side{side(0, 0), side(1, 0), side(2, 0)};
constexpr std::array<SmallCells, 3> last_side{side(0, last_small), side(1, last_small),
                                              side(2, last_small)};

// With those beside them.
SmallCells grown(SmallCells cells) {
    SmallCells out = cells;
    for (std::size_t k = 0; k < 3; ++k) {
        out |= (cells & ~last_side[k]) << small_steps[k];
        out |= (cells & ~first_side[k]) >> small_steps[k];
    }
    return out;
}

}  // namespace

// Numbers that are joined; the least stands for all of them.
class BoundaryCells::Unions {
public:
    explicit Unions(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), CellPart{0});
    }
    [[nodiscard]] CellPart root(CellPart p) {
        while (parents_[p] != p) p = parents_[p] = parents_[parents_[p]];
        return p;
    }
    void join(CellPart a, CellPart b) {
        a = root(a);
        b = root(b);
        if (a != b) parents_[std::max(a, b)] = std::min(a, b);
    }

private:
    PoolVector<CellPart> parents_;
};

BoundaryCells::BoundaryCells(const OutlineBox& all, std::size_t facets) : low_(all.lo) {
    std::array<double, 3> extent{};
    double volume = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        extent[k] = std::max(all.hi[k] - all.lo[k], 1.0);
        volume *= extent[k];
    }
    const double wanted = std::min(cells_a_facet * static_cast<double>(facets + 1), most_cells);
    const double size = std::cbrt(volume / wanted);
    std::size_t cells = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double count = std::clamp(std::floor(extent[k] / size), 1.0, most_along);
        scale_[k] = static_cast<double>(small_along) * count / extent[k];
        counts_[k] = static_cast<std::size_t>(count) + 3;
        cells *= counts_[k];
    }
    parts_.assign(cells, unknown_part);
}

// Of a small cell.
std::size_t BoundaryCells::place(double at, std::size_t k) const {
    if (!(at >= low_[k])) return 0;
    const double i = (at - low_[k]) * scale_[k] + static_cast<double>(small_along);
    const auto last = static_cast<double>(small_along * counts_[k] - 1);
    return static_cast<std::size_t>(std::min(i, last));
}

BoundaryCells::Range BoundaryCells::range_of(const OutlineBox& box) const {
    Range out;
    for (std::size_t k = 0; k < 3; ++k) {
        out.first[k] = place(box.lo[k], k);
        out.last[k] = place(box.hi[k], k);
    }
    return out;
}

// Calls each(cell, small cells) until it says false.
template <class Each>
bool BoundaryCells::for_each_cell(const Range& range, const Each& each) const {
    const auto small = [&](std::size_t k, std::size_t at) {
        const std::size_t begin = at << small_bits;
        const std::size_t first = std::max(range.first[k], begin) - begin;
        const std::size_t last = std::min(range.last[k], begin + last_small) - begin;
        return small_blocks[k][first][last];
    };
    for (std::size_t z = range.first[2] >> small_bits; z <= range.last[2] >> small_bits; ++z) {
        const SmallCells layers = small(2, z);
        for (std::size_t y = range.first[1] >> small_bits; y <= range.last[1] >> small_bits; ++y) {
            const SmallCells rows = layers * small(1, y);
            for (std::size_t x = range.first[0] >> small_bits; x <= range.last[0] >> small_bits;
                 ++x)
                if (!each((z * counts_[1] + y) * counts_[0] + x, rows * small(0, x))) return false;
        }
    }
    return true;
}

void BoundaryCells::occupy(const OutlineBox& facet) {
    for_each_cell(range_of(facet), [&](std::size_t cell, SmallCells small) {
        CellPart& part = parts_[cell];
        if (part == unknown_part) {
            part = divided_mark | static_cast<CellPart>(divided_.size());
            divided_.emplace_back().cell = cell;
        }
        divided_[part & ~divided_mark].occupied |= small;
        return true;
    });
}

CellPart BoundaryCells::part_of(const OutlineBox& box) const {
    CellPart part = occupied;
    const bool is_free = for_each_cell(range_of(box), [&](std::size_t cell, SmallCells small) {
        part = parts_[cell];
        if ((part & divided_mark) == 0) return true;
        const Divided& d = divided_[part & ~divided_mark];
        if ((d.occupied & small) != 0) return false;
        std::uint32_t piece = d.first_piece;
        while ((pieces_[piece].cells & small) == 0) ++piece;
        part = pieces_[piece].part;
        return true;
    });
    return is_free ? part : occupied;
}

// The first cell is in the layer around all.
void BoundaryCells::find_parts() {
    Open next;
    for (std::size_t cell = 0; cell < parts_.size(); ++cell) {
        if (parts_[cell] != unknown_part) continue;
        next.cell = cell;
        next.at = {static_cast<std::uint16_t>(cell % counts_[0]),
                   static_cast<std::uint16_t>(cell / counts_[0] % counts_[1]),
                   static_cast<std::uint16_t>(cell / counts_[0] / counts_[1])};
        fill(next, part_count_++);
    }
    for (Divided& d : divided_) find_pieces(d);
    Unions unions(part_count_ + pieces_.size());
    unite_pieces(unions);
    number_parts(unions);
}

void BoundaryCells::fill(const Open& cell, CellPart part) {
    const std::array<std::size_t, 3> strides{1, counts_[0], counts_[0] * counts_[1]};
    const auto visit = [&](const Open& c) {
        if (parts_[c.cell] != unknown_part) return;
        parts_[c.cell] = part;
        open_.push_back(c);
    };
    visit(cell);
    while (!open_.empty()) {
        const Open c = open_.back();
        open_.pop_back();
        for (std::size_t k = 0; k < 3; ++k) {
            Open beside = c;
            if (c.at[k] > 0) {
                beside.cell = c.cell - strides[k];
                --beside.at[k];
                visit(beside);
            }
            if (c.at[k] + std::size_t{1} < counts_[k]) {
                beside.cell = c.cell + strides[k];
                beside.at[k] = static_cast<std::uint16_t>(c.at[k] + 1);
                visit(beside);
            }
        }
    }
}

void BoundaryCells::find_pieces(Divided& d) {
    d.first_piece = static_cast<std::uint32_t>(pieces_.size());
    for (SmallCells left = ~d.occupied; left != 0;) {
        SmallCells piece = left & (~left + 1);
        for (SmallCells before = 0; before != piece;) {
            before = piece;
            piece = grown(piece) & left;
        }
        left &= ~piece;
        pieces_.push_back({piece, part_count_ + static_cast<CellPart>(pieces_.size())});
    }
    d.end_piece = static_cast<std::uint32_t>(pieces_.size());
}

// Each with those beside it, which are farther along one axis; and with whole cells on both sides.
void BoundaryCells::unite_pieces(Unions& unions) const {
    const std::array<std::size_t, 3> strides{1, counts_[0], counts_[0] * counts_[1]};
    const auto pieces_of = [&](const Divided& d) {
        return std::span(pieces_).subspan(d.first_piece, d.end_piece - d.first_piece);
    };
    const auto unite_with_cell = [&](const Divided& d, SmallCells side, CellPart part) {
        for (const Piece& p : pieces_of(d))
            if ((p.cells & side) != 0) unions.join(p.part, part);
    };
    for (const Divided& d : divided_)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t at = d.cell / strides[k] % counts_[k];
            if (at > 0)
                if (const CellPart below = parts_[d.cell - strides[k]]; (below & divided_mark) == 0)
                    unite_with_cell(d, first_side[k], below);
            if (at + 1 == counts_[k]) continue;
            const CellPart above = parts_[d.cell + strides[k]];
            if ((above & divided_mark) == 0) {
                unite_with_cell(d, last_side[k], above);
                continue;
            }
            for (const Piece& p : pieces_of(d)) {
                const SmallCells across = (p.cells & last_side[k]) >> last_small * small_steps[k];
                for (const Piece& q : pieces_of(divided_[above & ~divided_mark]))
                    if ((q.cells & across) != 0) unions.join(p.part, q.part);
            }
        }
}

// Those of whole cells come first, so that each part is named by one of them, if it has one.
void BoundaryCells::number_parts(Unions& unions) {
    const CellPart of_cells = part_count_;
    PoolVector<CellPart> numbers(of_cells, occupied);
    part_count_ = 1;
    for (CellPart p = outside; p < of_cells; ++p) {
        const CellPart root = unions.root(p);
        numbers[p] = root == p ? part_count_++ : numbers[root];
    }
    for (CellPart& p : parts_)
        if ((p & divided_mark) == 0) p = numbers[p];
    for (Piece& p : pieces_) {
        const CellPart root = unions.root(p.part);
        p.part = root < of_cells ? numbers[root] : occupied;
    }
}

OutlineBox outline_box(const Box& positions) {
    OutlineBox out;
    for (std::size_t k = 0; k < 3; ++k) {
        out.lo[k] = static_cast<double>(positions.lo[k]) - 2;
        out.hi[k] = static_cast<double>(positions.hi[k]) + 2;
    }
    return out;
}

}  // namespace trisect::detail
