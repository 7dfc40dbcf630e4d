// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/index_grid_lists.h>

#include <algorithm>
#include <cmath>

namespace trisect::detail {

namespace {

// May a triangle meet boxes? By its plane and its edges seen along the axes (Akenine-Möller 2001),
// with margins; coordinates relative to the model's middle, below 2^54. Made once for a triangle,
// asked for many boxes.
class TriangleInBoxes {
public:
    explicit TriangleInBoxes(const std::array<std::array<double, 3>, 3>& c) {
        std::array<double, 3> u{};
        std::array<double, 3> v{};
        for (std::size_t k = 0; k < 3; ++k) {
            u[k] = c[1][k] - c[0][k];
            v[k] = c[2][k] - c[0][k];
        }
        axes_[0] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t j = (k + 1) % 3;
                const std::size_t l = (k + 2) % 3;
                auto& axis = axes_[1 + 3 * i + k];
                axis[k] = 0;
                axis[j] = -(c[(i + 1) % 3][l] - c[i][l]);
                axis[l] = c[(i + 1) % 3][j] - c[i][j];
            }
        for (std::size_t a = 0; a < axes_.size(); ++a) {
            lo_[a] = HUGE_VAL;
            hi_[a] = -HUGE_VAL;
            double terms = 0;
            for (const auto& p : c) {
                double at = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    at += axes_[a][k] * p[k];
                    terms += std::fabs(axes_[a][k] * p[k]);
                }
                lo_[a] = std::min(lo_[a], at);
                hi_[a] = std::max(hi_[a], at);
            }
            // Axes carry two roundings and a cancellation of products of edges; edges are sums of
            // coordinates. All of it is below 2^-40 of the terms plus what follows from 8 units.
            const double margin = 0x1p-40 * terms;
            lo_[a] -= margin;
            hi_[a] += margin;
        }
    }

    [[nodiscard]] bool may_meet(const std::array<double, 3>& middle, double half) const {
        for (std::size_t a = 0; a < axes_.size(); ++a) {
            const auto& x = axes_[a];
            const double reach = (std::fabs(x[0]) + std::fabs(x[1]) + std::fabs(x[2])) * half;
            const double at = x[0] * middle[0] + x[1] * middle[1] + x[2] * middle[2];
            const double margin =
                0x1p-40 * (std::fabs(x[0] * middle[0]) + std::fabs(x[1] * middle[1]) +
                           std::fabs(x[2] * middle[2]) + reach);
            if (at - reach - margin > hi_[a] || at + reach + margin < lo_[a]) return false;
        }
        return true;
    }

private:
    std::array<std::array<double, 3>, 10> axes_{};
    std::array<double, 10> lo_{};
    std::array<double, 10> hi_{};
};

}  // namespace

