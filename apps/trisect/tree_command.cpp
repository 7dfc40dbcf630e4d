// SPDX-License-Identifier: Apache-2.0
//
// tree A: the partitions behind a solid: the cell tree that evaluation made, which for an untouched
// import is one leaf, and the index over the boundary that answers queries. As numbers, and as a
// drawing of a slice perpendicular to an axis.
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/cell_tree_view.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "commands.h"
#include "output_name.h"
#include "page_entities.h"
#include "queried_set.h"
#include "tree_drawing.h"
#include "tree_page.h"
#include "values.h"

namespace trisect::app {
namespace {

Json cells_json(const CellTreeStats& stats) {
    Json out;
    out["nodes"] = stats.nodes;
    out["leaves"] = stats.leaves;
    out["inside_leaves"] = stats.inside_leaves;
    out["outside_leaves"] = stats.outside_leaves;
    out["listing_leaves"] = stats.listing_leaves;
    out["arranged_leaves"] = stats.arranged_leaves;
    out["depth"] = stats.depth;
    out["polygons"] = stats.polygons;
    out["largest_leaf"] = stats.largest_leaf;
    out["fragments"] = stats.fragments;
    out["bytes"] = stats.bytes;
    return out;
}

Json index_json(const IndexStats& stats) {
    Json out;
    out["polygons"] = stats.polygons;
    out["nodes"] = stats.nodes;
    out["mixed_leaves"] = stats.mixed_leaves;
    out["empty_leaves"] = stats.empty_leaves;
    out["listed"] = stats.listed;
    out["depth"] = stats.depth;
    out["bytes"] = stats.bytes;
    out["bytes_per_polygon"] = stats.bytes_per_polygon;
    out["build_seconds"] = stats.build_seconds;
    return out;
}

std::string answer_text(const CellTreeStats& cells, const IndexStats& index) {
    return fmt::format(
        "cell tree  {} nodes, depth {}, {} bytes\n"
        "           leaves: {} inside, {} outside, {} with polygons, {} of them arranged\n"
        "           polygons listed: {}, most in a leaf {}, fragments {}\n"
        "index      {} nodes, depth {}, {} bytes, {:.1f} a polygon\n"
        "           leaves: {} empty, {} with polygons\n"
        "           {} polygons, listed {} times\n",
        cells.nodes, cells.depth, cells.bytes, cells.inside_leaves, cells.outside_leaves,
        cells.listing_leaves, cells.arranged_leaves, cells.polygons, cells.largest_leaf,
        cells.fragments, index.nodes, index.depth, index.bytes, index.bytes_per_polygon,
        index.empty_leaves, index.mixed_leaves, index.polygons, index.listed);
}

/// A plane perpendicular to an axis, as a place to cut partitions.
class Cut {
public:
    Cut(const PlaneRequest& request, const Bounds& bounds)
        : axis_(static_cast<std::size_t>(request.axis().value())),
          position_(request.position(bounds)),
          coefficients_(request.coefficients(bounds)),
          frame_(coefficients_) {}

    [[nodiscard]] std::array<double, 3> lower() const { return box(-infinity); }
    [[nodiscard]] std::array<double, 3> upper() const { return box(infinity); }
    [[nodiscard]] const std::array<double, 4>& coefficients() const { return coefficients_; }
    [[nodiscard]] const PlaneFrame& frame() const { return frame_; }
    /// A box in space, in the plane. The plane's axes point along those of space.
    [[nodiscard]] Svg::Rectangle rectangle(const std::array<double, 3>& lo,
                                           const std::array<double, 3>& hi) const {
        const std::size_t u = axis_ == 0 ? 1 : 0;
        const std::size_t v = axis_ == 2 ? 1 : 2;
        return {{lo[u], lo[v]}, {hi[u], hi[v]}};
    }
    [[nodiscard]] std::vector<std::vector<DrawingPoint>> section(const Solid& solid) const {
        return section(BrepIndex(solid));
    }
    [[nodiscard]] std::vector<std::vector<DrawingPoint>> section(const BrepIndex& index) const {
        std::vector<std::vector<DrawingPoint>> out;
        for (const SectionRegion& region : index.section(coefficients_)) {
            for (auto& loop : frame_.loops(region)) out.push_back(std::move(loop));
        }
        return out;
    }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    [[nodiscard]] std::array<double, 3> box(double end) const {
        std::array<double, 3> out{end, end, end};
        out[axis_] = position_;
        return out;
    }

