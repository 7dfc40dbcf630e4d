// SPDX-License-Identifier: Apache-2.0
//
// The trees of the modeller as structures for interference: B's triangles are pushed down A's tree,
// cut at its planes, and meet the triangles of A on the planes that they touch. In the classic tree
// of Thibault and Naylor a plane has a list of them; in Vanecek's tree, the Brep-Index, a tree in
// the plane says which face is there.
//
// No other structure here has inside and outside. So deep penetration is seen without one pair of
// triangles, the early accept of the Brep-Index, in two ways.
//  - Tree against tree, as trees are merged (Naylor, Amanatides and Thibault 1990): a leaf of B
//    that is inside goes down A's tree, cut by its planes, until a part of it is in a leaf of A
//    that is inside too. A leaf is a ball in it, so that B's tree need not be moved. With a vertex
//    of each solid outside of the other one, the solids overlap. B's triangles stay where they are.
//  - Points against A's tree: one vertex of B certainly inside of A and another one certainly
//    outside. Some vertices from all over B are tried, not all: where these say nothing, pairs of
//    triangles do.
//
// The distance is a side line: splitting planes have boxes of what is beyond them, but of the
// regions below only the planes on the way bound how near they can be.
//
// Source: W. Thibault and B. Naylor, Set operations on polyhedra using binary space partitioning
// trees (SIGGRAPH 1987); B. Naylor, J. Amanatides and W. Thibault, Merging BSP trees yields
// polyhedral set operations (SIGGRAPH 1990); G. Vanecek, Brep-Index (IJCGA 1(3), 1991); W. Bouma
// and G. Vanecek, Collision detection and analysis in a physically based simulation (Eurographics
// Workshop on Animation and Simulation, 1991).

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <trisect/bsp/hierarchies/partitions/partition.h>
#include <trisect/bsp/hierarchies/partitions/partitions.h>
#include <trisect/bsp/hierarchies/partitions/plane_tree.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::hierarchies {

using detail::Vector3;

namespace {

// The vertices that are farthest along the axes and diagonals.
std::vector<Vector3> extremes_of(const detail::InterferenceModelData& model) {
    std::vector<Vector3> r;
    for (int code = 0; code < 27; ++code) {
        const Vector3 along{code % 3 - 1.0, code / 3 % 3 - 1.0, code / 9 - 1.0};
        const auto reach = [&along](const Vector3& p) {
            return along[0] * p[0] + along[1] * p[1] + along[2] * p[2];
        };
        r.push_back(*std::ranges::max_element(model.positions, {}, reach));
    }
    std::ranges::sort(r);
    r.erase(std::unique(r.begin(), r.end()), r.end());
    return r;
}

// What is known of one solid, where it was modelled.
struct SolidTree {
    PlaneTree tree;
    std::vector<InnerBall> balls;  // of leaves inside
    std::vector<Vector3> extremes;
    Box bounds;

    SolidTree(PlaneTree made, const detail::InterferenceModelData& model)
        : tree(std::move(made)), extremes(extremes_of(model)), bounds{model.lo, model.hi} {
        if (tree.stray_count() == 0) balls = tree.inner_balls(bounds, most_balls);
    }
    [[nodiscard]] std::size_t bytes() const {
        return tree.bytes() + balls.size() * sizeof(InnerBall) +
               extremes.size() * sizeof(extremes[0]);
    }

    static constexpr std::size_t most_balls = 64;
};

class PlaneTreePartition final : public Partition {
public:
    using Make = PlaneTree (*)(const detail::InterferenceModelData&);

