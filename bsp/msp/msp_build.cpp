// SPDX-License-Identifier: Apache-2.0
//
// From a boundary to its index, after Vanecek (1991), and Thibault and Naylor (1987) for the part
// of dimension 3.
//
// Take the plane of one of the polygons in the cell, send the others to its sides, split those that
// it cuts. A classic BSP tree forgets what lies on the plane; here that is handed to a tree in the
// plane: polygons on it with their edges, the traces of polygons that are cut, edges and corners of
// polygons that touch it.
//
// What keeps that consistent is one rule: regions are open. What lies on a cut belongs to the on
// side and to no other. A part of a cut polygon still has an edge on the cut, and so has a polygon
// that merely touches it; if that edge were seen again below, it would be found on the border of
// another cut and indexed a second time, where no point can ever be located. So corners and edges
// die when a cut runs through them, and the dead are never handed on.
//
// Only planes of polygons with area in the cell cut it. Then an empty side needs no test (see
// bsp_build.cpp for the argument): below is inside, above outside. And every plane and line cuts
// its region, without a test either: the chosen polygon or segment has interior points in the open
// region.
//
// A convex solid makes a chain. Nothing recurses; and a list of polygons is kept in groups with
// boxes, so that a chain of 10^5 cuts, which passes 5·10^9 times by a polygon, is a matter of
// seconds (msp_groups.h).

#include <trisect/bsp/msp/msp_build.h>

#include <chrono>
#include <optional>
#include <utility>

#include <trisect/bsp/msp/msp_choice.h>
#include <trisect/bsp/msp/msp_groups.h>
#include <trisect/bsp/msp/msp_nodes.h>
#include <trisect/bsp/msp/msp_plane_tree.h>
#include <trisect/kernel/contract.h>

namespace trisect {

namespace detail::msp {

namespace {

using Node = MspTree::Node;
using Ref = MspTree::Ref;
using Leaf = MspTree::Leaf;

class SpaceTreeBuilder {
public:
    SpaceTreeBuilder(MspSoup& soup, const MspOptions& options)
        : geometry_(soup.geometry),
          fragments_(soup.fragments),
          options_(options),
          on_planes_(geometry_, nodes_, options_) {}

    void clip(std::span<const Plane> walls) {
        for (const Plane& wall : walls) {
            const PlaneIndex plane = geometry_.add_plane(wall);
            std::vector<Fragment> kept;
            for (Fragment& f : fragments_) {
                const Parts parts = classify(f, plane);
                if (!parts.below) continue;
                if (parts.above) {
                    kept.push_back(geometry_.cut(f, plane, sides_).below);
                } else {
                    kill_contacts(f);
                    kept.push_back(f);
                }
            }
            fragments_ = std::move(kept);
        }
    }

    NodeList& run(Leaf empty) {
        Cell all;
        for (std::size_t i = 0; i < fragments_.size(); ++i)
            add(all.fragments, static_cast<ItemIndex>(i));
        push(std::move(all), Ref::leaf(empty));
        while (!pending_.empty()) {
            Cell cell = std::move(pending_.back());
            pending_.pop_back();
            refine(std::move(cell));
        }
        return nodes_;
    }

    [[nodiscard]] std::size_t fragment_count() const { return placed_; }

private:
    struct Cell {
        Groups fragments;
        Slot slot;
    };
    class Items;

    // Also leaves the sides of the corners in sides_.
    Parts classify(const Fragment& f, PlaneIndex plane) {
        Parts parts;
        sides_.clear();
        for (const Corner& c : geometry_.corners(f)) {
            const Side s = geometry_.side(c.point, plane);
            sides_.push_back(s);
            parts.below = parts.below || s == Side::Below;
            parts.above = parts.above || s == Side::Above;
        }
        return parts;
    }
    [[nodiscard]] Side side_after(std::size_t i) const {
        return sides_[i + 1 < sides_.size() ? i + 1 : 0];
    }
    [[nodiscard]] Side side_before(std::size_t i) const {
        return sides_[i > 0 ? i - 1 : sides_.size() - 1];
    }

    void kill_contacts(const Fragment& f) {
        const auto corners = geometry_.corners(f);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (sides_[i] != Side::On) continue;
            corners[i].vertex_is_dead = true;
            if (side_after(i) == Side::On) corners[i].edge_is_dead = true;
        }
    }

    [[nodiscard]] Extent extent(const Fragment& f) const {
        Extent e;
        for (const Corner& c : geometry_.corners(f)) e.add(geometry_.approximation(c.point));
        return e;
    }
    void add(Groups& list, ItemIndex i) const {
        list.add(i, extent(fragments_[i]), fragments_[i].face.entity());
    }
    void push(Cell&& cell, Ref if_empty) {
        if (cell.fragments.is_empty()) {
            nodes_.set(cell.slot, if_empty);
        } else {
            pending_.push_back(std::move(cell));
        }
    }

