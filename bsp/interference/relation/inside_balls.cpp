// SPDX-License-Identifier: Apache-2.0
//
// Two solids that overlap deeply have crossing faces, but a walk that looks for them goes down to
// triangles first. A point that is in the interiors of both proves the same: with it, and a point
// of each outside the other, the relation is Overlapping. Balls inside the solids give such points
// in a few operations. When one solid is within a ball inside the other one, no face is anywhere
// near.
//
// Where balls come from. On a grid of points in the bounds a lower bound on the distance from the
// boundary is found by the tree of boxes; a few steps away from the nearest box enlarge it. Points
// are taken, the largest distance first, unless an earlier ball holds them; whether they are inside
// is located exactly. Shallow overlaps are between smaller balls, which touch the boundary in every
// region of it: of a few triangles there the one under the largest ball is taken.
//
// A point at a float distance: with reach r of the boxes rounding p costs u |p|, the difference to
// a centre u (|p| + r), the product with an axis 3 u (|p| + r), halves are exact. So a slab's
// distance is off by less than 2^-20 (|p| + r), and the axes' lengths by 2^-22; the distance from
// the box is at least the length of the three excesses, each less that, times 1 - 2^-20.

#include <trisect/bsp/interference/relation/inside_balls.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

struct BoundaryDistance {
    double lower = 0;  // in units of the tree
    ObbId nearest;
};

// Lower bounds of the distance of four boxes from a point, in the tree's units about its origin.
Float4 distances_from_boxes(const ObbNode& n, const Vector3& p, float margin) {
    std::array<Float4, 3> d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = all_lanes(static_cast<float>(p[k])) - n.center[k];
    Float4 squares = all_lanes(0);
    for (std::size_t i = 0; i < 3; ++i) {
        const Float4 along = (n.axis[i][0] * d[0] + n.axis[i][1] * d[1]) + n.axis[i][2] * d[2];
        const Float4 excess =
            larger(magnitude(along) - (n.half[i] + all_lanes(margin)), all_lanes(0));
        squares += excess * excess;
    }
    return square_root(squares) * all_lanes(1 - 0x1p-19F);
}

float margin_at(const ObbTree& tree, const Vector3& p) {
    return static_cast<float>(0x1p-19 * (length(p) + tree.reach));
}

// How far every box at a leaf is at least from a point.
BoundaryDistance distance_from_boundary(const ObbTree& tree, const Vector3& p) {
    const float margin = margin_at(tree, p);
    BoundaryDistance best{std::numeric_limits<double>::infinity(), {}};
    std::vector<std::pair<float, std::uint32_t>> stack{{0.0F, 0}};
    while (!stack.empty()) {
        const auto [bound, node] = stack.back();
        stack.pop_back();
        if (static_cast<double>(bound) >= best.lower) continue;
        const ObbNode& n = tree.nodes[node];
        const Float4 far = distances_from_boxes(n, p, margin);
        std::array<std::uint32_t, 4> order{0, 1, 2, 3};
        std::ranges::sort(order, [&far](auto i, auto j) { return far[i] > far[j]; });
        for (const std::uint32_t k : order) {
            if (!(n.half[0][k] >= 0)) continue;
            if (!n.child[k].is_leaf())
                stack.emplace_back(far[k], n.child[k].node());
            else if (static_cast<double>(far[k]) < best.lower)
                best = {static_cast<double>(far[k]), ObbId::of(node, k)};
        }
    }
    return best;
}

// The same up to a limit and with few nodes: inside a tube all boxes around are equally far. The
// nearest box first; where it ends the bound is that of a box which has not been opened.
BoundaryDistance quick_distance_from_boundary(const ObbTree& tree, const Vector3& p, double limit) {
    constexpr int most_nodes = 24;
    const float margin = margin_at(tree, p);
    struct Open {
        float bound;
        ObbId box;
        bool operator<(const Open& other) const { return bound > other.bound; }
    };
    std::array<Open, 4 * most_nodes + 1> heap{};
    std::size_t size = 0;
    BoundaryDistance best{limit, {}};
    const auto open_node = [&](std::uint32_t node) {
        const ObbNode& n = tree.nodes[node];
        const Float4 far = distances_from_boxes(n, p, margin);
        for (std::uint32_t k = 0; k < 4; ++k) {
            if (!(n.half[0][k] >= 0) || !(static_cast<double>(far[k]) < best.lower)) continue;
            if (n.child[k].is_leaf()) {
                best = {static_cast<double>(far[k]), ObbId::of(node, k)};
            } else {
                heap[size++] = {far[k], ObbId::of(node, k)};
                std::push_heap(heap.begin(), heap.begin() + static_cast<std::ptrdiff_t>(size));
            }
        }
    };
    open_node(0);
    for (int opened = 1; size > 0; ++opened) {
        const Open next = heap.front();
        if (!(static_cast<double>(next.bound) < best.lower)) break;
        if (opened == most_nodes) return {static_cast<double>(next.bound), next.box};
        std::pop_heap(heap.begin(), heap.begin() + static_cast<std::ptrdiff_t>(size--));
        open_node(tree.child(next.box).node());
    }
    return best;
}

