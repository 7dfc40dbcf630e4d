// SPDX-License-Identifier: Apache-2.0
//
// SpaceTreePartition: a SpaceTree over A's triangles as a pair structure.
// Octree and k-d tree differ only in the division of cells.
#pragma once

#include <string_view>

#include <trisect/bsp/hierarchies/partitions/partition.h>
#include <trisect/bsp/hierarchies/partitions/space_tree.h>

namespace trisect::hierarchies {

class SpaceTreePartition final : public Partition {
public:
    /// The tree over A's boxes.
    using Make = SpaceTree (*)(const detail::InterferenceModelData& model, const TriangleBoxes&);

    SpaceTreePartition(std::string_view name, Make make, const InterferenceModel& a,
                       const InterferenceModel& b);

    std::string_view name() const override { return name_; }
    BuildReport build_report() const override {
        return {seconds_, tree_.bytes() + common_bytes(), tree_.node_count(), tree_.depth()};
    }

protected:
    bool find_in_cells(const Box& box, FunctionRef<bool(std::uint32_t)> offer,
                       CostCounters& counters) override {
        return tree_.find_in_cells(box, offer, counters);
    }
    void find_near_cells(const Box& box, double limit, FunctionRef<double(std::uint32_t)> offer,
                         CostCounters& counters) override {
        tree_.find_near_cells(box, limit, offer, counters);
    }
    [[nodiscard]] std::vector<VolumeOutline> list_cells(unsigned levels) const override {
        std::vector<VolumeOutline> out;
        tree_.for_each_cell(levels, [&](const Box& cell, unsigned level, bool is_leaf) {
            out.push_back(outline_of(cell, level, is_leaf));
        });
        return out;
    }

private:
    std::string_view name_;
    SpaceTree tree_;
    double seconds_ = 0;
};

}  // namespace trisect::hierarchies