    void refine(Cell&& cell);
    void send(ItemIndex i, PlaneIndex plane, Cell& below, Cell& above);
    void lay_on_plane(const Fragment& f);
    void touch_plane(const Fragment& f, int elevation);
    void cross_plane(const Fragment& f, const MspGeometry::Cut& cut);
    [[nodiscard]] Segment segment(const Fragment& f, std::size_t edge, PlaneIndex line,
                                  int elevation) const;

    MspGeometry& geometry_;
    std::vector<Fragment> fragments_;  // grows where polygons are cut; a cell names its own
    MspOptions options_;
    NodeList nodes_;
    PlaneTreeBuilder on_planes_;
    std::vector<Cell> pending_;
    PlaneContents on_plane_;
    std::vector<Side> sides_;
    std::size_t placed_ = 0;
    std::size_t turn_ = 0;  // counts cuts
};

class SpaceTreeBuilder::Items {
public:
    explicit Items(const SpaceTreeBuilder& b) : b_(b) {}
    [[nodiscard]] const Plane& plane(PlaneIndex p) const { return b_.geometry_.plane(p); }
    [[nodiscard]] PlaneIndex cut_of(ItemIndex i) const { return b_.fragments_[i].support; }
    [[nodiscard]] double size(ItemIndex i) const { return b_.extent(b_.fragments_[i]).size(); }
    template <class F>
    void points(ItemIndex i, F&& f) const {
        for (const Corner& c : b_.geometry_.corners(b_.fragments_[i]))
            f(b_.geometry_.approximation(c.point));
    }
    [[nodiscard]] Parts parts(ItemIndex i, PlaneIndex plane) const {
        Parts parts;
        const MspGeometry& geometry = b_.geometry_;
        if (b_.fragments_[i].support == plane) return parts;
        for (const Corner& c : geometry.corners(b_.fragments_[i])) {
            const Side s = geometry.side(c.point, plane);
            parts.below = parts.below || s == Side::Below;
            parts.above = parts.above || s == Side::Above;
            if (parts.is_cut()) break;
        }
        return parts;
    }

private:
    const SpaceTreeBuilder& b_;
};

void SpaceTreeBuilder::refine(Cell&& cell) {
    const Fragment chosen = fragments_[choose(cell.fragments, Items(*this), options_)];
    const PlaneIndex plane = chosen.support;
    const std::uint32_t id = nodes_.add(3, plane, cell.slot);
    Cell below{{}, {&Node::below, id}};
    Cell above{{}, {&Node::above, id}};
    on_plane_ = {{}, {}, chosen.face};
    ++turn_;
    for (Groups::Pointer& group : cell.fragments.groups()) {
        const Side side = cell.fragments.side(*group, Items(*this), geometry_.plane(plane), turn_);
        if (side == Side::On) {
            for (const ItemIndex i : group->items) send(i, plane, below, above);
        } else {
            (side == Side::Below ? below : above).fragments.add(std::move(group));
        }
    }
    on_planes_.build(plane, std::move(on_plane_), {&Node::on, id});
    push(std::move(above), Ref::leaf(Leaf::Out));
    push(std::move(below), Ref::leaf(Leaf::In));
}

void SpaceTreeBuilder::send(ItemIndex i, PlaneIndex plane, Cell& below, Cell& above) {
    const Fragment f = fragments_[i];
    if (f.support == plane) {
        lay_on_plane(f);
        return;
    }
    const Parts parts = classify(f, plane);
    if (parts.is_cut()) {
        const MspGeometry::Cut cut = geometry_.cut(f, plane, sides_);
        cross_plane(f, cut);
        fragments_[i] = cut.below;
        fragments_.push_back(cut.above);
        add(below.fragments, i);
        add(above.fragments, static_cast<ItemIndex>(fragments_.size() - 1));
    } else if (parts.below || parts.above) {
        touch_plane(f, parts.above ? 1 : -1);
        kill_contacts(f);
        add((parts.below ? below : above).fragments, i);
    } else {
        lay_on_plane(f);
    }
}

// An edge of a polygon as a segment of a plane that contains the edge.
Segment SpaceTreeBuilder::segment(const Fragment& f, std::size_t edge, PlaneIndex line,
                                  int elevation) const {
    const auto corners = geometry_.corners(f);
    const Corner& from = corners[edge];
    const Corner& to = corners[edge + 1 < corners.size() ? edge + 1 : 0];
    const BorderPoint start{from.point, from.vertex, from.vertex_is_dead};
    const BorderPoint end{to.point, to.vertex, to.vertex_is_dead};
    const bool ahead = geometry_.compare(from.point, to.point) < 0;
    // The polygon lies to the left of its edges, in the direction n × (end - start).
    return {line,
            ahead ? start : end,
            ahead ? end : start,
            {f.support, ahead ? 1 : -1, elevation, f.face, from.edge}};
}

// Edges within the face separate nothing here: the face is on both sides.
void SpaceTreeBuilder::lay_on_plane(const Fragment& f) {
    ++placed_;
    const auto corners = geometry_.corners(f);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i].edge_is_dead || corners[i].edge.kind() == Leaf::OnFace) continue;
        on_plane_.segments.push_back(segment(f, i, corners[i].edge_plane, 0));
    }
}

