// SPDX-License-Identifier: Apache-2.0
//
// Meshes that are moved by less than any number have a boundary in general position. Moved back, it
// is a sum of parts of planes (a 2-chain), and that sum is the boundary of the exact set: whatever
// has no thickness bounds itself on both sides. In a plane a sum of parts is known by the sum of
// their directed edges. Of two parts A and B that face opposite ways the sum is A without B, and B
// without A: edges of A in the inside of B become edges of B, those of B in A edges of A, and where
// both have an edge with the parts on the same side of it, it vanishes. So it takes no geometry but
// points in which edges cross, and whether an edge is inside a part. One pair after the other may
// be taken, in any order.

#include <trisect/bsp/assembly/parts/sheets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include <trisect/bsp/assembly/parts/crossing_faces.h>
#include <trisect/bsp/assembly/parts/edge_splitter.h>
#include <trisect/bsp/assembly/parts/facet_boxes.h>
#include <trisect/bsp/cells/near_points.h>
#include <trisect/kernel/number/triangle_normal.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

class Sheets {
public:
    Sheets(BoundaryParts& parts, PoolVector<PointId>& representatives, BoundaryEdges& edges)
        : parts_(parts), bench_(parts.bench), representatives_(representatives), edges_(edges) {}

    [[nodiscard]] bool remove() {
        list_outlines();
        find_pairs();
        if (opposite_.empty()) return true;
        if (make_crossings()) split_edges();
        for (Outline& o : outlines_) {
            if (!o.has_opposite) continue;
            o.left.assign(edges_.begin() + o.first, edges_.begin() + o.end);
            cancel_slits(o.left);
        }
        for (const auto& [a, b] : opposite_)
            if (!remove_common(outlines_[a], outlines_[b])) return false;
        BoundaryEdges out;
        out.reserve(edges_.size());
        for (const Outline& o : outlines_) {
            const Edges edges = o.has_opposite ? Edges(o.left) : edges_of(o);
            out.insert(out.end(), edges.begin(), edges.end());
        }
        edges_.swap(out);
        return true;
    }

private:
    using Edges = std::span<const BoundaryEdge>;
    // What there is of a facet.
    struct Outline {
        std::int32_t facet = -1;
        bool has_opposite = false;
        FacetBox box;
        std::ptrdiff_t first = 0;  // of its edges
        std::ptrdiff_t end = 0;
        BoundaryEdges left;  // where it has an opposite, so far
    };
    // Numbers of outlines.
    struct OfPlane {
        PlaneId plane = -1;                               // of one of them
        std::array<PoolVector<std::uint32_t>, 2> facing;  // as that one does, or the other way
    };
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    enum class Fate : std::uint8_t { Unknown, Stays, Vanishes, GoesOver };

    [[nodiscard]] const BoundaryFacet& facet(const Outline& o) const {
        return parts_.facets[as_index(o.facet)];
    }
    [[nodiscard]] Edges edges_of(const Outline& o) const {
        return Edges(edges_.data() + o.first, edges_.data() + o.end);
    }
    void list_outlines();
    void list_edges();
    [[nodiscard]] double plane_number(const Outline& o, double extent) const;
    void find_pairs();
    void add_to_plane(PoolVector<OfPlane>& planes, std::uint32_t number) const;
    void find_pairs(const OfPlane& plane);
    void list_meeting(std::span<const std::uint32_t> some, std::span<const std::uint32_t> others,
                      PoolVector<Pair>& out);
    [[nodiscard]] bool make_crossings();
    void cross_edges(const Outline& a, const Outline& b);
    void cross(const Outline& a, const BoundaryEdge& e, const BoundaryEdge& f);
    void merge_crossings(std::size_t first);
    void split_edges();
    static void cancel_slits(BoundaryEdges& edges);
    [[nodiscard]] bool remove_common(Outline& a, Outline& b);
    static void match_edges(Edges a, Edges b, std::span<Fate> of_a, std::span<Fate> of_b);
    [[nodiscard]] bool decide(const Outline& own, const Outline& other, std::span<Fate> fates);
    void list_apart(const Outline& own, const Outline& other);
    void spread(Edges edges, std::uint32_t first, Fate fate, std::span<Fate> fates);
    static void distribute(Edges own, std::span<const Fate> fates, BoundaryEdges& to_own,
                           BoundaryEdges& to_other, std::int32_t other);
    [[nodiscard]] std::optional<bool> is_inside(const BoundaryEdge& edge,
                                                const Outline& outline) const;
    [[nodiscard]] FacetBox box_of(const BoundaryEdge& e) const {
        FacetBox box;
        box.add(bench_.approximation(e.from));
        box.add(bench_.approximation(e.to));
        return box;
    }

