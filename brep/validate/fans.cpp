// SPDX-License-Identifier: Apache-2.0
//
// Needles that lie side by side and run to one corner have boxes that contain each other, whatever
// way they are turned, and no view needs to show them all: those along a bar see it from all sides.
// Seen from that corner each is an arc of a circle on a sphere, and two of them have something in
// common beside the corner only where their arcs have. Arcs of needles are short, so few of their
// boxes meet; pairs of these are decided exactly.
//
// Errors. A difference of corners, its length and the quotient are rounded by some 2^-52 of their
// size, so a direction by less than 2^-50. A chord of length c is at most c²/4 below its arc.

#include <trisect/brep/validate/fans.h>

#include <algorithm>
#include <cstddef>
#include <limits>

#include <trisect/brep/contact/triangle_contact.h>
#include <trisect/brep/validate/sheets.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

using FanTriangle = std::array<std::uint32_t, 3>;

constexpr double direction_error = 0x1p-48;
// Of boxes compared along an axis, and of pairs decided exactly, for each triangle.
constexpr std::size_t most_comparisons = 400;
constexpr std::size_t most_contacts = 40;
// Fewer triangles are left to the search for pairs.
constexpr std::size_t least_fan = 16;

struct Arc {
    Vector3 low{}, high{};
    std::uint32_t triangle = 0;
    bool is_known = false;
    bool is_alone = true;  // meets no other triangle around the hub

    [[nodiscard]] bool meets(const Arc& other) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (low[k] > other.high[k] || other.low[k] > high[k]) return false;
        return true;
    }
};

class FanFinder {
public:
    FanFinder(std::span<const LatticePoint> points, std::span<const FanTriangle> triangles,
              std::uint32_t hub)
        : points_(points), triangles_(triangles), hub_(hub) {}

    void add(std::uint32_t triangle) {
        Arc arc;
        arc.triangle = triangle;
        std::array<Vector3, 2> ends{};
        std::size_t n = 0;
        for (const std::uint32_t c : triangles_[triangle])
            if (c != hub_ && n < 2) ends[n++] = direction_to(c);
        const Vector3 chord = minus(ends[1], ends[0]);
        const double margin = dot(chord, chord) / 4 + direction_error;
        for (std::size_t k = 0; k < 3; ++k) {
            arc.low[k] = std::min(ends[0][k], ends[1][k]) - margin;
            arc.high[k] = std::max(ends[0][k], ends[1][k]) + margin;
        }
        arc.is_known = margin < 8;  // not where a corner is at the hub
        arcs_.push_back(arc);
    }

    // Those that meet no others; none where too much would have to be compared.
    [[nodiscard]] std::vector<std::uint32_t> find() {
        std::vector<std::uint32_t> out;
        std::erase_if(arcs_, [](const Arc& a) { return !a.is_known; });
        if (!compare()) return out;
        for (const Arc& a : arcs_)
            if (a.is_alone) out.push_back(a.triangle);
        return out;
    }

private:
    [[nodiscard]] Vector3 direction_to(std::uint32_t corner) const {
        const Vector3 way = minus(points_[corner].doubles(), points_[hub_].doubles());
        return scaled(way, 1 / length(way));
    }

    // The one along which boxes are shortest, compared with all together.
    [[nodiscard]] std::size_t sweep_axis() const {
        std::size_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
            double low = 2, high = -2, sum = 0;
            for (const Arc& a : arcs_) {
                low = std::min(low, a.low[k]);
                high = std::max(high, a.high[k]);
                sum += a.high[k] - a.low[k];
            }
            if (sum < least * (high - low)) {
                least = sum / (high - low);
                best = k;
            }
        }
        return best;
    }

    [[nodiscard]] bool compare() {
        if (arcs_.empty()) return false;
        const std::size_t axis = sweep_axis();
        std::ranges::sort(arcs_, [axis](const Arc& a, const Arc& b) {
            return a.low[axis] != b.low[axis] ? a.low[axis] < b.low[axis] : a.triangle < b.triangle;
        });
        std::size_t comparisons = most_comparisons * arcs_.size();
        std::size_t contacts = most_contacts * arcs_.size();
        for (std::size_t i = 0; i < arcs_.size(); ++i) {
            check_stop();
            for (std::size_t k = i + 1; k < arcs_.size(); ++k) {
                if (arcs_[k].low[axis] > arcs_[i].high[axis]) break;
                if (--comparisons == 0) return false;
                if (!arcs_[i].meets(arcs_[k])) continue;
                if (--contacts == 0) return false;
                if (are_apart(triangles_[arcs_[i].triangle], triangles_[arcs_[k].triangle]))
                    continue;
                arcs_[i].is_alone = false;
                arcs_[k].is_alone = false;
            }
        }
        return true;
    }

    [[nodiscard]] bool are_apart(const FanTriangle& a, const FanTriangle& b) const {
        for (const std::uint32_t v : a)
            for (const std::uint32_t w : b)
                if (v != w && points_[v] == points_[w]) return false;
        return find_contact(points_, a, b).kind == ContactKind::None;
    }

    std::span<const LatticePoint> points_;
    std::span<const FanTriangle> triangles_;
    std::uint32_t hub_;
    std::vector<Arc> arcs_;
};

// The triangles around each hub that no hub before it has.
std::vector<std::vector<std::uint32_t>> triangles_around(std::size_t point_count,
                                                         std::span<const FanTriangle> triangles,
                                                         std::span<const std::uint32_t> hubs) {
    std::vector<std::uint32_t> number(point_count, no_sheet);
    for (std::size_t i = 0; i < hubs.size(); ++i) number[hubs[i]] = static_cast<std::uint32_t>(i);
    std::vector<std::vector<std::uint32_t>> out(hubs.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const FanTriangle& c = triangles[t];
        const std::uint32_t hub = std::min({number[c[0]], number[c[1]], number[c[2]]});
        if (hub != no_sheet) out[hub].push_back(static_cast<std::uint32_t>(t));
    }
    return out;
}

bool are_one_sheet(std::span<const std::uint32_t> triangles,
                   std::span<const std::uint32_t> sheets) {
    const std::uint32_t first = sheets[triangles.front()];
    return first != no_sheet &&
           std::ranges::all_of(triangles, [&](std::uint32_t t) { return sheets[t] == first; });
}

}  // namespace

std::uint32_t add_fans(std::span<const LatticePoint> points, std::span<const FanTriangle> triangles,
                       std::span<const std::uint32_t> hubs, std::uint32_t next,
                       std::vector<std::uint32_t>& sheets) {
    if (hubs.empty()) return next;
    const auto around = triangles_around(points.size(), triangles, hubs);
    check_stop(triangles.size());
    for (std::size_t i = 0; i < hubs.size(); ++i) {
        if (around[i].size() < least_fan || are_one_sheet(around[i], sheets)) continue;
        FanFinder fan(points, triangles, hubs[i]);
        for (const std::uint32_t t : around[i]) fan.add(t);
        const std::vector<std::uint32_t> apart = fan.find();
        for (const std::uint32_t t : apart) sheets[t] = next;
        if (!apart.empty()) ++next;
    }
    return next;
}

}  // namespace trisect::detail
