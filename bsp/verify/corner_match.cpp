// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/verify/corner_match.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include <trisect/brep/measure/grid_distance.h>
#include <trisect/kernel/support/disjoint_sets.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

using Index = std::uint32_t;
constexpr Index none = BoundaryPlaces::none;

/// How often edges of outlines run from their lesser to their greater place, less how often back.
class Outlines {
public:
    void add(Index face, Index from, Index to, int count) {
        if (from > to) {
            std::swap(from, to);
            count = -count;
        }
        sums_[{face, from, to}] += count;
    }
    void add(Index face, const std::array<Index, 3>& triangle) {
        for (std::size_t i = 0; i < 3; ++i) add(face, triangle[i], triangle[(i + 1) % 3], 1);
    }
    /// Edges of the triangle that the sum lacks, where it is added.
    [[nodiscard]] int fitting(Index face, const std::array<Index, 3>& triangle) const {
        int out = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            Index from = triangle[i];
            Index to = triangle[(i + 1) % 3];
            int wanted = -1;
            if (from > to) {
                std::swap(from, to);
                wanted = 1;
            }
            const auto sum = sums_.find({face, from, to});
            if (sum != sums_.end() && sum->second * wanted > 0) ++out;
        }
        return out;
    }
    /// Calls visit(from, to) for each edge that is left.
    template <class Visit>
    void for_each_left(Visit&& visit) const {
        for (const auto& [edge, sum] : sums_)
            if (sum != 0) visit(edge[1], edge[2]);
    }

private:
    std::map<std::array<Index, 3>, int> sums_;  ///< by face, lesser and greater place
};

/// Segments between places that lie in the boundary.
class CoveredSegments {
public:
    void add(Index a, Index b) { keys_[key(a, b)] = true; }
    void add(const std::array<Index, 3>& t) {
        for (std::size_t i = 0; i < 3; ++i) add(t[i], t[(i + 1) % 3]);
    }
    [[nodiscard]] bool has(Index a, Index b) const { return keys_.contains(key(a, b)); }
    [[nodiscard]] int count(const std::array<Index, 3>& t) const {
        return has(t[0], t[1]) + has(t[1], t[2]) + has(t[2], t[0]);
    }

private:
    static std::uint64_t key(Index a, Index b) {
        return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    }
    std::unordered_map<std::uint64_t, bool> keys_;
};

class CornerMatch {
public:
    CornerMatch(const Brep& exact, const BoundaryTriangles& surface, const LatticeMesh& mesh,
                double reach)
        : exact_(exact), mesh_(mesh), places_(exact, surface, reach) {}

    CornerBound run() {
        move_corners();
        for (const FaceId f : exact_.faces())
            for (const HalfedgeId h : exact_.halfedges(f)) add_outline(f, h);
        for (const auto& t : mesh_.triangles) assign({place_[t[0]], place_[t[1]], place_[t[2]]});
        assign_flat();
        check_covers();
        const double move = WideInt<2>(places_.largest_move()).to_double();
        return {std::ldexp(move, -grid_bits) * (1 + 0x1p-50) + grid_error, boxes()};
    }

private:
    using Triangle = std::array<Index, 3>;

    void move_corners() {
        place_.assign(mesh_.points.size(), none);
        for (const auto& t : mesh_.triangles)
            for (const Index c : t)
                if (place_[c] == none) place_[c] = places_.place_at(to_grid(mesh_.points[c]));
    }

    void add_outline(FaceId f, HalfedgeId h) {
        Index from = places_.place_of(exact_.origin(h));
        const auto step_to = [&](Index to) {
            outlines_.add(f.index, from, to, -1);
            covered_.add(from, to);
            from = to;
        };
        for (const Index p : places_.within(h)) step_to(p);
        step_to(places_.place_of(exact_.target(h)));
    }