    BoundaryParts& parts_;
    Workbench& bench_;
    PoolVector<PointId>& representatives_;
    BoundaryEdges& edges_;
    PoolVector<Outline> outlines_;
    PoolVector<Pair> opposite_;   // facets of one plane that face opposite ways
    PoolVector<Pair> alongside_;  // and those that face the same way
    PoolVector<PointId> crossings_;
    // Of two outlines:
    PoolVector<PointId> common_;  // vertices of the other one
    std::vector<std::pair<PointId, std::uint32_t>> apart_;
};

// Edges of one facet follow each other.
void Sheets::list_outlines() {
    for (const BoundaryEdge& e : edges_) {
        if (outlines_.empty() || outlines_.back().facet != e.facet)
            outlines_.emplace_back().facet = e.facet;
        outlines_.back().box.add(bench_.approximation(e.from));
    }
    list_edges();
}

void Sheets::list_edges() {
    std::ptrdiff_t at = 0;
    const auto count = std::ssize(edges_);
    for (Outline& o : outlines_) {
        o.first = at;
        while (at < count && edges_[as_index(at)].facet == o.facet) ++at;
        o.end = at;
    }
}

// The same for planes that are the same, but for rounding; mostly another one for others.
// Normals from corners are taken where they have about as many digits as those of planes.
double Sheets::plane_number(const Outline& o, double extent) const {
    constexpr Vector3 any{0.6180339887, 0.7320508076, 0.4142135624};
    const auto number = [&](const Vector3& n, double offset) {
        return std::fabs(dot(any, n) + 0.2360679775 * offset / extent) / length(n);
    };
    const BoundaryFacet& f = facet(o);
    if (!f.source->is_half_space()) {
        const Vector3 corner = f.source->corner(f.facet, 0).doubles();
        const TriangleNormal normal(corner, f.source->corner(f.facet, 1).doubles(),
                                    f.source->corner(f.facet, 2).doubles());
        const double longest = largest_component(normal.n);
        const double off = 3 * (largest_component(normal.error) + 0x1p-50 * longest);
        if (off * std::max(extent, largest_component(corner)) <= 0x1p-44 * longest * extent)
            return number(normal.n, -dot(normal.n, corner));
    }
    const Plane& p = bench_.plane_at(f.support);
    return number({p.approx_normal(0), p.approx_normal(1), p.approx_normal(2)}, p.approx_offset());
}

// Facets by their planes.
void Sheets::find_pairs() {
    double extent = 1;
    for (const Outline& o : outlines_)
        for (std::size_t k = 0; k < 3; ++k)
            extent = std::max({extent, std::fabs(o.box.lo[k]), std::fabs(o.box.hi[k])});
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < outlines_.size(); ++i)
        order.emplace_back(plane_number(outlines_[i], extent), i);
    std::ranges::sort(order);
    constexpr double rounding = 1e-12;
    PoolVector<OfPlane> planes;
    for (std::size_t i = 0; i < order.size();) {
        if (i + 1 == order.size() || order[i + 1].first - order[i].first > rounding) {
            ++i;  // alone
            continue;
        }
        planes.clear();
        do add_to_plane(planes, order[i].second);
        while (++i < order.size() && order[i].first - order[i - 1].first <= rounding);
        for (const OfPlane& p : planes) find_pairs(p);
    }
    std::ranges::sort(opposite_);
    std::ranges::sort(alongside_);
}

void Sheets::add_to_plane(PoolVector<OfPlane>& planes, std::uint32_t number) const {
    const BoundaryFacet& f = facet(outlines_[number]);
    const Plane& plane = bench_.plane_at(f.support);
    auto known = std::ranges::find_if(planes, [&](const OfPlane& p) {
        return bench_.plane_class(p.plane) == bench_.plane_class(f.support) ||
               is_same_plane(bench_.plane_at(p.plane), plane);
    });
    if (known == planes.end()) known = planes.insert(known, {f.support, {}});
    const bool is_up = same_orientation(bench_.plane_at(known->plane), plane) != f.flipped;
    known->facing[is_up ? 0 : 1].push_back(number);
}

void Sheets::find_pairs(const OfPlane& plane) {
    if (plane.facing[0].empty() || plane.facing[1].empty()) return;
    list_meeting(plane.facing[0], plane.facing[1], opposite_);
    std::array<PoolVector<std::uint32_t>, 2> some = plane.facing;
    for (auto& all : some) {
        std::erase_if(all, [&](std::uint32_t i) { return !outlines_[i].has_opposite; });
        list_meeting(all, all, alongside_);
    }
}

