// SPDX-License-Identifier: Apache-2.0
//
// Hubbard bounds a motion by what accelerations are possible; ours are known polynomials, so bounds
// can be had that are as tight as one likes. Over an interval a motion is (M(s) x + t(s)) / w(s).
// With Bernstein coefficients M_k, t_k, w_k over that interval, all w_k positive, a point is at any
// time a convex combination of the points (M_k x + t_k) / w_k: weights w_k B_k(s) / w(s) are
// positive and have sum 1. So the boxes of the solid under these few affine maps, together, contain
// it all the time. Coefficients are worked out in rationals; only the maps are rounded, within what
// BodyBounds allows for.
//
// Halving the interval brings the maps four times nearer to the motion.
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <trisect/bsp/hierarchies/motion/space_time_boxes.h>
#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/scene/body_bounds.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/number/infinity.h>

namespace trisect::hierarchies {

namespace {

using detail::BodyBounds;
using detail::BodyBox;
using detail::infinity;
using detail::IntegerPolynomial;
using detail::MotionPiece;

/// Of the sum of its sides, how much larger the box of an interval may be than that of a moment.
constexpr double tolerated = 1.5;

mpq_class binomial(int n, int k) {
    mpz_class r;
    mpz_bin_uiui(r.get_mpz_t(), static_cast<unsigned long>(n), static_cast<unsigned long>(k));
    return mpq_class(r);
}

/// Bernstein coefficients of degree n over an interval.
std::vector<mpq_class> bernstein(const IntegerPolynomial& p, int n, double from, double to) {
    const mpq_class start(from);
    const mpq_class length = mpq_class(to) - start;
    // In powers of the interval's own parameter first (Horner's scheme for p(start + length u)).
    std::vector<mpq_class> a(static_cast<std::size_t>(n) + 1);
    for (int i = p.degree(); i >= 0; --i) {
        for (std::size_t j = a.size() - 1; j > 0; --j) a[j] = a[j] * start + a[j - 1] * length;
        a[0] = a[0] * start + p[i];
    }
    std::vector<mpq_class> b(a.size());
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= k; ++j)
            b[static_cast<std::size_t>(k)] +=
                a[static_cast<std::size_t>(j)] * binomial(k, j) / binomial(n, j);
    return b;
}

double side_sum(const BodyBox& b) {
    return (b.hi[0] - b.lo[0]) + (b.hi[1] - b.lo[1]) + (b.hi[2] - b.lo[2]);
}

void add_to(BodyBox& box, const BodyBox& other) {
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], other.lo[k]);
        box.hi[k] = std::max(box.hi[k], other.hi[k]);
    }
}

/// A box of an interval, and the largest one of the maps that it is made of.
struct Bounded {
    BodyBox space;
    double largest_side_sum = 0;
};

Bounded bounds_over(const MotionPiece& piece, const BodyBounds& body, double from, double to) {
    const int n = std::max(piece.degree(), 1);
    const auto weight = bernstein(piece.weight, n, from, to);
    Bounded r;
    r.space = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const mpq_class& w : weight)
        if (sgn(w) <= 0)
            return {{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}, 0};
    std::vector<std::array<double, 12>> maps(weight.size());
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            const auto value =
                bernstein(column < 3 ? piece.matrix[row][column] : piece.shift[row], n, from, to);
            for (std::size_t k = 0; k < maps.size(); ++k)
                maps[k][4 * row + column] = mpq_class(value[k] / weight[k]).get_d();
        }
    for (const auto& map : maps) {
        const BodyBox box = body.under(map);
        r.largest_side_sum = std::max(r.largest_side_sum, side_sum(box));
        add_to(r.space, box);
    }
    return r;
}

