// SPDX-License-Identifier: Apache-2.0
//
// Corners are named as in mesh_section.cpp, and loops and their corners come in the order in which
// the arrangement of regions would hand them out: it numbers corners as sides lead to them, in the
// order of the triangles, and begins each loop with its smallest pair of numbers.

#include <trisect/bsp/modelling/sections/layer_walk.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

/// By which corners are above, as bits: the side of the triangle that leads down through the plane,
/// and the one that leads up.
struct Passage {
    std::uint8_t down = 0;
    std::uint8_t up = 0;
};
constexpr std::array<Passage, 8> passages{
    {{0, 0}, {0, 2}, {1, 0}, {1, 2}, {2, 1}, {0, 1}, {2, 0}, {0, 0}}};

constexpr double most_in_rows = 0x1p400;

}  // namespace

LayerWalk::LayerWalk(const MeshSection& mesh, const SectionEdges& edges)
    : mesh_(mesh), edges_(edges), links_(std::size_t{edges.count()} + mesh.point_count()) {
    takes_rows_ = mesh.frame().is_axis();
    for (std::uint32_t v = 0; v < mesh.point_count() && takes_rows_; ++v) {
        are_all_doubles_ = are_all_doubles_ && mesh.is_double(v);
        for (const double c : mesh.near(v))
            takes_rows_ = takes_rows_ && std::fabs(c) < most_in_rows;
    }
}

SectionNumbers::Name LayerWalk::name(std::uint32_t node) const {
    if (!is_edge(node)) return {node - edges_.count(), node - edges_.count()};
    return edges_.ends(node);
}

// At most one side leaves a node.
bool LayerWalk::link(std::uint32_t from, std::uint32_t to) {
    Link& l = links_[from];
    if (l.layer == layer_) return false;
    l = {layer_, to, static_cast<std::uint32_t>(from_.size())};
    from_.push_back(from);
    return true;
}

LayerOutcome LayerWalk::link_sides(const SectionPlane& plane, SliceRule rule) {
    from_.clear();
    if (++layer_ == 0) {
        links_.assign(links_.size(), {});
        layer_ = 1;
    }
    const int in_plane = rule == SliceRule::Above ? -1 : 1;
    for (const std::uint32_t number : plane.triangles) {
        const MeshSection::Triangle& t = mesh_.triangle(number);
        const std::array<int, 3> at{mesh_.side(t[0], plane.height), mesh_.side(t[1], plane.height),
                                    mesh_.side(t[2], plane.height)};
        const bool is_in_plane = at[0] == 0 && at[1] == 0 && at[2] == 0;
        if (is_in_plane && rule == SliceRule::Closed) return LayerOutcome::Faces;
        unsigned above = 0;
        for (unsigned k = 0; k < 3; ++k)
            above |= static_cast<unsigned>(2 * at[k] + in_plane > 0) << k;
        if (above == 0 || above == 7) continue;
        const auto node = [&](std::size_t k) {
            const std::size_t next = k == 2 ? 0 : k + 1;
            if (at[k] != 0 && at[next] != 0) return edges_.edge(number, k);
            return edges_.count() + (at[k] == 0 ? t[k] : t[next]);
        };
        const std::uint32_t from = node(passages[above].down);
        const std::uint32_t to = node(passages[above].up);
        if (from != to && !link(from, to)) return LayerOutcome::Touching;
    }
    return LayerOutcome::Found;
}

bool LayerWalk::is_straight(std::uint32_t node) const {
    return is_edge(node) && edges_.bend(node) == SectionEdges::Bend::Straight;
}

LayerOutcome LayerWalk::find_loops() {
    corners_.clear();
    begin_.assign(1, 0);
    for (const std::uint32_t first : from_) {
        if (links_[first].layer != layer_) continue;  // it was on the way before
        std::uint32_t node = first;
        do {
            Link& l = links_[node];
            if (l.layer != layer_) return LayerOutcome::Touching;
            l.layer = 0;
            if (!is_straight(node)) corners_.push_back({node, l.side, Exactness::Unknown});
            node = l.to;
        } while (node != first);
        begin_.push_back(static_cast<std::uint32_t>(corners_.size()));
        if (begin_.back() - begin_[loop_count() - 1] < 3) return LayerOutcome::Collapsed;
    }
    return LayerOutcome::Found;
}

