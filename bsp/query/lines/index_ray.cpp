// SPDX-License-Identifier: Apache-2.0
//
// Rays. The tree is walked from front to back with enclosures of the parameters at its splitting
// planes, so that no cell that the ray touches is missed; each polygon of a cell is tested whole,
// wherever it meets the ray. The walk for a first hit ends when every cell left begins behind the
// upper bound of a hit.
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
#include <utility>

#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/bsp/query/lines/index_handles.h>
#include <trisect/bsp/query/lines/index_path.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

struct Contact {
    PolygonId id = 0;
    LineContact contact;
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

class Walk {
public:
    Walk(const IndexCore& core, const IndexLine& line, bool first_only)
        : index_(*core.base), line_(line), first_only_(first_only) {}

    // Every polygon that the line meets, once; for a first hit, those that may be it.
    [[nodiscard]] std::vector<Contact> contacts() {
        if (line_.is_moderate()) {
            ParameterRange whole{0, line_.limit()};
            if (clipped_to_bounds(whole)) walk(0, whole);
        } else {
            visit_all();
        }
        if (first_only_)
            std::erase_if(found_, [&](const Contact& c) { return c.contact.lo > nearest_; });
        std::sort(found_.begin(), found_.end(),
                  [](const Contact& a, const Contact& b) { return a.id < b.id; });
        const auto same = [](const Contact& a, const Contact& b) { return a.id == b.id; };
        found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
        return std::move(found_);
    }

private:
    struct Pending {
        std::uint32_t node = 0;
        ParameterRange range;
    };

    // For lines whose cells doubles do not decide.
    void visit_all() {
        for_leaves(
            index_.tree, [](const DoubleBox&) { return true; },
            [this](const IndexTree::Cell& c, const DoubleBox&) {
                if (c.is_mixed()) visit(index_.tree.leaf(c.leaf));
            });
    }

    // Faces without an end may be hit beyond the bounds.
    [[nodiscard]] bool clipped_to_bounds(ParameterRange& range) const {
        const IndexTree& tree = index_.tree;
        if (!tree.is_bounded()) return true;
        for (std::size_t k = 0; k < 3; ++k) {
            if (line_.is_parallel(k)) {
                const double o = line_.origin()[k];
                const double e = line_.origin().error();
                if (o + e < tree.lo()[k] || o - e > tree.hi()[k]) return false;
                continue;
            }
            if (line_.direction()[k] == 0) continue;  // too small for a double
            const ParameterRange a = at_splitter(line_, k, tree.lo()[k], 0);
            const ParameterRange b = at_splitter(line_, k, tree.hi()[k], 0);
            const double lo = std::min(a.lo, b.lo);
            const double hi = std::max(a.hi, b.hi);
            if (lo > range.hi || hi < range.lo) return false;
            if (lo > range.lo) range.lo = lo;
            if (hi < range.hi) range.hi = hi;
        }
        return true;
    }

    // From a node on, front to back.
    void walk(std::uint32_t node, const ParameterRange& whole) {
        const std::size_t base = pending_.size();
        pending_.push_back({node, whole});
        while (pending_.size() > base) {
            Pending at = pending_.back();
            pending_.pop_back();
            if (first_only_ && at.range.lo > nearest_) continue;
            const IndexTree::Node* n = &index_.tree.node(at.node);
            while (n->has_splitter()) {
                step(*n, at);
                n = &index_.tree.node(at.node);
            }
            if (n->is_grid()) {
                walk_grid(index_.tree.grid(*n), at.range);
            } else if (n->is_mixed()) {
                visit(index_.tree.leaf(n->next));
            }
        }
    }

    void walk_grid(const IndexGrid& g, const ParameterRange& range) {
        const auto more = [&](double t) { return !first_only_ || !(t > nearest_); };
        // Faces without an end may be hit beyond the grid.
        const auto path = index_.tree.is_bounded() ? GridPath::make(g, line_, range) : std::nullopt;
        if (path) {
            path->walk(index_.tree, more, [&](std::uint32_t leaf, const GridPath::Span& span) {
                visit(index_.tree.leaf(leaf), span);
            });
            return;
        }
        const ApproximateLine line{line_.origin().approximate(), line_.direction(),
                                   line_.origin().error(), line_.direction_error()};
        for_grid_leaves_along(
            index_.tree, g, line, range.lo, range.hi, more,
            [&](std::uint32_t leaf, double, double) { visit(index_.tree.leaf(leaf)); });
    }

