// SPDX-License-Identifier: Apache-2.0
//
// Three ways to divide a part in two; wider nodes come from dividing their largest part again.
//
// Median and mean look at centres alone, as RAPID and QuickCD do, RAPID along the axis of the box
// that it has just fitted, which is what the principal axis stands for. The surface area heuristic
// (MacDonald and Booth 1990; binned after Wald 2007) takes the cut with the least sum of area times
// number, which is the chance that a large query meets a side times what it costs then. For pairs
// of solids that argument is not a theorem; docs/hierarchies.md has what it brings.

#include <trisect/bsp/interference/boxes/tree_builder.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::hierarchies {

using detail::Vector3;

namespace {

struct Bounds {
    Vector3 lo{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
               std::numeric_limits<double>::infinity()};
    Vector3 hi{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
               -std::numeric_limits<double>::infinity()};
    void add(const Vector3& l, const Vector3& h) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], l[k]);
            hi[k] = std::max(hi[k], h[k]);
        }
    }
    [[nodiscard]] double half_area() const {
        if (!(lo[0] <= hi[0])) return 0;
        const double x = hi[0] - lo[0];
        const double y = hi[1] - lo[1];
        const double z = hi[2] - lo[2];
        return x * y + y * z + z * x;
    }
};

struct ItemPart {
    std::size_t begin = 0;
    std::size_t end = 0;
    [[nodiscard]] std::size_t size() const { return end - begin; }
};

class ItemTreeBuilder {
public:
    ItemTreeBuilder(std::span<const TreeItem> items, const TreeOptions& options)
        : items_(items), options_(options), order_(items.size()) {
        std::iota(order_.begin(), order_.end(), 0U);
    }

    TreeShape run() {
        TreeShape shape;
        struct Open {
            std::uint32_t node;
            ItemPart part;
            unsigned level;
        };
        std::vector<Open> open{{0, {0, items_.size()}, 1}};
        shape.nodes.emplace_back();
        std::vector<ItemPart> parts;
        while (!open.empty()) {
            const Open o = open.back();
            open.pop_back();
            shape.depth = std::max(shape.depth, o.level);
            TreeNode& node = shape.nodes[o.node];
            if (o.part.size() <= options_.leaf_things) {
                node = {static_cast<std::uint32_t>(o.part.begin),
                        static_cast<std::uint16_t>(o.part.size()), true};
                continue;
            }
            divide(o.part, parts);
            node = {static_cast<std::uint32_t>(shape.nodes.size()),
                    static_cast<std::uint16_t>(parts.size()), false};
            for (std::size_t i = parts.size(); i-- > 0;)
                open.push_back(
                    {static_cast<std::uint32_t>(shape.nodes.size() + i), parts[i], o.level + 1});
            shape.nodes.resize(shape.nodes.size() + parts.size());
        }
        shape.order = std::move(order_);
        return shape;
    }

private:
    [[nodiscard]] const Vector3& center(std::size_t i) const { return items_[order_[i]].center; }

    // Into as many parts as a node has children, if there are that many.
    void divide(const ItemPart& whole, std::vector<ItemPart>& parts) {
        parts.assign(1, whole);
        while (parts.size() < options_.arity) {
            const auto largest = std::ranges::max_element(parts, {}, &ItemPart::size);
            if (largest->size() <= options_.leaf_things) break;
            const ItemPart part = *largest;
            const std::size_t middle = cut(part);
            *largest = {part.begin, middle};
            parts.insert(largest + 1, {middle, part.end});
        }
    }

    // Puts the part into an order of which the first elements, up to the place returned, are one
    // side.
    std::size_t cut(const ItemPart& part) {
        std::size_t middle = part.begin;
        if (options_.split == SplitRule::Mean) middle = cut_at_mean(part);
        if (options_.split == SplitRule::Principal) middle = cut_across_principal_axis(part);
        if (options_.split == SplitRule::SurfaceArea) middle = cut_by_area(part);
        const std::size_t least = std::max<std::size_t>(1, part.size() / 64);
        if (middle < part.begin + least || middle > part.end - least) middle = cut_at_median(part);
        return middle;
    }

    template <class Below>
    std::size_t separate(const ItemPart& part, Below&& below) {
        const auto first = order_.begin() + static_cast<std::ptrdiff_t>(part.begin);
        const auto last = order_.begin() + static_cast<std::ptrdiff_t>(part.end);
        return static_cast<std::size_t>(std::partition(first, last, below) - order_.begin());
    }

