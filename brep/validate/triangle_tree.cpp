// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/validate/triangle_tree.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

// Smaller nodes are halved whatever their boxes.
constexpr std::ptrdiff_t least_mixed = 32;

// Moves the smaller half to the front, along the axis in which the centres of the boxes spread
// most. `id` distinguishes equal centres. Boxes that are longer than half of that spread come apart
// from the others first: they overlap most of these, and centres of needles are among those of
// triangles that the needles pass at some distance. `parted`: whether that was done by the division
// before this one, or by this one; never twice in a row, so that numbers are halved every other
// time.
template <class Iterator, class BoxOf, class IdOf>
Iterator halve(Iterator begin, Iterator end, const BoxOf& box_of, const IdOf& id_of, bool& parted) {
    const auto centre = [&](const auto& item, std::size_t axis) {
        const LatticeBox& box = box_of(item);
        return coordinate(box.low, axis).to_double() + coordinate(box.high, axis).to_double();
    };
    const auto extent = [&](const auto& item, std::size_t axis) {
        const LatticeBox& box = box_of(item);
        return coordinate(box.high, axis).to_double() - coordinate(box.low, axis).to_double();
    };
    std::array<double, 3> low{}, high{};
    for (Iterator it = begin; it != end; ++it)
        for (std::size_t k = 0; k < 3; ++k) {
            const double c = centre(*it, k);
            low[k] = it == begin ? c : std::min(low[k], c);
            high[k] = it == begin ? c : std::max(high[k], c);
        }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    if (!std::exchange(parted, false) && end - begin >= least_mixed) {
        const double spread = (high[axis] - low[axis]) / 2;  // centres are doubled
        const auto is_long = [&](const auto& item) { return 2 * extent(item, axis) > spread; };
        if (std::any_of(begin, end, is_long)) {
            const Iterator middle =
                std::stable_partition(begin, end, [&](const auto& item) { return !is_long(item); });
            parted = middle != begin && middle != end;
            if (parted) return middle;
        }
    }
    const Iterator middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [&](const auto& a, const auto& b) {
        const double ca = centre(a, axis);
        const double cb = centre(b, axis);
        return ca != cb ? ca < cb : id_of(a) < id_of(b);
    });
    return middle;
}

}  // namespace

TriangleTree::TriangleTree(std::span<const LatticePoint> points,
                           std::span<const std::array<std::uint32_t, 3>> triangles,
                           std::span<const std::uint32_t> sheets, double error)
    : points_(points), triangles_(triangles), boxes_(triangles.size()), error_(error) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (const std::uint32_t c : triangles[t]) boxes_[t].add(points[c]);
        if (error > 0) boxes_[t].grow(error);
    }
    if (triangles.empty()) return;
    order_.reserve(triangles.size());
    end_step();
    Grouped grouped = group(sheets);
    end_step();
    divide(grouped.items, grouped.triangles, false);
}

// Sheets in the order of their first triangles, after the loose triangles.
TriangleTree::Grouped TriangleTree::group(std::span<const std::uint32_t> sheets) const {
    Grouped out;
    out.triangles.resize(boxes_.size());
    std::iota(out.triangles.begin(), out.triangles.end(), 0U);
    const auto sheet_of = [&](std::uint32_t t) { return sheets.empty() ? no_sheet : sheets[t]; };
    std::stable_sort(out.triangles.begin(), out.triangles.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return sheet_of(a) < sheet_of(b); });
    const auto n = static_cast<std::uint32_t>(out.triangles.size());
    for (std::uint32_t i = 0; i < n;) {
        Item item{{}, i, i};
        const std::uint32_t sheet = sheet_of(out.triangles[i]);
        do {
            item.box.add(boxes_[out.triangles[item.end++]]);
        } while (sheet != no_sheet && item.end < n && sheet_of(out.triangles[item.end]) == sheet);
        out.items.push_back(item);
        i = item.end;
    }
    return out;
}

// Recursive, but halving every other time: 64 levels at most.
std::uint32_t TriangleTree::divide(std::span<Item> items, std::span<const std::uint32_t> triangles,
                                   bool parted) {
    check_stop();
    Node node;
    node.begin = static_cast<std::uint32_t>(order_.size());
    if (items.size() == 1 && items[0].count() > 1) {
        order_.insert(order_.end(), triangles.begin() + items[0].begin,
                      triangles.begin() + items[0].end);
        const std::uint32_t root = add_part(node.begin, static_cast<std::uint32_t>(order_.size()));
        nodes_[root].is_sheet = true;
        return root;
    }
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    std::uint32_t count = 0;
    for (const Item& item : items) {
        node.box.add(item.box);
        count += item.count();
    }
    node.end = node.begin + count;
    nodes_.push_back(node);
    if (count == items.size() && count <= leaf_size) {
        for (const Item& item : items) order_.push_back(triangles[item.begin]);
        return self;
    }
    const auto middle = halve(
        items.begin(), items.end(), [](const Item& item) -> const LatticeBox& { return item.box; },
        [](const Item& item) { return item.begin; }, parted);
    const std::uint32_t left = divide({items.begin(), middle}, triangles, parted);
    const std::uint32_t right = divide({middle, items.end()}, triangles, parted);
    nodes_[self].left = left;
    nodes_[self].right = right;
    return self;
}

