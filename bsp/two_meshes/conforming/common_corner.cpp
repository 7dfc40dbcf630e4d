// SPDX-License-Identifier: Apache-2.0
//
// Two facets around a corner are parts of two cones. Seen along an axis these are sectors of less
// than a half turn, and lie apart where one of their four sides has all of the other sector beyond
// it. Of each two spokes, one of either mesh, the turn is computed once.

#include <trisect/bsp/two_meshes/conforming/common_corner.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

constexpr std::size_t word_bits = 64;

bool has_bit(const std::uint64_t* row, std::uint32_t i) {
    return (row[i / word_bits] >> (i % word_bits) & 1U) != 0;
}

}  // namespace

void CommonCorner::set(std::uint32_t name, const CornerFans& fans) {
    name_ = name;
    for (std::size_t mesh = 0; mesh < 2; ++mesh) set_mesh(mesh, fans);
}

void CommonCorner::set_mesh(std::size_t mesh, const CornerFans& fans) {
    auto& sectors = sectors_[mesh];
    auto& uses = uses_[mesh];
    auto& spokes = spokes_[mesh];
    sectors.clear();
    uses.clear();
    spokes.clear();
    for (const CornerFans::Corner c : fans.around(mesh, name_)) {
        const auto i = static_cast<std::uint32_t>(sectors.size());
        const CornerNames::Triple& t = names_.corners(c.item());
        sectors.push_back({c.item(), 0, 0});
        uses.push_back({t[(c.place() + 1) % 3], i, true});
        uses.push_back({t[(c.place() + 2) % 3], i, false});
    }
    std::ranges::sort(uses, [](const Use& a, const Use& b) {
        return a.other != b.other ? a.other < b.other : a.sector < b.sector;
    });
    for (const Use& use : uses) {
        if (spokes.empty() || spokes.back() != use.other) spokes.push_back(use.other);
        Sector& s = sectors[use.sector];
        (use.forward ? s.next : s.last) = static_cast<std::uint32_t>(spokes.size() - 1);
    }
}

// Along the axis in which the facets of the first mesh together are largest.
void CommonCorner::project() {
    const Vector3 origin = names_.point(name_).doubles();
    std::array<std::vector<Vector3>, 2> from;
    Vector3 normal{};
    const auto at = [&](std::size_t mesh, std::uint32_t spoke) {
        return minus(names_.point(spokes_[mesh][spoke]).doubles(), origin);
    };
    for (const Sector& s : sectors_[0]) normal = plus(normal, cross(at(0, s.next), at(0, s.last)));
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(normal[k]) > std::fabs(normal[axis])) axis = k;
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (std::size_t mesh = 0; mesh < 2; ++mesh) {
        flat_[mesh].clear();
        for (std::uint32_t i = 0; i < spokes_[mesh].size(); ++i) {
            const Vector3 p = at(mesh, i);
            flat_[mesh].push_back({p[u], p[v]});
        }
    }
}

// Differences round once, so a turn is within 4·2^-53 of the sum of its products.
void CommonCorner::compare_spokes() {
    for (std::size_t mesh = 0; mesh < 2; ++mesh) {
        words_[mesh] = (spokes_[1 - mesh].size() + word_bits - 1) / word_bits;
        left_[mesh].assign(words_[mesh] * spokes_[mesh].size(), 0);
        right_[mesh].assign(words_[mesh] * spokes_[mesh].size(), 0);
    }
    for (std::size_t i = 0; i < flat_[0].size(); ++i) {
        const Flat& p = flat_[0][i];
        for (std::size_t j = 0; j < flat_[1].size(); ++j) {
            const Flat& q = flat_[1][j];
            const double over = p.x * q.y;
            const double under = p.y * q.x;
            const double turn = over - under;
            const double bound = minor_rounding * (std::fabs(over) + std::fabs(under));
            const std::uint64_t is_left = turn > bound ? 1 : 0;
            const std::uint64_t is_right = turn < -bound ? 1 : 0;
            const std::size_t of_first = words_[0] * i + j / word_bits;
            const std::size_t of_second = words_[1] * j + i / word_bits;
            left_[0][of_first] |= is_left << (j % word_bits);
            right_[0][of_first] |= is_right << (j % word_bits);
            right_[1][of_second] |= is_left << (i % word_bits);
            left_[1][of_second] |= is_right << (i % word_bits);
        }
    }
}

void CommonCorner::add_open_pairs(std::vector<Pair>& out) {
    project();
    compare_spokes();
    // Which way a sector turns; 0 where doubles do not say so.
    const auto turn_of = [&](std::size_t mesh, const Sector& s) {
        const Flat& p = flat_[mesh][s.next];
        const Flat& q = flat_[mesh][s.last];
        const double over = p.x * q.y;
        const double under = p.y * q.x;
        return certain_sign(over - under, minor_rounding * (std::fabs(over) + std::fabs(under)));
    };
    // Whether all of the other sector is beyond a side of this one.
    const auto is_beyond = [&](std::size_t mesh, const Sector& s, int turn, const Sector& other) {
        const auto are_in = [&](const std::vector<std::uint64_t>& rows, std::uint32_t spoke) {
            const std::uint64_t* const row = rows.data() + words_[mesh] * spoke;
            return has_bit(row, other.next) && has_bit(row, other.last);
        };
        if (turn > 0) return are_in(left_[mesh], s.last) || are_in(right_[mesh], s.next);
        if (turn < 0) return are_in(right_[mesh], s.last) || are_in(left_[mesh], s.next);
        return false;
    };
    const auto share_spoke = [&](const Sector& a, const Sector& b) {
        const std::uint32_t p = spokes_[0][a.next];
        const std::uint32_t q = spokes_[0][a.last];
        const std::uint32_t r = spokes_[1][b.next];
        const std::uint32_t s = spokes_[1][b.last];
        return p == r || p == s || q == r || q == s;
    };
    for (const Sector& a : sectors_[0]) {
        const int of_a = turn_of(0, a);
        for (const Sector& b : sectors_[1]) {
            if (is_beyond(0, a, of_a, b) || share_spoke(a, b) ||
                is_beyond(1, b, turn_of(1, b), a))
                continue;
            out.push_back({a.item, b.item});
        }
    }
}

}  // namespace trisect::detail
