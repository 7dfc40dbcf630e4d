// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/hierarchies/curved/patch_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <trisect/kernel/error.h>

namespace trisect::hierarchies {

namespace {

struct Bounds {
    Point3d lo{INFINITY, INFINITY, INFINITY};
    Point3d hi{-INFINITY, -INFINITY, -INFINITY};

    void include(std::span<const Point3d> points) {
        for (const Point3d& p : points)
            for (std::size_t k = 0; k < 3; ++k) {
                lo[k] = std::min(lo[k], p[k]);
                hi[k] = std::max(hi[k], p[k]);
            }
    }
    [[nodiscard]] std::vector<Point3d> corners() const {
        std::vector<Point3d> c;
        for (unsigned m = 0; m < 8; ++m)
            c.push_back({(m & 1U) != 0 ? hi[0] : lo[0], (m & 2U) != 0 ? hi[1] : lo[1],
                         (m & 4U) != 0 ? hi[2] : lo[2]});
        return c;
    }
    [[nodiscard]] double size() const {
        return std::hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
    }
    [[nodiscard]] std::size_t longest_axis() const {
        std::size_t k = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (hi[i] - lo[i] > hi[k] - lo[k]) k = i;
        return k;
    }
};

}  // namespace

PatchTree::PatchTree(std::span<const BezierPatch> patches) {
    if (patches.empty()) throw UsageError("a tree of no patches");
    std::vector<std::uint32_t> order(patches.size());
    std::iota(order.begin(), order.end(), 0U);
    parts_.reserve(4 * patches.size());
    (void)add_group(order, 0, order.size(), patches);
}

// Halves by number, across the longest side of the box; so the depth is that of a balanced tree.
PatchTree::Part PatchTree::add_group(std::vector<std::uint32_t>& order, std::size_t begin,
                                     std::size_t end, std::span<const BezierPatch> patches) {
    if (end - begin == 1)
        return add_surface(detail::ControlNet(patches[order[begin]]), order[begin], {0, 0}, {1, 1});
    Bounds box;
    for (std::size_t i = begin; i < end; ++i) box.include(patches[order[i]].points());
    const std::size_t axis = box.longest_axis();
    const std::size_t middle = begin + (end - begin) / 2;
    const auto place = [&](std::uint32_t p) {
        double sum = 0;
        for (const Point3d& c : patches[p].points()) sum += c[axis];
        return std::pair(sum / static_cast<double>(patches[p].points().size()), p);
    };
    std::nth_element(order.begin() + static_cast<std::ptrdiff_t>(begin),
                     order.begin() + static_cast<std::ptrdiff_t>(middle),
                     order.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
    const auto part = static_cast<Part>(parts_.size());
    parts_.emplace_back();
    parts_[part].points = box.corners();
    parts_[part].extent = box.size();
    const Part first = add_group(order, begin, middle, patches);
    const Part second = add_group(order, middle, end, patches);
    parts_[part].child = {first, second};
    return part;
}

PatchTree::Part PatchTree::add_surface(detail::ControlNet net, std::uint32_t patch,
                                       const std::array<double, 2>& from,
                                       const std::array<double, 2>& to) {
    detail::ControlNet::Hull hull = net.hull();
    Bounds box;
    box.include(hull.points);
    Data data;
    data.points = std::move(hull.points);
    data.radius = hull.radius;
    data.extent = box.size();
    data.net = static_cast<std::uint32_t>(nets_.size());
    data.patch = patch;
    data.from = from;
    data.to = to;
    nets_.push_back(std::move(net));
    parts_.push_back(std::move(data));
    return static_cast<Part>(parts_.size() - 1);
}

PatchTree::Hull PatchTree::hull(Part part) const {
    return {parts_[part].points, parts_[part].radius};
}

std::array<PatchTree::Part, 2> PatchTree::halves(Part part) {
    if (parts_[part].child[0] != 0) return parts_[part].child;
    const Data& data = parts_[part];
    const detail::ControlNet& net = nets_[data.net];
    const std::size_t way = net.length_in_u() >= net.length_in_v() ? 0 : 1;
    // Below this a half is no smaller than the rounding of its points.
    if (data.to[way] - data.from[way] < 0x1p-48 || data.extent <= 4 * data.radius)
        return {part, part};
    auto [low, high] = way == 0 ? net.halves_in_u() : net.halves_in_v();
    std::array<double, 2> from = data.from;
    std::array<double, 2> to = data.to;
    const double middle = 0.5 * (from[way] + to[way]);
    const std::uint32_t patch = data.patch;
    to[way] = middle;
    const Part first = add_surface(std::move(low), patch, from, to);
    to[way] = parts_[part].to[way];
    from[way] = middle;
    const Part second = add_surface(std::move(high), patch, from, to);
    parts_[part].child = {first, second};
    return parts_[part].child;
}

const std::array<PatchTree::Sample, 5>& PatchTree::samples(Part part) {
    if (parts_[part].samples == no_net) {
        const Data& d = parts_[part];
        const detail::ControlNet& net = nets_[d.net];
        std::array<Sample, 5> s;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t u = k & 1U;
            const std::size_t v = k >> 1U;
            s[k] = {{d.patch, u == 0 ? d.from[0] : d.to[0], v == 0 ? d.from[1] : d.to[1]},
                    net.corner(u, v)};
        }
        s[4] = {{d.patch, 0.5 * (d.from[0] + d.to[0]), 0.5 * (d.from[1] + d.to[1])},
                net.at(0.5, 0.5)};
        parts_[part].samples = static_cast<std::uint32_t>(samples_.size());
        samples_.push_back(s);
    }
    return samples_[parts_[part].samples];
}

std::size_t PatchTree::bytes() const {
    std::size_t sum = parts_.size() * sizeof(Data) + samples_.size() * sizeof(samples_[0]);
    for (const Data& d : parts_)
        sum += d.points.size() * (sizeof(Point3d) + (d.net == no_net ? 0 : 4 * sizeof(double)));
    return sum;
}

}  // namespace trisect::hierarchies
