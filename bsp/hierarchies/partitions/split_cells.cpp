// SPDX-License-Identifier: Apache-2.0
//
// Splitting planes cut faces that no face plane would have cut, which is why a tree of splitting
// planes alone is no tree of a solid. They pay where they halve a long list: at the median of what
// is left, along the axis where the longer of both lists is shortest. Where to put them, boxes in
// doubles say; what is on which side, exact cuts.
//
// Source: the splitting planes of the modeller's own tree (bsp/divide/choose_splitting_plane.h); B.
// Naylor, Constructing good partitioning trees (Graphics Interface 1993), on why balance has to
// come from elsewhere than from the faces.

#include <trisect/bsp/hierarchies/partitions/split_cells.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace trisect::hierarchies {

namespace {

using detail::BodyBox;

struct Piece {
    ConvexPolygon shape;
    BodyBox box;  // contains it; positions of lattice points are exact
    std::uint32_t triangle = 0;
};

/// Where splitting planes may be: at odd multiples of half a unit where all coordinates are whole,
/// else at thirds of 2^-bits of a unit, where no double is.
class Positions {
public:
    explicit Positions(const detail::InterferenceModelData& model)
        : whole_(std::ranges::all_of(model.brep.points(),
                                     [](const Point& p) { return p.lattice().is_whole(); })),
          // Numbers of units have 61 bits.
          bits_(model.largest > 0 ? 60 - std::ilogb(model.largest) : 0) {}

    struct Position {
        std::size_t axis = 0;
        Plane plane;
        double low = 0;  ///< doubles at or around it
        double high = 0;
    };
    /// The one above a coordinate of the model.
    [[nodiscard]] Position above(std::size_t axis, double coordinate) const {
        const auto i = static_cast<int>(axis);
        if (whole_) {
            const std::int64_t twice = 2 * static_cast<std::int64_t>(std::floor(coordinate)) + 1;
            const double at = 0.5 * static_cast<double>(twice);
            return {axis, Plane::axis_aligned(i, 2, twice), at, at};
        }
        const auto below = static_cast<std::int64_t>(std::floor(std::ldexp(coordinate, bits_)));
        std::array<Plane::Coefficient, 3> n{};
        n[axis] = Plane::Coefficient(3).shifted_left(bits_);
        const Plane::Coefficient position(Int128{3} * below + 1);
        // Both roundings are within a place of it.
        const double at = std::ldexp(static_cast<double>(below) + 1.0 / 3, -bits_);
        const double low = std::nextafter(std::nextafter(at, -HUGE_VAL), -HUGE_VAL);
        const double high = std::nextafter(std::nextafter(at, HUGE_VAL), HUGE_VAL);
        return {axis, Plane(n[0], n[1], n[2], -position), low, high};
    }

private:
    bool whole_;
    int bits_;
};
using Position = Positions::Position;

std::optional<Position> best_position(const std::vector<Piece>& pieces,
                                      const Positions& positions) {
    const std::size_t n = pieces.size();
    std::optional<Position> best;
    // The longer of both lists, at most.
    std::size_t least = n - n / 8;
    std::vector<double> centres(n);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < n; ++i)
            centres[i] = 0.5 * (pieces[i].box.lo[axis] + pieces[i].box.hi[axis]);
        const auto middle = centres.begin() + static_cast<std::ptrdiff_t>(n / 2);
        std::nth_element(centres.begin(), middle, centres.end());
        const Position splitter = positions.above(axis, *middle);
        std::size_t below = 0;
        std::size_t above = 0;
        for (const Piece& p : pieces) {
            below += p.box.lo[axis] < splitter.high ? 1 : 0;
            above += p.box.hi[axis] > splitter.low ? 1 : 0;
        }
        const std::size_t longer = std::max(below, above);
        if (longer >= least) continue;
        least = longer;
        best = splitter;
    }
    return best;
}

std::vector<Piece> pieces_of(const detail::InterferenceModelData& model) {
    std::vector<Piece> pieces(model.triangles.size());
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
        const detail::ModelTriangle& t = model.triangles[i];
        std::array<LatticePoint, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = model.brep.point(t.vertex[k]).lattice();
        BodyBox box{model.position(t.vertex[0]), model.position(t.vertex[0])};
        for (const VertexId v : t.vertex)
            for (std::size_t k = 0; k < 3; ++k) {
                box.lo[k] = std::min(box.lo[k], model.position(v)[k]);
                box.hi[k] = std::max(box.hi[k], model.position(v)[k]);
            }
        pieces[i] = {ConvexPolygon::from_triangle(p[0], p[1], p[2]), box, i};
    }
    return pieces;
}