    PlaneTreePartition(std::string_view name, Make make, const InterferenceModel& a,
                       const InterferenceModel& b)
        : Partition(a, b), name_(name) {
        const auto start = std::chrono::steady_clock::now();
        a_.emplace(make(data_a()), data_a());
        if (&data_a() == &data_b())
            b_ = a_;
        else
            b_.emplace(make(data_b()), data_b());
        seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    std::string_view name() const override { return name_; }
    BuildReport build_report() const override {
        return {seconds_, a_->bytes() + b_->bytes() + common_bytes(),
                a_->tree.node_count() + b_->tree.node_count(),
                std::max(a_->tree.depth(), b_->tree.depth())};
    }

protected:
    // Triangles wait until trees alone do not do.
    void update(CostCounters&) override { is_moved_ = false; }

    bool find_candidates(PairVisit visit, CostCounters& counters) override {
        move_triangles(counters);
        return Partition::find_candidates(visit, counters);
    }
    void find_near(double limit, NearVisit visit, CostCounters& counters) override {
        move_triangles(counters);
        Partition::find_near(limit, visit, counters);
    }
    bool find_for(std::uint32_t b, FunctionRef<bool(std::uint32_t)> offer,
                  CostCounters& counters) override {
        return a_->tree.push(polygon(b), moved()[b], offer, counters);
    }
    bool find_in_cells(const Box&, FunctionRef<bool(std::uint32_t)>, CostCounters&) override {
        return false;  // find_for has the triangle
    }
    void find_near_cells(const Box& box, double limit, FunctionRef<double(std::uint32_t)> offer,
                         CostCounters& counters) override {
        a_->tree.find_near(box, limit, offer, counters);
    }

    std::optional<Relation> find_early_relation(CostCounters& counters) override {
        // Of a boundary that is not embedded, the tree's inside means nothing.
        if (a_->tree.stray_count() != 0) return std::nullopt;
        if (!box_meets(counters)) return std::nullopt;
        if ((b_->tree.stray_count() == 0 && leaves_overlap(counters)) || vertices_overlap(counters))
            return Relation::Overlapping;
        return std::nullopt;
    }

private:
    static constexpr std::size_t most_vertices = 64;

    // Whether B's box, turned, may meet A's.
    bool box_meets(CostCounters& counters) const {
        ++counters.volume_tests;
        const detail::ApproximateMap& to_a = placement().to_a;
        const double error =
            to_a.error_below(data_b().largest, data_b().position_error) + data_a().position_error;
        Vector3 middle{};
        for (std::size_t k = 0; k < 3; ++k) middle[k] = 0.5 * data_b().lo[k] + 0.5 * data_b().hi[k];
        const Vector3 center = to_a(middle);
        bool meets = true;
        for (std::size_t i = 0; i < 3; ++i) {
            double reach = 2 * error;
            for (std::size_t k = 0; k < 3; ++k)
                reach += std::abs(to_a.m[i][k]) * 0.5 * (data_b().hi[k] - data_b().lo[k]);
            reach *= 1 + 0x1p-40;
            meets = meets && center[i] - reach <= a_->bounds.hi[i] &&
                    center[i] + reach >= a_->bounds.lo[i];
        }
        return meets;
    }

    // Two leaves that are inside have volume in common, and each solid has a point that is outside
    // of the other. Neither triangles nor all vertices are looked at.
    bool leaves_overlap(CostCounters& counters) const {
        const detail::ApproximateMap& to_a = placement().to_a;
        const double stretch = least_stretch(to_a);
        if (!(stretch > 0)) return false;
        const bool have_common_volume = std::ranges::any_of(b_->balls, [&](const InnerBall& ball) {
            double largest = 0;
            for (const double x : ball.center) largest = std::max(largest, std::abs(x));
            InnerBall moved{to_a(ball.center), 0};
            // An error of a component moves the centre by less than twice that.
            moved.radius = ball.radius * stretch - 2 * to_a.error_below(largest, 0);
            ++counters.volume_tests;
            return moved.radius > 0 && is_near(moved, a_->bounds) &&
                   a_->tree.has_inside(moved, counters);
        });
        if (!have_common_volume) return false;
        const detail::ApproximateMap to_b =
            detail::approximate_map(pose_b(), model_b().lattice(), pose_a(), model_a().lattice());
        return to_b.is_usable() && reaches_out(*b_, data_b(), to_a, a_->tree, counters) &&
               reaches_out(*a_, data_a(), to_b, b_->tree, counters);
    }

    static bool is_near(const InnerBall& ball, const Box& box) {
        bool near = true;
        for (std::size_t k = 0; k < 3; ++k)
            near = near && ball.center[k] + ball.radius >= box.lo[k] &&
                   ball.center[k] - ball.radius <= box.hi[k];
        return near;
    }

    static bool reaches_out(const SolidTree& side, const detail::InterferenceModelData& model,
                            const detail::ApproximateMap& map, const PlaneTree& other,
                            CostCounters& counters) {
        const double error = map.error_below(model.largest, model.position_error);
        return std::ranges::any_of(side.extremes, [&](const Vector3& p) {
            return !other.is_inside(map(p), error, counters).value_or(true);
        });
    }

    // A few vertices of B, from all over it.
    bool vertices_overlap(CostCounters& counters) const {
        const auto& positions = data_b().positions;
        const detail::ApproximateMap& to_a = placement().to_a;
        const double error = to_a.error_below(data_b().largest, data_b().position_error);
        bool inside = false;
        bool outside = false;
        const std::size_t step = std::max<std::size_t>(1, positions.size() / most_vertices);
        for (std::size_t v = 0; v < positions.size() && !(inside && outside); v += step) {
            const auto where = a_->tree.is_inside(to_a(positions[v]), error, counters);
            if (where) (*where ? inside : outside) = true;
        }
        return inside && outside;
    }

    void move_triangles(CostCounters& counters) {
        if (!is_moved_) Partition::update(counters);
        is_moved_ = true;
    }

    [[nodiscard]] RoughPolygon polygon(std::uint32_t b) const {
        const auto& v = data_b().triangles[b].vertex;
        return RoughPolygon::triangle(moved().corner(v[0].index), moved().corner(v[1].index),
                                      moved().corner(v[2].index), moved().error());
    }

    std::string_view name_;
    std::optional<SolidTree> a_;
    std::optional<SolidTree> b_;
    bool is_moved_ = false;
    double seconds_ = 0;
};

}  // namespace

std::unique_ptr<PairStructure> make_bsp_partition(const InterferenceModel& a,
                                                  const InterferenceModel& b) {
    return std::make_unique<PlaneTreePartition>("bsp", PlaneTree::classic, a, b);
}

std::unique_ptr<PairStructure> make_msp_partition(const InterferenceModel& a,
                                                  const InterferenceModel& b) {
    return std::make_unique<PlaneTreePartition>("msp", PlaneTree::multidimensional, a, b);
}

}  // namespace trisect::hierarchies
