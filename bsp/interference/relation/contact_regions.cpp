// SPDX-License-Identifier: Apache-2.0
//
// Contact regions out of contacts of triangles.
//
// Triangles of two coplanar faces overlap in convex polygons, which are the cells of the overlay of
// both triangulations: neighbours share whole sides. So the outline of what two faces share is what
// is left when sides that run both ways cancel, as in assembly. Corners are named by the features
// that meet there, which makes the same corner the same in all polygons without comparing
// coordinates. Coordinates are worked out once a name.
//
// A segment is reported by every pair of triangles around it: an edge in a face by two, an edge on
// an edge by four. Those that are sides of a polygon belong to its outline. The others of one pair
// of entities are on one line and are joined there.

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/relation/meeting_pairs.h>

namespace trisect::detail {

namespace {

// The name of a corner of an intersection: a vertex of A, a vertex of B, or a side and a side, or a
// side and a face.
using Name = std::array<std::uint32_t, 5>;
using NamedSegment = std::pair<Name, Name>;  // the smaller name first
using EntityPair = std::pair<BoundaryEntity, BoundaryEntity>;

class RegionBuilder {
public:
    RegionBuilder(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                  const Pose& pose_a)
        : models_(models), pairs_(pairs), pose_a_(pose_a) {}

    std::vector<ContactRegion> build() {
        for (const MeetingPair& pair : pairs_)
            if (pair.contact.count > 2) add_polygon(pair);
        for (const MeetingPair& pair : pairs_)
            if (pair.contact.count == 2) add_segment(pair);
        for (const MeetingPair& pair : pairs_)
            if (pair.contact.count == 1) add_point(pair);
        std::vector<ContactRegion> regions;
        for (const auto& [faces, area] : areas_) regions.push_back(region_of(faces, area));
        for (auto& [entities, segments] : segments_) add_joined(entities, segments, regions);
        for (const auto& [name, entities] : points_)
            regions.push_back(
                {0, entities.first, entities.second, false, {{point(places_.at(name))}}});
        std::ranges::stable_sort(regions, [](const ContactRegion& x, const ContactRegion& y) {
            return std::tie(y.dimension, x.a, x.b) < std::tie(x.dimension, y.a, y.b);
        });
        return regions;
    }

private:
    struct Area {
        bool opposite = false;
        std::set<NamedSegment> sides;  // directed: from, to; without opposite ones
    };
    using Interval = std::pair<ExactPlace, ExactPlace>;

    static std::array<std::uint32_t, 2> side_name(const InterferenceModelData& model,
                                                  std::uint32_t triangle, Feature side) {
        const ModelTriangle& t = model.triangles[triangle];
        const std::uint32_t p = model.place[t.vertex[side.index()].index].index;
        const std::uint32_t q = model.place[t.vertex[(side.index() + 1) % 3].index].index;
        return {std::min(p, q), std::max(p, q)};
    }
    // The name; and the place, when it is a new one.
    Name name_of(const MeetingPair& pair, const MeetingPoint& p) {
        const Name name = make_name(pair, p);
        if (!places_.contains(name)) places_.emplace(name, place_of(models_, pair, p));
        return name;
    }
    Name make_name(const MeetingPair& pair, const MeetingPoint& p) const {
        const auto& [a, b, poses] = models_;
        if (p.a.is_corner())
            return {0, a.place[a.triangles[pair.a].vertex[p.a.index()].index].index};
        if (p.b.is_corner())
            return {1, b.place[b.triangles[pair.b].vertex[p.b.index()].index].index};
        if (p.a.is_side() && p.b.is_side()) {
            const auto s = side_name(a, pair.a, p.a);
            const auto t = side_name(b, pair.b, p.b);
            return {2, s[0], s[1], t[0], t[1]};
        }
        if (p.a.is_side()) {
            const auto s = side_name(a, pair.a, p.a);
            return {3, s[0], s[1], b.triangles[pair.b].face.index};
        }
        const auto t = side_name(b, pair.b, p.b);
        return {4, t[0], t[1], a.triangles[pair.a].face.index};
    }

    // Twice the signed area of a triangle, seen along the dominant axis of its plane.
    [[nodiscard]] static ExactRational turn(const ExactPlace& p, const ExactPlace& q,
                                            const ExactPlace& r, const Plane& plane) {
        const int axis = plane.dominant_axis();
        const auto i = static_cast<std::size_t>((axis + 1) % 3);
        const auto j = static_cast<std::size_t>((axis + 2) % 3);
        const ExactRational v =
            (q.c[i] - p.c[i]) * (r.c[j] - p.c[j]) - (q.c[j] - p.c[j]) * (r.c[i] - p.c[i]);
        return plane.normal(axis) > 0 ? v : -v;
    }

