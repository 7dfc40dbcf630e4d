// SPDX-License-Identifier: Apache-2.0
//
// Lower bounds. For any direction d, the gap of two point sets along d is a lower bound of the
// distance of their hulls times |d|. Directions come from Gilbert's iteration (Gilbert 1966): from
// a point v of the difference of the hulls go to the nearest point on the way to its support
// against v. No step needs to be right, since the gap is computed anew for each direction and
// rounded down.
//
// Upper bounds are distances of points of both surfaces.

#include <trisect/bsp/hierarchies/curved/patch_distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <span>
#include <vector>

#include <trisect/kernel/error.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::hierarchies {

using detail::dot;
using detail::minus;

namespace {

using Part = PatchTree::Part;

// The doubles of a pose; each is within 2^-50 of itself of the exact number.
class PatchPlacement {
public:
    explicit PatchPlacement(const Pose& pose) : map_(pose.approximate()) {
        for (std::size_t i = 0; i < 3; ++i) {
            double row = 0;
            for (std::size_t k = 0; k < 3; ++k) row += std::abs(map_[4 * i + k]);
            rows_ = std::max(rows_, row);
            shift_ = std::max(shift_, std::abs(map_[4 * i + 3]));
        }
    }
    // A coordinate of the image is within error(|p|, e) of the exact one, for a point that is known
    // within e. Three products, three sums: below 2^-49 of what is added up.
    [[nodiscard]] CertifiedPoint operator()(const Point3d& p, double error) const {
        CertifiedPoint r;
        double largest = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            r.position[i] = map_[4 * i] * p[0] + map_[4 * i + 1] * p[1] + map_[4 * i + 2] * p[2] +
                            map_[4 * i + 3];
            largest = std::max(largest, std::abs(p[i]));
        }
        r.error = detail::bound_slack * rows_ * error + 0x1p-48 * (rows_ * largest + shift_);
        return r;
    }

private:
    std::array<double, 12> map_;
    double rows_ = 0;
    double shift_ = 0;
};

struct MovedHull {
    std::vector<Point3d> points;
    double radius = 0;
    double largest = 0;

    void assign(const PatchTree::Hull& hull, const PatchPlacement& place) {
        points.clear();
        radius = largest = 0;
        for (const Point3d& p : hull.points) {
            const CertifiedPoint q = place(p, hull.radius);
            points.push_back(q.position);
            radius = std::max(radius, 1.8 * q.error);
            for (const double c : q.position) largest = std::max(largest, std::abs(c));
        }
    }
    [[nodiscard]] const Point3d& support(const Point3d& d) const {
        const Point3d* best = points.data();
        double most = dot(*best, d);
        for (const Point3d& p : points)
            if (const double along = dot(p, d); along > most) {
                most = along;
                best = &p;
            }
        return *best;
    }
};

// A lower bound of the distance of two surfaces within these hulls.
double lower_bound(const MovedHull& a, const MovedHull& b) {
    Point3d v = minus(b.points.front(), a.points.front());
    // Rounding of two dot products with a vector of length 1.
    const double slack = a.radius + b.radius + 0x1p-48 * (a.largest + b.largest);
    double best = 0;
    for (int step = 0; step < 12; ++step) {
        const double square = dot(v, v);
        if (!(square > 0)) break;
        // The point of b - a that is least along v.
        const Point3d least = minus(b.support({-v[0], -v[1], -v[2]}), a.support(v));
        const double gap = dot(least, v) / std::sqrt(square) - slack;
        best = std::max(best, gap * (1 - 0x1p-45));
        const Point3d way = minus(least, v);
        const double length = dot(way, way);
        if (!(length > 0)) break;
        const double t = std::clamp(-dot(v, way) / length, 0.0, 1.0);
        if (t == 0) break;
        for (std::size_t k = 0; k < 3; ++k) v[k] += t * way[k];
    }
    return best;
}

class Search {
public:
    Search(PatchTree& a, const Pose& pose_a, PatchTree& b, const Pose& pose_b,
           const PatchDistanceOptions& options)
        : a_(a), b_(b), place_a_(pose_a), place_b_(pose_b), options_(options) {
        if (!(options.tolerance > 0))
            throw UsageError("the tolerance of a distance must be a positive number");
        found_.upper = INFINITY;
    }

