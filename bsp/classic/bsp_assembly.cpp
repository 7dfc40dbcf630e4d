// SPDX-License-Identifier: Apache-2.0
//
// Assembly of fragments, without any hint about where they come from.
//
// Cutting leaves fragments whose edges do not match: one long edge on this side, three short ones
// on the other, vertices in the middle of edges (T-vertices), and one point under many names.
// Welding by distance closes such meshes mostly, and wrongly where the model is finer than the
// distance. All decisions here are exact, and they become simple by one choice: vertices are
// numbered in lexicographic order of their points. Then
//
//   - equal points have equal numbers, so everything after that is combinatorial;
//   - along any line numbers ascend or descend, so "between" and "in order" compare integers;
//   - the vertices that may lie on an edge have numbers between those of its ends;
//   - the smallest number in a region is on its outer loop.
//
// Steps: every vertex that lies on an edge is inserted there, after which edges of neighbours match
// piece by piece. Within a plane, pieces that run both ways cancel, joining their fragments; what
// is left bounds the joined regions. Where a region pinches at a vertex, several pieces leave it;
// the right continuation is the first one clockwise from the piece that we came by, because the
// region is between the two. Loops chained like that never leave their region, so each region has
// one outer loop, which holds its smallest vertex, and its other loops are holes: no hole is ever
// assigned by containment of points in polygons. At last, vertices are dropped where all loops pass
// straight along one line. Whether that is so is combinatorial as well: all passages have the same
// two neighbours.
//
// It is slow (edges are compared with all vertices in their range), on purpose: it is there to
// agree with the fast assembly, not to replace it.

#include <trisect/bsp/classic/bsp_assembly.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <trisect/brep/brep_builder.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/predicates.h>

namespace trisect {

namespace {

using Fragments = std::span<const ConvexPolygon>;
using Index = std::uint32_t;

constexpr Index no_vertex = ~Index{0};

Index to_index(std::size_t i) { return static_cast<Index>(i); }

/// The different points of all fragments in lexicographic order.
class VertexTable {
public:
    explicit VertexTable(Fragments fragments) {
        std::vector<std::pair<const Point*, Index>> corners;
        first_corner_.reserve(fragments.size());
        for (const ConvexPolygon& f : fragments) {
            first_corner_.push_back(to_index(corners.size()));
            for (const Point& p : f.vertices()) corners.emplace_back(&p, to_index(corners.size()));
        }
        std::sort(corners.begin(), corners.end(), [](const auto& a, const auto& b) {
            return compare_lexicographic(*a.first, *b.first) < 0;
        });
        vertex_of_corner_.resize(corners.size());
        for (const auto& [point, corner] : corners) {
            if (points_.empty() || !(*points_.back() == *point)) {
                points_.push_back(point);
                nearest_.push_back(point->nearest());
            } else if (point->is_lattice()) {
                points_.back() = point;  // at fractions others are named by planes
            }
            vertex_of_corner_[corner] = to_index(points_.size() - 1);
        }
    }

    [[nodiscard]] Index corner(std::size_t fragment, std::size_t i) const {
        return vertex_of_corner_[first_corner_[fragment] + i];
    }
    [[nodiscard]] std::size_t size() const { return points_.size(); }
    [[nodiscard]] const Point& point(Index v) const { return *points_[v]; }

    /// The vertices from a to b on the segment between them, which is where two planes meet. b is
    /// left out.
    [[nodiscard]] std::vector<Index> along(Index a, Index b, const Plane& p, const Plane& q) const {
        std::vector<Index> result;
        const Index low = std::min(a, b);
        const Index high = std::max(a, b);
        for (Index v = low + 1; v < high; ++v)
            if (in_box(v, low, high) && side_of(point(v), q) == Side::On &&
                side_of(point(v), p) == Side::On)
                result.push_back(v);
        if (a > b) std::reverse(result.begin(), result.end());
        result.insert(result.begin(), a);
        return result;
    }

private:
    // Correct rounding keeps the order of coordinates, so nothing on the segment is missed.
    [[nodiscard]] bool in_box(Index v, Index a, Index b) const {
        for (const std::size_t k : {std::size_t{1}, std::size_t{2}, std::size_t{0}}) {
            const auto [low, high] = std::minmax(nearest_[a][k], nearest_[b][k]);
            if (nearest_[v][k] < low || nearest_[v][k] > high) return false;
        }
        return true;
    }

