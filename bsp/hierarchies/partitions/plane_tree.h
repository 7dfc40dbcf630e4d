// SPDX-License-Identifier: Apache-2.0
//
// PlaneTree: planes of a BspTree or MspTree in doubles.
// Triangles are pushed down them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/bsp_tree.h>
#include <trisect/bsp/hierarchies/pairs/triangle_boxes.h>
#include <trisect/bsp/hierarchies/partitions/inner_balls.h>
#include <trisect/bsp/hierarchies/partitions/split_cells.h>
#include <trisect/bsp/interference/boxes/cost.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/msp_tree.h>
#include <trisect/kernel/support/function_ref.h>

namespace trisect::hierarchies {

/// A convex polygon in doubles, every point of which is within `error` of one of the true
/// polygon's.
struct RoughPolygon {
    static constexpr std::size_t most_corners = 12;
    std::array<std::array<double, 3>, most_corners> corner{};
    std::uint32_t count = 0;
    std::uint32_t cuts = 0;
    /// All of it is so near to a plane that it was cut at (2^-30 or so of its size) that of the
    /// true polygon there may be nothing on this side but a border.
    bool is_thin = false;
    double error = 0;

    [[nodiscard]] static RoughPolygon triangle(const std::array<double, 3>& a,
                                               const std::array<double, 3>& b,
                                               const std::array<double, 3>& c, double error);
};

/// What is on a node's plane is a list of triangles (from a BspTree), or a tree in the plane whose
/// leaves name faces (from an MspTree). Lists and faces are offered as triangles.
///
/// Signs are those of doubles with error bounds: where they cannot decide, both sides are visited;
/// so every triangle with a point in common with the one that is pushed down is offered.
///
/// Axis-perpendicular splitting planes above divide the boundary into cells of few triangles, and
/// each of these has a tree of its own (SplitCells): without them the tree of a convex solid would
/// be a list. A model with vertices that are not lattice points has no splitting planes. Nothing
/// recurses.
///
/// A tree is that of a solid only if its boundary is embedded. Of boundaries that are not, it may
/// have lost parts of faces; triangles of which a part has no place are strays, offered always.
/// Value type; its queries are for one thread.
class PlaneTree {
public:
    PlaneTree() = default;
    /// The classic tree, with the triangles of the boundary in the nodes of their planes. A model
    /// with vertices that are not lattice points has the planes of its MspTree instead.
    [[nodiscard]] static PlaneTree classic(const detail::InterferenceModelData& model);
    /// \throw as MspTree::from_brep.
    [[nodiscard]] static PlaneTree multidimensional(const detail::InterferenceModelData& model);

    /// offer(triangle) for those that a polygon, which is within the box, may meet, until it
    /// returns true.
    bool push(const RoughPolygon& polygon, const Box& box, FunctionRef<bool(std::uint32_t)> offer,
              CostCounters& counters);
    /// See Partition.
    void find_near(const Box& box, double limit, FunctionRef<double(std::uint32_t)> offer,
                   CostCounters& counters);
    /// Whether a point known within `error` is certainly inside or outside.
    [[nodiscard]] std::optional<bool> is_inside(const std::array<double, 3>& p, double error,
                                                CostCounters& counters) const;

    /// The largest balls in leaves that are inside, one a leaf, the largest first. Some twenty
    /// microseconds a leaf. \pre the boundary is embedded and within the bounds.
    [[nodiscard]] std::vector<InnerBall> inner_balls(const Box& bounds, std::size_t most) const;
    /// Whether a leaf inside certainly has volume in common with a ball. It may have some that is
    /// not found. One test for each plane that cuts the ball or a part of it.
    [[nodiscard]] bool has_inside(const InnerBall& ball, CostCounters& counters) const;

