// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/sections/arranged_slice.h>

#include <utility>
#include <variant>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/flat/flat_mesh.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/plane_region.h>
#include <trisect/bsp/modelling/sections/section_prism.h>

namespace trisect::detail {

Slice arranged_slice(const MeshSection& mesh, const SectionPlane& plane, SliceRule rule,
                     const EvaluateOptions& options) {
    SectionPrism section = section_prism(mesh, plane, rule, options);
    Slice out;
    out.height = plane.height;
    if (section.prism.is_empty()) return out;
    auto flat = flat_outlines(section.prism);
    if (!flat) {  // of coordinates that have no lattice in common
        section.prism = solid_of_region(region_of_faces(section.prism, 1));
        section.is_exact = false;
        flat = flat_outlines(section.prism);
        if (!flat) return out;
    }
    out.points = std::move(flat->points);
    out.loops = std::move(flat->loops);
    const auto& form = std::get<FlatPrism>(state_of(section.prism)->form);
    out.regions = flat_regions(form.operand->resolved());
    out.is_exact = section.is_exact && flat->is_exact;
    return out;
}

}  // namespace trisect::detail