/// Boxes of a piece, in the order of time; `start` is the number of the piece.
void append_boxes(const MotionPiece& piece, const BodyBounds& body, double start,
                  std::vector<SpaceTimeBox>& out) {
    struct Interval {
        double from;
        double to;
    };
    // The last one is the first in time. Each part of an interval that is cut has half of its share
    // of the boxes.
    std::vector<std::pair<Interval, std::size_t>> open{{{0, 1}, SpaceTimeBoxes::most_boxes}};
    while (!open.empty()) {
        const auto [interval, share] = open.back();
        open.pop_back();
        const Bounded b = bounds_over(piece, body, interval.from, interval.to);
        if (share > 1 && !(side_sum(b.space) <= tolerated * b.largest_side_sum)) {
            const double middle = 0.5 * (interval.from + interval.to);
            open.push_back({{middle, interval.to}, share / 2});
            open.push_back({{interval.from, middle}, share / 2});
            continue;
        }
        out.push_back({b.space, start + interval.from, start + interval.to});
    }
}

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using TreePoint4 = bg::model::point<double, 4, bg::cs::cartesian>;
using TreeBox4 = bg::model::box<TreePoint4>;

TreePoint4 tree_point(const std::array<double, 3>& p, double time) {
    TreePoint4 r;
    r.set<0>(p[0]);
    r.set<1>(p[1]);
    r.set<2>(p[2]);
    r.set<3>(time);
    return r;
}

/// Sorted intervals that touch become one.
void unite(std::vector<SpaceTimePair>& pairs) {
    std::sort(pairs.begin(), pairs.end());  // by both solids, then by time
    std::vector<SpaceTimePair> r;
    for (const SpaceTimePair& p : pairs) {
        if (!r.empty() && r.back().first == p.first && r.back().second == p.second &&
            p.from <= r.back().to)
            r.back().to = std::max(r.back().to, p.to);
        else
            r.push_back(p);
    }
    std::stable_sort(r.begin(), r.end(), [](const SpaceTimePair& a, const SpaceTimePair& b) {
        return a.from < b.from;
    });
    pairs = std::move(r);
}

}  // namespace

std::uint32_t SpaceTimeBoxes::add(const InterferenceModel& model, const Motion& motion) {
    std::vector<SpaceTimeBox> boxes;
    if (!model.is_empty()) {
        const BodyBounds body(trisect::detail::data_of(model));
        for (std::size_t i = 0; i < motion.piece_count(); ++i)
            append_boxes(trisect::detail::piece_of(motion, i), body, static_cast<double>(i), boxes);
        // Where it comes to rest.
        const auto end = static_cast<double>(motion.piece_count());
        const Bounded rest =
            bounds_over(trisect::detail::piece_of(motion, motion.piece_count() - 1), body, 1, 1);
        boxes.push_back({rest.space, end, std::numeric_limits<double>::infinity()});
    }
    bodies_.push_back(std::move(boxes));
    return static_cast<std::uint32_t>(bodies_.size() - 1);
}

std::vector<SpaceTimePair> SpaceTimeBoxes::pairs(double from, double to) const {
    struct Entry {
        std::uint32_t body;
        std::uint32_t box;
    };
    std::vector<std::pair<TreeBox4, Entry>> entries;
    for (std::uint32_t body = 0; body < bodies_.size(); ++body)
        for (std::uint32_t i = 0; i < bodies_[body].size(); ++i) {
            const SpaceTimeBox& b = bodies_[body][i];
            const double first = std::max(from, b.from);
            const double last = std::min(to, b.to);
            if (first <= last)
                entries.push_back(
                    {{tree_point(b.space.lo, first), tree_point(b.space.hi, last)}, {body, i}});
        }
    struct Indexable {
        using result_type = const TreeBox4&;
        result_type operator()(const std::pair<TreeBox4, Entry>& e) const { return e.first; }
    };
    struct Same {
        bool operator()(const std::pair<TreeBox4, Entry>& a,
                        const std::pair<TreeBox4, Entry>& b) const {
            return a.second.body == b.second.body && a.second.box == b.second.box;
        }
    };
    const bgi::rtree<std::pair<TreeBox4, Entry>, bgi::rstar<8>, Indexable, Same> tree(entries);
    std::vector<SpaceTimePair> found;
    for (const auto& [box, mine] : entries)
        for (auto it = tree.qbegin(bgi::intersects(box)); it != tree.qend(); ++it)
            if (mine.body < it->second.body)
                found.push_back(
                    {mine.body, it->second.body,
                     std::max(box.min_corner().get<3>(), it->first.min_corner().get<3>()),
                     std::min(box.max_corner().get<3>(), it->first.max_corner().get<3>())});
    unite(found);
    return found;
}

}  // namespace trisect::hierarchies
