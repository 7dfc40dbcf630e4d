// SPDX-License-Identifier: Apache-2.0
//
// Three facets meet in a point where their pairs cross on one of them; that is looked for on the
// one with the least number. Two segments on a facet cross where the ends of each are on different
// sides of the plane of the other one's cutter. Doubles decide nearly all of these signs, integers
// the others, so that the three facets agree.

#include <trisect/bsp/many_meshes/parity/segment_meetings.h>

#include <algorithm>
#include <atomic>
#include <numeric>

#include <trisect/bsp/cells/trace/interpolation.h>
#include <trisect/bsp/many_meshes/stops_in_order.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

constexpr std::size_t facets_of_a_part = 256;
constexpr std::size_t pairs_of_a_part = 1024;

}  // namespace

// The segments of one facet with those that have larger numbers.
class SegmentMeetings::OnFacet {
public:
    OnFacet(const SegmentMeetings& all, std::span<const OutlineVertex> vertices,
            SpecialPosition& special)
        : all_(all), vertices_(vertices), exact_(all.meshes_, special) {}

    [[nodiscard]] bool find(std::uint32_t first, std::uint32_t end, PoolVector<Meeting>& out) {
        if (end - first < 2) return true;
        list(first, end);
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            const Segment& s = segments_[i];
            for (std::size_t j = i + 1; j < segments_.size(); ++j) {
                const Segment& t = segments_[j];
                if (t.box.lo[axis_] > s.box.hi[axis_]) break;
                if (s.slot == t.slot || !s.box.meets(t.box)) continue;
                if (!compare(std::min(s.pair, t.pair), std::max(s.pair, t.pair), out)) return false;
            }
        }
        return true;
    }

private:
    struct Segment {
        OutlineBox box;
        std::uint32_t pair = 0;
        std::uint32_t slot = 0;  // of the cutter
    };

    // By where they begin along the axis along which they reach farthest together.
    void list(std::uint32_t first, std::uint32_t end) {
        segments_.clear();
        OutlineBox all = OutlineBox::none();
        for (std::uint32_t p = first; p < end; ++p) {
            Segment& s = segments_.emplace_back();
            s.box = OutlineBox::none();
            for (const std::uint32_t v : all_.ends_[p]) s.box.add(vertices_[v].at);
            s.pair = p;
            s.slot = all_.meshes_.slot_of(all_.pairs_[p].facets[1]);
            all.add(s.box);
        }
        axis_ = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (all.hi[k] - all.lo[k] > all.hi[axis_] - all.lo[axis_]) axis_ = k;
        std::ranges::sort(segments_, [&](const Segment& s, const Segment& t) {
            if (s.box.lo[axis_] != t.box.lo[axis_]) return s.box.lo[axis_] < t.box.lo[axis_];
            return s.pair < t.pair;
        });
    }

    [[nodiscard]] int side(std::uint32_t vertex, const FilteredPlane& plane,
                           std::uint32_t facet) const {
        const OutlineVertex& v = vertices_[vertex];
        if (const int sign = plane.sign(v.at); sign != 0) return sign;
        const ShiftedPoints::Side side = exact_.side(v, facet);
        if (side.by_moves) exact_.note_side(v, v.facets[0], facet);
        return side.sign;
    }

    // 0 where the ends of a pair are on one side of a facet, 2 where that is not known.
    [[nodiscard]] int crosses(std::uint32_t pair, std::uint32_t facet) const {
        const FilteredPlane& plane = all_.planes_[facet];
        const int from = side(all_.ends_[pair][0], plane, facet);
        const int to = side(all_.ends_[pair][1], plane, facet);
        if (from == 0 || to == 0) return 2;
        return from != to ? 1 : 0;
    }

    [[nodiscard]] bool compare(std::uint32_t p, std::uint32_t q, PoolVector<Meeting>& out) const {
        const std::uint32_t facet = all_.pairs_[p].facets[0];
        const std::uint32_t of_p = all_.pairs_[p].facets[1];
        const std::uint32_t of_q = all_.pairs_[q].facets[1];
        const int first = crosses(p, of_q);
        if (first != 1) return first == 0;
        const int second = crosses(q, of_p);
        if (second != 1) return second == 0;
        const auto third = all_.pair_of(of_p, of_q);
        if (!third) return false;
        Meeting& m = out.emplace_back();
        m.pairs = {p, q, *third};
        m.vertex.kind = OutlineVertex::Kind::Meeting;
        m.vertex.facets = {facet, of_p, of_q};
        m.vertex.at = place_of(m);
        return true;
    }

    // On the one of the three segments that gives the least error.
    [[nodiscard]] Approximation place_of(const Meeting& m) const {
        Approximation best;
        bool is_known = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const FilteredPlane& plane = all_.planes_[m.vertex.facets[2 - i]];
            const auto& ends = all_.ends_[m.pairs[i]];
            const Approximation& u = vertices_[ends[0]].at;
            const Approximation& w = vertices_[ends[1]].at;
            const double at_u = plane.value(u.c);
            const double at_w = plane.value(w.c);
            const double error = plane.error(u) + plane.error(w);
            Approximation at;
            if ((at_u > 0) == (at_w > 0) || !interpolate(u, at_u, w, at_w, error, at)) continue;
            if (is_known && !(at.error < best.error)) continue;
            best = at;
            is_known = true;
        }
        return is_known ? best : exact_.meeting(m.vertex.facets);
    }

    const SegmentMeetings& all_;
    std::span<const OutlineVertex> vertices_;
    ShiftedPoints exact_;
    std::size_t axis_ = 0;
    std::vector<Segment> segments_;
};

