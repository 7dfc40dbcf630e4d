// SPDX-License-Identifier: Apache-2.0
//
// The triangles of a mesh are of similar size, which is all that a uniform grid needs: cells as
// long as the median triangle have a few triangles each, and a triangle of B looks into a few
// cells. Occupied cells are in a hash table, so storage is O(n) although the grid is as wide as A.
//
// A triangle that would be in more than 64 cells is in none, and every triangle of B compares its
// box with it: a plate with a rivet pays for the plate, and no more.
//
// Source: as in broad_phases.h.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include <trisect/bsp/hierarchies/partitions/grid_level.h>
#include <trisect/bsp/hierarchies/partitions/partition.h>
#include <trisect/bsp/hierarchies/partitions/partitions.h>
#include <trisect/bsp/query/index/triangle_in_boxes.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::hierarchies {

namespace {

constexpr double most_cells = 64;

double extent(const Box& b) {
    return std::max({b.hi[0] - b.lo[0], b.hi[1] - b.lo[1], b.hi[2] - b.lo[2]});
}

double median_size(std::span<const Box> boxes) {
    std::vector<double> sizes;
    for (const Box& b : boxes) sizes.push_back(extent(b));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle;
}

/// Places of cells have 30 bits.
double size_of_cells(const TriangleBoxes& boxes) {
    double far = 0;
    for (std::size_t k = 0; k < 3; ++k)
        far = std::max({far, std::abs(boxes.bounds().lo[k]), std::abs(boxes.bounds().hi[k])});
    return power_of_two_above(std::max(median_size(boxes.all()), far * 0x1p-28));
}

class HashGridPartition final : public Partition {
public:
    HashGridPartition(const InterferenceModel& a, const InterferenceModel& b)
        : Partition(a, b), grid_(size_of_cells(fixed())) {
        const auto start = std::chrono::steady_clock::now();
        for (std::uint32_t i = 0; i < fixed().size(); ++i) {
            if (grid_.range_of(fixed()[i]).count() > most_cells)
                large_.push_back(i);
            else
                for_each_cell(i, [this](const CellPlace& c) { grid_.cells().count(c); });
        }
        grid_.cells().allocate();
        for (std::uint32_t i = 0; i < fixed().size(); ++i)
            if (grid_.range_of(fixed()[i]).count() <= most_cells)
                for_each_cell(i, [this, i](const CellPlace& c) { grid_.cells().add(c, i); });
        grid_.close();
        seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    std::string_view name() const override { return "hash-grid"; }
    BuildReport build_report() const override {
        return {seconds_, grid_.bytes() + large_.size() * sizeof(large_[0]) + common_bytes(),
                grid_.cells().size(), 1};
    }

protected:
    bool find_in_cells(const Box& box, FunctionRef<bool(std::uint32_t)> offer,
                       CostCounters& counters) override {
        return std::any_of(large_.begin(), large_.end(), offer) ||
               grid_.in(grid_.range_of(box), counters, offer);
    }
    void find_near_cells(const Box& box, double limit, FunctionRef<double(std::uint32_t)> offer,
                         CostCounters& counters) override {
        for (const std::uint32_t i : large_) limit = offer(i);
        (void)grid_.near(grid_.range_of(box), limit, counters, offer);
    }
    /// One level. Triangles that are in no cell are not shown.
    [[nodiscard]] std::vector<VolumeOutline> list_cells(unsigned /*levels*/) const override {
        std::vector<VolumeOutline> out;
        const CellLists& cells = grid_.cells();
        for (std::size_t c = 0; cells.size() <= most_shown_cells && c < cells.size(); ++c)
            out.push_back(outline_of(grid_.box_of(cells.place(c)), 0, true));
        return out;
    }

private:
    // Those of its box that the triangle may meet.
    template <class Visit>
    void for_each_cell(std::uint32_t i, Visit&& visit) const {
        const CellRange range = grid_.range_of(fixed()[i]);
        const detail::ModelTriangle& t = data_a().triangles[i];
        std::optional<detail::TriangleInBoxes> triangle;
        if (range.count() > 2)
            triangle.emplace(std::array{data_a().position(t.vertex[0]),
                                        data_a().position(t.vertex[1]),
                                        data_a().position(t.vertex[2])});
        const double half = 0.5 * grid_.size() * detail::surely_more + 4 * fixed().error();
        range.for_each([&](const CellPlace& c) {
            std::array<double, 3> middle{};
            for (std::size_t k = 0; k < 3; ++k) middle[k] = (c[k] + 0.5) * grid_.size();
            if (!triangle || triangle->may_meet(middle, half)) visit(c);
        });
    }

    GridLevel grid_;
    std::vector<std::uint32_t> large_;
    double seconds_ = 0;
};

}  // namespace

std::unique_ptr<PairStructure> make_hash_grid_partition(const InterferenceModel& a,
                                                        const InterferenceModel& b) {
    return std::make_unique<HashGridPartition>(a, b);
}

}  // namespace trisect::hierarchies
