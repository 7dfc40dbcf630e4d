// SPDX-License-Identifier: Apache-2.0
//
// A face whose corners are computed points cannot be triangulated here: the plane through a
// diagonal would need the corners' coordinates, hundreds of bits each. But it can be cut by what is
// known already, the lines of its own edges. That is a BSP tree in the plane (an autopartition):
// start with a rectangle around the face, cut it by the line of an edge, go on in both parts with
// the edges that lie there. A part without edges is all face or all outside; which one is decided
// by the edge that cut it off, since the face lies to the left of its edges.
//
// The new side of a part may be an edge of the face here, and run within the face there. It is
// divided at the ends of the edges on it, so parts have straight corners.

#include <trisect/bsp/msp/msp_face_parts.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <trisect/bsp/msp/msp_groups.h>
#include <trisect/bsp/msp/msp_line.h>
#include <trisect/kernel/contract.h>

namespace trisect::detail::msp {

namespace {

class FaceDivider {
public:
    FaceDivider(MspGeometry& geometry, PlaneIndex support, Label face, std::vector<Fragment>& parts)
        : geometry_(geometry), support_(support), face_(face), parts_(parts) {}

    void run(std::vector<FaceEdge>&& edges) {
        Region all{rectangle_around(edges), std::move(edges)};
        pending_.push_back(std::move(all));
        while (!pending_.empty()) {
            Region region = std::move(pending_.back());
            pending_.pop_back();
            divide(region);
        }
    }

private:
    struct Region {
        Fragment part;
        std::vector<FaceEdge> edges;
    };
    using Corners = std::vector<Corner>;

    [[nodiscard]] Fragment fragment(const Corners& corners) {
        return {support_, face_, geometry_.add_corners(corners),
                static_cast<std::uint32_t>(corners.size())};
    }

    Fragment rectangle_around(std::span<const FaceEdge> edges) {
        const Plane& plane = geometry_.plane(support_);
        const int k = plane.dominant_axis();
        std::array<int, 2> axes{(k + 1) % 3, (k + 2) % 3};
        if (plane.normal(k) < 0) std::swap(axes[0], axes[1]);
        std::array<PlaneIndex, 2> low{};
        std::array<PlaneIndex, 2> high{};
        for (std::size_t i = 0; i < 2; ++i) {
            const auto axis = static_cast<std::size_t>(axes[i]);
            double lo = HUGE_VAL;
            double hi = -HUGE_VAL;
            for (const FaceEdge& e : edges) {
                const Approximation& p = geometry_.approximation(e.from);
                lo = std::min(lo, p.c[axis] - p.error);
                hi = std::max(hi, p.c[axis] + p.error);
            }
            const auto position = [](double v) { return static_cast<std::int64_t>(v); };
            low[i] =
                geometry_.add_plane(Plane::axis_aligned(axes[i], 1, position(std::floor(lo)) - 2));
            high[i] =
                geometry_.add_plane(Plane::axis_aligned(axes[i], 1, position(std::ceil(hi)) + 2));
        }
        const auto corner = [&](PlaneIndex before, PlaneIndex after) {
            return Corner{geometry_.meet(support_, before, after), after, face_, face_};
        };
        return fragment({corner(low[0], low[1]), corner(low[1], high[0]), corner(high[0], high[1]),
                         corner(high[1], low[0])});
    }

    // The first edge of a few that splits the fewest others.
    [[nodiscard]] const FaceEdge& choose(std::span<const FaceEdge> edges) const {
        const std::size_t tried = std::min<std::size_t>(edges.size(), 6);
        std::size_t best = 0;
        std::size_t least = ~std::size_t{0};
        for (std::size_t k = 0; k < tried && least > 0; ++k) {
            const std::size_t candidate = k * edges.size() / tried;
            const auto splits = static_cast<std::size_t>(
                std::count_if(edges.begin(), edges.end(), [&](const FaceEdge& e) {
                    const Side from = geometry_.side(e.from, edges[candidate].plane);
                    return from != Side::On &&
                           from == opposite(geometry_.side(e.to, edges[candidate].plane));
                }));
            if (splits < least) best = candidate;
            least = std::min(splits, least);
        }
        return edges[best];
    }

