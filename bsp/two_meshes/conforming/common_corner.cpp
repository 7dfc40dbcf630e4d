// SPDX-License-Identifier: Apache-2.0
//
// Two facets around a corner are parts of two cones. Seen along an axis these are sectors of less
// than a half turn, which have nothing but the corner in common where they lie side by side on the
// circle around it. A place on the circle is the distance along the square |x| + |y| = 1: that is a
// quotient, and grows with the angle. A round is 4 and half a round 2.

#include <trisect/bsp/two_meshes/conforming/common_corner.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

// x and y carry one rounding each, so a place is within 8·2^-53 of the exact one, and differences
// of two within 2^-48 of theirs.
constexpr double relative_margin = 0x1p-46;
constexpr double no_place = 8;
constexpr double half_round = 2;
constexpr double full_round = 4;

// From -1 up to 3.
double place_of(double x, double y) {
    const double size = std::fabs(x) + std::fabs(y);
    if (!(size > 0)) return no_place;
    const double along = y / size;
    return x >= 0 ? along : 2 - along;
}

// A difference of places, as one from 0 to 4.
double around(double difference) { return difference < 0 ? difference + full_round : difference; }

}  // namespace

void CommonCorner::set(std::uint32_t name, const CornerFans& fans) {
    name_ = name;
    for (std::size_t mesh = 0; mesh < 2; ++mesh) set_mesh(mesh, fans);
}

void CommonCorner::set_mesh(std::size_t mesh, const CornerFans& fans) {
    const auto corners = fans.around(mesh, name_);
    sectors_[mesh].resize(corners.size());
    uses_[mesh].clear();
    Sector* out = sectors_[mesh].data();
    for (const CornerFans::Corner c : corners) {
        const CornerNames::Triple& t = names_.corners(c.item());
        const std::size_t k = c.place();
        const std::uint32_t next = t[k == 2 ? 0 : k + 1];
        const std::uint32_t last = t[k == 0 ? 2 : k - 1];
        *out++ = {c.item(), next, last, 0, 0};
        if (next > name_ && names_.is_common(next)) add_use(mesh, {next, c.item(), last, true});
        if (last > name_ && names_.is_common(last)) add_use(mesh, {last, c.item(), next, false});
    }
    constexpr std::size_t few = 32;
    const auto is_before = [](const Use& a, const Use& b) {
        return a.other != b.other ? a.other < b.other : a.item < b.item;
    };
    if (uses_[mesh].size() > few) std::ranges::sort(uses_[mesh], is_before);
}

// In order, unless they are many.
void CommonCorner::add_use(std::size_t mesh, const Use& use) {
    constexpr std::size_t few = 32;
    auto& uses = uses_[mesh];
    uses.push_back(use);
    if (uses.size() > few) return;
    std::size_t i = uses.size() - 1;
    for (; i > 0 && uses[i - 1].other > use.other; --i) uses[i] = uses[i - 1];
    uses[i] = use;
}

// The axis in which the facets of the first mesh together are largest.
std::size_t CommonCorner::largest_axis() const {
    const Vector3 origin = names_.point(name_).doubles();
    Vector3 normal{};
    for (const Sector& s : sectors_[0])
        normal = plus(normal, cross(minus(names_.point(s.next).doubles(), origin),
                                    minus(names_.point(s.last).doubles(), origin)));
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(normal[k]) > std::fabs(normal[axis])) axis = k;
    return axis;
}

// Where doubles do not say how a sector lies, it takes the whole round.
void CommonCorner::set_angles() {
    const auto axis = static_cast<int>(largest_axis());
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const LatticePoint& origin = names_.point(name_);
    const double x = origin[u].to_double();
    const double y = origin[v].to_double();
    const auto place = [&](std::uint32_t name) {
        const LatticePoint& p = names_.point(name);
        return place_of(p[u].to_double() - x, p[v].to_double() - y);
    };
    for (auto& sectors : sectors_)
        for (Sector& s : sectors) {
            const double next = place(s.next);
            const double last = place(s.last);
            const double turn = around(last - next);
            s.from = 0;
            s.width = full_round;
            if (next == no_place || last == no_place) continue;
            if (turn > relative_margin && turn < half_round - relative_margin) {
                s.from = next;
                s.width = turn + relative_margin;
            } else if (turn > half_round + relative_margin && turn < full_round - relative_margin) {
                s.from = last;
                s.width = full_round - turn + relative_margin;
            }
        }
}

void CommonCorner::add_open_pairs(std::vector<Pair>& out) {
    set_angles();
    const auto share_edge = [](const Sector& a, const Sector& b) {
        return a.next == b.next || a.next == b.last || a.last == b.next || a.last == b.last;
    };
    for (const Sector& a : sectors_[0])
        for (const Sector& b : sectors_[1]) {
            const double turn = around(b.from - a.from);
            const bool are_apart = turn > a.width && turn < full_round - b.width;
            if (!are_apart && !share_edge(a, b)) out.push_back({a.item, b.item});
        }
}

}  // namespace trisect::detail
