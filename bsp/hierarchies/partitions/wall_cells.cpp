// SPDX-License-Identifier: Apache-2.0
//
// Splitting planes cut faces that no face plane would have cut, which is why a tree of splitting
// planes alone is no tree of a solid. They pay where they halve a long list: at the median of what
// is left, along the axis where the longer of both lists is shortest. Where to put them, boxes in
// doubles say; what is on which side, exact cuts.
//
// Source: the splitting planes of the modeller's own tree (bsp/divide/choose_wall.h); B. Naylor,
// Constructing good partitioning trees (Graphics Interface 1993), on why balance has to come from
// elsewhere than from the faces.

#include <trisect/bsp/hierarchies/partitions/wall_cells.h>

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

struct Position {
    std::size_t axis = 0;
    std::int64_t twice = 0;  // odd
    [[nodiscard]] double at() const { return 0.5 * static_cast<double>(twice); }
};

std::optional<Position> best_position(const std::vector<Piece>& pieces) {
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
        const Position wall{axis, 2 * static_cast<std::int64_t>(std::floor(*middle)) + 1};
        std::size_t below = 0;
        std::size_t above = 0;
        for (const Piece& p : pieces) {
            below += p.box.lo[axis] < wall.at() ? 1 : 0;
            above += p.box.hi[axis] > wall.at() ? 1 : 0;
        }
        const std::size_t longer = std::max(below, above);
        if (longer >= least) continue;
        least = longer;
        best = wall;
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
    explicit Divider(std::size_t most) : most_(most) {}

    WallCells run(std::vector<Piece> pieces) {
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
    using Ref = WallCells::Ref;
    struct Task {
        std::vector<Piece> pieces;
        std::vector<Plane> walls;
        Ref WallCells::Wall::*side;  // of its parent; null for all of space
        std::size_t parent;
    };

    void link(const Task& task, Ref ref) {
        if (task.side != nullptr) result_.walls[task.parent].*task.side = ref;
    }

    bool divide(Task& task) {
        if (task.pieces.size() <= most_) return false;
        const auto position = best_position(task.pieces);
        if (!position) return false;
        const Plane wall =
            Plane::axis_aligned(static_cast<int>(position->axis), 2, position->twice);
        Task below{{}, task.walls, &WallCells::Wall::below, result_.walls.size()};
        Task above{{}, task.walls, &WallCells::Wall::above, result_.walls.size()};
        below.walls.push_back(wall);
        above.walls.push_back(wall.flipped());
        for (const Piece& p : task.pieces) {
            ConvexPolygon low;
            ConvexPolygon high;
            const auto parts = p.shape.split(wall, low, high);
            if (!parts.is_cut()) {
                (parts.below > 0 ? below : above).pieces.push_back(p);
                continue;
            }
            below.pieces.push_back({std::move(low), p.box, p.triangle});
            below.pieces.back().box.hi[position->axis] = position->at();
            above.pieces.push_back({std::move(high), p.box, p.triangle});
            above.pieces.back().box.lo[position->axis] = position->at();
        }
        // Boxes of parts are larger than the parts.
        if (std::max(below.pieces.size(), above.pieces.size()) >= task.pieces.size() ||
            below.pieces.empty() || above.pieces.empty())
            return false;
        link(task, static_cast<Ref>(result_.walls.size()));
        result_.walls.push_back({wall, 0, 0, {}, {}});
        open_.push_back(std::move(above));
        open_.push_back(std::move(below));
        return true;
    }

    void finish(Task&& task) {
        link(task, WallCells::cell_ref(result_.cells.size()));
        WallCells::Cell& cell = result_.cells.emplace_back();
        for (Piece& p : task.pieces) {
            cell.polygons.push_back(std::move(p.shape));
            cell.triangles.push_back(p.triangle);
            cell.box = cell.triangles.size() == 1 ? p.box : around(cell.box, p.box);
        }
        cell.walls = std::move(task.walls);
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
            const WallCells::Wall& wall = result_.walls[static_cast<std::size_t>(ref)];
            return around(wall.box_below, wall.box_above);
        };
        for (std::size_t i = result_.walls.size(); i-- > 0;) {
            WallCells::Wall& wall = result_.walls[i];
            wall.box_below = box_of(wall.below);
            wall.box_above = box_of(wall.above);
        }
    }

    std::size_t most_;
    std::vector<Task> open_;
    WallCells result_;
};

}  // namespace

WallCells WallCells::over(const detail::InterferenceModelData& model, std::size_t most) {
    return Divider(most).run(pieces_of(model));
}

}  // namespace trisect::hierarchies