    void divide(const Region& region) {
        const FaceEdge chosen = choose(region.edges);
        const LineFrame line = line_frame(geometry_, support_, chosen.plane);
        const bool runs_along = geometry_.compare(chosen.from, chosen.to) < 0;
        const bool face_is_below = runs_along == line.left_is_below();

        std::vector<Side> sides;
        for (const Corner& c : geometry_.corners(region.part))
            sides.push_back(geometry_.side(c.point, chosen.plane));
        const MspGeometry::Cut cut = geometry_.cut(region.part, chosen.plane, sides);

        std::vector<FaceEdge> along;
        Region below;
        Region above;
        for (const FaceEdge& e : region.edges) send(e, chosen.plane, along, below, above);
        below.part = with_edges(cut.below, chosen.plane, along);
        above.part = with_edges(cut.above, chosen.plane, along);
        finish(std::move(above), !face_is_below);
        finish(std::move(below), face_is_below);
    }

    void send(const FaceEdge& e, PlaneIndex cut, std::vector<FaceEdge>& along, Region& below,
              Region& above) {
        const Side from = geometry_.side(e.from, cut);
        const Side to = geometry_.side(e.to, cut);
        if (from == Side::On && to == Side::On) {
            along.push_back(e);
        } else if (from == Side::On || to == Side::On || from == to) {
            ((from == Side::On ? to : from) == Side::Below ? below : above).edges.push_back(e);
        } else {
            FaceEdge first = e;
            FaceEdge second = e;
            first.to = second.from = geometry_.meet(support_, cut, e.plane);
            first.to_label = second.from_label = e.label;
            (from == Side::Below ? below : above).edges.push_back(first);
            (to == Side::Below ? below : above).edges.push_back(second);
        }
    }

    void finish(Region&& region, bool is_face) {
        if (!region.edges.empty()) {
            pending_.push_back(std::move(region));
            return;
        }
        if (!is_face) return;
        for (Corner& c : geometry_.corners(region.part)) {
            c.vertex_is_dead = false;
            c.edge_is_dead = false;
        }
        parts_.push_back(region.part);
    }

    // The side on the cut, divided into what is an edge of the face and what is not.
    Fragment with_edges(const Fragment& part, PlaneIndex cut, std::span<const FaceEdge> along) {
        const auto old = geometry_.corners(part);
        std::size_t at = 0;
        while (at + 1 < old.size() && !(old[at].edge_plane == cut && old[at].edge_is_dead)) ++at;
        const std::size_t after = at + 1 < old.size() ? at + 1 : 0;
        const bool ahead = geometry_.compare(old[at].point, old[after].point) < 0;

        std::vector<FaceEdge> sorted(along.begin(), along.end());
        for (FaceEdge& e : sorted) {
            if ((geometry_.compare(e.from, e.to) < 0) == ahead) continue;
            std::swap(e.from, e.to);
            std::swap(e.from_label, e.to_label);
        }
        std::sort(sorted.begin(), sorted.end(), [&](const FaceEdge& a, const FaceEdge& b) {
            const auto order = geometry_.compare(a.from, b.from);
            return ahead ? order < 0 : order > 0;
        });

        Corners corners;
        for (std::size_t i = 0; i < at; ++i) corners.push_back(old[i]);
        Corner cursor = old[at];
        Corner end = old[after];
        for (const FaceEdge& e : sorted) {
            const auto order = geometry_.compare(e.from, cursor.point);
            if (order != 0 && (order < 0) == ahead) continue;  // seen from the other side already
            if (order == 0) {
                cursor.vertex = more_specific(cursor.vertex, e.from_label);
            } else {
                corners.push_back(cursor);
                cursor = {e.from, cut, e.from_label, face_};
            }
            cursor.edge = e.label;
            corners.push_back(cursor);
            cursor = {e.to, cut, e.to_label, face_};
        }
        if (geometry_.compare(cursor.point, end.point) == 0) {
            end.vertex = more_specific(end.vertex, cursor.vertex);
        } else {
            corners.push_back(cursor);
        }
        if (after == 0) {
            corners[0] = end;
        } else {
            corners.push_back(end);
            for (std::size_t i = after + 1; i < old.size(); ++i) corners.push_back(old[i]);
        }
        return fragment(corners);
    }

    MspGeometry& geometry_;
    PlaneIndex support_;
    Label face_;
    std::vector<Fragment>& parts_;
    std::vector<Region> pending_;
};

}  // namespace

void convex_parts(MspGeometry& geometry, PlaneIndex support, Label face,
                  std::vector<FaceEdge> edges, std::vector<Fragment>& parts) {
    FaceDivider(geometry, support, face, parts).run(std::move(edges));
}

}  // namespace trisect::detail::msp
