// SPDX-License-Identifier: Apache-2.0
//
// Brep: the boundary of a solid, with exact points and planes.
// It consists of vertices, halfedges, loops, faces and shells.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>

namespace trisect {

/// An index with a typed meaning: ids of different entities do not mix. Trivial type of four bytes;
/// a default-constructed one names nothing.
template <class Entity>
struct EntityId {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t index = none;

    constexpr EntityId() = default;
    constexpr explicit EntityId(std::size_t i) : index(static_cast<std::uint32_t>(i)) {}
    [[nodiscard]] constexpr bool is_valid() const { return index != none; }
    friend constexpr auto operator<=>(const EntityId&, const EntityId&) = default;
};

using VertexId = EntityId<struct VertexEntity>;
using HalfedgeId = EntityId<struct HalfedgeEntity>;
using EdgeId = EntityId<struct EdgeEntity>;
using LoopId = EntityId<struct LoopEntity>;
using FaceId = EntityId<struct FaceEntity>;
using ShellId = EntityId<struct ShellEntity>;

/// The ids begin, begin+1, ..., end-1, for range-based loops.
template <class Id>
class IdRange {
public:
    class Iterator {
    public:
        explicit constexpr Iterator(std::uint32_t i) : i_(i) {}
        constexpr Id operator*() const { return Id(i_); }
        constexpr Iterator& operator++() {
            ++i_;
            return *this;
        }
        friend constexpr bool operator==(const Iterator&, const Iterator&) = default;

    private:
        std::uint32_t i_;
    };

    constexpr IdRange(std::size_t begin, std::size_t end)
        : begin_(static_cast<std::uint32_t>(begin)), end_(static_cast<std::uint32_t>(end)) {}
    [[nodiscard]] constexpr Iterator begin() const { return Iterator(begin_); }
    [[nodiscard]] constexpr Iterator end() const { return Iterator(end_); }
    [[nodiscard]] constexpr std::size_t size() const { return end_ - begin_; }
    [[nodiscard]] constexpr bool empty() const { return begin_ == end_; }
    [[nodiscard]] constexpr Id operator[](std::size_t i) const { return Id(begin_ + i); }

private:
    std::uint32_t begin_;
    std::uint32_t end_;
};

/// Where a face comes from: which operand of an operation, which face of that operand.
struct FaceSource {
    std::uint32_t operand = 0;
    std::uint32_t face = 0;
    friend constexpr auto operator<=>(const FaceSource&, const FaceSource&) = default;
};

/// How many there are of each entity. Every face has one outer loop; the other loops are inner.
struct BrepCounts {
    std::size_t vertices = 0;
    std::size_t halfedges = 0;
    std::size_t edges = 0;
    std::size_t loops = 0;
    std::size_t faces = 0;
    std::size_t shells = 0;

    /// V - E + F - (inner loops): a face with h holes counts 1 - h, as a disk with h holes does.
    [[nodiscard]] std::ptrdiff_t euler_characteristic() const {
        const auto s = [](std::size_t n) { return static_cast<std::ptrdiff_t>(n); };
        return s(vertices) - s(edges) + s(faces) - (s(loops) - s(faces));
    }
    friend constexpr bool operator==(const BrepCounts&, const BrepCounts&) = default;
};

/// A closed, oriented 2-manifold of planar faces.
///
/// Invariants:
///  1. twin is an involution without fixed points; origin(twin(h)) = target(h).
///  2. The halfedges of a loop are consecutive ids, those of a face's loops too; the first loop of
///     a face is its outer one. Outer loops run counter-clockwise seen from outside, inner ones
///     clockwise: the face lies to the left of each of its halfedges.
///  3. Every corner of a face lies exactly on its plane; the plane's normal points outward and the
///     solid lies below it.
///  4. The halfedges leaving a vertex form one cycle under h -> twin(prev(h)).
///  5. Every entity is used: no isolated vertex, no empty shell.
///  6. A face is connected. Its loops do not touch each other; where one touches itself, its
///     corners there have disjoint wedges that contain no edge. A hole of two corners is a slit.
///
/// Where the solid touches itself the set is not a manifold. There the boundary is taken apart by
/// an infinitesimal amount, so that the solid's inside decides what stays connected: two cubes
/// that share an edge become two shells, each with its own copy of the edge and its ends. Copies
/// are linked to each other (`copies`). Two copies of an edge may join the same two vertices, where
/// the boundary stays connected at both.
///
/// The two faces of an edge may be the same one. The empty Brep bounds the empty set.
///
/// \pre of everything that takes an id: it is below the count of its kind. Audit builds check it
/// (kernel/contract.h); what walks a shell always does, and throws UsageError.
///
/// Immutable; made by BrepBuilder. Copying is O(size). Safe to read from many threads.
class Brep {
public:
    Brep() = default;

    [[nodiscard]] Lattice lattice() const { return lattice_; }
    [[nodiscard]] bool is_empty() const { return faces_.empty(); }
    [[nodiscard]] BrepCounts counts() const;
    /// Counts of one shell. O(its size).
    [[nodiscard]] BrepCounts counts(ShellId s) const;
    /// Handles of the shell: V - E + F - (inner loops) = 2 (1 - genus). O(its size).
    [[nodiscard]] std::ptrdiff_t genus(ShellId s) const;

    [[nodiscard]] IdRange<VertexId> vertices() const { return {0, vertices_.size()}; }
    [[nodiscard]] IdRange<HalfedgeId> halfedges() const { return {0, halfedges_.size()}; }
    [[nodiscard]] IdRange<EdgeId> edges() const { return {0, edges_.size()}; }
    [[nodiscard]] IdRange<LoopId> loops() const { return {0, loops_.size()}; }
    [[nodiscard]] IdRange<FaceId> faces() const { return {0, faces_.size()}; }
    [[nodiscard]] IdRange<ShellId> shells() const { return {0, shell_count()}; }

