// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/level_set/level_link.h>

#include <algorithm>
#include <cstddef>

namespace trisect::detail {
namespace {

using Triangle = LevelLink::Triangle;

constexpr std::size_t triangle_count = 24;

constexpr std::array<Triangle, triangle_count> make_triangles() {
    std::array<Triangle, triangle_count> out{};
    std::size_t n = 0;
    // A neighbour along an axis has four around it across cells, and edges between these.
    for (unsigned axis = 0; axis < 3; ++axis)
        for (unsigned up = 0; up < 2; ++up) {
            const unsigned u = (axis + 1) % 3;
            const unsigned v = (axis + 2) % 3;
            const unsigned first = up << axis;
            const std::array<unsigned, 4> around{first, first | (1U << u),
                                                 first | (1U << u) | (1U << v), first | (1U << v)};
            for (std::size_t i = 0; i < 4; ++i)
                out[n++] = {static_cast<std::uint8_t>(8 + 2 * axis + up),
                            static_cast<std::uint8_t>(around[up != 0 ? i : (i + 1) % 4]),
                            static_cast<std::uint8_t>(around[up != 0 ? (i + 1) % 4 : i])};
        }
    return out;
}

constexpr std::array<Triangle, triangle_count> all_triangles = make_triangles();

/// Where the curve goes from a place on it. A place is a neighbour of sign 0, or an edge between
/// two of different signs.
class Curve {
public:
    using Place = std::uint8_t;

    void add(Place a, Place b) {
        add_end(a, b);
        add_end(b, a);
    }
    [[nodiscard]] bool is_one_cycle() const {
        if (count_ == 0 || !is_valid_) return false;
        std::size_t seen = 0;
        Place before = places;
        Place at = first_;
        do {
            if (ends_[at] != 2) return false;
            const Place next = next_[at][0] != before ? next_[at][0] : next_[at][1];
            before = at;
            at = next;
            ++seen;
        } while (at != first_ && seen <= count_);
        return seen == count_;
    }

    static constexpr Place width = LevelLink::neighbours;
    static constexpr Place places = width * width;
    /// Of an edge, or of a neighbour with itself.
    static Place place(Place a, Place b) {
        return static_cast<Place>(a < b ? a * width + b : b * width + a);
    }

private:
    void add_end(Place a, Place b) {
        if (ends_[a] == 2) {
            is_valid_ = false;
            return;
        }
        if (ends_[a] == 0) {
            ++count_;
            first_ = a;
        }
        next_[a][ends_[a]++] = b;
    }

    std::array<std::uint8_t, places> ends_{};
    std::array<std::array<Place, 2>, places> next_;  // as many as there are ends
    Place first_ = 0;
    std::size_t count_ = 0;
    bool is_valid_ = true;
};

}  // namespace

std::span<const Triangle> LevelLink::triangles() { return all_triangles; }

NodePoint LevelLink::neighbour(const NodePoint& p, int which) {
    if (which < LevelGrid::short_directions) return LevelGrid::along(p, which);
    NodePoint out = p;
    out[static_cast<std::size_t>(which - 8) / 2] += which % 2 == 0 ? -2 : 2;
    return out;
}

namespace {

/// Signs beside edges of two zeros; the surface goes along those between 1 and -1.
using SignsBeside = std::array<std::int8_t, Curve::places>;

/// Adds what the surface has in a triangle. False where all corners are 0.
bool add_triangle(Curve& curve, SignsBeside& beside, const Triangle& t,
                  const std::array<std::int8_t, LevelLink::neighbours>& signs) {
    std::array<Curve::Place, 3> found{};
    std::size_t count = 0;
    std::size_t zeros = 0;
    std::size_t third = 0;  // the last one that is not 0
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint8_t a = t[i];
        const std::uint8_t b = t[(i + 1) % 3];
        if (signs[a] == 0) {
            ++zeros;
            found[count++] = Curve::place(a, a);
            continue;
        }
        third = i;
        if (signs[a] * signs[b] < 0) found[count++] = Curve::place(a, b);
    }
    if (zeros == 2) {
        const std::int8_t sign = signs[t[third]];
        std::int8_t& other = beside[Curve::place(t[(third + 1) % 3], t[(third + 2) % 3])];
        if (other * sign < 0) curve.add(found[0], found[1]);
        other = sign;
    } else if (count == 2) {
        curve.add(found[0], found[1]);
    }
    return zeros < 3;
}

}  // namespace

bool LevelLink::has_one_curve(const std::array<std::int8_t, neighbours>& signs) {
    Curve curve;
    SignsBeside beside{};
    return std::ranges::all_of(
               all_triangles,
               [&](const Triangle& t) { return add_triangle(curve, beside, t, signs); }) &&
           curve.is_one_cycle();
}

}  // namespace trisect::detail