    [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }
    /// None when the boundary is embedded.
    [[nodiscard]] std::size_t stray_count() const { return strays_.size(); }
    [[nodiscard]] unsigned depth() const;
    [[nodiscard]] std::size_t bytes() const {
        return nodes_.size() * sizeof(Node) + splitters_.size() * sizeof(SplitterBoxes) +
               (first_.size() + lists_.size()) * sizeof(std::uint32_t);
    }

private:
    // An inner node, a leaf, or a list.
    using Ref = std::int32_t;
    static constexpr Ref out = -1;
    static constexpr Ref in = -2;
    static constexpr Ref first_list = -3;
    static constexpr Ref nowhere = std::numeric_limits<Ref>::min();
    /// Cells with more polygons are divided by splitting planes.
    static constexpr std::size_t most_in_cell = 32;

    struct Node {
        std::array<double, 3> normal{};
        double offset = 0;
        Ref below = out;
        Ref on = out;
        Ref above = out;
    };
    // Of the boundary below and above a splitting plane. Splitting planes are the first nodes.
    struct SplitterBoxes {
        Box below;
        Box above;
    };
    struct Values {
        std::array<double, RoughPolygon::most_corners> at{};
        double bound = 0;
        [[nodiscard]] bool all_below(std::uint32_t count) const;
        [[nodiscard]] bool all_above(std::uint32_t count) const;
    };
    struct Task {
        Ref ref = out;
        bool is_flat = false;  // in a node's plane
        RoughPolygon polygon;
    };
    struct BallTask {
        InnerBall ball;
        Ref ref = out;
    };
    // A plane on the way to a region, turned so that the region is below.
    struct Step {
        RoughPlane plane;
        std::uint32_t before = 0;
    };
    struct NearTask {
        double least = 0;
        Ref ref = out;
    };

    [[nodiscard]] static Node node_of(const Plane& plane);
    /// A ball below all planes on a way, the largest if that is found; of radius 0 if none is.
    [[nodiscard]] static InnerBall ball_below(std::span<const Step> steps, std::uint32_t last,
                                              const InnerBall& start);
    /// Adds the nodes of a tree and says where it begins. Of an MspTree, leaves that name a face
    /// refer to the list of its number.
    Ref graft(const BspTree& tree, std::vector<Plane>& planes);
    Ref graft(const MspTree& tree, std::vector<Plane>& planes);
    /// Splitting planes, and a tree of its own for each cell below them. \pre there are no nodes.
    void build_under_splitters(const detail::InterferenceModelData& model,
                               std::vector<Plane>& planes,
                               FunctionRef<Ref(const SplitCells::Cell& cell)> graft_cell);
    [[nodiscard]] static Values values_of(const Node& node, const RoughPolygon& polygon);
    /// The part where sign · value is not above a margin; the whole where it is not worth cutting.
    [[nodiscard]] static RoughPolygon part(const RoughPolygon& polygon, const Values& values,
                                           double sign);
    /// Pushes every triangle down to the nodes of its plane and finds the strays. Where it is not
    /// listed there, it goes on in the tree in the plane, to leaves that name its face.
    void trace_triangles(const detail::InterferenceModelData& model, std::span<const Plane> planes,
                         FunctionRef<bool(Ref node, std::uint32_t triangle)> is_listed_at);
    void list_triangles(const detail::InterferenceModelData& model, std::span<const Plane> planes);
    [[nodiscard]] std::span<const std::uint32_t> list(Ref ref) const {
        const auto l = static_cast<std::size_t>(first_list - ref);
        return std::span(lists_).subspan(first_[l], first_[l + 1] - first_[l]);
    }

    std::vector<Node> nodes_;
    std::vector<SplitterBoxes> splitters_;
    Ref root_ = out;
    std::vector<std::uint32_t> first_;  // of lists: by node, or by face
    std::vector<std::uint32_t> lists_;
    std::vector<std::uint32_t> strays_;
    std::vector<Task> tasks_;  // scratch
    std::vector<NearTask> near_tasks_;
};

}  // namespace trisect::hierarchies