    std::vector<const Point*> points_;
    std::vector<std::array<double, 3>> nearest_;
    std::vector<Index> vertex_of_corner_;
    std::vector<Index> first_corner_;
};

/// A piece of a fragment's edge between neighbouring vertices, its region on the left.
struct EdgePiece {
    Index from = 0;
    Index to = 0;
    Index fragment = 0;
    const Plane* edge = nullptr;  // the edge plane that holds it; the region is below
};

/// Sets of fragments that are joined.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : parent_(n) {
        std::iota(parent_.begin(), parent_.end(), Index{0});
    }
    Index find(Index i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(Index a, Index b) {
        parent_[std::max(find(a), find(b))] = std::min(find(a), find(b));
    }

private:
    std::vector<Index> parent_;
};

struct Loop {
    std::vector<EdgePiece> pieces;
    Index region = 0;
    Index smallest_vertex = 0;
};

/// Chains the pieces that bound the regions of one plane to loops.
class LoopChainer {
public:
    LoopChainer(const Plane& plane, std::vector<EdgePiece> pieces)
        : plane_(plane), pieces_(std::move(pieces)), used_(pieces_.size(), false) {
        std::sort(pieces_.begin(), pieces_.end(), [](const EdgePiece& a, const EdgePiece& b) {
            return std::pair(a.from, a.to) < std::pair(b.from, b.to);
        });
    }

    std::vector<std::vector<EdgePiece>> run() {
        std::vector<std::vector<EdgePiece>> loops;
        for (std::size_t first = 0; first < pieces_.size(); ++first) {
            if (used_[first]) continue;
            std::vector<EdgePiece> loop;
            for (std::size_t at = first; !used_[at]; at = next(pieces_[at])) {
                used_[at] = true;
                loop.push_back(pieces_[at]);
            }
            loops.push_back(std::move(loop));
        }
        return loops;
    }

private:
    std::size_t next(const EdgePiece& arriving) const {
        const auto [first, last] = std::equal_range(
            pieces_.begin(), pieces_.end(), EdgePiece{arriving.to, 0, 0, nullptr},
            [](const EdgePiece& a, const EdgePiece& b) { return a.from < b.from; });
        if (first == last)
            throw Error(ErrorCode::InvalidSolid, "the fragments of a boundary are not closed");
        auto best = first;
        for (auto it = first + 1; it != last; ++it)
            if (comes_first_clockwise(*it, *best, *arriving.edge)) best = it;
        return static_cast<std::size_t>(best - pieces_.begin());
    }

    // Clockwise from the direction back along the arriving piece. In the plane with normal n the
    // piece with edge plane normal e runs along n × e, so det(n, e, f) > 0 when the direction of f
    // is less than half a turn counter-clockwise from that of e.
    [[nodiscard]] bool comes_first_clockwise(const EdgePiece& a, const EdgePiece& b,
                                             const Plane& arriving) const {
        const Plane back = arriving.flipped();
        const int half_a = half_turns(back, *a.edge);
        const int half_b = half_turns(back, *b.edge);
        if (half_a != half_b) return half_a < half_b;
        return sign_of_det(plane_, *a.edge, *b.edge) < 0;
    }
    // 0: less than half a turn clockwise, 1: straight on, 2: more.
    [[nodiscard]] int half_turns(const Plane& back, const Plane& leaving) const {
        return 1 + sign_of_det(plane_, back, leaving);
    }

    const Plane& plane_;
    std::vector<EdgePiece> pieces_;
    std::vector<bool> used_;
};

class Assembler {
public:
    Assembler(Fragments fragments, Lattice lattice)
        : fragments_(fragments),
          vertices_(fragments),
          regions_(fragments.size()),
          builder_(lattice) {}

