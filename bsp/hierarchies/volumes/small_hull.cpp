// SPDX-License-Identifier: Apache-2.0
//
// Corners. Extreme points in eighteen directions, those of the k-DOP with k = 18, in coordinates in
// which the points spread as far along each of their principal axes: in others nearly all
// directions end in the rims of a flat piece of surface. Then, while there is room, whatever point
// is the farthest outside. A hull of all its vertices would be a little tighter and cost a hundred
// times as much where bodies are round.
//
// The radius. The distance of a point from the hull of the corners is at most that from any point
// of the hull; the iteration of Gilbert, Johnson and Keerthi finds a near one. It may stop as soon
// as that is no more than the radius already is.
//
// Roundings, with u = 2^-24. A corner is off by u of its magnitude in each coordinate when it is
// made a float: points are within 2, so √3 2^-23 in all. A sum of three products in floats is off
// by less than 4 u of the sum of magnitudes, which is at most |d|_1 times the largest coordinate,
// and |d|_1 <= √3 |d|; for both hulls 7 u |d| (largest_a + largest_b).

#include <trisect/bsp/hierarchies/volumes/small_hull.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <trisect/bsp/hierarchies/volumes/kdop.h>
#include <trisect/bsp/hierarchies/volumes/nearest_of_simplex.h>
#include <trisect/kernel/support/float_above.h>

namespace trisect::hierarchies {

using detail::dot;
using detail::minus;
using detail::Vector3;

namespace {

using Float3 = std::array<float, 3>;

struct Extreme {
    std::size_t index = 0;
    float along = 0;
};

// The largest d · p, four points at a time.
Extreme extreme_of(const SmallHull& h, const Float3& d) {
    const std::size_t rows = (h.count + 3) / 4;
    std::array<float, SmallHull::most> along;
    std::array<float, 4> best;
    best.fill(-std::numeric_limits<float>::infinity());
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t l = 0; l < 4; ++l) {
            const std::size_t i = 4 * r + l;
            along[i] = h.x[0][i] * d[0] + h.x[1][i] * d[1] + h.x[2][i] * d[2];
            best[l] = along[i] > best[l] ? along[i] : best[l];
        }
    Extreme e;
    e.along = std::max(std::max(best[0], best[1]), std::max(best[2], best[3]));
    while (e.index + 1 < h.count && along[e.index] != e.along) ++e.index;
    return e;
}

Float3 unit_floats(const Vector3& v) {
    const double length = std::sqrt(dot(v, v));
    return {static_cast<float>(v[0] / length), static_cast<float>(v[1] / length),
            static_cast<float>(v[2] / length)};
}

Vector3 doubles(const Float3& v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

constexpr int most_steps = 16;

}  // namespace

class SmallHullBuilder {
public:
    SmallHullBuilder(std::span<const Vector3> points, double error)
        : points_(points.begin(), points.end()), error_(error) {
        std::ranges::sort(points_);
        points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    }

    SmallHull run() {
        if (points_.size() <= SmallHull::most) {
            for (const Vector3& p : points_) add(p);
        } else {
            add_extremes();
            add_farthest();
        }
        hull_.finish(out_ + 1.7321 * error_ + 0x1p-22 + 0x1p-44);
        return hull_;
    }

private:
    void add(const Vector3& p) {
        for (std::size_t k = 0; k < 3; ++k) hull_.x[k][hull_.count] = static_cast<float>(p[k]);
        ++hull_.count;
        corners_.push_back(p);
    }
    [[nodiscard]] const Vector3& extreme(const Vector3& d) const {
        return *std::ranges::max_element(points_, {}, [&d](const Vector3& p) { return dot(d, p); });
    }

    void add_extremes() {
        const detail::AreaFrame frame = spread();
        std::array<double, 3> scale{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3& u = frame.axis[i];
            const double extent = dot(u, extreme(u)) - dot(u, extreme({-u[0], -u[1], -u[2]}));
            scale[i] = 1 / std::max(extent, 0x1p-30);
        }
        for (const auto& d : KDop<18>::directions)
            for (const double sign : {1.0, -1.0}) {
                Vector3 v{};
                for (std::size_t i = 0; i < 3; ++i)
                    for (std::size_t k = 0; k < 3; ++k)
                        v[k] += sign * d[i] * scale[i] * frame.axis[i][k];
                const Vector3& p = extreme(v);
                if (std::ranges::find(corners_, p) == corners_.end()) add(p);
            }
    }

