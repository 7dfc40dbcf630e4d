// SPDX-License-Identifier: Apache-2.0
//
// Rays. The tree is walked from front to back with enclosures of the parameters at its splitting
// planes, so that no cell that the ray touches is missed; each polygon of a leaf is tested whole,
// and counts where it meets the ray in the leaf's cell. The walk for a first hit ends when every
// cell left begins behind the upper bound of a hit.
//
// A line meets most polygons in an interior point, which doubles decide. What is left are rays
// through edges and vertices, along edges and in faces. There all contacts are collected, their
// ends sorted exactly, and between and at these the rank of the normals decides what the ray is on.
// Of a point and the intervals beside it that have the same rank one hit is made: the point was the
// end of a triangle, but not of a face or edge.

#include <trisect/bsp/query/lines/index_ray.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/bsp/query/lines/index_handles.h>
#include <trisect/bsp/query/lines/index_path.h>
#include <trisect/bsp/query/lines/line_in_cell.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

struct Contact {
    PolygonId id;
    LineContact contact;
    std::optional<std::uint32_t> ends;  // where they were worked out already
};

struct ParameterRange {
    double lo = 0;
    double hi = 0;
};

// The enclosure of the parameter at which the line passes a splitting plane.
ParameterRange at_splitter(const IndexLine& line, std::size_t axis, double splitter,
                           double splitter_error) {
    const double d = line.direction()[axis];
    const double t = (splitter - line.origin()[axis]) / d;
    const double e = std::fabs(t) * (0x1p-50 + line.direction_error() / std::fabs(d) * 1.01) +
                     (splitter_error + line.origin().error()) / std::fabs(d) * 1.01 + 0x1p-1000;
    return {t - e, t + e};
}

struct Contacts {
    std::vector<Contact> all;
    std::vector<ContactEnds> ends;
};

class Walk {
public:
    Walk(const IndexCore& core, const IndexLine& line, bool first_only)
        : index_(*core.base), line_(line), first_only_(first_only) {}

    // Every polygon that the line meets in its cell, once for each leaf; for a first hit, those
    // that may be it.
    [[nodiscard]] Contacts contacts() {
        if (line_.is_moderate()) {
            ParameterRange whole{0, line_.limit()};
            if (clipped_to_bounds(whole)) walk(whole);
        } else {
            visit_all();
        }
        if (first_only_)
            std::erase_if(found_, [&](const Contact& c) { return c.contact.lo > nearest_; });
        std::sort(found_.begin(), found_.end(),
                  [](const Contact& a, const Contact& b) { return a.id < b.id; });
        const auto same = [](const Contact& a, const Contact& b) { return a.id == b.id; };
        found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
        return {std::move(found_), std::move(ends_)};
    }

private:
    struct Pending {
        const CellNode* node = nullptr;
        bool turned = false;
        Cell cell;
        ParameterRange range;
    };

    // For lines whose cells doubles do not decide.
    void visit_all() {
        for_tree_leaves(
            index_, [](const DoubleBox&) { return true; },
            [this](const LeafInTree& leaf) {
                if (leaf.node.size() == 0) return;
                enter(leaf.index(), leaf.turned);
                for (IndexedLeaf::Id id = 0; id < leaf_->polygons().size(); ++id) test(id);
            });
    }

    // Faces without an end may be hit beyond the bounds.
    [[nodiscard]] bool clipped_to_bounds(ParameterRange& range) const {
        if (!index_.is_bounded()) return true;
        for (std::size_t k = 0; k < 3; ++k) {
            if (line_.is_parallel(k)) {
                const double o = line_.origin()[k];
                const double e = line_.origin().error();
                if (o + e < index_.lo()[k] || o - e > index_.hi()[k]) return false;
                continue;
            }
            if (line_.direction()[k] == 0) continue;  // too small for a double
            const ParameterRange a = at_splitter(line_, k, index_.lo()[k], 0);
            const ParameterRange b = at_splitter(line_, k, index_.hi()[k], 0);
            const double lo = std::min(a.lo, b.lo);
            const double hi = std::max(a.hi, b.hi);
            if (lo > range.hi || hi < range.lo) return false;
            if (lo > range.lo) range.lo = lo;
            if (hi < range.hi) range.hi = hi;
        }
        return true;
    }