    [[nodiscard]] HalfedgeId twin(HalfedgeId h) const { return at(halfedges_, h).twin; }
    [[nodiscard]] HalfedgeId next(HalfedgeId h) const;
    [[nodiscard]] HalfedgeId prev(HalfedgeId h) const;
    [[nodiscard]] VertexId origin(HalfedgeId h) const { return at(halfedges_, h).origin; }
    [[nodiscard]] VertexId target(HalfedgeId h) const { return origin(twin(h)); }
    [[nodiscard]] EdgeId edge(HalfedgeId h) const { return at(halfedges_, h).edge; }
    [[nodiscard]] LoopId loop(HalfedgeId h) const { return at(halfedges_, h).loop; }
    [[nodiscard]] FaceId face(HalfedgeId h) const { return face(loop(h)); }

    /// The halfedge of the edge with the smaller id.
    [[nodiscard]] HalfedgeId halfedge(EdgeId e) const { return at(edges_, e).first; }
    /// One of the halfedges that leave the vertex.
    [[nodiscard]] HalfedgeId outgoing(VertexId v) const { return at(vertices_, v).outgoing; }
    /// All of them, in the order of the fan.
    [[nodiscard]] std::vector<HalfedgeId> outgoing_halfedges(VertexId v) const;

    [[nodiscard]] FaceId face(LoopId l) const { return at(loops_, l).face; }
    [[nodiscard]] IdRange<HalfedgeId> halfedges(LoopId l) const;
    /// All loops of a face, the outer one first.
    [[nodiscard]] IdRange<LoopId> loops(FaceId f) const;
    [[nodiscard]] LoopId outer_loop(FaceId f) const { return LoopId(at(faces_, f).first_loop); }
    [[nodiscard]] IdRange<LoopId> inner_loops(FaceId f) const;
    /// The halfedges of all loops of a face.
    [[nodiscard]] IdRange<HalfedgeId> halfedges(FaceId f) const;
    [[nodiscard]] const Plane& plane(FaceId f) const { return at(planes_, f); }
    [[nodiscard]] FaceSource source(FaceId f) const { return at(faces_, f).source; }
    [[nodiscard]] ShellId shell(FaceId f) const { return at(faces_, f).shell; }
    /// The faces of a shell in ascending order.
    [[nodiscard]] std::span<const FaceId> faces(ShellId s) const;

    [[nodiscard]] const Point& point(VertexId v) const { return at(points_, v); }
    [[nodiscard]] std::span<const Point> points() const { return points_; }

    /// The vertices at the same place, this one included; empty when it is the only one.
    [[nodiscard]] std::span<const VertexId> copies(VertexId v) const;
    /// The edges that were one edge with four or more faces, this one included; empty when the
    /// edge always had two faces.
    [[nodiscard]] std::span<const EdgeId> copies(EdgeId e) const;
    /// Number of places where vertices, and of those where edges, were taken apart.
    [[nodiscard]] std::size_t vertex_contact_count() const { return vertex_copies_.group_count(); }
    [[nodiscard]] std::size_t edge_contact_count() const { return edge_copies_.group_count(); }

private:
    friend class BrepBuilder;
    friend class BrepConnector;

    static constexpr std::uint32_t no_group = std::numeric_limits<std::uint32_t>::max();

    struct Halfedge {
        VertexId origin;
        HalfedgeId twin;
        EdgeId edge;
        LoopId loop;
    };
    struct Edge {
        HalfedgeId first;
        std::uint32_t group = no_group;
    };
    struct Vertex {
        HalfedgeId outgoing;
        std::uint32_t group = no_group;
    };
    struct Loop {
        std::uint32_t first = 0;  // halfedges first .. next loop's first
        FaceId face;
    };
    struct Face {
        std::uint32_t first_loop = 0;
        FaceSource source;
        ShellId shell;
    };
    // Groups of ids, one after the other.
    template <class Id>
    struct Groups {
        std::vector<Id> members;
        std::vector<std::uint32_t> begin{0};
        [[nodiscard]] std::size_t group_count() const { return begin.size() - 1; }
        [[nodiscard]] std::span<const Id> group(std::uint32_t g) const {
            if (g == no_group) return {};
            return std::span<const Id>(members).subspan(begin[g], begin[g + 1] - begin[g]);
        }
        void close() { begin.push_back(static_cast<std::uint32_t>(members.size())); }
    };

    template <class T, class Id>
    static const T& at(const std::vector<T>& array, Id id) {
        TRISECT_AUDIT_CHECK(id.index < array.size(), "an id of no entity of this B-rep");
        return array[id.index];
    }
    [[nodiscard]] std::uint32_t loop_end(std::size_t l) const {
        return l + 1 < loops_.size() ? loops_[l + 1].first
                                     : static_cast<std::uint32_t>(halfedges_.size());
    }
    [[nodiscard]] std::uint32_t face_end(std::size_t f) const {
        return f + 1 < faces_.size() ? faces_[f + 1].first_loop
                                     : static_cast<std::uint32_t>(loops_.size());
    }
    [[nodiscard]] std::size_t shell_count() const { return shells_.group_count(); }

    Lattice lattice_;
    std::vector<Halfedge> halfedges_;
    std::vector<Edge> edges_;
    std::vector<Vertex> vertices_;
    std::vector<Point> points_;
    std::vector<Loop> loops_;
    std::vector<Face> faces_;
    std::vector<Plane> planes_;
    Groups<FaceId> shells_;
    Groups<VertexId> vertex_copies_;
    Groups<EdgeId> edge_copies_;
};

}  // namespace trisect