class Divider {
public:
    Divider(const Positions& positions, std::size_t most) : positions_(positions), most_(most) {}

    SplitCells run(std::vector<Piece> pieces) {
        open_.push_back({std::move(pieces), {}, nullptr, 0});
        while (!open_.empty()) {
            Task task = std::move(open_.back());
            open_.pop_back();
            if (!divide(task)) finish(std::move(task));
        }
        fit_boxes();
        return std::move(result_);
    }

private:
    using Ref = SplitCells::Ref;
    struct Task {
        std::vector<Piece> pieces;
        std::vector<Plane> splitters;
        Ref SplitCells::SplittingPlane::*side;  // of its parent; null for all of space
        std::size_t parent;
    };

    void link(const Task& task, Ref ref) {
        if (task.side != nullptr) result_.splitters[task.parent].*task.side = ref;
    }

    bool divide(Task& task) {
        if (task.pieces.size() <= most_) return false;
        const auto position = best_position(task.pieces, positions_);
        if (!position) return false;
        const Plane& splitter = position->plane;
        Task below{
            {}, task.splitters, &SplitCells::SplittingPlane::below, result_.splitters.size()};
        Task above{
            {}, task.splitters, &SplitCells::SplittingPlane::above, result_.splitters.size()};
        below.splitters.push_back(splitter);
        above.splitters.push_back(splitter.flipped());
        for (const Piece& p : task.pieces) {
            ConvexPolygon low;
            ConvexPolygon high;
            const auto parts = p.shape.split(splitter, low, high);
            if (!parts.is_cut()) {
                (parts.below > 0 ? below : above).pieces.push_back(p);
                continue;
            }
            below.pieces.push_back({std::move(low), p.box, p.triangle});
            below.pieces.back().box.hi[position->axis] = position->high;
            above.pieces.push_back({std::move(high), p.box, p.triangle});
            above.pieces.back().box.lo[position->axis] = position->low;
        }
        // Boxes of parts are larger than the parts.
        if (std::max(below.pieces.size(), above.pieces.size()) >= task.pieces.size() ||
            below.pieces.empty() || above.pieces.empty())
            return false;
        link(task, static_cast<Ref>(result_.splitters.size()));
        result_.splitters.push_back({splitter, 0, 0, {}, {}});
        open_.push_back(std::move(above));
        open_.push_back(std::move(below));
        return true;
    }

    void finish(Task&& task) {
        link(task, SplitCells::cell_ref(result_.cells.size()));
        SplitCells::Cell& cell = result_.cells.emplace_back();
        for (Piece& p : task.pieces) {
            cell.polygons.push_back(std::move(p.shape));
            cell.triangles.push_back(p.triangle);
            cell.box = cell.triangles.size() == 1 ? p.box : around(cell.box, p.box);
        }
        cell.splitters = std::move(task.splitters);
    }

    static BodyBox around(BodyBox a, const BodyBox& b) {
        for (std::size_t k = 0; k < 3; ++k) {
            a.lo[k] = std::min(a.lo[k], b.lo[k]);
            a.hi[k] = std::max(a.hi[k], b.hi[k]);
        }
        return a;
    }

    // A splitting plane comes after the one that it is below or above of.
    void fit_boxes() {
        const auto box_of = [this](Ref ref) {
            if (ref < 0) return result_.cells[static_cast<std::size_t>(~ref)].box;
            const SplitCells::SplittingPlane& splitter =
                result_.splitters[static_cast<std::size_t>(ref)];
            return around(splitter.box_below, splitter.box_above);
        };
        for (std::size_t i = result_.splitters.size(); i-- > 0;) {
            SplitCells::SplittingPlane& splitter = result_.splitters[i];
            splitter.box_below = box_of(splitter.below);
            splitter.box_above = box_of(splitter.above);
        }
    }

    Positions positions_;
    std::size_t most_;
    std::vector<Task> open_;
    SplitCells result_;
};

}  // namespace

SplitCells SplitCells::over(const detail::InterferenceModelData& model, std::size_t most) {
    return Divider(Positions(model), most).run(pieces_of(model));
}

}  // namespace trisect::hierarchies
