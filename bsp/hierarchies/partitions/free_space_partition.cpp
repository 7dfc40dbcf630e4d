// SPDX-License-Identifier: Apache-2.0
//
// For a small body that flies through a field of obstacles, most of the time nothing is near. Held,
// Klosowski and Mitchell fill space with tetrahedra that list the obstacles in them, and walk: from
// frame to frame the body enters a few new tetrahedra and leaves a few. What is tested is what the
// tetrahedra that it is in have to do with; where that is nothing, the body's own triangles are not
// even moved.
//
// They constrain the mesh to the obstacles, so that free tetrahedra have obstacles on their faces
// only; we list what a tetrahedron meets instead (obstacle_mesh.cpp). And we walk with the box that
// the body was modelled in, turned with it. The walk starts in the tetrahedron where the last one
// did. Tetrahedra that a convex body meets are connected, so going on from neighbour to neighbour
// finds all of them; when the body is outside of the cube that is filled, it starts at its surface.
//
// Source: M. Held, J. Klosowski and J. Mitchell, Evaluation of collision detection methods for
// virtual reality fly-throughs (CCCG 1995).

#include <algorithm>
#include <chrono>
#include <cmath>

#include <trisect/bsp/hierarchies/partitions/obstacle_mesh.h>
#include <trisect/bsp/hierarchies/partitions/partitions.h>
#include <trisect/bsp/interference/boxes/box_gap.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::hierarchies {

using detail::Vector3;

