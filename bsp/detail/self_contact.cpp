// SPDX-License-Identifier: Apache-2.0
//
// Does a boundary touch itself? Its triangles under the identity against each other: two that meet
// anywhere but in common corners and sides are in contact.

#include <algorithm>

#include <trisect/bsp/detail/interference_model_data.h>
#include <trisect/bsp/detail/meeting_pairs.h>

namespace trisect::detail {

namespace {

int common_corners(const InterferenceModelData& model, const ModelTriangle& s,
                   const ModelTriangle& t) {
    int count = 0;
    for (const VertexId v : s.vertex)
        for (const VertexId w : t.vertex)
            if (model.place[v.index] == model.place[w.index]) ++count;
    return count;
}

bool find_self_contact(const InterferenceModelData& model) {
    const Pose identity;
    const Lattice lattice = model.brep.lattice();
    const PosedModels models{model, model, PosedPair(identity, lattice, identity, lattice)};
    TrianglePairTest test(models.poses);
    return for_candidate_pairs(models, [&](std::uint32_t i, std::uint32_t j, PairVerdict) {
        if (i >= j) return false;
        const ModelTriangle& s = model.triangles[i];
        const ModelTriangle& t = model.triangles[j];
        // Triangles with a common side lie on different sides of it or in different planes.
        if (common_corners(model, s, t) >= 2) return false;
        const TriangleContact c = test(posed_triangle(model, i), posed_triangle(model, j));
        return std::ranges::any_of(c.corners(), [&](const MeetingPoint& p) {
            return !p.a.is_corner() || !p.b.is_corner() ||
                   model.place[s.vertex[p.a.index()].index] !=
                       model.place[t.vertex[p.b.index()].index];
        });
    });
}

}  // namespace

bool InterferenceModelData::touches_itself() const {
    std::call_once(self_contact_once_,
                   [this] { touches_itself_ = !is_empty() && find_self_contact(*this); });
    return touches_itself_;
}

}  // namespace trisect::detail
