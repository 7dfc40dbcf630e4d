// SPDX-License-Identifier: Apache-2.0
//
// Models of the parts that are near each other. Walls of the boxes are off the other solid, so they
// have no contacts. Corners, edges and areas of contacts are those of the whole solids: an area is
// connected, and a face that falls apart falls apart beyond the other solid.

#include <trisect/bsp/interference/solid_regions.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/tree/entity_names.h>
#include <trisect/bsp/interference/tree/part_near.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect {

namespace {

// Names of a placed model's entities, at points of the world.
class NamesOf {
public:
    NamesOf(const InterferenceModel& model, const Pose& pose)
        : model_(model), index_(model.solid()), into_(pose.inverse()) {}

    // At an inner point of an area only the face is named.
    [[nodiscard]] EntityName operator()(const ContactRegion& region,
                                        const BoundaryEntity& entity) const {
        if (region.dimension == 2) {
            EntityName name;
            name.face_count = 1;
            name.faces[0] = model_.brep().source(entity.face());
            return name;
        }
        const auto& ends = region.loops.front();
        if (region.dimension == 0) return name_at(ends.front().exact);
        // All but some points of a segment are on one entity; the others, where boundaries touch
        // themselves, are on smaller ones.
        EntityName largest;
        for (int i = 1; i <= tries; ++i) {
            ExactPoint at;
            for (std::size_t k = 0; k < 3; ++k)
                at[k] = (ends.front().exact[k] * ExactRational(i) + ends.back().exact[k]) /
                        ExactRational(i + 1);
            const EntityName name = name_at(at);
            if (i == 1 || name.kind > largest.kind) largest = name;
            if (largest.kind == kind_of(entity)) break;
        }
        return largest;
    }

private:
    static constexpr int tries = 6;

    [[nodiscard]] static EntityName::Kind kind_of(const BoundaryEntity& entity) {
        return entity.is_face()   ? EntityName::Kind::Face
               : entity.is_edge() ? EntityName::Kind::Edge
                                  : EntityName::Kind::Vertex;
    }
    [[nodiscard]] EntityName name_at(const ExactPoint& at) const {
        return detail::name_of(index_.locate(moved_back(at)));
    }
    [[nodiscard]] ExactPoint moved_back(const ExactPoint& p) const {
        const auto number = [](const Pose::Number& n) { return ExactRational(n); };
        ExactPoint out;
        for (std::size_t i = 0; i < 3; ++i) {
            out[i] = number(into_.translation(i));
            for (std::size_t j = 0; j < 3; ++j) out[i] += number(into_.matrix(i, j)) * p[j];
            out[i] /= number(into_.denominator());
        }
        return out;
    }

    const InterferenceModel& model_;
    BrepIndex index_;
    Pose into_;
};

}  // namespace

std::vector<NamedRegion> contact_regions(const Solid& a, const Pose& pose_a, const Solid& b,
                                         const Pose& pose_b) {
    const detail::SolidBoundary boundary_a(a);
    const detail::SolidBoundary boundary_b(b);
    if (boundary_a.is_empty() || boundary_b.is_empty()) return {};
    const InterferenceModel part_a(detail::part_near(a, boundary_a, pose_a, boundary_b, pose_b));
    const InterferenceModel part_b(detail::part_near(b, boundary_b, pose_b, boundary_a, pose_a));
    InterferenceOptions options;
    options.regions = true;
    InterferenceResult result = interfere(part_a, pose_a, part_b, pose_b, options);
    const NamesOf names_a(part_a, pose_a);
    const NamesOf names_b(part_b, pose_b);
    std::vector<NamedRegion> out;
    for (ContactRegion& r : result.regions)
        out.push_back(
            {r.dimension, names_a(r, r.a), names_b(r, r.b), r.opposite, std::move(r.loops)});
    std::ranges::stable_sort(out, [](const NamedRegion& p, const NamedRegion& q) {
        return std::tie(q.dimension, p.a, p.b) < std::tie(p.dimension, q.a, q.b);
    });
    return out;
}

}  // namespace trisect
