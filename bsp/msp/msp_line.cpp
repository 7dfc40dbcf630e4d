// SPDX-License-Identifier: Apache-2.0
//
// What lies on a line and beside it, from what touches the line alone.
//
// A region of a plane is cut by a line that carries some segment: an edge in the plane, or the
// trace of a face that crosses it. Leaves have to be labelled that no segment reaches: the rest of
// the line, and the parts of the region on which nothing is left. The naive way takes a sample
// point of each and queries an oracle. But a point inside an arbitrary cell has no name that is as
// short as the planes', and an oracle costs as much as the tree that is being built.
//
// Everything can be seen from the line itself instead.
//
//   Beside a segment. Perpendicular to the line, the polygons that touch it are rays, and any
//   direction lies in a wedge between two of them, or on one. On one: the plane continues as that
//   face. In a wedge: the next ray counter-clockwise bounds it, and whether the wedge is inside is
//   decided by the side of that face which looks into it. It needs signs of cross and dot products
//   of normals only (as in brep/radial_order.cpp).
//
//   Beyond a segment's end, where the line goes on and nothing lies on it. Around the end, within
//   the plane, segments are rays again. Turn from the segment to the line's continuation on the
//   left: if there is no ray on the way, the label beside the segment is still the label; otherwise
//   it is the one beside the last ray, on the side that is met first from the continuation. All
//   rays at points of the line are known, since whatever leaves the line to the left was found
//   touching or crossing it when the region was cut. So labels walk along the line, from a segment
//   outward.
//
// One thing cannot be seen from contacts. A polygon that touches the plane along its edge, a ridge
// from below or a wedge that stands on its edge, may touch it in the middle of a face that lies in
// the plane. That face has no edge here, so it is missing among the contacts, and they seem to say
// that outside or inside is all around. Then as many of the polygons that touch from above leave
// the edge as arrive, an even number. So these contacts settle the matter: a polygon that lies in
// the plane or crosses it (no face of the plane goes on behind it), and an odd number that touch
// from above. Others change nothing: what is on one side is on the other. Lines are chosen by
// polygons that lie in the plane or cross it, as long as there are any; if there are none, no face
// in the plane ends in the region, so it contains all of it or nothing, as decided before.
//
// A part of the region on which no segment is left is all alike, and what it is was seen from the
// line that cut it off. This is the rule of Thibault and Naylor (1987) for the empty side of a
// plane, one dimension lower; as there, it holds because the line was chosen by a segment in this
// very region.
//
// Source of the structure: Vanecek (1991). His labelling is not described in what we could read;
// the above is ours.

#include <trisect/bsp/msp/msp_line.h>

#include <algorithm>
#include <utility>

#include <trisect/kernel/contract.h>

namespace trisect::detail::msp {

namespace {

/// Orders directions sense · n of planes through one line counter-clockwise about its direction.
class Turn {
public:
    Turn(const MspGeometry& geometry, PlaneIndex from, int from_sense, int axis)
        : geometry_(geometry), from_(from), from_sense_(from_sense), axis_(axis) {}

    /// 0 for the direction itself, 1 within the half turn after it, 2 opposite, 3 behind.
    [[nodiscard]] int quarter(PlaneIndex plane, int sense) const {
        const int c = cross(from_, plane) * from_sense_ * sense;
        if (c != 0) return c > 0 ? 1 : 3;
        return dot(from_, plane) * from_sense_ * sense > 0 ? 0 : 2;
    }
    /// Whether direction a comes before b. \pre neither is the direction itself.
    [[nodiscard]] bool is_before(PlaneIndex a, int sense_a, PlaneIndex b, int sense_b) const {
        const int qa = quarter(a, sense_a);
        const int qb = quarter(b, sense_b);
        if (qa != qb) return qa < qb;
        return cross(a, b) * sense_a * sense_b > 0;
    }

private:
    [[nodiscard]] int cross(PlaneIndex a, PlaneIndex b) const {
        if (a == b) return 0;
        return sign_of_cross(geometry_.plane(a), geometry_.plane(b), axis_);
    }
    [[nodiscard]] int dot(PlaneIndex a, PlaneIndex b) const {
        return a == b ? 1 : sign_of_dot(geometry_.plane(a), geometry_.plane(b));
    }

