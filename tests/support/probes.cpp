// SPDX-License-Identifier: Apache-2.0

#include "probes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <trisect/kernel/predicates.h>

#include "entity_oracle.h"

namespace trisect::test {

namespace {

class Prober {
public:
    Prober(const Brep& brep, std::mt19937& random) : brep_(brep), random_(random) {
        for (const Point& p : brep.points()) {
            for (std::size_t k = 0; k < 3; ++k) {
                lo_[k] = std::min(lo_[k], std::floor(p.approximation().c[k]));
                hi_[k] = std::max(hi_[k], std::ceil(p.approximation().c[k]));
            }
        }
    }

    std::optional<Point> next() {
        switch (below(8)) {
            case 0:
                return brep_.point(
                    VertexId(static_cast<std::size_t>(below(brep_.vertices().size()))));
            case 1:
                return on_edge();
            case 2:
            case 3:
                return meet(plane_of_face(), plane_of_face(), plane_of_face());
            case 4:
                return meet(plane_of_face(), plane_of_face(), plane_across(below(3)));
            case 5: {
                const int axis = below(3);
                return meet(plane_of_face(), plane_across(axis), plane_across((axis + 1) % 3));
            }
            default:
                return Point(LatticePoint{coordinate(0), coordinate(1), coordinate(2)});
        }
    }

private:
    template <class N>
    int below(N n) {
        return static_cast<int>(random_() % static_cast<std::uint32_t>(n));
    }
    const Plane& plane_of_face() { return brep_.plane(FaceId(idx(below(brep_.faces().size())))); }
    static std::size_t idx(int i) { return static_cast<std::size_t>(i); }

    std::int64_t coordinate(int axis) {
        const auto lo = static_cast<std::int64_t>(lo_[idx(axis)]) - 1;
        const auto hi = static_cast<std::int64_t>(hi_[idx(axis)]) + 1;
        return lo + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(hi - lo + 1));
    }
    Plane plane_across(int axis) {
        const std::int64_t parts = std::int64_t{1} << below(4);
        return Plane::axis_aligned(axis, parts, coordinate(axis) * parts + below(parts));
    }
    static std::optional<Point> meet(const Plane& p, const Plane& q, const Plane& r) {
        if (!meet_in_a_point(p, q, r)) return std::nullopt;
        return Point(p, q, r);
    }
    std::optional<Point> on_edge() {
        const HalfedgeId h = brep_.halfedge(EdgeId(idx(below(brep_.edges().size()))));
        return meet(brep_.plane(brep_.face(h)), brep_.plane(brep_.face(brep_.twin(h))),
                    plane_across(below(3)));
    }

    const Brep& brep_;
    std::mt19937& random_;
    std::array<double, 3> lo_{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    std::array<double, 3> hi_{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
};

}  // namespace

std::vector<Point> probes(const Brep& brep, std::size_t count, std::mt19937& random) {
    Prober prober(brep, random);
    std::vector<Point> points;
    while (points.size() < count)
        if (auto p = prober.next()) points.push_back(std::move(*p));
    return points;
}

std::string to_string(MspTree::Ref leaf) {
    constexpr std::array<const char*, 5> kinds{"outside", "inside", "face ", "edge ", "vertex "};
    std::string name = kinds[static_cast<std::size_t>(leaf.kind())];
    if (leaf.kind() > MspTree::Leaf::In) name += std::to_string(leaf.entity());
    return name;
}

std::vector<Probe> answered_probes(const Brep& brep, std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    const EntityOracle oracle(brep);
    std::vector<Probe> answered;
    for (Point& p : probes(brep, count, random)) {
        const MspTree::Ref expected = oracle.locate(rational(p));
        answered.push_back({std::move(p), expected});
    }
    return answered;
}

std::string first_difference(const MspTree& tree, const std::vector<Probe>& probes) {
    for (const auto& [point, expected] : probes) {
        const MspTree::Ref found = tree.locate(point);
        if (found == expected) continue;
        const auto exact = rational(point);
        return "(" + exact[0].get_str() + ", " + exact[1].get_str() + ", " + exact[2].get_str() +
               ") is located as " + to_string(found) + " instead of " + to_string(expected);
    }
    return {};
}

}  // namespace trisect::test