void Sheets::list_meeting(std::span<const std::uint32_t> some,
                          std::span<const std::uint32_t> others, PoolVector<Pair>& out) {
    PoolVector<FacetBox> boxes;
    for (const std::uint32_t i : some) {
        boxes.push_back(outlines_[i].box);
        boxes.back().facet = static_cast<std::int32_t>(i);
    }
    const FacetBoxes all(std::move(boxes));
    for (const std::uint32_t j : others)
        all.for_each_meeting(outlines_[j].box, [&](std::int32_t number) {
            const auto i = static_cast<std::uint32_t>(number);
            if (some.data() == others.data() && i >= j) return;
            out.emplace_back(std::min(i, j), std::max(i, j));
            outlines_[i].has_opposite = outlines_[j].has_opposite = true;
        });
}

// Whether there are some.
bool Sheets::make_crossings() {
    const std::size_t first = bench_.point_count();
    for (const auto* const pairs : {&opposite_, &alongside_})
        for (const auto& [a, b] : *pairs) cross_edges(outlines_[a], outlines_[b]);
    if (crossings_.empty()) return false;
    merge_crossings(first);
    return true;
}

void Sheets::cross_edges(const Outline& a, const Outline& b) {
    for (const BoundaryEdge& e : edges_of(a)) {
        const FacetBox box = box_of(e);
        if (!box.meets(b.box)) continue;
        for (const BoundaryEdge& f : edges_of(b))
            if (box.meets(box_of(f))) cross(a, e, f);
    }
}

// No vertex lies inside an edge so far.
void Sheets::cross(const Outline& a, const BoundaryEdge& e, const BoundaryEdge& f) {
    if (e.from == f.from || e.from == f.to || e.to == f.from || e.to == f.to) return;
    const int from = bench_.side(e.from, f.line.plane);
    if (from == 0 || bench_.side(e.to, f.line.plane) != -from) return;
    const int start = bench_.side(f.from, e.line.plane);
    if (start == 0 || bench_.side(f.to, e.line.plane) != -start) return;
    crossings_.push_back(bench_.meet(facet(a).support, e.line.plane, f.line.plane));
}

void Sheets::merge_crossings(std::size_t first) {
    for (std::size_t p = first; p < bench_.point_count(); ++p)
        representatives_.push_back(static_cast<PointId>(p));
    PoolVector<PointId> values;
    for_each_near_group(bench_, [&](std::span<const PointId> group) {
        if (as_index(group.back()) < first) return;
        values.clear();
        for (const PointId p : group) {
            if (as_index(p) < first) {
                if (representatives_[as_index(p)] == p) values.push_back(p);
                continue;
            }
            const auto value =
                std::ranges::find_if(values, [&](PointId v) { return bench_.same_point(v, p); });
            if (value == values.end()) {
                values.push_back(p);
            } else {
                representatives_[as_index(p)] = *value;
            }
        }
    });
}

// Nothing else lies inside an edge.
void Sheets::split_edges() {
    EdgeSplitter splitter(bench_, parts_.facets);
    for (const PointId p : crossings_) splitter.add_candidate(representatives_[as_index(p)]);
    BoundaryEdges out;
    splitter.split(edges_, out);
    edges_.swap(out);
    list_edges();
}

// Takes out edges that the facet has in both directions, at strips without a width, and sorts by
// the ends.
void Sheets::cancel_slits(BoundaryEdges& edges) {
    std::ranges::stable_sort(edges, {}, [](const BoundaryEdge& e) { return ends_of(e); });
    std::size_t left = 0;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t j = i;
        std::ptrdiff_t up = 0;
        for (; j < edges.size() && ends_of(edges[j]) == ends_of(edges[i]); ++j)
            up += edges[j].from < edges[j].to ? 1 : -1;
        for (; i < j; ++i) {
            const bool is_up = edges[i].from < edges[i].to;
            if (up == 0 || is_up != (up > 0)) continue;
            up -= is_up ? 1 : -1;
            edges[left++] = edges[i];
        }
    }
    edges.resize(left);
}