struct Candidate {
    Vector3 p{};  // in the tree's units
    double distance = 0;
};

Candidate climbed(const ObbTree& tree, Candidate c) {
    for (double step = 0.5; step > 0.1; step *= 0.7) {
        const BoundaryDistance d = distance_from_boundary(tree, c.p);
        const OrientedBox box = tree.box(d.nearest);
        Vector3 away{};
        for (std::size_t k = 0; k < 3; ++k) away[k] = c.p[k] - static_cast<double>(box.center[k]);
        const double size = length(away);
        if (!(size > 0)) break;
        Candidate next = c;
        for (std::size_t k = 0; k < 3; ++k) next.p[k] += step * c.distance * away[k] / size;
        next.distance = distance_from_boundary(tree, next.p).lower;
        if (next.distance > c.distance) c = next;
    }
    return c;
}

std::vector<Candidate> candidates_of(const InterferenceModelData& model) {
    constexpr int steps = 10;
    const ObbTree& tree = model.boxes;
    std::vector<Candidate> all;
    for (int x = 0; x < steps; ++x)
        for (int y = 0; y < steps; ++y)
            for (int z = 0; z < steps; ++z) {
                Candidate c;
                const std::array<int, 3> at{x, y, z};
                for (std::size_t k = 0; k < 3; ++k)
                    c.p[k] = (model.lo[k] + (at[k] + 0.5) / steps * (model.hi[k] - model.lo[k]) -
                              tree.origin[k]) /
                             tree.unit;
                c.distance = distance_from_boundary(tree, c.p).lower;
                all.push_back(c);
            }
    std::ranges::sort(all, [](const auto& a, const auto& b) { return a.distance > b.distance; });
    return all;
}

// Whether M is a rotation times a number, up to 2^-25, and the number.
std::optional<double> similarity(const ApproximateMap& map) {
    std::array<Vector3, 3> gram{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) gram[i][j] += map.m[k][i] * map.m[k][j];
    const double square = (gram[0][0] + gram[1][1] + gram[2][2]) / 3;
    double off = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            off = std::max(off, std::abs(gram[i][j] - (i == j ? square : 0)));
    const double scale = std::sqrt(square);
    if (!(off <= 0x1p-25 * square) || !(map.m_error <= 0x1p-28 * scale)) return std::nullopt;
    return scale;
}

// Images of lengths are within this factor of the scale: 3 · 2^-25 of its square and 3 · 2^-28 of
// itself.
constexpr double ball_slack = 0x1p-22;

// By how much at least a point of A is outside the box around the image of B's bounds; not positive
// when none may be. A's bounds are exact or outward by twice the error of positions and two
// roundings.
double sticks_out(const Boundary& a, const Boundary& b, const ApproximateMap& to_a, double error) {
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double middle = to_a.t[i];
        double half = 0;
        double size = std::abs(to_a.t[i]);
        for (std::size_t j = 0; j < 3; ++j) {
            middle += to_a.m[i][j] * (0.5 * (b.lo[j] + b.hi[j]));
            half += (std::abs(to_a.m[i][j]) + to_a.m_error) * (0.5 * (b.hi[j] - b.lo[j]));
            size += std::abs(to_a.m[i][j]) * b.largest;
        }
        const double reach =
            half + error + 0x1p-48 * (size + half + a.largest) + 3 * a.position_error;
        most = std::max({most, a.hi[i] - (middle + reach), (middle - reach) - a.lo[i]});
    }
    return most;
}