    const MspGeometry& geometry_;
    PlaneIndex from_;
    int from_sense_;
    int axis_;
};

}  // namespace

LineFrame line_frame(const MspGeometry& geometry, PlaneIndex plane, PlaneIndex cut) {
    for (int axis = 0; axis < 3; ++axis) {
        const int s = sign_of_cross(geometry.plane(plane), geometry.plane(cut), axis);
        if (s != 0) return {plane, cut, axis, s};
    }
    TRISECT_EXPECTS(false, "MSP tree: a line of two parallel planes");
    return {};
}

// The label of the region beside a line, where the given contacts meet it. side: 1 left, -1 right.
Label MspLine::beside(const LineFrame& line, std::span<const Contact> contacts, int side) const {
    // Left is n_plane × t: the direction that a polygon of this plane with sense 1 goes.
    const Turn turn(geometry_, line.plane, side, line.axis);
    const Contact* next = nullptr;
    int next_sense = 0;
    for (const Contact& c : contacts) {
        for (const int sense : {1, -1}) {
            if (c.sense != 0 && c.sense != sense) continue;
            if (turn.quarter(c.plane, sense) == 0) return c.face;
            if (next != nullptr && !turn.is_before(c.plane, sense, next->plane, next_sense))
                continue;
            next = &c;
            next_sense = sense;
        }
    }
    // Just before the polygon, counter-clockwise, one is on the side -sense · n of it.
    return Label::leaf(next_sense > 0 ? MspTree::Leaf::In : MspTree::Leaf::Out);
}

MspLine::MspLine(const MspGeometry& geometry, const LineFrame& frame, const LineContents& contents,
                 Evidence evidence, Label around)
    : geometry_(geometry), frame_(frame), evidence_(evidence), left_(around), right_(around) {
    sort_places(contents);
    intervals_.resize(places_.size() + 1, {false, false, around, around, around});
    cover(contents);
    if (evidence != Evidence::Around) look_around(contents);
    drop_needless_stops();
}

bool MspLine::tell(std::span<const Contact> contacts) const {
    if (evidence_ != Evidence::Settled) return evidence_ == Evidence::All;
    std::size_t from_above = 0;
    for (const Contact& c : contacts) {
        if (c.elevation == 0) return true;
        if (c.elevation > 0) ++from_above;
    }
    return from_above % 2 == 1;
}

void MspLine::sort_places(const LineContents& contents) {
    const auto add = [&](const BorderPoint& p) {
        places_.push_back({p.point, p.label, p.is_dead, !p.is_dead});
    };
    for (const BorderPoint& p : contents.points) add(p);
    for (const Segment& s : contents.along) {
        add(s.a);
        add(s.b);
    }
    std::sort(places_.begin(), places_.end(), [&](const Place& a, const Place& b) {
        return geometry_.compare(a.point, b.point, frame_.axis) < 0;
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const Place& p = places_[i];
        if (kept > 0 && geometry_.compare(places_[kept - 1].point, p.point, frame_.axis) == 0) {
            Place& same = places_[kept - 1];
            same.is_dead = same.is_dead || p.is_dead;
            if (p.has_label)
                same.label = same.has_label ? more_specific(same.label, p.label) : p.label;
            same.has_label = same.has_label || p.has_label;
        } else {
            places_[kept++] = p;
        }
    }
    places_.resize(kept);
}

std::size_t MspLine::place_of(PointIndex p) const {
    const auto at = std::partition_point(places_.begin(), places_.end(), [&](const Place& q) {
        return geometry_.compare(q.point, p, frame_.axis) < 0;
    });
    return static_cast<std::size_t>(at - places_.begin());
}

// Segment by segment; intervals that several of them share are looked at with all.
void MspLine::cover(const LineContents& contents) {
    struct Event {
        std::size_t place;
        bool ends;
        std::size_t segment;
    };
    std::vector<Event> events;
    for (std::size_t i = 0; i < contents.along.size(); ++i) {
        events.push_back({place_of(contents.along[i].a.point), false, i});
        events.push_back({place_of(contents.along[i].b.point), true, i});
    }
    std::sort(events.begin(), events.end(),
              [](const Event& a, const Event& b) { return a.place < b.place; });
    std::vector<std::size_t> open;
    std::vector<Contact> contacts;
    std::size_t e = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        // What runs on through the place determines what the place is, beside its own labels.
        const auto pass = [&](std::size_t segment) {
            const Label own = contents.along[segment].contact.own;
            Place& p = places_[i];
            p.label = p.has_label ? more_specific(p.label, own) : own;
            p.has_label = true;
        };
        const std::size_t first = e;
        while (e < events.size() && events[e].place == i) ++e;
        for (std::size_t k = first; k < e; ++k)
            if (events[k].ends) std::erase(open, events[k].segment);
        for (const std::size_t s : open) pass(s);
        for (std::size_t k = first; k < e; ++k)
            if (!events[k].ends) open.push_back(events[k].segment);
        if (open.empty()) continue;
        contacts.clear();
        for (const std::size_t s : open) contacts.push_back(contents.along[s].contact);
        Interval& interval = intervals_[i + 1];
        interval.is_covered = true;
        interval.label = contacts.front().own;
        for (const Contact& c : contacts) interval.label = more_specific(interval.label, c.own);
        interval.is_told = tell(contacts);
        if (!interval.is_told) continue;
        interval.left = beside(frame_, contacts, 1);
        interval.right = beside(frame_, contacts, -1);
    }
}

void MspLine::look_around(const LineContents& contents) {
    for (const Ray& r : contents.rays) rays_.emplace_back(place_of(r.at), r);
    std::sort(rays_.begin(), rays_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto told = std::find_if(intervals_.begin(), intervals_.end(),
                                   [](const Interval& i) { return i.is_told; });
    TRISECT_EXPECTS(told != intervals_.end(), "MSP tree: a line whose sides nobody knows");
    left_ = told->left;
    right_ = told->right;
    const auto first = static_cast<std::size_t>(told - intervals_.begin());
    const auto fill = [this](std::size_t from, std::size_t to, std::size_t place, bool forward) {
        Interval& next = intervals_[to];
        if (next.is_told) return;
        next.left = next.right = beyond(place, intervals_[from], forward);
        if (!next.is_covered) next.label = next.left;
    };
    for (std::size_t i = first; i + 1 < intervals_.size(); ++i) fill(i, i + 1, i, true);
    for (std::size_t i = first; i > 0; --i) fill(i, i - 1, i - 1, false);
}

// What lies on the line beyond a place when nothing does, seen from the interval before it.
Label MspLine::beyond(std::size_t place, const Interval& known, bool forward) const {
    // A ray to the left along n_plane × n_line has this factor.
    const auto factor = [&](const Ray& r) {
        return sign_of_det(geometry_.plane(r.line), geometry_.plane(frame_.plane),
                           geometry_.plane(frame_.cut)) *
               frame_.sign;
    };
    const auto turn = [&](const Ray& a, const Ray& b) {  // 1: b is to the left of a
        if (a.line == b.line) return 0;
        return factor(a) * factor(b) *
               sign_of_det(geometry_.plane(frame_.plane), geometry_.plane(a.line),
                           geometry_.plane(b.line));
    };
    std::vector<const Ray*> around;
    const auto by_place = [](const auto& a, std::size_t p) { return a.first < p; };
    for (auto at = std::lower_bound(rays_.begin(), rays_.end(), place, by_place);
         at != rays_.end() && at->first == place; ++at)
        around.push_back(&at->second);
    // The nearest to where one looks come first.
    std::sort(around.begin(), around.end(), [&](const Ray* a, const Ray* b) {
        return forward ? turn(*a, *b) > 0 : turn(*a, *b) < 0;
    });
    std::vector<Contact> contacts;
    for (std::size_t i = 0; i < around.size();) {
        const Ray& nearest = *around[i];
        contacts.clear();
        for (; i < around.size() && turn(nearest, *around[i]) == 0; ++i)
            contacts.push_back(around[i]->contact);
        if (!tell(contacts)) continue;
        const LineFrame line = line_frame(geometry_, frame_.plane, nearest.line);
        const bool ray_runs_along = factor(nearest) == line.sign;
        // From the forward end one meets the ray's right side first.
        return beside(line, contacts, forward == ray_runs_along ? -1 : 1);
    }
    return known.left;
}

void MspLine::drop_needless_stops() {
    // Dead places bound the region: one at each end at most. What is beyond is not part of it.
    std::size_t first = 0;
    std::size_t last = places_.size();
    if (first < last && places_.front().is_dead) ++first;
    if (first < last && places_.back().is_dead) --last;
    between_.push_back(intervals_[first].label);
    for (std::size_t i = first; i < last; ++i) {
        const Label before = between_.back();
        const Label after = intervals_[i + 1].label;
        if (before == after && places_[i].label == before) continue;
        stops_.push_back({places_[i].point, places_[i].label});
        between_.push_back(after);
    }
}

}  // namespace trisect::detail::msp