    // `enough(lower, upper)` ends the search.
    template <class Enough>
    PatchDistance run(Enough&& enough) {
        push(PatchTree::root, PatchTree::root);
        double lower = 0;
        while (!open_.empty() && found_.tests < options_.max_tests) {
            const Pair pair = open_.top();
            lower = pair.lower;
            if (lower >= found_.upper || enough(lower, found_.upper)) break;
            open_.pop();
            const bool split_a = a_.extent(pair.a) >= b_.extent(pair.b);
            if (!halve(pair, split_a) && !halve(pair, !split_a)) {
                // Neither can be halved: this is as far as doubles go.
                stuck_ = std::min(stuck_, lower);
            }
        }
        if (open_.empty()) lower = INFINITY;
        found_.lower = std::min({lower, stuck_, found_.upper});
        found_.reached = found_.upper - found_.lower <= options_.tolerance;
        return found_;
    }

private:
    struct Pair {
        double lower;
        double extent;
        Part a;
        Part b;
        // Least bound first; of equal ones the smallest parts, so that where surfaces meet the
        // search dives.
        bool operator<(const Pair& o) const {
            return lower != o.lower ? lower > o.lower : extent > o.extent;
        }
    };

    bool halve(const Pair& pair, bool split_a) {
        const Part part = split_a ? pair.a : pair.b;
        const auto [first, second] = split_a ? a_.halves(part) : b_.halves(part);
        if (first == part) return false;
        for (const Part half : {first, second}) {
            if (split_a)
                push(half, pair.b);
            else
                push(pair.a, half);
        }
        return true;
    }

    void push(Part a, Part b) {
        ++found_.tests;
        hull_a_.assign(a_.hull(a), place_a_);
        hull_b_.assign(b_.hull(b), place_b_);
        const double lower = lower_bound(hull_a_, hull_b_);
        if (lower >= found_.upper) return;
        if (a_.is_surface(a) && b_.is_surface(b)) sample(a, b);
        open_.push({lower, a_.extent(a) + b_.extent(b), a, b});
    }

    void sample(Part a, Part b) {
        for (const PatchTree::Sample& s : a_.samples(a)) {
            const CertifiedPoint p = place_a_(s.point.position, s.point.error);
            for (const PatchTree::Sample& t : b_.samples(b)) {
                const CertifiedPoint q = place_b_(t.point.position, t.point.error);
                const Point3d way = minus(q.position, p.position);
                const double d =
                    (1 + 0x1p-48) * (std::sqrt(dot(way, way)) + 1.8 * (p.error + q.error));
                if (d < found_.upper) {
                    found_.upper = d;
                    found_.a = s.at;
                    found_.b = t.at;
                }
            }
        }
    }

    PatchTree& a_;
    PatchTree& b_;
    PatchPlacement place_a_;
    PatchPlacement place_b_;
    PatchDistanceOptions options_;
    MovedHull hull_a_;
    MovedHull hull_b_;
    std::priority_queue<Pair> open_;
    PatchDistance found_;
    double stuck_ = INFINITY;
};

}  // namespace

PatchDistance patch_distance(PatchTree& a, const Pose& pose_a, PatchTree& b, const Pose& pose_b,
                             const PatchDistanceOptions& options) {
    return Search(a, pose_a, b, pose_b, options).run([&](double lower, double upper) {
        return upper - lower <= options.tolerance;
    });
}

PatchInterference patches_interfere(PatchTree& a, const Pose& pose_a, PatchTree& b,
                                    const Pose& pose_b, const PatchDistanceOptions& options) {
    const PatchDistance d =
        Search(a, pose_a, b, pose_b, options).run([&](double lower, double upper) {
            return lower > 0 || upper <= options.tolerance;
        });
    if (d.lower > 0) return PatchInterference::Apart;
    return d.upper <= options.tolerance ? PatchInterference::Near : PatchInterference::Undecided;
}

}  // namespace trisect::hierarchies