namespace {

class FreeSpacePartition final : public PairStructure {
public:
    FreeSpacePartition(const InterferenceModel& a, const InterferenceModel& b)
        : PairStructure(a, b), fixed_(trisect::detail::data_of(a)) {
        const auto start = std::chrono::steady_clock::now();
        obstacles_ = ObstacleMesh(trisect::detail::data_of(a));
        tetrahedron_stamps_.assign(obstacles_.mesh().tetrahedra().size(), 0);
        triangle_stamps_.assign(fixed_.size(), 0);
        seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    std::string_view name() const override { return "free-space"; }
    BuildReport build_report() const override {
        return {seconds_,
                obstacles_.bytes() + fixed_.bytes() + moved_.bytes() +
                    (tetrahedron_stamps_.size() + triangle_stamps_.size()) * sizeof(std::uint32_t),
                obstacles_.mesh().tetrahedra().size(), 1};
    }

protected:
    void update(CostCounters& counters) override {
        const auto& b = data_b();
        double far = 0;
        std::array<Vector3, 8> corners{};
        for (std::size_t c = 0; c < 8; ++c) {
            Vector3 p = b.lo;
            for (std::size_t k = 0; k < 3; ++k) {
                if ((c >> k & 1U) != 0) p[k] = b.hi[k];
                far = std::max(far, std::abs(p[k]));
            }
            corners[c] = placement().to_a(p);
        }
        // A unit more, so that the rounded centre is within.
        body_ = PointHull(corners, placement().to_a.error_below(far, 0) + obstacles_.unit());
        triangles_moved_ = false;
        ++counters.updates;
    }

    bool find_candidates(PairVisit visit, CostCounters& counters) override {
        found_.clear();
        next_stamp();
        start_walk(counters, [this](std::uint32_t t) { return obstacles_.may_meet(t, body_); });
        while (!open_.empty()) {
            const std::uint32_t t = open_.back();
            open_.pop_back();
            for (const std::uint32_t i : obstacles_.list(t)) {
                if (!is_first(triangle_stamps_[i])) continue;
                ++counters.volume_tests;
                if (fixed_[i].meets(body_.box)) found_.push_back(i);
            }
            for (const std::uint32_t n : obstacles_.mesh().tetrahedra()[t].neighbour) {
                if (n == DelaunayMesh::none || !is_first(tetrahedron_stamps_[n])) continue;
                ++counters.volume_tests;
                if (obstacles_.may_meet(n, body_)) open_.push_back(n);
            }
        }
        return !found_.empty() && sweep(visit, counters);
    }

    void find_near(double limit, NearVisit visit, CostCounters& counters) override {
        move_triangles(counters);
        next_stamp();
        start_walk(counters, [](std::uint32_t) { return true; });
        // Those that are left to visit, the nearest first.
        struct Entry {
            double least;
            std::uint32_t tetrahedron;
        };
        const auto farther = [](const Entry& x, const Entry& y) { return x.least > y.least; };
        std::vector<Entry> heap;
        const auto push = [&](std::uint32_t t) {
            ++counters.volume_tests;
            heap.push_back({gap_between(obstacles_.box(t), body_.box), t});
            std::push_heap(heap.begin(), heap.end(), farther);
        };
        for (const std::uint32_t t : open_) push(t);
        while (!heap.empty() && !(heap.front().least > limit)) {
            const std::uint32_t t = heap.front().tetrahedron;
            std::pop_heap(heap.begin(), heap.end(), farther);
            heap.pop_back();
            for (const std::uint32_t i : obstacles_.list(t)) {
                if (!is_first(triangle_stamps_[i])) continue;
                ++counters.volume_tests;
                if (gap_between(fixed_[i], body_.box) > limit) continue;
                counters.volume_tests += moved_.size();
                for (std::uint32_t j = 0; j < moved_.size(); ++j)
                    if (!(gap_between(fixed_[i], moved_[j]) > limit)) limit = visit(i, j);
            }
            for (const std::uint32_t n : obstacles_.mesh().tetrahedra()[t].neighbour)
                if (n != DelaunayMesh::none && is_first(tetrahedron_stamps_[n])) push(n);
        }
    }

private:
    /// Puts a tetrahedron with the body's centre into `open_`, or all at the surface of the cube
    /// that pass, when it is outside.
    template <class Passes>
    void start_walk(CostCounters& counters, Passes&& passes) {
        open_.clear();
        Vector3 centre{};
        double far = 0;
        for (const Vector3& p : body_.point)
            for (std::size_t k = 0; k < 3; ++k) {
                centre[k] += p[k] / 8;
                far = std::max(far, std::abs(p[k]));
            }
        const bool is_near =
            far < 0x1p60 * obstacles_.unit() && obstacles_.contains(obstacles_.place(centre));
        if (is_near) {
            at_ = obstacles_.mesh().locate(obstacles_.place(centre), at_, counters.volume_tests);
            (void)is_first(tetrahedron_stamps_[at_]);
            open_.push_back(at_);
            return;
        }
        for (const std::uint32_t t : obstacles_.outermost()) {
            ++counters.volume_tests;
            if (!passes(t)) continue;
            (void)is_first(tetrahedron_stamps_[t]);
            open_.push_back(t);
        }
    }

    void move_triangles(CostCounters& counters) {
        if (triangles_moved_) return;
        moved_.move(data_b(), placement());
        counters.updates += moved_.size();
        triangles_moved_ = true;
    }

    /// Pairs of the obstacles found with triangles of the body whose boxes meet, along the axis
    /// where the body is longest.
    bool sweep(PairVisit visit, CostCounters& counters) {
        move_triangles(counters);
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (body_.box.hi[k] - body_.box.lo[k] > body_.box.hi[axis] - body_.box.lo[axis])
                axis = k;
        const auto by_low = [axis](const TriangleBoxes& boxes) {
            return [&boxes, axis](std::uint32_t x, std::uint32_t y) {
                return boxes[x].lo[axis] < boxes[y].lo[axis];
            };
        };
        std::sort(found_.begin(), found_.end(), by_low(fixed_));
        order_.resize(moved_.size());
        for (std::uint32_t j = 0; j < order_.size(); ++j) order_[j] = j;
        std::sort(order_.begin(), order_.end(), by_low(moved_));
        const auto compare = [&](std::uint32_t i, std::uint32_t j) {
            ++counters.volume_tests;
            return fixed_[i].meets(moved_[j]) && visit(i, j);
        };
        std::size_t f = 0;
        std::size_t m = 0;
        while (f < found_.size() && m < order_.size()) {
            const std::uint32_t i = found_[f];
            const std::uint32_t j = order_[m];
            if (fixed_[i].lo[axis] <= moved_[j].lo[axis]) {
                for (std::size_t n = m;
                     n < order_.size() && moved_[order_[n]].lo[axis] <= fixed_[i].hi[axis]; ++n)
                    if (compare(i, order_[n])) return true;
                ++f;
            } else {
                for (std::size_t n = f;
                     n < found_.size() && fixed_[found_[n]].lo[axis] <= moved_[j].hi[axis]; ++n)
                    if (compare(found_[n], j)) return true;
                ++m;
            }
        }
        return false;
    }

    void next_stamp() {
        if (++stamp_ != 0) return;
        std::fill(tetrahedron_stamps_.begin(), tetrahedron_stamps_.end(), 0);
        std::fill(triangle_stamps_.begin(), triangle_stamps_.end(), 0);
        stamp_ = 1;
    }
    [[nodiscard]] bool is_first(std::uint32_t& stamp) const {
        if (stamp == stamp_) return false;
        stamp = stamp_;
        return true;
    }

    TriangleBoxes fixed_;
    TriangleBoxes moved_;
    ObstacleMesh obstacles_;
    PointHull body_;
    std::uint32_t at_ = 0;  // where the last walk began
    bool triangles_moved_ = false;
    std::vector<std::uint32_t> open_;
    std::vector<std::uint32_t> found_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> tetrahedron_stamps_;
    std::vector<std::uint32_t> triangle_stamps_;
    std::uint32_t stamp_ = 0;
    double seconds_ = 0;
};

}  // namespace

std::unique_ptr<PairStructure> make_free_space_partition(const InterferenceModel& a,
                                                         const InterferenceModel& b) {
    return std::make_unique<FreeSpacePartition>(a, b);
}

}  // namespace trisect::hierarchies