    // Front to back.
    void walk(const ParameterRange& whole) {
        pending_.push_back({index_.root().node.get(), index_.root().complemented, Cell{}, whole});
        while (!pending_.empty()) {
            Pending at = pending_.back();
            pending_.pop_back();
            if (first_only_ && at.range.lo > nearest_) continue;
            const CellNode* n = &refined(*at.node);
            for (; !n->is_leaf(); n = &refined(*at.node)) step(*n, at);
            if (n->size() == 0) continue;
            enter(indexed_leaf(*n, at.cell), at.turned);
            walk_leaf(at.range);
        }
    }

    // The leaf of the cell tree that is next.
    void enter(const IndexedLeaf& leaf, bool turned) {
        leaf_ = &leaf;
        turned_ = turned;
        in_cell_.reset();
        recent_.fill(IndexPolygons::none);
    }

    void walk_leaf(const ParameterRange& range) {
        const IndexGrid* const g = leaf_->grid();
        if (g == nullptr) {
            if (leaf_->polygons().size() != 0) visit(leaf_->leaf(0));
            return;
        }
        const auto more = [&](double t) { return !first_only_ || !(t > nearest_); };
        // Faces without an end may be hit beyond the grid.
        const auto path = index_.is_bounded() ? GridPath::make(*g, line_, range) : std::nullopt;
        if (path) {
            path->walk(*leaf_, more, [&](std::uint32_t leaf, const GridPath::Span& span) {
                visit(leaf_->leaf(leaf), span);
            });
            return;
        }
        const ApproximateLine line{line_.origin().approximate(), line_.direction(),
                                   line_.origin().error(), line_.direction_error()};
        for_grid_leaves_along(
            *leaf_, line, range.lo, range.hi, more,
            [&](std::uint32_t leaf, double, double) { visit(leaf_->leaf(leaf)); });
    }

    static void enter_child(const CellNode& n, int side, Pending& at) {
        const CellRef& child = n.child(side);
        at.node = child.node.get();
        at.turned = at.turned != child.complemented;
        (side == 0 ? at.cell.hi : at.cell.lo)[static_cast<std::size_t>(n.axis())] = n.splitter();
    }

    // Goes to the child that the line is in first; the other one waits, if the line gets there.
    void step(const CellNode& n, Pending& at) {
        const auto axis = static_cast<std::size_t>(n.axis());
        const double splitter = rounded_position(n.splitter());
        const double splitter_error = std::fabs(splitter) * last_place;
        const auto wait = [&](int side, const ParameterRange& range) {
            Pending other = at;
            other.range = range;
            enter_child(n, side, other);
            pending_.push_back(other);
        };
        if (line_.is_parallel(axis)) {
            const double d = line_.origin()[axis] - splitter;
            const double slack = splitter_error + 2 * line_.origin().error();
            if (d >= -slack && d <= slack) wait(1, at.range);
            enter_child(n, d > slack ? 1 : 0, at);
            return;
        }
        const int far = line_.direction()[axis] > 0 ? 1 : 0;
        const ParameterRange t = at_splitter(line_, axis, splitter, splitter_error);
        if (at.range.hi < t.lo) {
            enter_child(n, 1 - far, at);
        } else if (at.range.lo > t.hi) {
            enter_child(n, far, at);
        } else {
            ParameterRange behind = at.range;
            if (t.lo > behind.lo) behind.lo = t.lo;
            wait(far, behind);
            if (t.hi < at.range.hi) at.range.hi = t.hi;
            enter_child(n, 1 - far, at);
        }
    }

    // A polygon has something in common with the part of the line in its cell only if the ends of
    // that are not surely on one side of its plane.
    void visit(const IndexLeaf& leaf, const GridPath::Span& span) {
        if (!leaf.has_planes() || leaf.count > 64 || !span.is_near()) {
            visit(leaf);
            return;
        }
        detail::counters_of_thread<PredicateCounters>.filtered += 2 * std::uint64_t{leaf.count};
        const LeafPlanes planes = leaf_->planes(leaf);
        const PlaneSides a = sides_of(planes, leaf.count, span.enter);
        const PlaneSides b = sides_of(planes, leaf.count, span.leave);
        const auto listed = leaf_->listed(leaf);
        std::uint64_t left = ~((a.above & b.above) | (a.below & b.below));
        left &= ~std::uint64_t{0} >> (64 - leaf.count);
        for (; left != 0; left &= left - 1)
            test(listed[static_cast<std::size_t>(std::countr_zero(left))]);
    }

    void visit(const IndexLeaf& leaf) {
        for (const IndexedLeaf::Id id : leaf_->listed(leaf)) test(id);
    }