    Brep run() {
        for (const std::vector<Index>& group : groups_by_plane()) chain_loops(group);
        find_turning_vertices();
        sort_loops();
        emit();
        return std::move(builder_).build();
    }

private:
    /// Fragments with the same plane and orientation.
    [[nodiscard]] std::vector<std::vector<Index>> groups_by_plane() const {
        std::vector<std::vector<Index>> groups;
        for (Index f = 0; f < fragments_.size(); ++f) {
            const Plane& plane = fragments_[f].support();
            const auto it = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
                const Plane& other = fragments_[group.front()].support();
                return plane == other ||
                       (is_same_plane(plane, other) && same_orientation(plane, other));
            });
            if (it != groups.end())
                it->push_back(f);
            else
                groups.push_back({f});
        }
        return groups;
    }

    void chain_loops(const std::vector<Index>& group) {
        std::vector<EdgePiece> pieces;
        for (const Index f : group) append_pieces(f, pieces);
        pieces = without_opposites(std::move(pieces));
        const Plane& plane = fragments_[group.front()].support();
        for (std::vector<EdgePiece>& loop : LoopChainer(plane, std::move(pieces)).run()) {
            const auto smallest = std::min_element(loop.begin(), loop.end(),
                                                   [](const EdgePiece& a, const EdgePiece& b) {
                                                       return a.from < b.from;
                                                   })
                                      ->from;
            const Index region = regions_.find(loop.front().fragment);
            loops_.push_back({std::move(loop), region, smallest});
        }
    }

    void append_pieces(Index f, std::vector<EdgePiece>& pieces) const {
        const ConvexPolygon& fragment = fragments_[f];
        const std::size_t n = fragment.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Index end = vertices_.corner(f, i + 1 < n ? i + 1 : 0);
            const Plane& edge = fragment.edge(i);
            const std::vector<Index> chain =
                vertices_.along(vertices_.corner(f, i), end, fragment.support(), edge);
            for (std::size_t k = 0; k < chain.size(); ++k)
                pieces.push_back({chain[k], k + 1 < chain.size() ? chain[k + 1] : end, f, &edge});
        }
    }

    /// Cancels pieces that run both ways and joins their fragments.
    std::vector<EdgePiece> without_opposites(std::vector<EdgePiece> pieces) {
        const auto key = [](const EdgePiece& p) {
            return std::pair(std::min(p.from, p.to), std::max(p.from, p.to));
        };
        std::stable_sort(pieces.begin(), pieces.end(),
                         [&](const EdgePiece& a, const EdgePiece& b) { return key(a) < key(b); });
        std::vector<EdgePiece> left;
        for (const EdgePiece& p : pieces) {
            if (!left.empty() && left.back().from == p.to && left.back().to == p.from) {
                regions_.join(left.back().fragment, p.fragment);
                left.pop_back();
            } else {
                left.push_back(p);
            }
        }
        return left;
    }

    /// A vertex turns unless all loops pass it between the same two neighbours.
    void find_turning_vertices() {
        using Neighbours = std::pair<Index, Index>;
        std::vector<Neighbours> seen(vertices_.size(), {no_vertex, no_vertex});
        turns_.assign(vertices_.size(), false);
        for (const Loop& loop : loops_) {
            const Plane& plane = fragments_[loop.pieces.front().fragment].support();
            for (std::size_t i = 0; i < loop.pieces.size(); ++i) {
                const EdgePiece& in = loop.pieces[i];
                const EdgePiece& out = loop.pieces[i + 1 < loop.pieces.size() ? i + 1 : 0];
                const Neighbours here = std::minmax(in.from, out.to);
                Neighbours& before = seen[out.from];
                if (before.first == no_vertex) before = here;
                if (before != here || sign_of_det(plane, *in.edge, *out.edge) != 0)
                    turns_[out.from] = true;
            }
        }
    }

    /// By region, the outer loop first: the one with the smallest vertex.
    void sort_loops() {
        for (Loop& loop : loops_) loop.region = regions_.find(loop.region);
        std::sort(loops_.begin(), loops_.end(), [](const Loop& a, const Loop& b) {
            return std::pair(a.region, a.smallest_vertex) < std::pair(b.region, b.smallest_vertex);
        });
    }

    void emit() {
        std::vector<Index> number(vertices_.size(), no_vertex);
        std::vector<std::vector<Index>> face;
        for (std::size_t i = 0; i < loops_.size(); ++i) {
            face.emplace_back();
            for (const EdgePiece& piece : loops_[i].pieces) {
                if (!turns_[piece.from]) continue;
                Index& id = number[piece.from];
                if (id == no_vertex) id = builder_.add_vertex(vertices_.point(piece.from));
                face.back().push_back(id);
            }
            if (i + 1 < loops_.size() && loops_[i + 1].region == loops_[i].region) continue;
            builder_.add_face(fragments_[loops_[i].region].support(), face,
                              {0, to_index(builder_.face_count())});
            face.clear();
        }
    }

    Fragments fragments_;
    VertexTable vertices_;
    DisjointSets regions_;  // of fragments
    std::vector<Loop> loops_;
    std::vector<bool> turns_;
    BrepBuilder builder_;
};

}  // namespace

Brep brep_from_fragments(std::span<const ConvexPolygon> fragments, Lattice lattice) {
    return Assembler(fragments, lattice).run();
}

}  // namespace trisect
