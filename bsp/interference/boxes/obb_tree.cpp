// SPDX-License-Identifier: Apache-2.0
//
// Built from the top: a part is divided across its longest principal axis at the mean of its
// triangles' centres, twice, which makes the four boxes of a node. Directions come from the
// principal axes of the area (obb_fit.cpp).
//
// Why four: a walk tests one box against the four children of another, and four of them fit into
// one register, so that fifteen axes cost for four boxes what they cost for one. Why oriented
// boxes: where surfaces come close over an area, thin boxes along the surface separate them after
// O(n^1/2) pairs, axis-parallel ones after O(n) (Gottschalk, Lin and Manocha 1996).
//
// Certified containment. In units of the tree a point is known within e = 2^-50 + error / unit: the
// difference to the origin is rounded once (it is at most 2 in units), dividing by a power of two
// is exact. For a float axis u, |u| < 1.01, the product u · p of three terms below 2 is off by at
// most 6·3·2^-53 and by 2 e from the point. So each half is enlarged by 2^-48 + 2 e. Now the slabs
// hold all contents.
//
// The other set, centre + Σ s_i axis_i, contains the slabs if halves are enlarged again: with U the
// matrix of axes and U U^T = I + E, x - centre = U^-1 y = U^T (I + E)^-1 y. Rounding to floats
// moves components by at most 2^-25, so |E_ij| <= 3·2·2^-25 + 2^-48 < 2^-22.4, and |((I + E)^-1 -
// I) y| <= 2^-22 Σ half. Finally halves grow by the factor 1 + 2^-20, of which 2^-21 pay for all
// roundings of sums of halves in box tests (obb_pose.h), the rest for the roundings here.

#include <trisect/bsp/interference/boxes/obb_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

struct Item {
    std::uint32_t triangle;
    std::array<float, 3> center;
};

// A range of items with its frame.
struct FramedPart {
    std::size_t begin = 0;
    std::size_t end = 0;
    AreaFrame frame;
    [[nodiscard]] std::size_t size() const { return end - begin; }
};

class ObbTreeBuilder {
public:
    ObbTreeBuilder(ObbTree& tree, std::span<const Vector3> positions, double error,
                   std::span<const std::array<std::uint32_t, 3>> corners, ObbTreeOptions options)
        : tree_(tree), corners_(corners), leaf_(options.leaf_triangles) {
        set_unit(positions);
        slack_ = 0x1p-48 + 2 * (0x1p-50 + error / tree.unit);
        points_.reserve(positions.size());
        for (const Vector3& p : positions) {
            Vector3 q = minus(p, tree.origin);
            for (double& c : q) c /= tree.unit;
            points_.push_back(q);
            tree.radius = std::max(tree.radius, bound_slack * std::sqrt(dot(q, q)) + slack_);
        }
        items_.resize(corners.size());
        for (std::uint32_t t = 0; t < corners.size(); ++t) {
            items_[t].triangle = t;
            for (std::size_t k = 0; k < 3; ++k)
                items_[t].center[k] =
                    static_cast<float>(corner(t, 0)[k] + corner(t, 1)[k] + corner(t, 2)[k]);
        }
    }

    void run() {
        tree_.nodes.reserve(items_.size());
        FramedPart all = make_part(0, items_.size());
        tree_.nodes.emplace_back();
        close_lanes(0, 1);
        put(0, 0, all);
        tree_.nodes[0].child[0] = below(all, 1);
        tree_.order.reserve(items_.size());
        tree_.parent.assign(tree_.nodes.size(), 0);
        for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n)
            for (std::uint32_t k = 0; k < 4; ++k) {
                const ObbChild child = tree_.nodes[n].child[k];
                if (!child.is_leaf()) tree_.parent[child.node()] = ObbId::of(n, k).index;
            }
        tree_.corners.reserve(items_.size());
        for (const Item& i : items_) {
            tree_.order.push_back(i.triangle);
            tree_.corners.push_back(corners_[i.triangle]);
        }
    }