// By how much at least one of the farthest points of B is outside the bounds of A.
double has_point_outside(const InsideBalls& b, const Boundary& a, const ApproximateMap& to_a,
                         double error) {
    double most = 0;
    for (const Vector3& p : b.extremes()) {
        const Vector3 x = to_a(p);
        for (std::size_t k = 0; k < 3; ++k)
            most = std::max({most, (x[k] - error) - a.hi[k], a.lo[k] - (x[k] + error)});
    }
    return most;
}

double distance(const Vector3& p, const Vector3& q) { return length(minus(p, q)); }

}  // namespace

namespace {

// By how much two balls reach into each other, at most by a radius; not positive when they do not.
double depth_of(double radius, double other, double distance) {
    return std::min({radius + other - distance, radius, other});
}

// Balls inside both have common points. When each solid has a point that is not in the other one
// they overlap, and do so until something has moved by as much as they stick out.
std::optional<Relation> overlap_if_both_stick_out(const Boundary& a, const Boundary& b,
                                                  const InsideBalls& balls_b,
                                                  const ApproximateMap& to_a, double depth,
                                                  double* reserve) {
    const double error = to_a.error_below(b.largest, b.position_error);
    const double of_a = sticks_out(a, b, to_a, error);
    if (!(of_a > 0)) return std::nullopt;
    const double of_b = has_point_outside(balls_b, a, to_a, error);
    if (!(of_b > 0)) return std::nullopt;
    if (reserve != nullptr) *reserve = std::min({depth, of_a, of_b});
    return Relation::Overlapping;
}

bool is_certainly_inside(const InterferenceModelData& model, Vector3 p) {
    for (double& c : p) c = std::ldexp(c, model.brep.lattice().exponent);
    return model.model.index().locate(p).location == Location::Inside;
}

Vector3 in_tree(const ObbTree& tree, const Vector3& p) {
    Vector3 r{};
    for (std::size_t k = 0; k < 3; ++k) r[k] = (p[k] - tree.origin[k]) / tree.unit;
    return r;
}

// A ball around a point, given a bound on the distance of its rounded place in the tree from the
// boundary; none when it is not inside.
std::optional<InsideBall> certified_ball(const InterferenceModelData& model, const Vector3& center,
                                         double distance_in_tree) {
    const ObbTree& tree = model.boxes;
    const double radius = distance_in_tree - 0x1p-50 * (model.largest / tree.unit + 1);
    if (!(radius > 0) || !is_certainly_inside(model, center)) return std::nullopt;
    return InsideBall{center, tree.unit * radius * slightly_less};
}

}  // namespace

InsideBalls::InsideBalls(const InterferenceModelData& model) {
    quick_radius_.fill(all_lanes(-std::numeric_limits<float>::infinity()));
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [lo, hi] = std::ranges::minmax_element(model.positions, {},
                                                          [k](const Vector3& p) { return p[k]; });
        extremes_[2 * k] = *lo;
        extremes_[2 * k + 1] = *hi;
    }
    find_large_ones(model);
    find_along_boundary(model);
}

void InsideBalls::find_large_ones(const InterferenceModelData& model) {
    const ObbTree& tree = model.boxes;
    const auto place = [&tree](const Candidate& c) {
        Vector3 x{};
        for (std::size_t k = 0; k < 3; ++k) x[k] = tree.origin[k] + tree.unit * c.p[k];
        return x;
    };
    const auto is_held = [this](const Vector3& p, double part) {
        for (std::size_t i = 0; i < size_; ++i)
            if (distance(p, center_[i]) < part * radius_[i]) return true;
        return false;
    };
    for (const Candidate& start : candidates_of(model)) {
        if (size_ == most || !(start.distance > 0)) break;
        if (is_held(place(start), 0.8) || !is_certainly_inside(model, place(start))) continue;
        const Vector3 center = place(climbed(tree, start));
        if (is_held(center, 0.5)) continue;
        const double far = distance_from_boundary(tree, in_tree(tree, center)).lower;
        if (const auto ball = certified_ball(model, center, far)) add(ball->center, ball->radius);
    }
}

void InsideBalls::find_along_boundary(const InterferenceModelData& model) {
    constexpr std::uint32_t regions = 1024;
    constexpr std::uint32_t tries = 3;
    const auto count = static_cast<std::uint32_t>(model.boxes.order.size());
    region_ = (count + regions - 1) / regions;
    for (std::uint32_t begin = 0; begin < count; begin += region_) {
        const std::uint32_t size = std::min(region_, count - begin);
        InsideBall largest;
        for (std::uint32_t i = 0; i < std::min(tries, size); ++i) {
            const std::uint32_t place = begin + (2 * i + 1) * size / (2 * std::min(tries, size));
            const auto ball = touching_ball(model, model.boxes.order[place]);
            if (ball && ball->radius > largest.radius) largest = *ball;
        }
        along_boundary_.push_back(largest);
    }
}

