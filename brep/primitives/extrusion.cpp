// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/primitives/extrusion.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <trisect/brep/primitives/cap.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/wide_int.h>

namespace trisect {

namespace {

// Sign of the area, exact: differences are below 2^127 in units of 2^-fraction_limit, and
// WideInt<5> holds any number of products of two.
int area_sign(std::span<const LatticePoint> points, std::span<const std::uint32_t> loop) {
    WideInt<5> sum;
    const auto from_first = [&](std::uint32_t p, int k) {
        return WideInt<2>(detail::scaled_integer(points[p][k], fraction_limit) -
                          detail::scaled_integer(points[loop[0]][k], fraction_limit));
    };
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const std::uint32_t a = loop[i];
        const std::uint32_t b = loop[i + 1];
        sum += multiply<5>(from_first(a, 0), from_first(b, 1)) -
               multiply<5>(from_first(a, 1), from_first(b, 0));
    }
    return sum.sign();
}

class Extruder {
public:
    Extruder(const Outline& outer, std::span<const Outline> holes, double low, double high)
        : low_(low), high_(high) {
        if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
            throw UsageError("an extrusion needs finite heights with low < high");
        add_loop(outer);
        for (const Outline& h : holes) add_loop(h);
        LatticeReport report;
        lattice_points_ = to_lattice(flat_, choose_lattice(flat_, 0, Fractions::Kept), report, 0,
                                     Fractions::Kept);
        orient();
    }

    PolygonMesh run() {
        const auto n = static_cast<std::uint32_t>(flat_.size());
        for (const double z : {low_, high_})
            for (const Point3d& p : flat_) mesh_.points.push_back({p[0], p[1], z});
        for (const auto& loop : loops_)
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const std::uint32_t a = loop[i];
                const std::uint32_t b = loop[(i + 1) % loop.size()];
                mesh_.add_face(std::array<std::uint32_t, 4>{a, b, n + b, n + a});
            }
        add_caps(n);
        return std::move(mesh_);
    }

private:
    void add_loop(const Outline& outline) {
        if (outline.size() < 3) throw UsageError("an outline needs at least three corners");
        std::vector<std::uint32_t> loop;
        for (const Point2d& p : outline) {
            if (!std::isfinite(p[0]) || !std::isfinite(p[1]))
                throw UsageError("the corners of an outline must be finite");
            loop.push_back(static_cast<std::uint32_t>(flat_.size()));
            flat_.push_back({p[0], p[1], 0});
        }
        loops_.push_back(std::move(loop));
    }

    // The outer loop counter-clockwise, holes clockwise.
    void orient() {
        for (std::size_t l = 0; l < loops_.size(); ++l) {
            const int s = area_sign(lattice_points_, loops_[l]);
            if (s == 0) throw UsageError("an outline has no area");
            if ((s > 0) != (l == 0)) std::reverse(loops_[l].begin(), loops_[l].end());
        }
    }

    void add_caps(std::uint32_t n) {
        if (loops_.size() == 1) {
            std::vector<std::uint32_t> cap = loops_[0];
            std::reverse(cap.begin(), cap.end());
            mesh_.add_face(cap);
            for (std::size_t i = 0; i < cap.size(); ++i) cap[i] = n + loops_[0][i];
            mesh_.add_face(cap);
            return;
        }
        for (const auto& [a, b, c] : detail::triangulate_cap(lattice_points_, loops_)) {
            mesh_.add_triangle(a, c, b);
            mesh_.add_triangle(n + a, n + b, n + c);
        }
    }

    double low_, high_;
    std::vector<Point3d> flat_;
    std::vector<LatticePoint> lattice_points_;
    std::vector<std::vector<std::uint32_t>> loops_;
    PolygonMesh mesh_;
};

}  // namespace

PolygonMesh make_extrusion(const Outline& outer, std::span<const Outline> holes, double low,
                           double high) {
    return Extruder(outer, holes, low, high).run();
}

}  // namespace trisect