    void test(IndexedLeaf::Id id) {
        // Neighbouring cells list the same polygons; most repetitions are recent ones.
        IndexedLeaf::Id& recent = recent_[id % recent_.size()];
        if (recent == id) return;
        recent = id;
        const IndexPolygons& polygons = leaf_->polygons();
        LineContact c = meet(polygons, id, line_);
        if (c.kind == LineContact::Kind::None) return;
        std::optional<std::uint32_t> ends;
        if (polygons.reaches_out(id)) {
            if (first_only_ && c.lo > nearest_) return;
            if (!in_cell_) in_cell_.emplace(line_, polygons.cell());
            if (c.kind != LineContact::Kind::Interval) {
                if (!in_cell_->contains(polygons, id, c)) return;
            } else {
                const auto clipped = in_cell_->clipped(polygons, id, c);
                if (!clipped) return;
                c.lo = clipped->enter.approximate() - clipped->enter.error();
                ends = static_cast<std::uint32_t>(ends_.size());
                ends_.push_back(*clipped);
            }
        }
        if (first_only_) {
            if (c.lo > nearest_) return;
            // An interval begins before it ends.
            double latest = c.hi;
            if (ends) {
                latest = ends_.back().enter.approximate() + ends_.back().enter.error();
            } else if (c.kind == LineContact::Kind::Interval) {
                latest = std::nextafter(std::nextafter(c.lo, HUGE_VAL), HUGE_VAL);
            }
            nearest_ = std::min(nearest_, latest);
        }
        found_.push_back({{leaf_, id, turned_}, c, ends});
    }

    const IndexBase& index_;
    const IndexLine& line_;
    bool first_only_;
    double nearest_ = HUGE_VAL;
    std::vector<Contact> found_;
    std::vector<ContactEnds> ends_;
    std::vector<Pending> pending_;
    const IndexedLeaf* leaf_ = nullptr;
    bool turned_ = false;
    std::optional<LineInCell> in_cell_;  // of the leaf
    std::array<IndexedLeaf::Id, 64> recent_{};
};

// A contact with its ends.
struct RayPart {
    PolygonId id;
    ContactEnds ends;
};

// The line from one end of a part to the next: a point or an open interval.
struct LinePiece {
    RayParameter enter;
    RayParameter leave;
    bool is_interval = false;
    int rank = 0;
    std::vector<PolygonId> on;
};

class Pieces {
public:
    Pieces(const IndexCore& core, const IndexLine& line, const Contacts& contacts)
        : core_(core), line_(line) {
        for (const Contact& c : contacts.all)
            parts_.push_back({c.id, c.ends ? contacts.ends[*c.ends]
                                           : ends_of(c.id.all(), c.id.number, line, c.contact)});
    }

    [[nodiscard]] std::vector<RayHit> hits() {
        cut();
        std::vector<RayHit> out;
        for (std::size_t i = 0; i < pieces_.size();) {
            std::size_t end = i + 1;
            while (end < pieces_.size() && continues(pieces_[end - 1], pieces_[end])) ++end;
            out.push_back(hit(i, end));
            i = end;
        }
        return out;
    }

private:
    void cut() {
        std::vector<RayParameter> at;
        for (const RayPart& p : parts_) {
            at.push_back(p.ends.enter);
            at.push_back(p.ends.leave);
        }
        std::sort(at.begin(), at.end(), [](const auto& a, const auto& b) { return (a <=> b) < 0; });
        at.erase(std::unique(at.begin(), at.end()), at.end());
        // For every part the numbers of its ends; then sweep.
        std::sort(parts_.begin(), parts_.end(), [](const RayPart& a, const RayPart& b) {
            return (a.ends.enter <=> b.ends.enter) < 0;
        });
        std::vector<const RayPart*> open;
        std::size_t next = 0;
        for (std::size_t i = 0; i < at.size(); ++i) {
            std::erase_if(open, [&](const RayPart* p) { return (p->ends.leave <=> at[i]) < 0; });
            while (next < parts_.size() && (parts_[next].ends.enter <=> at[i]) <= 0)
                open.push_back(&parts_[next++]);
            if (!at[i].is_infinite()) add(at[i], at[i], false, open);
            if (i + 1 == at.size()) break;
            std::vector<const RayPart*> going;
            for (const RayPart* p : open)
                if ((p->ends.leave <=> at[i + 1]) >= 0) going.push_back(p);
            if (!going.empty()) add(at[i], at[i + 1], true, going);
        }
    }