    [[nodiscard]] std::vector<Index> common_faces(const Triangle& t) const {
        std::vector<Index> out;
        for (const Index f : places_.faces_at(t[0])) {
            const auto has = [&](Index p) {
                const auto& faces = places_.faces_at(p);
                return std::binary_search(faces.begin(), faces.end(), f);
            };
            if (has(t[1]) && has(t[2])) out.push_back(f);
        }
        return out;
    }

    void assign(const Triangle& t) {
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
            collapsed_.push_back(t);
            return;
        }
        bool flat = false;
        for (const Index f : common_faces(t)) {
            const int orientation = places_.orientation(FaceId(f), t);
            flat = flat || orientation == 0;
            if (orientation <= 0) continue;
            outlines_.add(f, t);
            covered_.add(t);
            return;
        }
        (flat ? flat_ : left_).push_back(t);
    }

    /// Each to the face where its edges cancel others, as long as there is one.
    void assign_flat() {
        std::vector<Triangle> open = flat_;
        for (std::size_t before = open.size() + 1; open.size() < before;) {
            before = open.size();
            std::erase_if(open, [&](const Triangle& t) { return assign_to_best_face(t); });
        }
        left_.insert(left_.end(), open.begin(), open.end());
    }
    bool assign_to_best_face(const Triangle& t) {
        Index best = none;
        int most = 0;
        for (const Index f : common_faces(t)) {
            const int fitting = outlines_.fitting(f, t);
            if (fitting > most) best = f;
            most = std::max(most, fitting);
        }
        if (best != none) outlines_.add(best, t);
        return best != none;
    }

    /// Of three places on one line, two segments make up the third, or are a part of it.
    void check_covers() {
        std::vector<Triangle> open = flat_;
        for (std::size_t before = open.size() + 1; open.size() < before;) {
            before = open.size();
            std::erase_if(open, [&](const Triangle& t) {
                if (covered_.count(t) < 2) return false;
                covered_.add(t);
                return true;
            });
        }
        left_.insert(left_.end(), open.begin(), open.end());
        for (const Triangle& t : collapsed_)
            for (std::size_t i = 0; i < 3; ++i)
                if (t[i] != t[(i + 1) % 3] && !covered_.has(t[i], t[(i + 1) % 3]))
                    left_.push_back(t);
    }

    /// Around each connected part of what is left.
    [[nodiscard]] std::vector<GridBox> boxes() const {
        DisjointSets parts;
        parts.start(places_.count());
        std::vector<bool> is_used(places_.count(), false);
        const auto join = [&](Index a, Index b) {
            is_used[a] = is_used[b] = true;
            parts.join(a, b);
        };
        outlines_.for_each_left(join);
        for (const Triangle& t : left_) {
            join(t[0], t[1]);
            join(t[0], t[2]);
        }
        std::map<Index, GridBox> boxes;
        for (Index p = 0; p < places_.count(); ++p) {
            if (!is_used[p]) continue;
            const GridPoint& at = places_.at(p);
            GridBox& box = boxes.try_emplace(parts.root(p), GridBox{at, at}).first->second;
            for (std::size_t k = 0; k < 3; ++k) {
                box.low[k] = std::min(box.low[k], at[k] - places_.largest_move() - 1);
                box.high[k] = std::max(box.high[k], at[k] + places_.largest_move() + 1);
            }
        }
        std::vector<GridBox> out;
        for (const auto& [part, box] : boxes) out.push_back(box);
        return out;
    }

    const Brep& exact_;
    const LatticeMesh& mesh_;
    BoundaryPlaces places_;
    std::vector<Index> place_;  ///< of each corner of the mesh
    Outlines outlines_;
    CoveredSegments covered_;
    std::vector<Triangle> flat_;       ///< after the move
    std::vector<Triangle> collapsed_;  ///< two corners in one place
    std::vector<Triangle> left_;       ///< in no face
};

}  // namespace

CornerBound matched_corners(const Brep& exact, const BoundaryTriangles& surface,
                            const LatticeMesh& mesh, double reach) {
    return CornerMatch(exact, surface, mesh, reach).run();
}

}  // namespace trisect::detail