IndexGridLists::IndexGridLists(const std::array<double, 3>& middle, const FloatBox& box,
                               const std::vector<IndexItem>& items, const IndexPolygons& polygons,
                               float finest)
    : middle_(middle), whole_(box), items_(items), polygons_(polygons) {
    float largest = 0;
    for (std::size_t k = 0; k < 3; ++k)
        largest = std::max({largest, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
    // Walls are floats: origin an odd multiple of the last bit that the largest one has.
    float bit = finest;
    while (bit * 0x1p23F < 2 * largest) bit *= 2;
    // The last cell takes the rest of the box: half a cell to one and a half.
    size_ = bit * 4;
    const auto count = [&](std::size_t k) {
        return std::max(
            1.0, std::round(static_cast<double>(box.extent(k)) / static_cast<double>(size_)));
    };
    const double wanted = 2.5 * static_cast<double>(items.size());
    while (count(0) * count(1) * count(2) > wanted) size_ *= 2;
    for (std::size_t k = 0; k < 3; ++k) {
        float steps = std::floor(box.lo[k] / bit);
        if (std::fmod(steps, 2.0F) == 0) steps -= 1;
        origin_[k] = steps * bit;
        n_[k] = static_cast<std::uint32_t>(count(k));
    }
}

FloatBox IndexGridLists::box_of(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const std::array<std::uint32_t, 3> at{x, y, z};
    FloatBox b;
    for (std::size_t k = 0; k < 3; ++k) {
        b.lo[k] = at[k] == 0 ? whole_.lo[k] : origin_[k] + size_ * static_cast<float>(at[k]);
        b.hi[k] =
            at[k] + 1 == n_[k] ? whole_.hi[k] : origin_[k] + size_ * static_cast<float>(at[k] + 1);
    }
    return b;
}

// Floats of at most 24 bits and differences of them in doubles: exact.
IndexGridLists::Range IndexGridLists::range_of(const IndexItem& item) const {
    Range r;
    for (std::size_t k = 0; k < 3; ++k) {
        const double scale = 1.0 / static_cast<double>(size_);
        const auto at = [&](float v) {
            const double t = (static_cast<double>(v) - static_cast<double>(origin_[k])) * scale;
            if (!(t > 0)) return std::uint32_t{0};
            return std::min(static_cast<std::uint32_t>(t), n_[k] - 1);
        };
        r.lo[k] = at(item.lo[k]);
        r.hi[k] = at(item.hi[k]);
    }
    return r;
}

bool IndexGridLists::is_large(const Range& r) {
    return std::size_t{r.hi[0] - r.lo[0] + 1} * (r.hi[1] - r.lo[1] + 1) * (r.hi[2] - r.lo[2] + 1) >
           8;
}

template <class F>
void IndexGridLists::for_range(const Range& r, const F& f) const {
    for (std::uint32_t z = r.lo[2]; z <= r.hi[2]; ++z)
        for (std::uint32_t y = r.lo[1]; y <= r.hi[1]; ++y)
            for (std::uint32_t x = r.lo[0]; x <= r.hi[0]; ++x) f(number(x, y, z));
}

// Counts, then fills.
void IndexGridLists::list() {
    begin_.assign(cell_count() + 1, 0);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> large;  // cell, item
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
        const Range r = range_of(items_[i]);
        if (is_large(r)) {
            list_large(i, r, large);
            continue;
        }
        for_range(r, [&](std::size_t cell) { ++begin_[cell + 1]; });
    }
    for (const auto& [cell, item] : large) ++begin_[cell + 1];
    for (std::size_t c = 0; c + 1 < begin_.size(); ++c) begin_[c + 1] += begin_[c];
    listed_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
        const Range r = range_of(items_[i]);
        if (!is_large(r)) for_range(r, [&](std::size_t cell) { listed_[next[cell]++] = i; });
    }
    for (const auto& [cell, item] : large) listed_[next[cell]++] = item;
}

void IndexGridLists::list_large(std::uint32_t i, const Range& r,
                                std::vector<std::pair<std::uint32_t, std::uint32_t>>& out) const {
    const IndexPolygons::Id id = items_[i].id;
    if (!polygons_.is_triangle(id)) {
        for_range(r, [&](std::size_t c) { out.emplace_back(static_cast<std::uint32_t>(c), i); });
        return;
    }
    std::array<std::array<double, 3>, 3> corners{};
    for (int c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 3; ++k)
            corners[static_cast<std::size_t>(c)][k] =
                static_cast<double>(polygons_.corner(id, c)[static_cast<int>(k)]) - middle_[k];
    const TriangleInBoxes triangle(corners);
    const double half = 0.5 * static_cast<double>(size_);
    std::array<double, 3> at{};
    for (std::uint32_t z = r.lo[2]; z <= r.hi[2]; ++z) {
        at[2] = static_cast<double>(origin_[2]) + static_cast<double>(size_) * (z + 0.5);
        for (std::uint32_t y = r.lo[1]; y <= r.hi[1]; ++y) {
            at[1] = static_cast<double>(origin_[1]) + static_cast<double>(size_) * (y + 0.5);
            for (std::uint32_t x = r.lo[0]; x <= r.hi[0]; ++x) {
                at[0] = static_cast<double>(origin_[0]) + static_cast<double>(size_) * (x + 0.5);
                const bool is_last = x + 1 == n_[0] || y + 1 == n_[1] || z + 1 == n_[2];
                if (is_last || triangle.may_meet(at, half))
                    out.emplace_back(static_cast<std::uint32_t>(number(x, y, z)), i);
            }
        }
    }
}

}  // namespace trisect::detail
