// SPDX-License-Identifier: Apache-2.0
//
// Triangles of a boundary fill polygons whose corners are within the errors of the boundary, so
// what separates triangles by that much separates polygons, and triangles that certainly cross do
// so as parts of faces. The search is that of models.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/approach/enclosed_query.h>
#include <trisect/bsp/interference/solid_motion.h>
#include <trisect/bsp/interference/tree/entity_names.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/bsp/interference/tree/solid_pair.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/kernel/diagnostics.h>

namespace trisect {

namespace {

using detail::SolidBoundary;

class EnclosedQueryOfSolids final : public detail::EnclosedQuery {
public:
    EnclosedQueryOfSolids(const SolidBoundary& a, const EnclosedMotion& motion_a,
                          const SolidBoundary& b, const EnclosedMotion& motion_b,
                          const EnclosedContactOptions& options)
        : EnclosedQuery(a, motion_a, b, motion_b, options), a_(a), b_(b) {}

protected:
    [[nodiscard]] Relation relation_at(const Pose& pose_a, const Pose& pose_b) override {
        return relation_of(a_, pose_a, b_, pose_b, {}).relation;
    }
    // Points deep inside are looked for where no faces cross: for most motions never.
    [[nodiscard]] const BrepIndex& index_a() override { return index_of(a_, index_a_); }
    [[nodiscard]] const BrepIndex& index_b() override { return index_of(b_, index_b_); }

private:
    static const BrepIndex& index_of(const SolidBoundary& s, std::optional<BrepIndex>& index) {
        if (!index) index.emplace(s.base().solid());
        return *index;
    }

    const SolidBoundary& a_;
    const SolidBoundary& b_;
    std::optional<BrepIndex> index_a_;
    std::optional<BrepIndex> index_b_;
};

EntityName face_of(const SolidBoundary& s, std::uint32_t triangle) {
    std::vector<detail::PolygonId> on{s.origin(triangle).polygon()};
    return detail::name_of(detail::place_on(on));
}

}  // namespace

NamedEnclosedContact enclosed_first_contact(const Solid& a, const EnclosedMotion& motion_a,
                                            const Solid& b, const EnclosedMotion& motion_b,
                                            const EnclosedContactOptions& options) {
    const SolidBoundary boundary_a(a);
    const SolidBoundary boundary_b(b);
    EnclosedQueryOfSolids query(boundary_a, motion_a, boundary_b, motion_b, options);
    EnclosedContact found = query.run();
    NamedEnclosedContact result;
    result.outcome = found.outcome;
    result.free_until = found.free_until;
    result.contact_by = found.contact_by;
    result.is_narrow = found.is_narrow;
    result.undecided = std::move(found.undecided);
    if (const auto& c = query.crossing())
        result.witnesses.push_back({face_of(boundary_a, c->a), face_of(boundary_b, c->b)});
    detail::counters_of_thread<FirstContactCounters> += query.counters();
    return result;
}

}  // namespace trisect
