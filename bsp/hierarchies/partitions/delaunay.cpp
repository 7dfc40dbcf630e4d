// SPDX-License-Identifier: Apache-2.0
//
// A point is inserted by taking away all tetrahedra whose spheres contain it strictly and joining
// it to the surface of the cavity. With exact signs this cannot go wrong, even where many points
// are on one sphere, as the corners of machined parts are:
//   - p is in some closed tetrahedron and not a corner of it, so strictly inside of its sphere: the
//     cavity is not empty;
//   - along a ray from p the power of p with respect to the spheres that are passed never falls, so
//     the cavity is star-shaped and connected;
//   - p is not in the plane of a face of the cavity's surface: within that plane both spheres at
//     the face cut out the same disc, so p would be inside both or neither. So every new
//     tetrahedron has volume. All points are strictly inside of the cube, so this holds at its
//     surface as well.
//
// Each walk to the place of the next point is short because points come in rounds of doubling size,
// chosen at random, each in the order of a curve through space. The random numbers are always the
// same.

#include <trisect/bsp/hierarchies/partitions/delaunay.h>

#include <algorithm>
#include <utility>

#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::hierarchies {

namespace {

// Bits of three coordinates in turns: the order of an octree.
std::uint64_t curve_key(const IntegerPoint& p, const IntegerPoint& low, int shift) {
    std::uint64_t key = 0;
    for (int bit = 20; bit >= 0; --bit)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = static_cast<std::uint64_t>(p[k] - low[k]) >> shift;
            key = key << 1U | (at >> static_cast<unsigned>(bit) & 1U);
        }
    return key;
}

// Sorted by rounds and the curve, without repetitions.
std::vector<IntegerPoint> in_order(std::span<const IntegerPoint> points, const IntegerPoint& low,
                                   std::int64_t side) {
    std::vector<IntegerPoint> r(points.begin(), points.end());
    std::sort(r.begin(), r.end());
    r.erase(std::unique(r.begin(), r.end()), r.end());
    int shift = 0;
    while ((side >> shift) >= (std::int64_t{1} << 21)) ++shift;
    struct Entry {
        unsigned round;
        std::uint64_t key;
        IntegerPoint point;
    };
    std::vector<Entry> entries;
    entries.reserve(r.size());
    for (std::size_t i = 0; i < r.size(); ++i) {
        // A random number of coins: half of the points are in the last round.
        const auto coins = detail::mix64(i + 0x9e3779b97f4a7c15ULL);
        unsigned heads = 0;
        while (heads < 40 && (coins >> heads & 1U) != 0) ++heads;
        entries.push_back({40 - heads, curve_key(r[i], low, shift), r[i]});
    }
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return std::pair(a.round, a.key) < std::pair(b.round, b.key);
    });
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = entries[i].point;
    return r;
}

// The corners of face i of a positive tetrahedron, so that with a point on the inner side in place
// of corner i the tetrahedron is positive again.
int side_of_face(const std::array<IntegerPoint, 4>& t, std::size_t i, const IntegerPoint& p) {
    std::array<IntegerPoint, 4> with = t;
    with[i] = p;
    return orientation(with[0], with[1], with[2], with[3]);
}

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32U | std::max(a, b);
}

WideInt<4> six_volumes(const std::array<IntegerPoint, 4>& t) {
    WideInt<4> r;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto d = [&t](std::size_t corner, std::size_t k) {
            return static_cast<Int128>(t[corner][k % 3] - t[0][k % 3]);
        };
        const Int128 minor = d(2, i + 1) * d(3, i + 2) - d(2, i + 2) * d(3, i + 1);
        r += multiply<4>(WideInt<2>(minor), WideInt<2>(d(1, i)));
    }
    return r;
}

}  // namespace

DelaunayMesh::DelaunayMesh(std::span<const IntegerPoint> points) {
    IntegerPoint low{};
    IntegerPoint high{};
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = i == 0 ? points[i][k] : std::min(low[k], points[i][k]);
            high[k] = i == 0 ? points[i][k] : std::max(high[k], points[i][k]);
        }
    std::int64_t side = 0;
    for (std::size_t k = 0; k < 3; ++k) side = std::max(side, high[k] - low[k]);
    const std::int64_t margin = side / 8 + 1;
    side += 2 * margin;
    for (std::size_t k = 0; k < 3; ++k) low[k] -= margin;
    for (std::size_t c = 0; c < 8; ++c) {
        IntegerPoint p = low;
        for (std::size_t k = 0; k < 3; ++k)
            if ((c >> k & 1U) != 0) p[k] += side;
        points_.push_back(p);
    }
    fill_cube();
    mark_.assign(tetrahedra_.size(), 0);
    for (const IntegerPoint& p : in_order(points, low, side)) {
        if (tetrahedra_.size() > most_per_point * points_.size()) break;
        points_.push_back(p);
        insert(static_cast<std::uint32_t>(points_.size() - 1));
    }
    remove_free();
}