void SpaceTreeBuilder::touch_plane(const Fragment& f, int elevation) {
    const auto corners = geometry_.corners(f);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (sides_[i] != Side::On) continue;
        if (side_after(i) == Side::On) {
            if (!corners[i].edge_is_dead)
                on_plane_.segments.push_back(segment(f, i, f.support, elevation));
        } else if (side_before(i) != Side::On && !corners[i].vertex_is_dead) {
            on_plane_.points.push_back({{corners[i].point, corners[i].vertex, false}, f.support});
        }
    }
}

void SpaceTreeBuilder::cross_plane(const Fragment& f, const MspGeometry::Cut& cut) {
    const bool ahead = geometry_.compare(cut.ends[0].point, cut.ends[1].point) < 0;
    on_plane_.segments.push_back({f.support,
                                  cut.ends[ahead ? 0 : 1],
                                  cut.ends[ahead ? 1 : 0],
                                  {f.support, 0, 0, f.face, f.face}});
}

}  // namespace

}  // namespace detail::msp

namespace {

using detail::msp::NodeList;

/// What remains when redundant nodes are left out, and planes that no node names.
class Compaction {
public:
    Compaction(const NodeList& list, const std::vector<Plane>& planes)
        : list_(list), planes_(planes), kept_as_(list.nodes().size()) {}

    void run(std::vector<MspTree::Node>& nodes, std::vector<std::uint8_t>& dimensions,
             std::vector<Plane>& planes, MspTree::Ref& root) {
        for (std::size_t i = kept_as_.size(); i-- > 0;) {
            const MspTree::Node& n = list_.nodes()[i];
            const MspTree::Ref on = resolved(n.on);
            const bool is_needless =
                on.is_leaf() && resolved(n.below) == on && resolved(n.above) == on;
            kept_as_[i] = is_needless ? on : MspTree::Ref::node(i);
        }
        root = resolved(list_.root());
        if (root.is_leaf()) return;
        copy(root, nodes, dimensions, planes);
        root = MspTree::Ref::node(0);
    }

private:
    using Child = MspTree::Ref MspTree::Node::*;
    struct Visit {
        MspTree::Ref old;
        std::uint32_t parent;
        Child child;
    };

    [[nodiscard]] MspTree::Ref resolved(MspTree::Ref r) const {
        return r.is_leaf() ? r : kept_as_[r.index()];
    }

    // Depth first, so that a descent mostly reads on.
    void copy(MspTree::Ref root, std::vector<MspTree::Node>& nodes,
              std::vector<std::uint8_t>& dimensions, std::vector<Plane>& planes) {
        constexpr std::uint32_t unused = ~std::uint32_t{0};
        std::vector<std::uint32_t> plane_as(planes_.size(), unused);
        std::vector<Visit> pending{{root, 0, nullptr}};
        while (!pending.empty()) {
            const Visit visit = pending.back();
            pending.pop_back();
            const std::size_t id = nodes.size();
            if (visit.child != nullptr) nodes[visit.parent].*visit.child = MspTree::Ref::node(id);
            MspTree::Node node = list_.nodes()[visit.old.index()];
            dimensions.push_back(list_.dimensions()[visit.old.index()]);
            std::uint32_t& plane = plane_as[node.plane];
            if (plane == unused) {
                plane = static_cast<std::uint32_t>(planes.size());
                planes.push_back(planes_[node.plane]);
            }
            node.plane = plane;
            for (const Child child :
                 {&MspTree::Node::on, &MspTree::Node::above, &MspTree::Node::below}) {
                node.*child = resolved(node.*child);
                if (!(node.*child).is_leaf())
                    pending.push_back({node.*child, static_cast<std::uint32_t>(id), child});
            }
            nodes.push_back(node);
        }
    }

    const NodeList& list_;
    const std::vector<Plane>& planes_;
    std::vector<MspTree::Ref> kept_as_;
};

}  // namespace

MspTree MspTreeBuilder::run(detail::msp::MspSoup&& soup, std::span<const Plane> walls,
                            MspTree::Leaf empty, const MspOptions& options, Lattice lattice) {
    TRISECT_EXPECTS(options.candidates >= 1, "MSP tree: a sample of no candidates");
    const auto start = std::chrono::steady_clock::now();
    MspTree tree;
    tree.lattice_ = lattice;
    tree.faces_ = soup.face_count;
    detail::msp::SpaceTreeBuilder builder(soup, options);
    builder.clip(walls);
    tree.polygons_ = soup.fragments.size();
    const NodeList& nodes = builder.run(empty);
    tree.fragments_ = builder.fragment_count();
    Compaction(nodes, soup.geometry.planes())
        .run(tree.nodes_, tree.dimension_, tree.planes_, tree.root_);
    tree.nodes_.shrink_to_fit();
    tree.dimension_.shrink_to_fit();
    tree.planes_.shrink_to_fit();
    tree.build_seconds_ =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return tree;
}

}  // namespace trisect
