// SPDX-License-Identifier: Apache-2.0
//
// Partition: interface for partitions of the space of a fixed solid.
// A stands still and its space is divided once and for all. B's triangles come to it as boxes.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/pair_structure.h>
#include <trisect/bsp/hierarchies/pairs/triangle_boxes.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect::hierarchies {

/// What all partitions share: the cells are A's and in A's lattice units, whatever the poses; an
/// update brings every triangle of B into them (one `update` each), and each of those that are not
/// beyond A's bounds gets the triangles of A in the cells that its box meets. A triangle of A that
/// is in several of them comes up once: it is stamped.
///
/// Nothing recurses.
class Partition : public PairStructure {
public:
    Partition(const InterferenceModel& a, const InterferenceModel& b)
        : PairStructure(a, b), fixed_(trisect::detail::data_of(a)), stamps_(fixed_.size(), 0) {}

protected:
    /// Calls `offer` for the triangles of A in the cells that the box meets, until it returns true.
    /// Any triangle may be offered any number of times. Counts cells as volume tests.
    virtual bool find_in_cells(const Box& box, FunctionRef<bool(std::uint32_t)> offer,
                               CostCounters& counters) = 0;
    /// Calls `offer` for the triangles of A in cells that are not farther than the limit from the
    /// box, near cells first. `offer` returns the limit from now on.
    virtual void find_near_cells(const Box& box, double limit,
                                 FunctionRef<double(std::uint32_t)> offer,
                                 CostCounters& counters) = 0;

    /// Cells of the first levels, a parent before its children; none where they are no boxes, or
    /// more than a picture shows. Of trees only cells that have triangles.
    [[nodiscard]] virtual std::vector<VolumeOutline> list_cells(unsigned /*levels*/) const {
        return {};
    }
    static constexpr std::size_t most_shown_cells = 20'000;
    [[nodiscard]] VolumeOutline outline_of(const Box& cell, unsigned level, bool is_leaf) const;

    /// The same for a triangle of B by its number; by its box unless overridden.
    virtual bool find_for(std::uint32_t b, FunctionRef<bool(std::uint32_t)> offer,
                          CostCounters& counters) {
        return find_in_cells(moved_[b], offer, counters);
    }

    void update(CostCounters& counters) override;
    bool find_candidates(PairVisit visit, CostCounters& counters) override;
    void find_near(double limit, NearVisit visit, CostCounters& counters) override;
    /// B has no cells.
    std::vector<VolumeOutline> list_outlines(bool of_b, unsigned levels) override {
        return of_b ? std::vector<VolumeOutline>() : list_cells(levels);
    }

    [[nodiscard]] const TriangleBoxes& fixed() const { return fixed_; }
    [[nodiscard]] const TriangleBoxes& moved() const { return moved_; }
    /// Of the boxes that all partitions have.
    [[nodiscard]] std::size_t common_bytes() const {
        return fixed_.bytes() + moved_.bytes() + stamps_.size() * sizeof(stamps_[0]);
    }

private:
    /// Whether a triangle of A comes up for the first time since the last call of next_stamp.
    [[nodiscard]] bool is_first(std::uint32_t a) {
        if (stamps_[a] == stamp_) return false;
        stamps_[a] = stamp_;
        return true;
    }
    void next_stamp();

    TriangleBoxes fixed_;
    TriangleBoxes moved_;
    std::vector<std::uint32_t> stamps_;  // by triangle of A
    std::uint32_t stamp_ = 0;
};

}  // namespace trisect::hierarchies