// No edge ends or begins inside another one, so that each is inside the other outline, or outside,
// all along.
bool Sheets::remove_common(Outline& a, Outline& b) {
    if (a.left.empty() || b.left.empty()) return true;
    std::vector<Fate> of_a(a.left.size(), Fate::Unknown);
    std::vector<Fate> of_b(b.left.size(), Fate::Unknown);
    match_edges(a.left, b.left, of_a, of_b);
    if (!decide(a, b, of_a) || !decide(b, a, of_b)) return false;
    const auto stays = [](Fate fate) { return fate == Fate::Stays; };
    if (std::ranges::all_of(of_a, stays) && std::ranges::all_of(of_b, stays)) return true;
    BoundaryEdges new_a;
    BoundaryEdges new_b;
    distribute(a.left, of_a, new_a, new_b, b.facet);
    distribute(b.left, of_b, new_b, new_a, a.facet);
    cancel_slits(new_a);
    cancel_slits(new_b);
    a.left = std::move(new_a);
    b.left = std::move(new_b);
    return true;
}

// Those that both have. With the parts on the same side they run against each other.
// Both are sorted by their ends.
void Sheets::match_edges(Edges a, Edges b, std::span<Fate> of_a, std::span<Fate> of_b) {
    std::size_t j = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::uint64_t ends = ends_of(a[i]);
        while (j < b.size() && ends_of(b[j]) < ends) ++j;
        if (j == b.size()) return;
        if (ends_of(b[j]) != ends) continue;
        of_a[i] = of_b[j] = b[j].from == a[i].to ? Fate::Vanishes : Fate::Stays;
    }
}

bool Sheets::decide(const Outline& own, const Outline& other, std::span<Fate> fates) {
    list_apart(own, other);
    for (std::uint32_t i = 0; i < fates.size(); ++i) {
        if (fates[i] != Fate::Unknown) continue;
        const std::optional<bool> inside = is_inside(own.left[i], other);
        if (!inside) return false;
        spread(own.left, i, *inside ? Fate::GoesOver : Fate::Stays, fates);
    }
    return true;
}

// Vertices of an outline that the other one does not have, with their edges.
void Sheets::list_apart(const Outline& own, const Outline& other) {
    common_.clear();
    for (const BoundaryEdge& e : other.left) common_.push_back(e.from);
    std::ranges::sort(common_);
    apart_.clear();
    for (std::uint32_t i = 0; i < own.left.size(); ++i)
        for (const PointId p : {own.left[i].from, own.left[i].to})
            if (!std::ranges::binary_search(common_, p)) apart_.emplace_back(p, i);
    std::ranges::sort(apart_);
}

// What goes on at a vertex that the other outline does not have stays on the same side of that.
void Sheets::spread(Edges edges, std::uint32_t first, Fate fate, std::span<Fate> fates) {
    fates[first] = fate;
    PoolVector<std::uint32_t> found{first};
    while (!found.empty()) {
        const BoundaryEdge& e = edges[found.back()];
        found.pop_back();
        for (const PointId p : {e.from, e.to}) {
            auto at = std::ranges::lower_bound(apart_, std::pair(p, std::uint32_t{0}));
            for (; at != apart_.end() && at->first == p; ++at)
                if (std::exchange(fates[at->second], fate) == Fate::Unknown)
                    found.push_back(at->second);
        }
    }
}

void Sheets::distribute(Edges own, std::span<const Fate> fates, BoundaryEdges& to_own,
                        BoundaryEdges& to_other, std::int32_t other) {
    for (std::size_t i = 0; i < fates.size(); ++i) {
        BoundaryEdge e = own[i];
        if (fates[i] == Fate::Stays) to_own.push_back(e);
        if (fates[i] != Fate::GoesOver) continue;
        e.facet = other;
        e.line.above = !e.line.above;
        to_other.push_back(e);
    }
}

// If the line of the edge, beyond one of its ends, meets the outline an odd number of times.
// Nothing where the outline runs through the edge.
std::optional<bool> Sheets::is_inside(const BoundaryEdge& edge, const Outline& outline) const {
    if (!box_of(edge).meets(outline.box)) return false;
    const PlaneId across = edge.line.plane;
    bool inside = false;
    for (const BoundaryEdge& e : outline.left) {
        const int from = bench_.side(e.from, across);
        const int to = bench_.side(e.to, across);
        if (from == to) continue;
        const int a = bench_.side(edge.from, e.line.plane);
        const int b = bench_.side(edge.to, e.line.plane);
        if (a == -b) return std::nullopt;
        if ((from > 0) == (to > 0)) continue;
        const bool is_up = to > from;
        const bool is_beside_part = (a + b > 0) == e.line.above;
        if (is_up == is_beside_part) inside = !inside;
    }
    return inside;
}

}  // namespace

bool remove_sheets(BoundaryParts& parts, PoolVector<PointId>& representatives,
                   BoundaryEdges& edges) {
    return Sheets(parts, representatives, edges).remove();
}

}  // namespace trisect::detail
