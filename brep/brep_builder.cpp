// SPDX-License-Identifier: Apache-2.0
//
// From polygons to a connected boundary, in four passes over flat arrays:
//
//  1. Directed edges are distributed to the smaller of their two vertices (counting sort) and
//     sorted there by the larger one. A hash table would do the same with worse locality and an
//     order of its own; here the order is that of the faces.
//  2. Two opposite ones are twins. Where there are more, the faces are paired across the solid's
//     wedges (radial_order.cpp).
//  3. Given the twins, the halfedges that leave a vertex fall into cycles of h -> twin(prev(h)),
//     one for each fan of faces. Each cycle becomes a vertex of the result.
//  4. Faces joined by twins form shells.
//
// The naive way, one edge record for all faces that meet there, leaves every later algorithm with
// the question which of four faces comes next. Taking contacts apart here, once and exactly, makes
// the boundary a manifold; the coincidence is kept as a fact beside it.

#include <trisect/brep/brep_builder.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <trisect/brep/radial_order.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/ready_memory.h>

namespace trisect {

using detail::reserve_ready;
using detail::resize_ready;

class BrepConnector {
public:
    explicit BrepConnector(BrepBuilder&& input) : in_(std::move(input)) {}

    Brep run() {
        for (const auto step : {&BrepConnector::lay_out_loops, &BrepConnector::sort_directed_edges,
                                &BrepConnector::pair_halfedges, &BrepConnector::number_edges,
                                &BrepConnector::split_vertices, &BrepConnector::find_shells}) {
            detail::check_stop(in_.corners_.size());
            (this->*step)();
        }
        return std::move(out_);
    }

private:
    struct DirectedEdge {
        std::uint32_t far = 0;  // the larger of the two vertices
        std::uint32_t halfedge = 0;
    };

    std::uint32_t start_of(std::uint32_t h) const { return in_.corners_[h]; }
    std::uint32_t end_of(std::uint32_t h) const {
        return in_.corners_[out_.next(HalfedgeId(h)).index];
    }

    void lay_out_loops() {
        const std::size_t n = in_.corners_.size();
        out_.lattice_ = in_.lattice_;
        resize_ready(out_.halfedges_, n);
        out_.planes_ = std::move(in_.planes_);
        resize_ready(out_.loops_, in_.loop_begin_.size());
        resize_ready(out_.faces_, in_.faces_.size());
        for (std::size_t l = 0; l < out_.loops_.size(); ++l)
            out_.loops_[l].first = in_.loop_begin_[l];
        for (std::size_t f = 0; f < out_.faces_.size(); ++f) {
            out_.faces_[f].first_loop = in_.faces_[f].first_loop;
            out_.faces_[f].source = in_.faces_[f].source;
        }
        for (const FaceId f : out_.faces()) {
            for (const LoopId l : out_.loops(f)) {
                out_.loops_[l.index].face = f;
                for (const HalfedgeId h : out_.halfedges(l)) out_.halfedges_[h.index].loop = l;
            }
        }
    }