    std::size_t axis_;
    double position_;
    std::array<double, 4> coefficients_;
    PlaneFrame frame_;
};

SliceCell slice_cell(const CellLeaf& leaf, const Cut& cut) {
    SliceCell cell;
    cell.box = cut.rectangle(leaf.lo, leaf.hi);
    cell.polygons = leaf.polygons;
    if (leaf.polygons == 0) {
        cell.kind = leaf.is_inside ? SliceCell::Kind::Inside : SliceCell::Kind::Outside;
    } else {
        cell.kind = leaf.is_arranged ? SliceCell::Kind::Arranged : SliceCell::Kind::Listing;
    }
    return cell;
}

Slice slice_of(const QueriedSet& set, const BrepIndex& index, const Cut& cut) {
    Slice slice;
    for (const CellLeaf& leaf : cell_tree_leaves(set.solid, cut.lower(), cut.upper())) {
        slice.cells.push_back(slice_cell(leaf, cut));
    }
    slice.section = cut.section(index);
    if (set.operands.size() > 1) {
        for (std::size_t i = 0; i < set.operands.size(); ++i) {
            slice.operands.push_back({cut.section(set.operands[i].solid), i});
        }
    }
    return slice;
}

DrawingFrame frame_of(const Cut& cut, const Bounds& bounds, const Slice& slice) {
    DrawingFrame frame = DrawingFrame::empty();
    const Svg::Rectangle box = cut.rectangle(bounds.lo, bounds.hi);
    frame.add(box.lower);
    frame.add(box.upper);
    for (const SliceOutline& operand : slice.operands) {
        for (const auto& loop : operand.loops) {
            for (const DrawingPoint& p : loop) frame.add(p);
        }
    }
    return frame.with_margin(0.06);
}

}  // namespace

void add_tree_command(CLI::App& app, TreeOptions& options) {
    CLI::App* command =
        app.add_subcommand("tree", "the partition behind a solid, and a slice of it");
    add_query_options(*command, options.set);
    command
        ->add_option_function<std::string>(
            "--plane",
            [&options](const auto& s) {
                options.plane = PlaneRequest::from_text(s, "--plane");
                if (!options.plane.axis()) {
                    throw UsageError("--plane: walls are perpendicular to axes: x, y, z=NUMBER");
                }
            },
            "where to slice; by default z, in the middle")
        ->type_name("z=NUMBER|z");
    command->add_option("-o,--output", options.output, "drawing (SVG); '-' is the standard output")
        ->type_name("FILE");
    add_page_option(*command, options.page);
}

Outcome run_tree(Session& session, const TreeOptions& options) {
    check_output_name(session, options.output, ".svg");
    check_page_name(session, options.page);
    check_outputs(session, {options.output, options.page}, Answer::Printed);
    session.plan(options.page.empty() ? 5 : 6);
    const QueriedSet set = read_set(session, options.set);
    const BrepIndex index = session.stage("index", [&] { return BrepIndex(set.solid); });
    index.refine();  // so that its figures are those of all of it
    const CellTreeStats cells = cell_tree_stats(set.solid);
    Outcome out;
    out.document["schema"] = "trisect.tree/1";
    describe_inputs(options.set, set, out.document);
    out.document["cells"] = cells_json(cells);
    out.document["index"] = index_json(index.stats());
    out.document["output"] = options.output.empty() ? Json() : Json(options.output);
    if (!options.output.empty()) {
        const std::string drawing = session.stage("draw", [&] {
            const Bounds bounds = bounds_of(corners_of(set.solid)).value_or(Bounds());
            const Cut cut(options.plane, bounds);
            const Slice slice = slice_of(set, index, cut);
            out.document["plane"] = cut.coefficients();
            out.document["slice_cells"] = slice.cells.size();
            return draw_slice(slice, frame_of(cut, bounds, slice));
        });
        session.stage("write", [&] { session.write_output(options.output, drawing); });
    }
    if (!options.page.empty())
        session.stage("page", [&] {
            const std::string title =
                set.operands.size() == 1
                    ? short_name(options.set.inputs[0])
                    : fmt::format("{} of {} solids", options.set.operation, set.operands.size());
            session.write_output(options.page, tree_page(title, set.solid, set.solid.to_brep()));
        });
    out.document["seconds"] = session.seconds();
    (options.output == "-" ? out.remarks : out.answer) = answer_text(cells, index.stats());
    return out;
}

}  // namespace trisect::app