    // Principal axes of the points.
    [[nodiscard]] detail::AreaFrame spread() const {
        detail::AreaMoments m;
        m.area = static_cast<double>(points_.size());
        for (const Vector3& p : points_)
            for (std::size_t k = 0; k < 3; ++k) {
                m.first[k] += p[k];
                m.second[k] += p[k] * p[k];
                m.second[3 + k] += p[k == 2 ? 1 : 0] * p[k == 0 ? 1 : 2];
            }
        return detail::principal_frame(m);
    }

    // Points that are not inside yet stay in points_; those that are never come out again.
    void add_farthest() {
        for (;;) {
            out_ = 0;
            std::size_t farthest = 0;
            const bool more = corners_.size() < SmallHull::most;
            std::size_t kept = 0;
            for (std::size_t i = 0; i < points_.size(); ++i) {
                const Vector3 p = points_[i];
                const double d = distance(p, more ? 0 : out_);
                if (!(d > small)) continue;
                if (d > out_) {
                    out_ = d;
                    farthest = kept;
                }
                points_[kept++] = p;
            }
            points_.resize(kept);
            if (!more || !(out_ > small)) break;
            add(points_[farthest]);
        }
        out_ = std::max(out_, small);
    }

    // No less than the distance of the point from the hull of the corners; good enough when it is
    // not above `enough`.
    [[nodiscard]] double distance(const Vector3& p, double enough) const {
        Simplex simplex;
        Vector3 v = minus(corners_.front(), p);
        double least = std::sqrt(dot(v, v));
        for (int step = 0; step < most_steps && least > std::max(enough, small); ++step) {
            const auto below = [&](const Vector3& c) { return dot(c, v); };
            const Vector3 w = minus(*std::ranges::min_element(corners_, {}, below), p);
            if (dot(v, v) - dot(v, w) < 1e-3 * dot(v, v)) break;
            simplex.add(w);
            v = simplex.nearest();
            least = std::min(least, std::sqrt(dot(v, v)));
        }
        return least;
    }

    // What a float cannot distinguish from nothing.
    static constexpr double small = 0x1p-24;

    std::vector<Vector3> points_;
    std::vector<Vector3> corners_;
    double error_;
    double out_ = 0;
    SmallHull hull_;
};

SmallHull SmallHull::around(std::span<const Vector3> points, double error) {
    return SmallHullBuilder(points, error).run();
}

void SmallHull::finish(double r) {
    for (std::size_t k = 0; k < 3; ++k) {
        std::fill(x[k].begin() + count, x[k].end(), x[k][0]);
        const auto [lo, hi] = std::ranges::minmax(x[k]);
        largest = std::max({largest, std::abs(lo), std::abs(hi)});
        size_ += hi - lo;
    }
    radius = float_above(r);
}

SmallHull SmallHull::moved(const FrameMap& map) const {
    SmallHull r;
    r.count = count;
    for (std::size_t i = 0; i < count; ++i) {
        const Vector3 y = map(point(i));
        for (std::size_t k = 0; k < 3; ++k) r.x[k][i] = static_cast<float>(y[k]);
    }
    double size = 0;
    for (const auto& row : r.x)
        for (std::size_t i = 0; i < count; ++i)
            size = std::max(size, static_cast<double>(std::abs(row[i])));
    r.finish(map.stretch * static_cast<double>(radius) + 1.7321 * (map.error() + 0x1p-23 * size) +
             0x1p-44);
    return r;
}

double gap_of(const SmallHull& a, const SmallHull& b, GapEffort effort, Vector3& direction) {
    const double slack =
        static_cast<double>(a.radius) + static_cast<double>(b.radius) +
        7 * 0x1p-24 * (static_cast<double>(a.largest) + static_cast<double>(b.largest)) + 0x1p-40;
    Vector3 v = direction;
    if (!(dot(v, v) > 0)) v = minus(b.point(0), a.point(0));
    if (!(dot(v, v) > 0)) v = {1, 0, 0};
    Simplex simplex;
    double best = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (int step = 0; step < most_steps; ++step) {
        const Float3 d = unit_floats(v);
        const Extreme ea = extreme_of(a, d);
        const Extreme eb = extreme_of(b, {-d[0], -d[1], -d[2]});
        const Vector3 along = doubles(d);
        const double way = -static_cast<double>(eb.along) - static_cast<double>(ea.along);
        const double gap = way * (way > 0 ? 1 - 0x1p-22 : 1) - slack;
        if (gap > best) {
            best = gap;
            direction = along;
            if (effort == GapEffort::Sign) break;
        }
        simplex.add(minus(b.point(eb.index), a.point(ea.index)));
        v = simplex.nearest();
        // The hulls of the points are not farther apart than this.
        const double most = std::sqrt(dot(v, v));
        if (!(most > slack) || most - slack <= 1.0625 * best || !(most < nearest)) break;
        nearest = most;
    }
    return best;
}

}  // namespace trisect::hierarchies