    // Goes to the child that the line is in first; the other one waits, if the line gets there.
    void step(const IndexTree::Node& n, Pending& at) {
        const std::size_t axis = n.axis();
        const double splitter = n.rounded_splitter();
        const double splitter_error = std::fabs(splitter) * last_place;
        if (line_.is_parallel(axis)) {
            const double d = line_.origin()[axis] - splitter;
            const double slack = splitter_error + 2 * line_.origin().error();
            if (d < -slack) {
                at.node = n.next;
            } else if (d > slack) {
                at.node = n.next + 1;
            } else {
                pending_.push_back({n.next + 1, at.range});
                at.node = n.next;
            }
            return;
        }
        const std::uint32_t far = line_.direction()[axis] > 0 ? 1 : 0;
        const ParameterRange t = at_splitter(line_, axis, splitter, splitter_error);
        if (at.range.hi < t.lo) {
            at.node = n.next + 1 - far;
        } else if (at.range.lo > t.hi) {
            at.node = n.next + far;
        } else {
            ParameterRange behind = at.range;
            if (t.lo > behind.lo) behind.lo = t.lo;
            pending_.push_back({n.next + far, behind});
            if (t.hi < at.range.hi) at.range.hi = t.hi;
            at.node = n.next + 1 - far;
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
        const LeafPlanes planes = index_.tree.planes(leaf);
        const PlaneSides a = sides_of(planes, leaf.count, span.enter);
        const PlaneSides b = sides_of(planes, leaf.count, span.leave);
        const auto listed = index_.tree.listed(leaf);
        std::uint64_t left = ~((a.above & b.above) | (a.below & b.below));
        left &= ~std::uint64_t{0} >> (64 - leaf.count);
        for (; left != 0; left &= left - 1)
            test(listed[static_cast<std::size_t>(std::countr_zero(left))]);
    }

    void visit(const IndexLeaf& leaf) {
        for (const PolygonId id : index_.tree.listed(leaf)) test(id);
    }

    void test(PolygonId id) {
        // Neighbouring cells list the same polygons; most repetitions are recent ones.
        PolygonId& recent = recent_[id % recent_.size()];
        if (recent == id) return;
        recent = id;
        const LineContact c = meet(index_.polygons, id, line_);
        if (c.kind == LineContact::Kind::None) return;
        if (first_only_) {
            if (c.lo > nearest_) return;
            // An interval begins before it ends.
            const double latest = c.kind == LineContact::Kind::Interval
                                      ? std::nextafter(std::nextafter(c.lo, HUGE_VAL), HUGE_VAL)
                                      : c.hi;
            nearest_ = std::min(nearest_, latest);
        }
        found_.push_back({id, c});
    }

    const IndexBase& index_;
    const IndexLine& line_;
    bool first_only_;
    double nearest_ = HUGE_VAL;
    std::vector<Contact> found_;
    std::vector<Pending> pending_;
    std::array<PolygonId, 64> recent_ = [] {
        std::array<PolygonId, 64> none{};
        none.fill(IndexPolygons::none);
        return none;
    }();
};

// A contact with its ends.
struct Part {
    PolygonId id = 0;
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
    Pieces(const IndexCore& core, const IndexLine& line, const std::vector<Contact>& contacts)
        : core_(core), line_(line) {
        for (const Contact& c : contacts)
            parts_.push_back({c.id, ends_of(core.polygons(), c.id, line, c.contact)});
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
        for (const Part& p : parts_) {
            at.push_back(p.ends.enter);
            at.push_back(p.ends.leave);
        }
        std::sort(at.begin(), at.end(), [](const auto& a, const auto& b) { return (a <=> b) < 0; });
        at.erase(std::unique(at.begin(), at.end()), at.end());
        // For every part the numbers of its ends; then sweep.
        std::sort(parts_.begin(), parts_.end(),
                  [](const Part& a, const Part& b) { return (a.ends.enter <=> b.ends.enter) < 0; });
        std::vector<const Part*> open;
        std::size_t next = 0;
        for (std::size_t i = 0; i < at.size(); ++i) {
            std::erase_if(open, [&](const Part* p) { return (p->ends.leave <=> at[i]) < 0; });
            while (next < parts_.size() && (parts_[next].ends.enter <=> at[i]) <= 0)
                open.push_back(&parts_[next++]);
            if (!at[i].is_infinite()) add(at[i], at[i], false, open);
            if (i + 1 == at.size()) break;
            std::vector<const Part*> going;
            for (const Part* p : open)
                if ((p->ends.leave <=> at[i + 1]) >= 0) going.push_back(p);
            if (!going.empty()) add(at[i], at[i + 1], true, going);
        }
    }

