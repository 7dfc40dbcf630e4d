// SPDX-License-Identifier: Apache-2.0
//
// A shell of positive volume bounds material, one of negative volume a cavity (B-reps are taken
// apart so that the inside decides what is connected, see brep.h). A cavity belongs to the smallest
// part around it. Any of its vertices that is not on that part's shell shows whether it is around.

#include <trisect/bsp/solid_transform.h>

#include <algorithm>
#include <memory>
#include <utility>

#include <trisect/brep/brep_builder.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid/named_boundary.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

Brep part_of(const Brep& brep, std::span<const ShellId> shells) {
    BrepBuilder builder(brep.lattice());
    std::vector<std::uint32_t> number(brep.counts().vertices, VertexId::none);
    const auto vertex = [&](VertexId v) {
        if (number[v.index] == VertexId::none) number[v.index] = builder.add_vertex(brep.point(v));
        return number[v.index];
    };
    for (const ShellId s : shells)
        for (const FaceId f : brep.faces(s)) {
            std::vector<std::vector<std::uint32_t>> loops;
            for (const LoopId l : brep.loops(f)) {
                auto& loop = loops.emplace_back();
                for (const HalfedgeId h : brep.halfedges(l)) loop.push_back(vertex(brep.origin(h)));
            }
            builder.add_face(brep.plane(f), loops, brep.source(f));
        }
    return std::move(builder).build();
}

// A shell that bounds material, without cavities yet.
struct Part {
    std::vector<ShellId> shells;
    ExactRational volume;
    std::unique_ptr<BrepIndex> index;  // of the shell alone, when it is first needed
};

bool is_around(const Part& part, const Brep& brep, ShellId cavity) {
    for (const FaceId f : brep.faces(cavity))
        for (const HalfedgeId h : brep.halfedges(f)) {
            const Location l = part.index->locate(brep.point(brep.origin(h))).location;
            if (l == Location::Inside) return true;
            if (l == Location::Outside) return false;
        }
    // All its corners are on the shell of the part.
    return part.volume > -exact_volume(brep, cavity);
}

Part& part_around(std::vector<Part*>& by_volume, const Brep& brep, ShellId cavity) {
    for (Part* p : by_volume) {
        if (p->index == nullptr)
            p->index = std::make_unique<BrepIndex>(
                detail::named_solid(part_of(brep, std::span(p->shells).first(1))));
        if (is_around(*p, brep, cavity)) return *p;
    }
    throw Error(ErrorCode::Internal, "a cavity lies in no part of its solid");
}

std::vector<Part> parts_of(const Brep& brep) {
    std::vector<Part> parts;
    std::vector<ShellId> cavities;
    for (const ShellId s : brep.shells()) {
        if (sign_of_volume(brep, s) < 0) {
            cavities.push_back(s);
        } else {
            parts.push_back({{s}, exact_volume(brep, s), nullptr});
        }
    }
    std::vector<Part*> by_volume;
    for (Part& p : parts) by_volume.push_back(&p);
    std::ranges::stable_sort(by_volume, {}, [](const Part* p) { return p->volume; });
    for (const ShellId c : cavities) part_around(by_volume, brep, c).shells.push_back(c);
    return parts;
}

}  // namespace

std::vector<Solid> components(const Solid& solid) {
    if (solid.is_empty()) return {};
    if (detail::state_of(solid)->far_out == 1)
        throw UnsupportedError("an unbounded set has no components as solids");
    const Solid resolved = detail::state_of(solid)->embedded ? solid : evaluate(Expression(solid));
    const Brep brep = resolved.to_brep();
    if (detail::state_of(solid)->far_out < 0 && exact_volume(brep).sign() < 0)
        throw UnsupportedError("an unbounded set has no components as solids");
    if (brep.shells().size() == 1) return {resolved};
    std::vector<Solid> out;
    for (const Part& p : parts_of(brep))
        out.push_back(detail::named_solid(part_of(brep, p.shells)));
    return out;
}

}  // namespace trisect
