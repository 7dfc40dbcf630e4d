// SPDX-License-Identifier: Apache-2.0
//
// AxisArrangement: leaf arrangement of axis-perpendicular polygons in numbers of one type.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include <trisect/bsp/cells/axis_grid.h>
#include <trisect/bsp/cells/axis_polygon.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/occupancy_grid.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/workbench.h>
#include <trisect/bsp/leaf/grid/axis_clip.h>
#include <trisect/bsp/leaf/leaf_arrangement.h>
#include <trisect/bsp/leaf/leaf_work.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

/// AxisLeaf for coordinates that a type of integers takes.
template <class Number>
class AxisArrangement final : public LeafArrangement {
private:
    using Numbers = AxisNumbers<Number>;
    using Polygon = AxisPolygon<Number>;
    using Grid = AxisGrid<Number>;
    // Bits of all units, layer by layer across z, row by row along y; a bit for each along x.
    using Units = std::vector<std::uint64_t>;
    using Polygons = std::span<const Polygon>;
    // The units on both sides of a plane that are inside some set, in the frame of the plane.
    struct Sides {
        UnitRows low;
        UnitRows high;
    };
    struct Rectangle {
        std::size_t row, end_row, bit, end_bit;
    };

    [[nodiscard]] std::optional<LeafResult> try_to_arrange(const LeafProblem& problem,
                                                           LeafFindings& findings) override;
    void find_result();
    [[nodiscard]] bool seems_across_axes() const;
    [[nodiscard]] bool list();
    [[nodiscard]] bool make_grid();
    [[nodiscard]] std::size_t rows() const { return grid_.units(1).count(); }
    [[nodiscard]] std::size_t layers() const { return grid_.units(2).count(); }
    [[nodiscard]] std::size_t words() const { return rows() * layers(); }
    [[nodiscard]] std::uint64_t* units_of(LeafIndex operand) {
        return insides_.data() + as_index(operand) * words();
    }
    [[nodiscard]] std::uint64_t all_bits() const { return unit_bits(0, grid_.units(0).count()); }

    void fill(LeafIndex operand, Polygons polygons);
    void evaluate(const Residual& formula, Units& out);
    [[nodiscard]] Sides sides(const std::uint64_t* units, std::size_t axis, std::size_t plane,
                              std::size_t first_row, std::size_t end_row) const;
    void start_planes();
    void emit_all();
    void emit_occupancy();
    void emit_plane(Polygons plane_polygons);
    void start_plane(Polygons plane_polygons);
    void find_clean(Polygons plane_polygons);
    [[nodiscard]] bool is_clean(const UnitRows& units) const;
    void emit_clean(const Polygon& p, const UnitRows& units);
    void emit_uncut(const Polygon& p, const UnitRows& units);
    void note_found(std::uint8_t what);
    [[nodiscard]] std::uint8_t corners_in(const Polygon& p, const UnitRows& units) const;
    [[nodiscard]] std::unique_ptr<OccupancyGrid> make_occupancy();
    void emit_group(Polygons group);
    void emit_rectangles(Polygons group, UnitRows rows, bool inside_low);
    void emit_clipped(Polygons group, const Rectangle& r, bool inside_low);
    void note_incomplete(Polygons group, std::size_t first_made);
    // The inside on the higher side, and on the lower side.
    using Facings = std::array<bool, 2>;
    static constexpr Facings both_facings{true, true};
    void note_incomplete(const Polygon& p, const UnitRows& units, Facings without);
    [[nodiscard]] bool is_inside_low(const UnitRows& units) const;
    [[nodiscard]] UnitRows overlapped(const Polygon& p) const;
    [[nodiscard]] AxisBox<Number> box_of(const Rectangle& r) const;
    [[nodiscard]] bool touches_others(const Polygon& p, const UnitRows& rows) const;
    [[nodiscard]] AxisRectangle<Number> with_names(const Rectangle& r) const;
    [[nodiscard]] std::optional<PolygonRef> clip_slowly(const Polygon& p,
                                                        const AxisRectangle<Number>& r);

    const LeafProblem* problem_ = nullptr;
    EvaluateStats* stats_ = nullptr;
    std::vector<FacetName> incomplete_;

    std::vector<Polygon> polygons_;  // by operand, axis, plane, source, normal
    Grid grid_;
    Units insides_;  // of all operands
    std::vector<LeafIndex> operand_of_slot_;
    Units result_;
    std::unordered_map<const Residual*, Units> known_;
    bool remembers_ = false;
    Units toggles_;
    std::array<std::vector<UnitRows>, 3> claimed_;  // by axis and plane
    // The plane that is being emitted.
    std::size_t axis_ = 0;
    std::size_t plane_ = 0;
    std::size_t first_row_ = 0;
    std::size_t end_row_ = 0;
    // Of the plane at hand, from first_row_ to end_row_.
    UnitRows own_{};
    UnitRows up_{};         // kept, with the inside on the lower side
    UnitRows down_{};       // kept, with the inside on the higher side
    UnitRows bounds_{};     // of the result
    UnitRows whole_low_{};  // the result on the lower side
    Polygons plane_polygons_;
    std::vector<std::uint8_t> clean_;  // by polygon, see find_clean()
    bool occupancies_ = false;         // an occupancy grid is made instead of parts of facets
    bool needs_parts_ = false;         // an occupancy grid is not enough
    bool any_cut_ = false;
    static constexpr std::uint8_t found_clean = 1;
    static constexpr std::uint8_t found_cut = 2;
    std::array<std::vector<std::uint8_t>, 3> found_;  // by axis and plane
    std::vector<OccupancyGrid::Part> parts_;          // of the occupancy grid
    Workbench bench_;
};

}  // namespace trisect::detail