    void add(const RayParameter& enter, const RayParameter& leave, bool is_interval,
             const std::vector<const Part*>& parts) {
        LinePiece piece{enter, leave, is_interval, 0, {}};
        for (const Part* p : parts) piece.on.push_back(p->id);
        piece.rank = place_on(core_.polygons(), piece.on).face_count;
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
        std::sort(on.begin(), on.end());
        on.erase(std::unique(on.begin(), on.end()), on.end());
        h.place = place_on(core_.polygons(), on);
        h.plane = core_.polygons().outward(on.front());
        if (h.is_interval) {
            if (core_.handles) core_.handles->name(core_, h.place, on, middle(h));
        } else if (core_.handles || h.place.location == Location::OnVertex) {
            const IndexPoint p = line_.at(h.enter);
            h.place = place_on(core_.polygons(), on, p);
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
    std::vector<Part> parts_;
    std::vector<LinePiece> pieces_;
};

}  // namespace

std::vector<RayHit> all_hits(const IndexCore& core, const IndexLine& line) {
    return Pieces(core, line, Walk(core, line, false).contacts()).hits();
}

namespace {

RayHit first_of(const IndexCore& core, const IndexLine& line,
                const std::vector<Contact>& contacts) {
    // Where the line runs in a face or along an edge from the start, the end may be far away.
    const bool may_run = std::any_of(contacts.begin(), contacts.end(), [](const Contact& c) {
        return c.contact.kind == LineContact::Kind::Interval;
    });
    auto hits = may_run ? all_hits(core, line) : Pieces(core, line, contacts).hits();
    return std::move(hits.front());
}

}  // namespace

std::optional<RayHit> first_hit(const IndexCore& core, const IndexLine& line) {
    const auto contacts = Walk(core, line, true).contacts();
    if (contacts.empty()) return std::nullopt;
    if (contacts.size() == 1 && contacts.front().contact.kind == LineContact::Kind::Crossing) {
        const PolygonId id = contacts.front().id;
        RayHit h;
        h.plane = core.polygons().outward(id);
        h.enter = line.meet(h.plane);
        h.leave = h.enter;
        h.place.location = Location::OnFace;
        h.place.face_count = 1;
        h.place.faces[0] = core.polygons().face_source(id);
        if (core.handles) h.place.face = core.handles->face_of(id);
        return h;
    }
    return first_of(core, line, contacts);
}

std::optional<FacetHit> first_facet(const IndexCore& core, const IndexLine& line) {
    const auto contacts = Walk(core, line, true).contacts();
    if (contacts.empty()) return std::nullopt;
    if (contacts.size() == 1 && contacts.front().contact.kind == LineContact::Kind::Crossing) {
        const auto& [id, c] = contacts.front();
        return FacetHit{core.polygons().face_source(id), c.lo, c.hi};
    }
    const RayHit h = first_of(core, line, contacts);
    const double t = h.enter.approximate();
    const double e = h.enter.error() + std::fabs(t) * last_place;
    return FacetHit{h.place.faces[0], t - e, t + e};
}

}  // namespace trisect::detail