std::uint32_t TriangleTree::add_part(std::uint32_t begin, std::uint32_t end) {
    Node node;
    node.begin = begin;
    node.end = end;
    for (std::uint32_t i = begin; i < end; ++i) node.box.add(boxes_[order_[i]]);
    nodes_.push_back(node);
    return static_cast<std::uint32_t>(nodes_.size() - 1);
}

std::array<std::uint32_t, 2> TriangleTree::children(std::uint32_t node) {
    if (nodes_[node].left == 0) {
        const std::uint32_t begin = nodes_[node].begin;
        const std::uint32_t end = nodes_[node].end;
        check_stop(end - begin);
        bool parted = nodes_[node].is_parted;
        const auto middle = halve(
            order_.begin() + begin, order_.begin() + end,
            [this](std::uint32_t t) -> const LatticeBox& { return boxes_[t]; },
            [](std::uint32_t t) { return t; }, parted);
        const auto split = static_cast<std::uint32_t>(middle - order_.begin());
        const std::uint32_t left = add_part(begin, split);
        const std::uint32_t right = add_part(split, end);
        nodes_[node].left = left;
        nodes_[node].right = right;
        nodes_[left].is_parted = parted;
        nodes_[right].is_parted = parted;
    }
    return {nodes_[node].left, nodes_[node].right};
}

TriangleTree::TurnedBoxes::TurnedBoxes(const TriangleTree& tree)
    : tree_(tree), frame_(tree.nodes_[0].box.low, tree.nodes_[0].box.high) {
    frame_.margin += 4 * tree.error_;  // two points, each off by a diagonal
}

bool TriangleTree::TurnedBoxes::are_apart(std::uint32_t a, std::uint32_t b) {
    if (tree_.error_ > 0) return false;  // boxes along the axes of the part are good ones
    if (visits_.size() < tree_.nodes_.size()) visits_.resize(tree_.nodes_.size(), 0);
    const bool a_is_hot = is_hot(a);
    const bool b_is_hot = is_hot(b);
    return (a_is_hot || b_is_hot) && box_of(a).is_apart(box_of(b), frame_);
}

// Counts a visit; true from the one on that makes the box.
bool TriangleTree::TurnedBoxes::is_hot(std::uint32_t node) {
    std::uint32_t& visits = visits_[node];
    if (visits < hot_visits && ++visits < hot_visits) return false;
    if (visits > hot_visits) return true;
    const Node& n = tree_.nodes_[node];
    check_stop(n.count());
    const auto box = TurnedBox::around(frame_, tree_.points_, tree_.triangles_,
                                       std::span(tree_.order_).subspan(n.begin, n.count()));
    visits = hot_visits + 1 + static_cast<std::uint32_t>(boxes_.size());
    boxes_.push_back(box ? *box : TurnedBox(frame_, n.box.low, n.box.high));
    return true;
}

unsigned TriangleTree::TurnedBoxes::meeting(std::uint32_t leaf, std::uint32_t other) {
    const std::uint32_t count = tree_.nodes_[leaf].count();
    const unsigned all = (1U << count) - 1;
    if (tree_.error_ > 0) return all;
    if (visits_[leaf] <= hot_visits || visits_[other] <= hot_visits) return all;
    const std::uint32_t first = triangles_of(leaf);
    const TurnedBox& box = boxes_[visits_[other] - hot_visits - 1];
    unsigned out = 0;
    for (std::uint32_t i = 0; i < count; ++i)
        if (!triangle_boxes_[first + i].is_apart(box, frame_)) out |= 1U << i;
    return out;
}

// Makes the boxes of its triangles, if they are not there; returns the place of the first one.
std::uint32_t TriangleTree::TurnedBoxes::triangles_of(std::uint32_t leaf) {
    if (first_of_leaf_.size() < tree_.nodes_.size()) first_of_leaf_.resize(tree_.nodes_.size(), 0);
    if (first_of_leaf_[leaf] != 0) return first_of_leaf_[leaf] - 1;
    const auto first = static_cast<std::uint32_t>(triangle_boxes_.size());
    first_of_leaf_[leaf] = first + 1;
    const Node& n = tree_.nodes_[leaf];
    for (std::uint32_t i = n.begin; i < n.end; ++i) {
        const auto box = TurnedBox::around(frame_, tree_.points_, tree_.triangles_,
                                           std::span(tree_.order_).subspan(i, 1));
        const LatticeBox& usual = tree_.boxes_[tree_.order_[i]];
        triangle_boxes_.push_back(box ? *box : TurnedBox(frame_, usual.low, usual.high));
    }
    return first;
}

TurnedBox TriangleTree::TurnedBoxes::box_of(std::uint32_t node) const {
    if (visits_[node] > hot_visits) return boxes_[visits_[node] - hot_visits - 1];
    const LatticeBox& box = tree_.nodes_[node].box;
    return TurnedBox(frame_, box.low, box.high);
}

}  // namespace trisect::detail
