// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/brep.h>

#include <string>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>

namespace trisect {

BrepCounts Brep::counts() const {
    return {vertices_.size(), halfedges_.size(), edges_.size(),
            loops_.size(),    faces_.size(),     shell_count()};
}

BrepCounts Brep::counts(ShellId s) const {
    BrepCounts c;
    c.shells = 1;
    c.faces = faces(s).size();
    for (const FaceId f : faces(s)) {
        c.loops += loops(f).size();
        c.halfedges += halfedges(f).size();
        // Every vertex and edge belongs to one shell and is counted at the halfedge it names.
        for (const HalfedgeId h : halfedges(f))
            if (outgoing(origin(h)) == h) ++c.vertices;
    }
    c.edges = c.halfedges / 2;
    return c;
}

std::ptrdiff_t Brep::genus(ShellId s) const {
    const std::ptrdiff_t characteristic = counts(s).euler_characteristic();
    TRISECT_EXPECTS(characteristic % 2 == 0 && characteristic <= 2,
                    "a shell is a closed orientable surface");
    return 1 - characteristic / 2;
}

HalfedgeId Brep::next(HalfedgeId h) const {
    const std::size_t l = loop(h).index;
    const std::uint32_t following = h.index + 1;
    return HalfedgeId(following == loop_end(l) ? loops_[l].first : following);
}

HalfedgeId Brep::prev(HalfedgeId h) const {
    const std::size_t l = loop(h).index;
    return HalfedgeId((h.index == loops_[l].first ? loop_end(l) : h.index) - 1);
}

std::vector<HalfedgeId> Brep::outgoing_halfedges(VertexId v) const {
    std::vector<HalfedgeId> out;
    const HalfedgeId first = outgoing(v);
    HalfedgeId h = first;
    do {
        out.push_back(h);
        h = twin(prev(h));
    } while (h != first);
    return out;
}

IdRange<HalfedgeId> Brep::halfedges(LoopId l) const {
    return {loops_[l.index].first, loop_end(l.index)};
}

IdRange<LoopId> Brep::loops(FaceId f) const {
    return {faces_[f.index].first_loop, face_end(f.index)};
}

IdRange<LoopId> Brep::inner_loops(FaceId f) const {
    return {faces_[f.index].first_loop + 1, face_end(f.index)};
}

IdRange<HalfedgeId> Brep::halfedges(FaceId f) const {
    return {loops_[faces_[f.index].first_loop].first, loop_end(face_end(f.index) - 1)};
}

std::span<const FaceId> Brep::faces(ShellId s) const {
    if (s.index >= shell_count())
        throw UsageError("a B-rep of " + std::to_string(shell_count()) + " shells has no shell " +
                         (s.is_valid() ? std::to_string(s.index) : "without a number"));
    return shells_.group(s.index);
}

std::span<const VertexId> Brep::copies(VertexId v) const {
    return vertex_copies_.group(at(vertices_, v).group);
}

std::span<const EdgeId> Brep::copies(EdgeId e) const {
    return edge_copies_.group(at(edges_, e).group);
}

}  // namespace trisect