bool LayerWalk::is_in_rows(std::uint32_t node) const {
    if (!is_edge(node) || !takes_rows_) return false;
    if (are_all_doubles_) return true;
    const auto [p, q] = edges_.ends(node);
    return mesh_.is_double(p) && mesh_.is_double(q);
}

void LayerWalk::find_rows(double height) {
    rows_.clear();
    const auto [u, v] = mesh_.frame().axes();
    for (const Corner& c : corners_) {
        if (!is_in_rows(c.node)) {
            rows_.add_nothing();
            continue;
        }
        const auto [p, q] = edges_.ends(c.node);
        const Point3d& a = mesh_.near(p);
        const Point3d& b = mesh_.near(q);
        rows_.add({a[u], a[v]}, mesh_.level(p), {b[u], b[v]}, mesh_.level(q));
    }
    rows_.find(height);
}

void LayerWalk::find_points(double height) {
    points_.resize(corners_.size());
    find_rows(height);
    const SectionNumbers numbers(mesh_, height);
    const auto [u, v] = mesh_.frame().axes();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        Corner& corner = corners_[i];
        const auto [p, q] = name(corner.node);
        if (!rows_.is_found(i) || !is_in_rows(corner.node)) {
            points_[i] = numbers.rounded({p, q});
            if (p == q)
                corner.exactness = mesh_.is_double(p) ? Exactness::Exact : Exactness::Rounded;
            continue;
        }
        points_[i] = rows_.corner(i);
        if (rows_.was_rounded(i)) {
            corner.exactness = Exactness::Rounded;
        } else if (mesh_.near(p)[u] == mesh_.near(q)[u] && mesh_.near(p)[v] == mesh_.near(q)[v]) {
            corner.exactness = Exactness::Exact;
        }
    }
}

bool LayerWalk::goes_straight(std::size_t before, std::size_t i, std::size_t after,
                              const SectionNumbers& numbers) const {
    const std::uint32_t node = corners_[i].node;
    if (is_edge(node) && edges_.bend(node) == SectionEdges::Bend::Turns) return false;
    if (surely_turns(points_[before], points_[i], points_[after])) return false;
    return numbers.goes_straight(name(corners_[before].node), name(node),
                                 name(corners_[after].node));
}

// Corners in the plane, and those at edges of which the triangles do not show it. False where too
// few are left.
bool LayerWalk::leave_out_straight(const SectionNumbers& numbers) {
    std::vector<std::uint32_t>& straight = ordered_begin_;  // used later on
    straight.clear();
    for (std::size_t l = 0; l < loop_count(); ++l)
        for (std::size_t i = begin_[l]; i < begin_[l + 1]; ++i) {
            const std::size_t before = i == begin_[l] ? begin_[l + 1] - 1 : i - 1;
            const std::size_t after = i + 1 == begin_[l + 1] ? begin_[l] : i + 1;
            if (goes_straight(before, i, after, numbers))
                straight.push_back(static_cast<std::uint32_t>(i));
        }
    if (straight.empty()) return true;
    std::size_t kept = 0;
    std::size_t i = 0;
    auto next = straight.begin();
    for (std::size_t l = 0; l < loop_count(); ++l) {
        const std::size_t begin = kept;
        for (; i < begin_[l + 1]; ++i) {
            if (next != straight.end() && *next == i) {
                ++next;
                continue;
            }
            corners_[kept] = corners_[i];
            points_[kept++] = points_[i];
        }
        begin_[l + 1] = static_cast<std::uint32_t>(kept);
        if (kept - begin < 3) return false;
    }
    corners_.resize(kept);
    points_.resize(kept);
    return true;
}

bool LayerWalk::has_equal_neighbours() const {
    for (std::size_t l = 0; l < loop_count(); ++l) {
        const Point2d* before = &points_[begin_[l + 1] - 1];
        for (std::size_t i = begin_[l]; i < begin_[l + 1]; ++i) {
            if (points_[i] == *before) return true;
            before = &points_[i];
        }
    }
    return false;
}