    std::size_t cut_at_median(const ItemPart& part) {
        Bounds b;
        for (std::size_t i = part.begin; i < part.end; ++i) b.add(center(i), center(i));
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (b.hi[k] - b.lo[k] > b.hi[axis] - b.lo[axis]) axis = k;
        const std::size_t middle = part.begin + part.size() / 2;
        const auto at = [this](std::size_t i) {
            return order_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        // Equal centres in the order of their numbers, so that the tree is the same everywhere.
        std::nth_element(at(part.begin), at(middle), at(part.end),
                         [this, axis](std::uint32_t i, std::uint32_t j) {
                             const double x = items_[i].center[axis];
                             const double y = items_[j].center[axis];
                             return x < y || (x == y && i < j);
                         });
        return middle;
    }

    std::size_t cut_at_mean(const ItemPart& part) {
        Vector3 sum{};
        Vector3 squares{};
        const Vector3 about = center(part.begin);
        for (std::size_t i = part.begin; i < part.end; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const double d = center(i)[k] - about[k];
                sum[k] += d;
                squares[k] += d * d;
            }
        const double n = static_cast<double>(part.size());
        std::size_t axis = 0;
        Vector3 variance{};
        for (std::size_t k = 0; k < 3; ++k) {
            variance[k] = squares[k] - sum[k] * sum[k] / n;
            if (variance[k] > variance[axis]) axis = k;
        }
        const double mean = about[axis] + sum[axis] / n;
        return separate(
            part, [this, axis, mean](std::uint32_t i) { return items_[i].center[axis] < mean; });
    }

    std::size_t cut_across_principal_axis(const ItemPart& part) {
        detail::AreaMoments m;
        m.area = static_cast<double>(part.size());
        for (std::size_t i = part.begin; i < part.end; ++i) {
            const Vector3& c = center(i);
            for (std::size_t k = 0; k < 3; ++k) {
                m.first[k] += c[k];
                m.second[k] += c[k] * c[k];
                m.second[3 + k] += c[k == 2 ? 1 : 0] * c[k == 0 ? 1 : 2];
            }
        }
        const Vector3 axis = detail::principal_frame(m).axis[0];
        const double mean = detail::dot(axis, m.first) / m.area;
        return separate(part, [this, &axis, mean](std::uint32_t i) {
            return detail::dot(axis, items_[i].center) < mean;
        });
    }

    std::size_t cut_by_area(const ItemPart& part) {
        Bounds centers;
        for (std::size_t i = part.begin; i < part.end; ++i) centers.add(center(i), center(i));
        constexpr std::size_t bins = 16;
        double best = std::numeric_limits<double>::infinity();
        std::size_t best_axis = 0;
        std::size_t best_bin = 0;
        const auto bin_of = [&centers](const Vector3& c, std::size_t axis) {
            const double from = centers.lo[axis];
            const double width = centers.hi[axis] - from;
            const auto b = static_cast<std::size_t>((c[axis] - from) / width * bins);
            return std::min(b, bins - 1);
        };
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!(centers.hi[axis] > centers.lo[axis])) continue;
            std::array<Bounds, bins> box;
            std::array<std::size_t, bins> number{};
            for (std::size_t i = part.begin; i < part.end; ++i) {
                const TreeItem& item = items_[order_[i]];
                const std::size_t b = bin_of(item.center, axis);
                box[b].add(item.lo, item.hi);
                ++number[b];
            }
            // Costs of the upper side of each cut, then of both.
            std::array<double, bins> above{};
            Bounds side;
            std::size_t count = 0;
            for (std::size_t b = bins; b-- > 1;) {
                side.add(box[b].lo, box[b].hi);
                count += number[b];
                above[b] = side.half_area() * static_cast<double>(count);
            }
            side = {};
            count = 0;
            for (std::size_t b = 1; b < bins; ++b) {
                side.add(box[b - 1].lo, box[b - 1].hi);
                count += number[b - 1];
                const double cost = above[b] + side.half_area() * static_cast<double>(count);
                if (count == 0 || count == part.size() || !(cost < best)) continue;
                best = cost;
                best_axis = axis;
                best_bin = b;
            }
        }
        if (best_bin == 0) return part.begin;
        return separate(
            part, [&](std::uint32_t i) { return bin_of(items_[i].center, best_axis) < best_bin; });
    }

    std::span<const TreeItem> items_;
    TreeOptions options_;
    std::vector<std::uint32_t> order_;
};

}  // namespace

TreeShape build_tree(std::span<const TreeItem> items, const TreeOptions& options) {
    TRISECT_EXPECTS(!items.empty() && options.arity >= 2 && options.arity <= 8 &&
                        options.leaf_things >= 1 && options.leaf_things <= 255,
                    "options of a tree are out of range");
    return ItemTreeBuilder(items, options).run();
}

}  // namespace trisect::hierarchies