void InsideBalls::add(const Vector3& center, double radius) {
    center_[size_] = center;
    radius_[size_] = radius;
    const std::size_t group = size_ / 4;
    const std::size_t lane = size_ % 4;
    for (std::size_t k = 0; k < 3; ++k)
        quick_center_[group][k][lane] = static_cast<float>(center[k]);
    quick_radius_[group][lane] = static_cast<float>(radius);
    ++size_;
}

std::optional<Relation> relation_by_balls(const Boundary& a, const InsideBalls& balls_a,
                                          const Boundary& b, const InsideBalls& balls_b,
                                          const ApproximateMap& to_a, double* reserve) {
    const std::optional<double> scale = similarity(to_a);
    if (!scale) return std::nullopt;
    // Of a moved point, as a distance.
    const double error = to_a.error_below(b.largest, b.position_error);
    const double way_error = 2 * error + 0x1p-48 * a.largest;
    const auto whole = [](const Boundary& m) {
        return bound_slack * (m.boxes.radius * m.boxes.unit);
    };
    const Vector3 middle_of_b = to_a(b.boxes.origin);
    const double radius_of_b = *scale * (1 + ball_slack) * whole(b);
    for (std::size_t i = 0; i < balls_a.size_; ++i) {
        if (!(radius_of_b < balls_a.radius_[i])) continue;
        const double left =
            balls_a.radius_[i] -
            (bound_slack * distance(middle_of_b, balls_a.center_[i]) + radius_of_b + way_error);
        if (!(left > 0)) continue;
        if (reserve != nullptr) *reserve = left;
        return Relation::Contains;
    }
    double deepest = 0;
    for (std::size_t j = 0; j < balls_b.size_; ++j) {
        const Vector3 center = to_a(balls_b.center_[j]);
        const double radius = *scale * (1 - ball_slack) * balls_b.radius_[j];
        if (const double left =
                radius - (bound_slack * (distance(center, a.boxes.origin) + whole(a)) + way_error);
            left > 0) {
            if (reserve != nullptr) *reserve = left;
            return Relation::Inside;
        }
        const std::array<Float4, 3> c{all_lanes(static_cast<float>(center[0])),
                                      all_lanes(static_cast<float>(center[1])),
                                      all_lanes(static_cast<float>(center[2]))};
        const Float4 r = all_lanes(static_cast<float>(radius));
        for (std::size_t g = 0; 4 * g < balls_a.size_; ++g) {
            Float4 squares = all_lanes(0);
            for (std::size_t k = 0; k < 3; ++k) {
                const Float4 d = c[k] - balls_a.quick_center_[g][k];
                squares += d * d;
            }
            const Float4 sum = larger(r + balls_a.quick_radius_[g], all_lanes(0));
            unsigned hits = bits_of(squares < sum * sum);
            for (std::size_t lane = 0; hits != 0; ++lane, hits >>= 1U) {
                if ((hits & 1U) == 0) continue;
                const std::size_t i = 4 * g + lane;
                deepest = std::max(
                    deepest,
                    depth_of(radius, balls_a.radius_[i],
                             bound_slack * distance(center, balls_a.center_[i]) + way_error));
                // For the answer alone any will do.
                if (deepest > 0 && reserve == nullptr)
                    return overlap_if_both_stick_out(a, b, balls_b, to_a, deepest, reserve);
            }
        }
    }
    if (!(deepest > 0)) return std::nullopt;
    return overlap_if_both_stick_out(a, b, balls_b, to_a, deepest, reserve);
}

std::optional<Relation> relation_by_ball_pair(const Boundary& a, const InsideBall& in_a,
                                              const Boundary& b, const InsideBalls& balls_b,
                                              const InsideBall& in_b, const ApproximateMap& to_a,
                                              double* reserve) {
    const std::optional<double> scale = similarity(to_a);
    if (!scale) return std::nullopt;
    const double error = to_a.error_below(b.largest, b.position_error);
    const double depth = depth_of(
        *scale * (1 - ball_slack) * in_b.radius, in_a.radius,
        bound_slack * distance(to_a(in_b.center), in_a.center) + 2 * error + 0x1p-48 * a.largest);
    if (!(depth > 0)) return std::nullopt;
    return overlap_if_both_stick_out(a, b, balls_b, to_a, depth, reserve);
}