    void sort_directed_edges() {
        const auto n = static_cast<std::uint32_t>(in_.corners_.size());
        begin_.assign(in_.points_.size() + 1, 0);
        for (std::uint32_t h = 0; h < n; ++h) ++begin_[std::min(start_of(h), end_of(h)) + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        resize_ready(directed_, n);
        std::vector<std::uint32_t> fill(begin_.begin(), begin_.end() - 1);
        for (std::uint32_t h = 0; h < n; ++h) {
            const std::uint32_t u = start_of(h);
            const std::uint32_t v = end_of(h);
            TRISECT_EXPECTS(u != v, "a loop repeats a vertex without an edge between");
            directed_[fill[std::min(u, v)]++] = {std::max(u, v), h};
        }
    }

    void pair_halfedges() {
        for (std::size_t v = 0; v + 1 < begin_.size(); ++v) {
            const auto bucket = std::span(directed_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
            std::sort(bucket.begin(), bucket.end(),
                      [](const DirectedEdge& a, const DirectedEdge& b) {
                          return a.far != b.far ? a.far < b.far : a.halfedge < b.halfedge;
                      });
            for (std::size_t i = 0; i < bucket.size();) {
                std::size_t j = i + 1;
                while (j < bucket.size() && bucket[j].far == bucket[i].far) ++j;
                pair_group(bucket.subspan(i, j - i));
                i = j;
            }
        }
    }

    // All directed edges between one pair of vertices.
    void pair_group(std::span<const DirectedEdge> group) {
        const std::uint32_t from = start_of(group[0].halfedge);
        const std::uint32_t to = end_of(group[0].halfedge);
        const auto along = [&](const DirectedEdge& e) { return start_of(e.halfedge) == from; };
        const auto forward =
            static_cast<std::size_t>(std::count_if(group.begin(), group.end(), along));
        if (2 * forward != group.size())
            throw unbalanced(from, to, forward, group.size() - forward);
        if (group.size() == 2) {
            link(group[0].halfedge, group[1].halfedge);
            return;
        }
        std::vector<RadialFace> faces;
        faces.reserve(group.size());
        for (const DirectedEdge& e : group)
            faces.push_back({&out_.plane(out_.face(HalfedgeId(e.halfedge))), along(e)});
        const auto partner =
            pair_across_inside(faces, direction_between(in_.points_[from], in_.points_[to]));
        contacts_.emplace_back();
        for (std::size_t i = 0; i < group.size(); ++i) {
            if (partner[i] < i) continue;
            link(group[i].halfedge, group[partner[i]].halfedge);
            contacts_.back().push_back(group[i].halfedge);
        }
    }

    void link(std::uint32_t a, std::uint32_t b) {
        out_.halfedges_[a].twin = HalfedgeId(b);
        out_.halfedges_[b].twin = HalfedgeId(a);
    }

    Error unbalanced(std::uint32_t from, std::uint32_t to, std::size_t forward,
                     std::size_t backward) const {
        return {ErrorCode::InvalidSolid,
                "not a closed boundary: the edge from " + place(from) + " to " + place(to) +
                    " is used " + std::to_string(forward) + " times in this direction and " +
                    std::to_string(backward) + " times in the other"};
    }

    std::string place(std::uint32_t v) const {
        const auto c = in_.points_[v].nearest();
        std::array<char, 128> text{};
        std::snprintf(text.data(), text.size(), "(%.17g, %.17g, %.17g)",
                      in_.lattice_.to_double(c[0]), in_.lattice_.to_double(c[1]),
                      in_.lattice_.to_double(c[2]));
        return text.data();
    }

    void number_edges() {
        reserve_ready(out_.edges_, out_.halfedges_.size() / 2);
        for (std::uint32_t h = 0; h < out_.halfedges_.size(); ++h) {
            const std::uint32_t t = out_.halfedges_[h].twin.index;
            if (t < h) continue;
            const EdgeId e(out_.edges_.size());
            out_.edges_.push_back({HalfedgeId(h)});
            out_.halfedges_[h].edge = e;
            out_.halfedges_[t].edge = e;
        }
        std::sort(contacts_.begin(), contacts_.end());
        for (const auto& halfedges : contacts_) {
            for (const std::uint32_t h : halfedges) {
                const EdgeId e = out_.halfedges_[h].edge;
                out_.edge_copies_.members.push_back(e);
                out_.edges_[e.index].group =
                    static_cast<std::uint32_t>(out_.edge_copies_.group_count());
            }
            out_.edge_copies_.close();
        }
    }

    void split_vertices() {
        std::vector<VertexId> first_copy(in_.points_.size());
        std::vector<std::pair<VertexId, VertexId>> copies;  // (first copy, further copy)
        reserve_ready(out_.vertices_, in_.points_.size());
        reserve_ready(out_.points_, in_.points_.size());
        for (std::uint32_t h = 0; h < out_.halfedges_.size(); ++h) {
            if (out_.halfedges_[h].origin.is_valid()) continue;
            const VertexId v(out_.vertices_.size());
            const std::uint32_t place = start_of(h);
            out_.vertices_.push_back({HalfedgeId(h)});
            if (const VertexId first = first_copy[place]; first.is_valid()) {
                out_.points_.push_back(Point(out_.points_[first.index]));
                copies.emplace_back(first, v);
            } else {
                out_.points_.push_back(std::move(in_.points_[place]));
                first_copy[place] = v;
            }
            number_fan(HalfedgeId(h), v);
        }
        std::sort(copies.begin(), copies.end());
        record_copies(copies);
    }

    void number_fan(HalfedgeId first, VertexId v) {
        HalfedgeId h = first;
        do {
            out_.halfedges_[h.index].origin = v;
            h = out_.twin(out_.prev(h));
        } while (h != first);
    }

    void record_copies(const std::vector<std::pair<VertexId, VertexId>>& copies) {
        auto& groups = out_.vertex_copies_;
        const auto add = [&](VertexId v) {
            groups.members.push_back(v);
            out_.vertices_[v.index].group = static_cast<std::uint32_t>(groups.group_count());
        };
        for (std::size_t i = 0; i < copies.size();) {
            const VertexId first = copies[i].first;
            add(first);
            for (; i < copies.size() && copies[i].first == first; ++i) add(copies[i].second);
            groups.close();
        }
    }

    void find_shells() {
        std::vector<FaceId> stack;
        std::uint32_t count = 0;
        for (const FaceId seed : out_.faces()) {
            if (out_.faces_[seed.index].shell.is_valid()) continue;
            const ShellId shell(count++);
            out_.faces_[seed.index].shell = shell;
            stack.push_back(seed);
            while (!stack.empty()) {
                const FaceId f = stack.back();
                stack.pop_back();
                for (const HalfedgeId h : out_.halfedges(f)) {
                    const FaceId g = out_.face(out_.twin(h));
                    if (out_.faces_[g.index].shell.is_valid()) continue;
                    out_.faces_[g.index].shell = shell;
                    stack.push_back(g);
                }
            }
        }
        list_faces_of_shells(count);
    }

    void list_faces_of_shells(std::uint32_t count) {
        auto& groups = out_.shells_;
        groups.begin.assign(count + 1U, 0);
        for (const auto& face : out_.faces_) ++groups.begin[face.shell.index + 1];
        std::partial_sum(groups.begin.begin(), groups.begin.end(), groups.begin.begin());
        groups.members.resize(out_.faces_.size());
        std::vector<std::uint32_t> fill(groups.begin.begin(), groups.begin.end() - 1);
        for (const FaceId f : out_.faces())
            groups.members[fill[out_.faces_[f.index].shell.index]++] = f;
    }

    BrepBuilder in_;
    Brep out_;
    std::vector<std::uint32_t> begin_;
    std::vector<DirectedEdge> directed_;
    std::vector<std::vector<std::uint32_t>> contacts_;  // one halfedge for each copy of an edge
};

void BrepBuilder::reserve(std::size_t vertices, std::size_t faces, std::size_t corners) {
    reserve_ready(points_, vertices);
    reserve_ready(corners_, corners);
    reserve_ready(loop_begin_, faces);
    reserve_ready(faces_, faces);
    reserve_ready(planes_, faces);
}

std::uint32_t BrepBuilder::add_vertex(const Point& p) {
    if (points_.size() >= VertexId::none) throw LimitError("more than 2^32 - 2 vertices");
    points_.push_back(p);
    return static_cast<std::uint32_t>(points_.size() - 1);
}

void BrepBuilder::add_face(const Plane& plane, const std::vector<std::vector<std::uint32_t>>& loops,
                           FaceSource source) {
    TRISECT_EXPECTS(!loops.empty(), "a face has an outer loop");
    TRISECT_EXPECTS(loops[0].size() >= 3, "an outer loop has at least three corners");
    ++call_;
    bool touches = false;
    for (const IndexLoop& loop : loops) {
        check_loop(plane, loop);
        touches = repeats_a_vertex(loop) || touches;
    }
    if (touches) {
        append_regions(plane, loops, source);
        return;
    }
    append_face(plane, source);
    for (const IndexLoop& loop : loops) append_loop(loop);
}

void BrepBuilder::add_polygon(const Plane& plane, std::span<const std::uint32_t> loop,
                              FaceSource source) {
    ++call_;
    TRISECT_EXPECTS(loop.size() >= 3, "an outer loop has at least three corners");
    check_loop(plane, loop);
    if (loop.size() > 3 && repeats_a_vertex(loop)) {
        append_regions(plane, std::vector<IndexLoop>{{loop.begin(), loop.end()}}, source);
        return;
    }
    append_face(plane, source);
    append_loop(loop);
}

void BrepBuilder::check_loop(const Plane& plane, std::span<const std::uint32_t> loop) const {
    TRISECT_EXPECTS(plane.is_valid(), "a face has a plane");
    TRISECT_EXPECTS(loop.size() >= 2, "a loop has at least three corners, a slit two");
    for (const std::uint32_t v : loop) {
        TRISECT_EXPECTS(v < points_.size(), "a loop names an unknown vertex");
        TRISECT_AUDIT_CHECK(side_of(points_[v], plane) == Side::On,
                            "a corner lies on the plane of its face");
    }
}

// Whether a corner of the loop was used before by the same call.
bool BrepBuilder::repeats_a_vertex(std::span<const std::uint32_t> loop) {
    if (seen_.size() < points_.size()) seen_.resize(points_.size(), 0);
    bool repeats = false;
    for (const std::uint32_t v : loop) repeats = std::exchange(seen_[v], call_) == call_ || repeats;
    return repeats;
}

void BrepBuilder::append_regions(const Plane& plane, std::span<const IndexLoop> loops,
                                 FaceSource source) {
    for (const auto& region : connected_regions(plane, points_, loops)) {
        append_face(plane, source);
        for (const IndexLoop& loop : region) append_loop(loop);
    }
}

void BrepBuilder::append_face(const Plane& plane, FaceSource source) {
    faces_.push_back({static_cast<std::uint32_t>(loop_begin_.size()), source});
    planes_.push_back(plane);
}

void BrepBuilder::append_loop(std::span<const std::uint32_t> loop) {
    TRISECT_EXPECTS(loop.size() >= 2, "a loop has at least three corners, a slit two");
    if (corners_.size() + loop.size() >= HalfedgeId::none)
        throw LimitError("more than 2^32 - 2 halfedges");
    loop_begin_.push_back(static_cast<std::uint32_t>(corners_.size()));
    corners_.insert(corners_.end(), loop.begin(), loop.end());
}

Brep BrepBuilder::build() && { return BrepConnector(std::move(*this)).run(); }

}  // namespace trisect
