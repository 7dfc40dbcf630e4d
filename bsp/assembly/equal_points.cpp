// SPDX-License-Identifier: Apache-2.0
//
// Points whose certified doubles are close (near_points.h) are compared exactly.

#include <trisect/bsp/assembly/equal_points.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include <trisect/bsp/assembly/parts/named_edges.h>
#include <trisect/bsp/cells/near_points.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

class EqualPoints {
public:
    EqualPoints(BoundaryParts& parts, std::uint64_t serial) : parts_(parts), serial_(serial) {}

    [[nodiscard]] PoolVector<PointId> find(std::uint32_t threads) {
        // Few groups need the same planes as others.
        constexpr std::size_t many_planes = 8192;
        Workbench& bench = parts_.bench;
        same_ = points_as_named(parts_);
        const auto rank = [&](PointId p) {
            if (!bench.is_corner(p)) return 0;
            return bench.corner_name(p).first->serial() == serial_ ? 2 : 1;
        };
        const auto better = [&](PointId a, PointId b) {
            return rank(a) != rank(b) ? rank(a) > rank(b) : a < b;
        };
        PoolVector<PointId> values;
        const auto compare = [&](std::span<const PointId> group) {
            // Against one of each value: what is equal to it needs no comparison of its own.
            values.clear();
            through_.clear();
            if (bench.made_plane_count() > many_planes) bench.forget_made_planes();
            for (const PointId p : group) {
                const auto value = std::ranges::find_if(
                    values, [&](PointId v) { return bench.may_be_same(v, p) && is_same(v, p); });
                if (value == values.end()) {
                    values.push_back(p);
                    add_planes_through(p);
                    continue;
                }
                const PointId kept = same_[as_index(*value)];
                same_[as_index(p)] = kept;
                if (better(p, kept))
                    same_[as_index(kept)] = same_[as_index(*value)] = same_[as_index(p)] = p;
            }
        };
        for_each_near_group(bench, compare, threads);
        for (PointId& p : same_)
            while (same_[as_index(p)] != p) p = same_[as_index(p)];
        return std::move(same_);
    }

private:
    void add_planes_through(PointId value) {
        const Workbench& bench = parts_.bench;
        if (bench.is_corner(value)) return;
        for (const PlaneId p : bench.planes_of(value))
            through_.emplace_back(value, bench.plane_class(p));
    }

    // Where several planes have a point in common any three of them name it. Once a plane is found
    // to contain the point other names that it occurs in cost no arithmetic.
    [[nodiscard]] bool is_same(PointId value, PointId name) {
        const Workbench& bench = parts_.bench;
        if (bench.is_corner(name) || (bench.is_lattice(value) && bench.is_lattice(name)))
            return bench.same_point(value, name);
        return std::ranges::all_of(bench.planes_of(name), [&](PlaneId p) {
            const std::pair known(value, bench.plane_class(p));
            if (std::ranges::find(through_, known) != through_.end()) return true;
            if (!bench.is_corner(value) && passes_by_edges(bench, value, p)) {
                ++parts_.stats.named_by_edges;
            } else if (bench.side(value, p) != 0) {
                return false;
            }
            through_.push_back(known);
            return true;
        });
    }

    BoundaryParts& parts_;
    std::uint64_t serial_;  // of the mesh whose corners come first
    PoolVector<PointId> same_;
    PoolVector<std::pair<PointId, PlaneId>> through_;  // a value, the class of a plane through it
};

}  // namespace

PoolVector<PointId> representatives(BoundaryParts& parts, std::uint64_t serial,
                                    std::uint32_t threads) {
    return EqualPoints(parts, serial).find(threads);
}

PoolVector<PointId> points_as_named(const BoundaryParts& parts) {
    PoolVector<PointId> out(parts.bench.point_count());
    std::iota(out.begin(), out.end(), 0);
    return out;
}

}  // namespace trisect::detail