    void add_polygon(const MeetingPair& pair) {
        const TriangleContact& c = pair.contact;
        const FaceId fa = models_.a.triangles[pair.a].face;
        const FaceId fb = models_.b.triangles[pair.b].face;
        // Corners in order: each shares a side of a triangle with its neighbours.
        std::vector<std::size_t> order{0};
        const auto are_neighbours = [&c](std::size_t i, std::size_t j) {
            return feature_between(c.points[i].a, c.points[j].a).is_side() ||
                   feature_between(c.points[i].b, c.points[j].b).is_side();
        };
        while (order.size() < c.count) {
            const std::size_t before = order.size();
            for (std::size_t i = 0; i < c.count && order.size() == before; ++i)
                if (std::ranges::find(order, i) == order.end() && are_neighbours(order.back(), i))
                    order.push_back(i);
            TRISECT_EXPECTS(order.size() > before, "a polygon whose corners have no neighbours");
        }
        std::vector<Name> names;
        for (const std::size_t i : order) names.push_back(name_of(pair, c.points[i]));
        if (turn(places_.at(names[0]), places_.at(names[1]), places_.at(names[2]),
                 models_.a.brep.plane(fa))
                .sign() < 0)
            std::ranges::reverse(names);
        Area& area = areas_[{fa, fb}];
        area.opposite = c.opposite;
        for (std::size_t i = 0; i < names.size(); ++i) {
            const Name& p = names[i];
            const Name& q = names[(i + 1) % names.size()];
            outlines_.insert(std::minmax(p, q));
            taken_.insert(p);
            if (area.sides.erase({q, p}) == 0) area.sides.insert({p, q});
        }
    }

    ContactRegion region_of(const EntityPair& faces, const Area& area) {
        ContactRegion region{2, faces.first, faces.second, area.opposite, {}};
        const Plane& plane = models_.a.brep.plane(faces.first.face());
        std::set<NamedSegment> left = area.sides;
        while (!left.empty()) {
            std::vector<Name> loop;
            for (auto it = left.begin(); it != left.end();) {
                loop.push_back(it->first);
                const Name to = it->second;
                left.erase(it);
                if (to == loop.front()) break;
                it = left.lower_bound({to, Name{}});
                TRISECT_EXPECTS(it != left.end() && it->first == to,
                                "the outline of a contact area does not close");
            }
            std::vector<ContactPoint> corners;
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const ExactPlace& before = places_.at(loop[(i + loop.size() - 1) % loop.size()]);
                const ExactPlace& here = places_.at(loop[i]);
                const ExactPlace& after = places_.at(loop[(i + 1) % loop.size()]);
                if (turn(before, here, after, plane).sign() != 0) corners.push_back(point(here));
            }
            region.loops.push_back(std::move(corners));
        }
        return region;
    }

    void add_segment(const MeetingPair& pair) {
        const MeetingPoint& p = pair.contact.points[0];
        const MeetingPoint& q = pair.contact.points[1];
        const Name n = name_of(pair, p);
        const Name m = name_of(pair, q);
        taken_.insert(n);
        taken_.insert(m);
        if (!outlines_.insert(std::minmax(n, m)).second) return;
        Interval interval{places_.at(n), places_.at(m)};
        if (interval.second < interval.first) std::swap(interval.first, interval.second);
        segments_[{entity_of(models_.a, pair.a, feature_between(p.a, q.a)),
                   entity_of(models_.b, pair.b, feature_between(p.b, q.b))}]
            .push_back(std::move(interval));
    }

    void add_joined(const EntityPair& entities, std::vector<Interval>& intervals,
                    std::vector<ContactRegion>& regions) {
        std::ranges::sort(intervals);
        for (std::size_t i = 0; i < intervals.size();) {
            std::size_t j = i + 1;
            while (j < intervals.size() && intervals[j].first == intervals[j - 1].second) ++j;
            regions.push_back({1,
                               entities.first,
                               entities.second,
                               false,
                               {{point(intervals[i].first), point(intervals[j - 1].second)}}});
            i = j;
        }
    }

    void add_point(const MeetingPair& pair) {
        const MeetingPoint& p = pair.contact.points[0];
        const Name name = name_of(pair, p);
        if (taken_.contains(name)) return;
        points_.try_emplace(name, entity_of(models_.a, pair.a, p.a),
                            entity_of(models_.b, pair.b, p.b));
    }

    [[nodiscard]] ContactPoint point(const ExactPlace& place) const {
        ContactPoint p{in_world(place, models_.a.brep.lattice(), pose_a_), {}};
        for (std::size_t k = 0; k < 3; ++k) p.nearest[k] = p.exact[k].to_double();
        return p;
    }

    const PosedModels& models_;
    const std::vector<MeetingPair>& pairs_;
    const Pose& pose_a_;
    std::map<Name, ExactPlace> places_;
    std::map<EntityPair, Area> areas_;
    std::map<EntityPair, std::vector<Interval>> segments_;
    std::map<Name, EntityPair> points_;
    std::set<NamedSegment> outlines_;  // known segments
    std::set<Name> taken_;             // points of segments and areas
};

}  // namespace

std::vector<ContactRegion> regions_of(const PosedModels& models,
                                      const std::vector<MeetingPair>& pairs, const Pose& pose_a) {
    return RegionBuilder(models, pairs, pose_a).build();
}

}  // namespace trisect::detail