// The last ones take their places.
void DelaunayMesh::remove_free() {
    std::sort(free_.rbegin(), free_.rend());
    for (const std::uint32_t place : free_) {
        const auto last = static_cast<std::uint32_t>(tetrahedra_.size() - 1);
        if (place != last) {
            for (const std::uint32_t n : tetrahedra_[last].neighbour)
                if (n != none) tetrahedra_[n].neighbour[face_towards(n, last)] = place;
            tetrahedra_[place] = tetrahedra_[last];
        }
        tetrahedra_.pop_back();
    }
    free_ = {};
    mark_ = {};
}

// Six tetrahedra, one for each way along three edges from the first corner to the last.
void DelaunayMesh::fill_cube() {
    std::array<std::uint32_t, 3> order{0, 1, 2};
    do {
        Tetrahedron t;
        t.corner = {0, 1U << order[0], (1U << order[0]) | (1U << order[1]), 7};
        t.neighbour.fill(none);
        const auto p = corners_of(t);
        if (orientation(p[0], p[1], p[2], p[3]) < 0) std::swap(t.corner[1], t.corner[2]);
        tetrahedra_.push_back(t);
    } while (std::next_permutation(order.begin(), order.end()));
    const auto face_of = [this](std::uint32_t t, std::size_t i) {
        auto c = tetrahedra_[t].corner;
        c[i] = none;
        std::sort(c.begin(), c.end());
        return c;
    };
    for (std::uint32_t s = 0; s < 6; ++s)
        for (std::uint32_t t = 0; t < 6; ++t)
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < 4; ++j)
                    if (s != t && face_of(s, i) == face_of(t, j)) tetrahedra_[s].neighbour[i] = t;
}

std::array<IntegerPoint, 4> DelaunayMesh::corners_of(const Tetrahedron& t) const {
    return {points_[t.corner[0]], points_[t.corner[1]], points_[t.corner[2]], points_[t.corner[3]]};
}

// Going on through any face that p is beyond comes to an end in a Delaunay mesh: the power of p
// with respect to the spheres falls with every step.
std::uint32_t DelaunayMesh::locate(const IntegerPoint& p, std::uint32_t start,
                                   std::uint64_t& steps) const {
    std::uint32_t at = start;
    std::uint32_t from = none;
    while (true) {
        ++steps;
        const Tetrahedron& t = tetrahedra_[at];
        const auto corners = corners_of(t);
        std::uint32_t next = none;
        for (std::size_t i = 0; i < 4 && next == none; ++i)
            if (t.neighbour[i] != none && t.neighbour[i] != from && side_of_face(corners, i, p) < 0)
                next = t.neighbour[i];
        if (next == none) return at;
        from = at;
        at = next;
    }
}

void DelaunayMesh::insert(std::uint32_t corner) {
    std::uint64_t steps = 0;
    ++insertion_;
    find_cavity(locate(points_[corner], last_, steps), points_[corner]);
    fill_cavity(corner);
}

void DelaunayMesh::find_cavity(std::uint32_t start, const IntegerPoint& p) {
    // Marks: twice the number of the insertion where it is in the cavity, one more where it is not.
    cavity_.assign(1, start);
    surface_.clear();
    mark_[start] = 2 * insertion_;
    for (std::size_t c = 0; c < cavity_.size(); ++c) {
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::uint32_t n = tetrahedra_[cavity_[c]].neighbour[i];
            if (n != none && mark_[n] < 2 * insertion_) {
                const bool inside = side_of_sphere(corners_of(tetrahedra_[n]), p) > 0;
                mark_[n] = 2 * insertion_ + (inside ? 0 : 1);
                if (inside) cavity_.push_back(n);
            }
            if (n == none || mark_[n] != 2 * insertion_)
                surface_.push_back(
                    {{cavity_[c], i}, {n, n == none ? 0 : face_towards(n, cavity_[c])}});
        }
    }
}