void LayerWalk::put_in_order() {
    starts_.clear();
    for (std::uint32_t l = 0; l < loop_count(); ++l) {
        std::uint32_t least = begin_[l];
        for (std::uint32_t i = begin_[l]; i < begin_[l + 1]; ++i)
            if (corners_[i].side < corners_[least].side) least = i;
        starts_.push_back({corners_[least].side, l, least});
    }
    std::ranges::sort(starts_, {}, &Start::side);
    ordered_.clear();
    ordered_begin_.assign(1, 0);
    for (const Start& s : starts_) {
        const auto at = [&](std::uint32_t i) {
            return points_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        ordered_.insert(ordered_.end(), at(s.corner + 1), at(begin_[s.loop + 1]));
        ordered_.insert(ordered_.end(), at(begin_[s.loop]), at(s.corner + 1));
        ordered_begin_.push_back(static_cast<std::uint32_t>(ordered_.size()));
    }
}

bool LayerWalk::are_exact(const SectionNumbers& numbers) const {
    const auto is = [](Exactness e) { return [e](const Corner& c) { return c.exactness == e; }; };
    if (std::ranges::any_of(corners_, is(Exactness::Rounded))) return false;
    for (std::size_t i = 0; i < corners_.size(); ++i)
        if (corners_[i].exactness == Exactness::Unknown &&
            !numbers.is_exact(name(corners_[i].node), points_[i]))
            return false;
    return true;
}

// In the order of their smallest corners, so that what is below a loop is known.
bool LayerWalk::find_regions(EvaluateOptions::Winding winding, Slice& out) {
    const auto is_inside = [&](int n) {
        return winding == EvaluateOptions::Winding::Positive ? n > 0 : n != 0;
    };
    left_.assign(loop_count(), 0);
    region_.assign(loop_count(), none);
    for (const std::uint32_t l : sweep_.order()) {
        const LoopSweep::Place& place = sweep_.place(l);
        int around = 0;
        if (place.below != none) around = left_[place.below] - (place.is_on_left ? 0 : 1);
        left_[l] = around + (place.is_outline ? 1 : 0);
        if (!is_inside(left_[l]) || is_inside(left_[l] - 1)) return false;
        if (place.is_outline) {
            region_[l] = static_cast<std::uint32_t>(out.regions.size());
            out.regions.push_back({l});
        } else {
            region_[l] = region_[place.below];
            out.regions[region_[l]].push_back(l);
        }
    }
    return true;
}

// Without corners that rounding put on a line with their neighbours.
void LayerWalk::write(Slice& out) const {
    out.points.reserve(ordered_.size());
    out.loops.reserve(loop_count());
    for (std::size_t l = 0; l < loop_count(); ++l) {
        std::vector<std::uint32_t>& loop = out.loops.emplace_back();
        const std::size_t begin = ordered_begin_[l];
        const std::size_t end = ordered_begin_[l + 1];
        loop.reserve(end - begin);
        const Point2d* before = &ordered_[end - 1];
        for (std::size_t i = begin; i < end; ++i) {
            const Point2d& after = ordered_[i + 1 == end ? begin : i + 1];
            if (sweep_.turn(*before, ordered_[i], after) != 0) {
                loop.push_back(static_cast<std::uint32_t>(out.points.size()));
                out.points.push_back(ordered_[i]);
            }
            before = &ordered_[i];
        }
    }
}

LayerOutcome LayerWalk::run(const SectionPlane& plane, SliceRule rule,
                            EvaluateOptions::Winding winding, Slice& out) {
    check_stop(plane.triangles.size());
    out = {};
    out.height = plane.height;
    if (const LayerOutcome linked = link_sides(plane, rule); linked != LayerOutcome::Found)
        return linked;
    if (const LayerOutcome found = find_loops(); found != LayerOutcome::Found) return found;
    if (corners_.empty()) return LayerOutcome::Found;
    const SectionNumbers numbers(mesh_, plane.height);
    find_points(plane.height);
    if (!leave_out_straight(numbers) || has_equal_neighbours()) return LayerOutcome::Collapsed;
    put_in_order();
    if (!sweep_.run(ordered_, ordered_begin_) || !find_regions(winding, out)) {
        out.regions.clear();
        return LayerOutcome::Crossing;
    }
    write(out);
    out.is_exact = are_exact(numbers);
    return LayerOutcome::Found;
}

}  // namespace trisect::detail
