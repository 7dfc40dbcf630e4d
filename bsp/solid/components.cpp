// SPDX-License-Identifier: Apache-2.0
//
// A shell of positive volume bounds material, one of negative volume a cavity (B-reps are taken
// apart so that the inside decides what is connected, see brep.h). A cavity belongs to the smallest
// part around it. Any of its vertices that is not on that part's shell shows whether it is around.

#include <trisect/bsp/solid_transform.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/brep_builder.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/named_boundary.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/predicates.h>

namespace trisect {

namespace {

// Takes shells out of a boundary.
class ShellCopier {
public:
    explicit ShellCopier(const Brep& brep)
        : brep_(brep), number_(brep.counts().vertices, VertexId::none) {}

    [[nodiscard]] Brep copy(std::span<const ShellId> shells) {
        BrepBuilder builder(brep_.lattice());
        for (const ShellId s : shells)
            for (const FaceId f : brep_.faces(s)) add(f, builder);
        for (const VertexId v : numbered_) number_[v.index] = VertexId::none;
        numbered_.clear();
        return std::move(builder).build();
    }

private:
    void add(FaceId f, BrepBuilder& builder) {
        std::vector<std::vector<std::uint32_t>> loops;
        for (const LoopId l : brep_.loops(f)) {
            auto& loop = loops.emplace_back();
            for (const HalfedgeId h : brep_.halfedges(l))
                loop.push_back(number_of(brep_.origin(h), builder));
        }
        builder.add_face(brep_.plane(f), loops, brep_.source(f));
    }
    std::uint32_t number_of(VertexId v, BrepBuilder& builder) {
        std::uint32_t& number = number_[v.index];
        if (number == VertexId::none) {
            number = builder.add_vertex(brep_.point(v));
            numbered_.push_back(v);
        }
        return number;
    }

    const Brep& brep_;
    std::vector<std::uint32_t> number_;  // of all vertices, in the copy that is being made
    std::vector<VertexId> numbered_;
};

// Around the vertices of a shell, in units: each coordinate is the nearest double, and these are in
// the order of the exact ones.
struct ShellBox {
    std::array<double, 3> lo{};
    std::array<double, 3> hi{};

    [[nodiscard]] bool may_be_around(const ShellBox& o) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (o.lo[k] < lo[k] || o.hi[k] > hi[k]) return false;
        return true;
    }
};

ShellBox box_of(const Brep& brep, ShellId shell) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    ShellBox box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const FaceId f : brep.faces(shell))
        for (const HalfedgeId h : brep.halfedges(f)) {
            const auto p = nearest_doubles(brep.point(brep.origin(h)).homogeneous());
            for (std::size_t k = 0; k < 3; ++k) {
                box.lo[k] = std::min(box.lo[k], p[k]);
                box.hi[k] = std::max(box.hi[k], p[k]);
            }
        }
    return box;
}

// A shell that bounds material, without cavities yet.
struct SolidPart {
    std::vector<ShellId> shells;
    ExactRational volume;
    ShellBox box;
    std::unique_ptr<BrepIndex> index;  // of the shell alone, when it is first needed
};

bool is_around(const SolidPart& part, const Brep& brep, ShellId cavity) {
    for (const FaceId f : brep.faces(cavity))
        for (const HalfedgeId h : brep.halfedges(f)) {
            const Location l = part.index->locate(brep.point(brep.origin(h))).location;
            if (l == Location::Inside) return true;
            if (l == Location::Outside) return false;
        }
    // All its corners are on the shell of the part.
    return part.volume > -exact_volume(brep, cavity);
}

SolidPart& part_around(std::vector<SolidPart*>& by_volume, const Brep& brep, ShellId cavity,
                       ShellCopier& copier) {
    const ShellBox box = box_of(brep, cavity);
    for (SolidPart* p : by_volume) {
        if (!p->box.may_be_around(box)) continue;
        if (p->index == nullptr)
            p->index = std::make_unique<BrepIndex>(
                detail::named_solid(copier.copy(std::span(p->shells).first(1))));
        if (is_around(*p, brep, cavity)) return *p;
    }
    throw Error(ErrorCode::Internal, "a cavity lies in no part of its solid");
}

std::vector<SolidPart> parts_of(const Brep& brep, ShellCopier& copier) {
    std::vector<SolidPart> parts;
    std::vector<ShellId> cavities;
    for (const ShellId s : brep.shells()) {
        if (sign_of_volume(brep, s) < 0) {
            cavities.push_back(s);
        } else {
            parts.push_back({{s}, exact_volume(brep, s), box_of(brep, s), nullptr});
        }
    }
    std::vector<SolidPart*> by_volume;
    for (SolidPart& p : parts) by_volume.push_back(&p);
    std::ranges::stable_sort(by_volume, {}, [](const SolidPart* p) { return p->volume; });
    for (const ShellId c : cavities) part_around(by_volume, brep, c, copier).shells.push_back(c);
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
    ShellCopier copier(brep);
    for (const SolidPart& p : parts_of(brep, copier))
        out.push_back(detail::named_solid(copier.copy(p.shells)));
    return out;
}

}  // namespace trisect
