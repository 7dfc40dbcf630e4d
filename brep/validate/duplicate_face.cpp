// SPDX-License-Identifier: Apache-2.0
//
// duplicate_face and duplicate_opposite_faces: faces with the same corners in the same cyclic
// order, or in the reverse one. Loops are compared in a canonical form: the least of all rotations
// in both directions.

#include <algorithm>
#include <utility>

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

namespace {

struct CanonicalLoop {
    std::vector<std::uint32_t> corners;
    bool reversed = false;
};

// Start of the least rotation: two candidates race; the loser's whole matched stretch is ruled out,
// so this is linear.
std::size_t least_rotation(std::span<const std::uint32_t> v) {
    const std::size_t n = v.size();
    std::size_t i = 0;
    std::size_t j = 1;
    std::size_t k = 0;
    while (i < n && j < n && k < n) {
        const std::uint32_t a = v[(i + k) % n];
        const std::uint32_t b = v[(j + k) % n];
        if (a == b) {
            ++k;
            continue;
        }
        (a > b ? i : j) += k + 1;
        if (i == j) ++j;
        k = 0;
    }
    return std::min(i, j);
}

CanonicalLoop canonical(std::span<const std::uint32_t> loop) {
    const auto rotated = [](std::vector<std::uint32_t> v) {
        const auto start = static_cast<std::ptrdiff_t>(least_rotation(v));
        std::rotate(v.begin(), v.begin() + start, v.end());
        return v;
    };
    CanonicalLoop out;
    out.corners = rotated({loop.begin(), loop.end()});
    auto backward = rotated({loop.rbegin(), loop.rend()});
    if (backward < out.corners) {
        out.corners = std::move(backward);
        out.reversed = true;
    }
    return out;
}

// Independent of rotation and direction.
std::uint64_t signature(std::span<const std::uint32_t> loop) {
    std::uint64_t s = loop.size();
    for (const std::uint32_t c : loop) {
        std::uint64_t h = (c + 1) * 0x9e3779b97f4a7c15U;
        h ^= h >> 29;
        s += h * 0xbf58476d1ce4e5b9U;
    }
    return s;
}

void report_pair(const CheckedMesh& m, std::uint32_t a, std::uint32_t b, bool same,
                 ValidationReport& report) {
    const auto kind = same ? DefectKind::DuplicateFace : DefectKind::DuplicateOppositeFaces;
    report.add(kind, [&] {
        return Defect{kind,
                      {},
                      {a, b},
                      m.face_place(a),
                      "faces " + std::to_string(a) + " and " + std::to_string(b) + " at " +
                          place_text(m.face_place(a)) + " have the same corners and " +
                          (same ? "the same" : "opposite") + " orientation"};
    });
}

}  // namespace

void check_duplicate_faces(const CheckedMesh& m, ValidationReport& report) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> faces;
    for (std::uint32_t f = 0; f < m.mesh.face_count(); ++f)
        if (m.mesh.loop(f).size() >= 3) faces.emplace_back(signature(m.mesh.loop(f)), f);
    std::sort(faces.begin(), faces.end());

    struct Pair {
        std::uint32_t a, b;
        bool same;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < faces.size();) {
        std::size_t end = i + 1;
        while (end < faces.size() && faces[end].first == faces[i].first) ++end;
        if (end - i > 1) {
            std::vector<std::pair<CanonicalLoop, std::uint32_t>> group;
            for (; i < end; ++i)
                group.emplace_back(canonical(m.mesh.loop(faces[i].second)), faces[i].second);
            std::stable_sort(group.begin(), group.end(), [](const auto& x, const auto& y) {
                return x.first.corners < y.first.corners;
            });
            // A run of equal loops: each is compared with the one before it.
            for (std::size_t k = 1; k < group.size(); ++k) {
                const auto& [x, a] = group[k - 1];
                const auto& [y, b] = group[k];
                if (x.corners == y.corners) pairs.push_back({a, b, x.reversed == y.reversed});
            }
        }
        i = end;
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
        return std::pair(x.a, x.b) < std::pair(y.a, y.b);
    });
    for (const Pair& p : pairs) report_pair(m, p.a, p.b, p.same, report);
}

}  // namespace trisect::detail