// Two tetrahedra share one face at most.
std::uint32_t DelaunayMesh::face_towards(std::uint32_t t, std::uint32_t neighbour) const {
    const auto& n = tetrahedra_[t].neighbour;
    return static_cast<std::uint32_t>(std::find(n.begin(), n.end(), neighbour) - n.begin());
}

void DelaunayMesh::fill_cavity(std::uint32_t corner) {
    // One tetrahedron for each face, in the places of the old ones first.
    std::vector<Tetrahedron> added;
    added.reserve(surface_.size());
    for (const SplittingPlane& w : surface_) {
        Tetrahedron t;
        t.corner = tetrahedra_[w.inside.tetrahedron].corner;
        t.corner[w.inside.face] = corner;
        t.neighbour.fill(none);
        t.neighbour[w.inside.face] = w.outside.tetrahedron;
        added.push_back(t);
    }
    // There may be more old ones than new ones.
    while (cavity_.size() > surface_.size()) {
        free_.push_back(cavity_.back());
        tetrahedra_[cavity_.back()] = {};
        cavity_.pop_back();
    }
    while (cavity_.size() < surface_.size() && !free_.empty()) {
        cavity_.push_back(free_.back());
        free_.pop_back();
    }
    while (cavity_.size() < surface_.size()) {
        cavity_.push_back(static_cast<std::uint32_t>(tetrahedra_.size()));
        tetrahedra_.emplace_back();
        mark_.push_back(0);
    }
    edges_.clear();
    for (std::size_t n = 0; n < added.size(); ++n) {
        const SplittingPlane& w = surface_[n];
        tetrahedra_[cavity_[n]] = added[n];
        if (w.outside.tetrahedron != none)
            tetrahedra_[w.outside.tetrahedron].neighbour[w.outside.face] = cavity_[n];
        for (std::uint32_t i = 0; i < 4; ++i) {
            if (i == w.inside.face) continue;
            // The face opposite corner i has the new point and an edge of the face.
            std::array<std::uint32_t, 2> ends{};
            std::size_t k = 0;
            for (std::uint32_t j = 0; j < 4; ++j)
                if (j != i && j != w.inside.face) ends[k++] = added[n].corner[j];
            edges_.push_back({edge_key(ends[0], ends[1]), {cavity_[n], i}});
        }
    }
    // Each edge of the surface has a face on both sides.
    std::sort(edges_.begin(), edges_.end(),
              [](const Edge& a, const Edge& b) { return a.key < b.key; });
    for (std::size_t e = 0; e + 1 < edges_.size(); e += 2) {
        const Side& a = edges_[e].side;
        const Side& b = edges_[e + 1].side;
        tetrahedra_[a.tetrahedron].neighbour[a.face] = b.tetrahedron;
        tetrahedra_[b.tetrahedron].neighbour[b.face] = a.tetrahedron;
    }
    last_ = cavity_[0];
}

bool DelaunayMesh::is_valid(bool all_spheres) const {
    WideInt<4> volume;
    for (std::uint32_t n = 0; n < tetrahedra_.size(); ++n) {
        const Tetrahedron& t = tetrahedra_[n];
        const auto p = corners_of(t);
        if (orientation(p[0], p[1], p[2], p[3]) != 1) return false;
        volume += six_volumes(p);
        for (std::uint32_t i = 0; i < 4; ++i) {
            if (t.neighbour[i] == none) continue;
            const Tetrahedron& o = tetrahedra_[t.neighbour[i]];
            const std::uint32_t j = face_towards(t.neighbour[i], n);
            if (j == 4) return false;
            for (std::uint32_t k = 0; k < 4; ++k)
                if (k != i && std::count(o.corner.begin(), o.corner.end(), t.corner[k]) != 1)
                    return false;
            if (side_of_sphere(p, points_[o.corner[j]]) > 0) return false;
        }
        if (!all_spheres) continue;
        for (const IntegerPoint& q : points_)
            if (side_of_sphere(p, q) > 0) return false;
    }
    const WideInt<1> side(high()[0] - low()[0]);
    return volume == multiply<4>(WideInt<1>(6), multiply<3>(side, multiply<2>(side, side)));
}

}  // namespace trisect::hierarchies