private:
    [[nodiscard]] const Vector3& corner(std::uint32_t t, std::size_t i) const {
        return points_[corners_[t][i]];
    }

    void set_unit(std::span<const Vector3> positions) {
        Vector3 lo = positions.front();
        Vector3 hi = lo;
        for (const Vector3& p : positions)
            for (std::size_t k = 0; k < 3; ++k) {
                lo[k] = std::min(lo[k], p[k]);
                hi[k] = std::max(hi[k], p[k]);
            }
        double extent = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            tree_.origin[k] = lo[k] + 0.5 * (hi[k] - lo[k]);
            extent = std::max(extent, hi[k] - lo[k]);
        }
        // Half the extent and a little is at most one unit.
        tree_.unit = extent > 0 ? std::ldexp(1.0, std::ilogb(extent)) : 1.0;
    }

    [[nodiscard]] FramedPart make_part(std::size_t begin, std::size_t end) const {
        FramedPart part{begin, end, {}};
        if (end - begin == 1) {
            const std::uint32_t t = items_[begin].triangle;
            part.frame = triangle_frame(corner(t, 0), corner(t, 1), corner(t, 2));
            return part;
        }
        AreaMoments m;
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t t = items_[i].triangle;
            m.add(corner(t, 0), corner(t, 1), corner(t, 2));
        }
        part.frame = principal_frame(m);
        return part;
    }

    // Across the axis along which the centres reach farthest, at their mean; at the median where
    // the mean leaves hardly anything on one side.
    [[nodiscard]] std::pair<FramedPart, FramedPart> divide(const FramedPart& part) {
        std::array<float, 3> axis{};
        float reach = -1;
        double mean = 0;
        for (const Vector3& a : part.frame.axis) {
            const std::array<float, 3> u{static_cast<float>(a[0]), static_cast<float>(a[1]),
                                         static_cast<float>(a[2])};
            float lo = std::numeric_limits<float>::infinity();
            float hi = -lo;
            double sum = 0;
            for (std::size_t i = part.begin; i < part.end; ++i) {
                const float c = along(u, items_[i]);
                lo = std::min(lo, c);
                hi = std::max(hi, c);
                sum += static_cast<double>(c);
            }
            if (hi - lo > reach) {
                reach = hi - lo;
                axis = u;
                mean = sum / static_cast<double>(part.size());
            }
        }
        const auto first = items_.begin() + static_cast<std::ptrdiff_t>(part.begin);
        const auto last = items_.begin() + static_cast<std::ptrdiff_t>(part.end);
        const auto split = std::partition(
            first, last, [&](const Item& i) { return static_cast<double>(along(axis, i)) < mean; });
        std::size_t middle = static_cast<std::size_t>(split - items_.begin());
        if (std::min(middle - part.begin, part.end - middle) < 1 + part.size() / 16) {
            middle = part.begin + part.size() / 2;
            std::nth_element(
                first, items_.begin() + static_cast<std::ptrdiff_t>(middle), last,
                [&axis](const Item& i, const Item& j) { return along(axis, i) < along(axis, j); });
        }
        return {make_part(part.begin, middle), make_part(middle, part.end)};
    }
    [[nodiscard]] static float along(const std::array<float, 3>& u, const Item& i) {
        return u[0] * i.center[0] + u[1] * i.center[1] + u[2] * i.center[2];
    }

    [[nodiscard]] ObbChild below(const FramedPart& part, std::size_t depth) {
        check_stop(part.size());
        tree_.depth = std::max(tree_.depth, depth);
        if (part.size() <= leaf_)
            return ObbChild::leaf(static_cast<std::uint32_t>(part.begin),
                                  static_cast<std::uint32_t>(part.size()));
        std::array<FramedPart, 4> parts;
        std::size_t count = 1;
        parts[0] = part;
        while (count < 4) {
            std::size_t largest = 0;
            for (std::size_t i = 1; i < count; ++i)
                if (parts[i].size() > parts[largest].size()) largest = i;
            if (parts[largest].size() <= leaf_) break;
            auto [one, other] = divide(parts[largest]);
            parts[largest] = one;
            parts[count++] = other;
        }
        const std::uint32_t node = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.nodes.emplace_back();
        close_lanes(node, count);
        for (std::uint32_t i = 0; i < count; ++i) put(node, i, parts[i]);
        for (std::uint32_t i = 0; i < count; ++i) {
            const ObbChild child = below(parts[i], depth + 1);
            tree_.nodes[node].child[i] = child;
        }
        return ObbChild::node(node);
    }

    void close_lanes(std::uint32_t node, std::size_t from) {
        for (std::size_t i = from; i < 4; ++i)
            for (Float4& h : tree_.nodes[node].half) h[i] = -1e30F;
    }

    // The box of a part into a lane.
    void put(std::uint32_t node, std::uint32_t lane, const FramedPart& part) {
        std::array<Vector3, 3> u{};  // the floats' values
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                u[i][k] = static_cast<double>(static_cast<float>(part.frame.axis[i][k]));
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                TRISECT_EXPECTS(std::abs(dot(u[i], u[j]) - (i == j ? 1 : 0)) < 0x1.6p-23,
                                "box axes that are orthonormal up to rounding");
        Vector3 lo{};
        Vector3 hi{};
        lo.fill(std::numeric_limits<double>::infinity());
        hi.fill(-std::numeric_limits<double>::infinity());
        for (std::size_t i = part.begin; i < part.end; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const Vector3& p = corner(items_[i].triangle, j);
                for (std::size_t k = 0; k < 3; ++k) {
                    const double c = dot(u[k], p);
                    lo[k] = std::min(lo[k], c);
                    hi[k] = std::max(hi[k], c);
                }
            }
        Vector3 center{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 3; ++i) center[k] += 0.5 * (lo[i] + hi[i]) * u[i][k];
        for (double& c : center) c = static_cast<double>(static_cast<float>(c));
        Vector3 half{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double c = dot(u[k], center);
            half[k] = std::max(hi[k] - c, c - lo[k]) + slack_;
        }
        const double sum = half[0] + half[1] + half[2];
        double far = std::sqrt(dot(center, center));
        ObbNode& n = tree_.nodes[node];
        for (std::size_t k = 0; k < 3; ++k) {
            const double wanted = (half[k] + 0x1p-22 * sum) * (1 + 0x1p-20);
            float h = static_cast<float>(wanted);
            if (static_cast<double>(h) < wanted)
                h = std::nextafter(h, std::numeric_limits<float>::infinity());
            n.half[k][lane] = h;
            n.center[k][lane] = static_cast<float>(center[k]);
            for (std::size_t j = 0; j < 3; ++j)
                n.axis[k][j][lane] = static_cast<float>(part.frame.axis[k][j]);
            half[k] = static_cast<double>(h);
        }
        far += std::sqrt(dot(half, half));
        tree_.reach = std::max(tree_.reach, bound_slack * far);
    }

    ObbTree& tree_;
    std::span<const std::array<std::uint32_t, 3>> corners_;
    std::size_t leaf_;
    double slack_ = 0;
    std::vector<Vector3> points_;
    std::vector<Item> items_;
};

}  // namespace

std::uint32_t ObbTree::open(ObbId id) const { return source->open(id); }

ObbTree::ObbTree(std::span<const std::array<double, 3>> positions, double error,
                 std::span<const std::array<std::uint32_t, 3>> triangles, ObbTreeOptions options) {
    TRISECT_EXPECTS(options.leaf_triangles >= 1 && options.leaf_triangles <= ObbChild::max_leaf,
                    "a leaf size that fits into a leaf");
    TRISECT_EXPECTS(triangles.size() < (std::size_t{1} << 28), "triangles that leaves can name");
    if (triangles.empty()) return;
    ObbTreeBuilder(*this, positions, error, triangles, options).run();
}

}  // namespace trisect::detail