namespace {

// Four balls side by side, in floats. What is no ball reaches nothing.
struct BallQuad {
    std::array<Float4, 3> center{};
    Float4 radius = all_lanes(-std::numeric_limits<float>::infinity());

    // At most four.
    explicit BallQuad(std::span<const InsideBall> balls) {
        for (std::size_t i = 0; i < balls.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k)
                center[k][i] = static_cast<float>(balls[i].center[k]);
            if (balls[i].radius > 0) radius[i] = static_cast<float>(balls[i].radius);
        }
    }
};

}  // namespace

// Floats find pairs that may be deeper than the deepest so far, four at a time and without a root.
std::optional<std::pair<std::size_t, std::size_t>> deepest_pair(std::span<const InsideBall> of_a,
                                                                std::span<const InsideBall> of_b,
                                                                const ApproximateMap& to_a) {
    const double scale = length(Vector3{to_a.m[0][0], to_a.m[1][0], to_a.m[2][0]});
    std::vector<BallQuad> quads;
    quads.reserve((of_a.size() + 3) / 4);
    for (std::size_t i = 0; i < of_a.size(); i += 4)
        quads.emplace_back(of_a.subspan(i, std::min<std::size_t>(4, of_a.size() - i)));
    std::optional<std::pair<std::size_t, std::size_t>> deepest;
    double depth = 0;
    for (std::size_t j = 0; j < of_b.size(); ++j) {
        if (!(of_b[j].radius > 0)) continue;
        const Vector3 center = to_a(of_b[j].center);
        const double radius = scale * of_b[j].radius;
        const std::array<Float4, 3> c{all_lanes(static_cast<float>(center[0])),
                                      all_lanes(static_cast<float>(center[1])),
                                      all_lanes(static_cast<float>(center[2]))};
        for (std::size_t q = 0; q < quads.size(); ++q) {
            Float4 squares = all_lanes(0);
            for (std::size_t k = 0; k < 3; ++k) {
                const Float4 d = c[k] - quads[q].center[k];
                squares += d * d;
            }
            const Float4 reach = larger(
                quads[q].radius + all_lanes(static_cast<float>(radius - depth)), all_lanes(0));
            for (unsigned hits = bits_of(squares < reach * reach); hits != 0; hits &= hits - 1) {
                const std::size_t i = 4 * q + static_cast<std::size_t>(std::countr_zero(hits));
                const double d = radius + of_a[i].radius - length(minus(center, of_a[i].center));
                if (!(d > depth)) continue;
                depth = d;
                deepest.emplace(i, j);
            }
        }
    }
    return deepest;
}

std::optional<InsideBall> touching_ball(const InterferenceModelData& model,
                                        std::uint32_t triangle) {
    const ObbTree& tree = model.boxes;
    std::array<Vector3, 3> corner{};
    Vector3 foot{};
    for (std::size_t i = 0; i < 3; ++i) {
        corner[i] = in_tree(tree, model.position(model.triangles[triangle].vertex[i]));
        for (std::size_t k = 0; k < 3; ++k) foot[k] += corner[i][k] / 3;
    }
    Vector3 inward = cross(minus(corner[2], corner[0]), minus(corner[1], corner[0]));
    const double size = length(inward);
    if (!(size > 0)) return std::nullopt;
    for (double& c : inward) c /= size;
    // From a ball that is too large: through the nearest box each time, while that shrinks it.
    double radius = 0.15 * tree.radius;
    for (int round = 0; round < 6; ++round) {
        Vector3 center{};
        for (std::size_t k = 0; k < 3; ++k)
            center[k] = tree.origin[k] + tree.unit * (foot[k] + radius * inward[k]);
        const BoundaryDistance d =
            quick_distance_from_boundary(tree, in_tree(tree, center), radius);
        if (d.lower > 0.93 * radius) return certified_ball(model, center, d.lower);
        const OrientedBox box = tree.box(d.nearest);
        Vector3 way{};
        for (std::size_t k = 0; k < 3; ++k) way[k] = static_cast<double>(box.center[k]) - foot[k];
        const double along = dot(way, inward);
        const double through = along > 0 ? dot(way, way) / (2 * along) : 0;
        radius = std::clamp(through, 0.3 * radius, 0.93 * radius);
    }
    return std::nullopt;
}

}  // namespace trisect::detail