bool SegmentMeetings::find(PoolVector<OutlineVertex>& vertices, std::uint32_t threads) {
    const std::size_t facets = meshes_.facet_count();
    first_of_facet_.assign(facets + 1, 0);
    for (const FacetCrossing& c : pairs_) ++first_of_facet_[c.facets[0] + 1];
    for (std::size_t f = 0; f < facets; ++f) first_of_facet_[f + 1] += first_of_facet_[f];
    make_planes(threads);
    return find_points(vertices, threads) && sort(vertices, threads);
}

void SegmentMeetings::make_planes(std::uint32_t threads) {
    const std::size_t facets = meshes_.facet_count();
    std::vector<std::uint8_t> is_wanted(facets, 0);
    for (const FacetCrossing& c : pairs_) is_wanted[c.facets[0]] = is_wanted[c.facets[1]] = 1;
    planes_.resize(facets);
    ParallelParts(facets, threads).for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (auto f = static_cast<std::uint32_t>(begin); f < end; ++f) {
            if (is_wanted[f] == 0) continue;
            const std::uint32_t slot = meshes_.slot_of(f);
            const std::uint32_t own = f - meshes_.operands->operands[slot].first;
            planes_[f] = FilteredFacets::plane_of(meshes_.corners(slot, own), meshes_.extent);
        }
    });
}

std::optional<std::uint32_t> SegmentMeetings::pair_of(std::uint32_t first,
                                                      std::uint32_t second) const {
    const std::uint32_t begin = first_of_facet_[first];
    const auto of_first = pairs_.subspan(begin, first_of_facet_[first + 1] - begin);
    const auto at = std::ranges::lower_bound(of_first, second, {},
                                             [](const FacetCrossing& c) { return c.facets[1]; });
    if (at == of_first.end() || at->facets[1] != second) return std::nullopt;
    return begin + static_cast<std::uint32_t>(at - of_first.begin());
}

bool SegmentMeetings::find_points(PoolVector<OutlineVertex>& vertices, std::uint32_t threads) {
    const ParallelParts parts(meshes_.facet_count(), threads, facets_of_a_part);
    std::vector<PoolVector<Meeting>> found(parts.count());
    std::atomic<bool> is_known{true};
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        OnFacet on_facet(*this, vertices, special());
        for (std::size_t f = begin; f < end; ++f)
            if (!on_facet.find(first_of_facet_[f], first_of_facet_[f + 1], found[part]))
                is_known = false;
    });
    if (!is_known) return false;
    first_.assign(pairs_.size() + 1, 0);
    for (const auto& part : found)
        for (const Meeting& m : part)
            for (const std::uint32_t p : m.pairs) ++first_[p + 1];
    for (std::size_t p = 0; p < pairs_.size(); ++p) first_[p + 1] += first_[p];
    stops_.resize(first_.back());
    vertices.reserve(vertices.size() + stops_.size() / 3);
    PoolVector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const auto& part : found)
        for (const Meeting& m : part) {
            const auto vertex = static_cast<std::uint32_t>(vertices.size());
            vertices.push_back(m.vertex);
            for (std::size_t i = 0; i < 3; ++i)
                stops_[next[m.pairs[i]]++] = {vertex, m.vertex.facets[2 - i], 0};
        }
    return true;
}

bool SegmentMeetings::sort(std::span<const OutlineVertex> vertices, std::uint32_t threads) {
    std::atomic<bool> is_known{true};
    ParallelParts(pairs_.size(), threads, pairs_of_a_part)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            const ShiftedPoints exact(meshes_, special());
            for (std::size_t p = begin; p < end; ++p)
                if (!sort_stops(p, vertices, exact)) is_known = false;
        });
    return is_known;
}

// A crossing has the direction of the product of its facets' normals.
bool SegmentMeetings::sort_stops(std::size_t pair, std::span<const OutlineVertex> vertices,
                                 const ShiftedPoints& exact) {
    const std::span<Stop> stops =
        std::span(stops_).subspan(first_[pair], first_[pair + 1] - first_[pair]);
    const auto& ends = ends_[pair];
    return sort_along(stops, vertices[ends[0]].at, vertices[ends[1]].at, vertices,
                      [&](const Stop& s, const Stop& t) {
                          return exact.order_on_line(pairs_[pair].facets, s.cutter, t.cutter);
                      });
}

}  // namespace trisect::detail
