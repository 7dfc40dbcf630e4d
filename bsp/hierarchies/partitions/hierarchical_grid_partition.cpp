// SPDX-License-Identifier: Apache-2.0
//
// A grid for each power of two, as the broad phase of that name (hierarchical_grid_phase.cpp). A
// triangle is in one cell alone, that of the lower corner of its box, in the grid whose cells are
// just longer than it is; a box of B looks one cell farther down along each axis for it. So storage
// is one entry a triangle, and one large triangle costs small ones nothing.
//
// Looked through are the coarse grids first: they have the large triangles, and give a limit soon.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include <trisect/bsp/hierarchies/partitions/grid_level.h>
#include <trisect/bsp/hierarchies/partitions/partition.h>
#include <trisect/bsp/hierarchies/partitions/partitions.h>

namespace trisect::hierarchies {

namespace {

// A power of two that is above the length of the box, whatever was rounded, and so large that
// places in the grid have 30 bits.
double level_of(const Box& b) {
    double size = 0;
    double far = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        size = std::max(size, b.hi[k] - b.lo[k]);
        far = std::max({far, std::abs(b.lo[k]), std::abs(b.hi[k])});
    }
    return power_of_two_above(std::max(std::nextafter(size, HUGE_VAL), far * 0x1p-28));
}

class HierarchicalGridPartition final : public Partition {
public:
    HierarchicalGridPartition(const InterferenceModel& a, const InterferenceModel& b)
        : Partition(a, b) {
        const auto start = std::chrono::steady_clock::now();
        std::map<double, GridLevel, std::greater<>> levels;
        for (const Box& box : fixed().all()) {
            const double size = level_of(box);
            const auto level = levels.try_emplace(size, size).first;
            level->second.cells().count(corner_of(box, level->second));
        }
        for (auto& [size, level] : levels) level.cells().allocate();
        for (std::uint32_t i = 0; i < fixed().size(); ++i) {
            GridLevel& level = levels.at(level_of(fixed()[i]));
            level.cells().add(corner_of(fixed()[i], level), i);
        }
        for (auto& [size, level] : levels) {
            level.close();
            levels_.push_back(std::move(level));
        }
        seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    std::string_view name() const override { return "hierarchical-grid"; }
    BuildReport build_report() const override {
        BuildReport r{seconds_, common_bytes(), 0, static_cast<unsigned>(levels_.size())};
        for (const GridLevel& level : levels_) {
            r.bytes += level.bytes();
            r.volumes += level.cells().size();
        }
        return r;
    }

protected:
    bool find_in_cells(const Box& box, FunctionRef<bool(std::uint32_t)> offer,
                       CostCounters& counters) override {
        for (const GridLevel& level : levels_)
            if (level.in(reach_of(box, level), counters, offer)) return true;
        return false;
    }
    void find_near_cells(const Box& box, double limit, FunctionRef<double(std::uint32_t)> offer,
                         CostCounters& counters) override {
        for (const GridLevel& level : levels_)
            limit = level.near(reach_of(box, level), limit, counters, offer);
    }
    /// The coarsest grid first, each cell with the next ones, which its triangles may reach into.
    [[nodiscard]] std::vector<VolumeOutline> list_cells(unsigned levels) const override {
        std::vector<VolumeOutline> out;
        for (unsigned i = 0; i < std::min<std::size_t>(levels, levels_.size()); ++i) {
            const CellLists& cells = levels_[i].cells();
            if (out.size() + cells.size() > most_shown_cells) break;
            for (std::size_t c = 0; c < cells.size(); ++c) {
                Box box = levels_[i].box_of(cells.place(c));
                for (double& hi : box.hi) hi += levels_[i].size();
                out.push_back(outline_of(box, i, true));
            }
        }
        return out;
    }

private:
    static CellPlace corner_of(const Box& box, const GridLevel& level) {
        return level.range_of(box).lo;
    }
    // Where the lower corners of what meets the box are.
    static CellRange reach_of(const Box& box, const GridLevel& level) {
        CellRange range = level.range_of(box);
        for (std::int32_t& c : range.lo) --c;
        return range;
    }

    std::vector<GridLevel> levels_;
    double seconds_ = 0;
};

}  // namespace

std::unique_ptr<PairStructure> make_hierarchical_grid_partition(const InterferenceModel& a,
                                                                const InterferenceModel& b) {
    return std::make_unique<HierarchicalGridPartition>(a, b);
}

}  // namespace trisect::hierarchies