    void add(const RayParameter& enter, const RayParameter& leave, bool is_interval,
             const std::vector<const RayPart*>& parts) {
        LinePiece piece{enter, leave, is_interval, 0, {}};
        for (const RayPart* p : parts) piece.on.push_back(p->id);
        piece.rank = place_on(piece.on).face_count;
        pieces_.push_back(std::move(piece));
    }

    // Pieces that follow each other and are on one face or edge. The polygons of an interval
    // contain its ends, so planes at the end are the same when there are no more dimensions.
    [[nodiscard]] bool continues(const LinePiece& a, const LinePiece& b) const {
        return a.is_interval != b.is_interval && a.rank == b.rank &&
               (a.is_interval ? a.leave : a.enter) == b.enter;
    }

    [[nodiscard]] RayHit hit(std::size_t begin, std::size_t end) const {
        RayHit h;
        h.enter = pieces_[begin].enter;
        h.leave = pieces_[end - 1].leave;
        std::vector<PolygonId> on;
        for (std::size_t i = begin; i < end; ++i) {
            on.insert(on.end(), pieces_[i].on.begin(), pieces_[i].on.end());
            h.is_interval = h.is_interval || pieces_[i].is_interval;
        }
        sort_unique(on);
        h.place = place_on(on);
        h.plane = on.front().outward();
        if (h.is_interval) {
            if (core_.handles) core_.handles->name(core_, h.place, on, middle(h));
        } else if (core_.handles || h.place.location == Location::OnVertex) {
            const IndexPoint p = line_.at(h.enter);
            h.place = place_on(on, p);
            if (core_.handles) core_.handles->name(core_, h.place, on, p);
        }
        return h;
    }

    [[nodiscard]] IndexPoint middle(const RayHit& h) const {
        const ExactRational t = h.leave.is_infinite()
                                    ? h.enter.exact() + ExactRational(1)
                                    : (h.enter.exact() + h.leave.exact()) / ExactRational(2);
        return line_.at(t);
    }

    const IndexCore& core_;
    const IndexLine& line_;
    std::vector<RayPart> parts_;
    std::vector<LinePiece> pieces_;
};

}  // namespace

std::vector<RayHit> all_hits(const IndexCore& core, const IndexLine& line) {
    return Pieces(core, line, Walk(core, line, false).contacts()).hits();
}

namespace {

RayHit first_of(const IndexCore& core, const IndexLine& line, const Contacts& contacts) {
    // Where the line runs in a face or along an edge from the start, the end may be far away.
    const bool may_run =
        std::any_of(contacts.all.begin(), contacts.all.end(),
                    [](const Contact& c) { return c.contact.kind == LineContact::Kind::Interval; });
    auto hits = may_run ? all_hits(core, line) : Pieces(core, line, contacts).hits();
    return std::move(hits.front());
}

bool is_one_crossing(const Contacts& contacts) {
    return contacts.all.size() == 1 &&
           contacts.all.front().contact.kind == LineContact::Kind::Crossing;
}

}  // namespace

std::optional<RayHit> first_hit(const IndexCore& core, const IndexLine& line) {
    const auto contacts = Walk(core, line, true).contacts();
    if (contacts.all.empty()) return std::nullopt;
    if (is_one_crossing(contacts)) {
        const PolygonId id = contacts.all.front().id;
        RayHit h;
        h.plane = id.outward();
        h.enter = line.meet(h.plane);
        h.leave = h.enter;
        h.place.location = Location::OnFace;
        h.place.face_count = 1;
        h.place.faces[0] = id.face_source();
        if (core.handles) h.place.face = core.handles->face_of(id);
        return h;
    }
    return first_of(core, line, contacts);
}

std::optional<FacetHit> first_facet(const IndexCore& core, const IndexLine& line) {
    const auto contacts = Walk(core, line, true).contacts();
    if (contacts.all.empty()) return std::nullopt;
    if (is_one_crossing(contacts)) {
        const auto& [id, c, ends] = contacts.all.front();
        return FacetHit{id.face_source(), c.lo, c.hi};
    }
    const RayHit h = first_of(core, line, contacts);
    const double t = h.enter.approximate();
    const double e = h.enter.error() + std::fabs(t) * last_place;
    return FacetHit{h.place.faces[0], t - e, t + e};
}

}  // namespace trisect::detail
