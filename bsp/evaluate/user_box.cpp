// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/user_box.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <variant>

#include <trisect/bsp/cells/source.h>

namespace trisect::detail {

namespace {

// Null where it is no imported mesh.
const Source* source_of_mesh(const SolidState& state) {
    const auto* const tree = std::get_if<CellTree>(&state.form);
    if (tree == nullptr || state.far_out < 0) return nullptr;
    const CellNode& root = *tree->root.node;
    if (!root.is_leaf() || root.deferred() != nullptr || !root.polygons().has_all_facets())
        return nullptr;
    const Source* const source = root.polygons().whole_source();
    if (source == nullptr || source->is_half_space() || source->box().is_empty()) return nullptr;
    return source;
}

}  // namespace

// A fraction is less than a unit away from its position.
std::optional<UserBox> box_around_mesh(const SolidState& state) {
    const Source* const source = source_of_mesh(state);
    // Else whole numbers of 53 bits times the unit might be no doubles.
    constexpr int largest_exponent = 900;
    if (source == nullptr || std::abs(state.lattice.exponent) > largest_exponent)
        return std::nullopt;
    const auto in_units = [&](std::int64_t c) {
        return std::ldexp(static_cast<double>(c), state.lattice.exponent);
    };
    UserBox out;
    for (std::size_t k = 0; k < 3; ++k) {
        out.lo[k] = in_units(source->box().lo[k] - 1);
        out.hi[k] = in_units(source->box().hi[k] + 1);
    }
    return out;
}

// Of the corners of facets: other points may lie anywhere.
UserBox least_box_of_mesh(const SolidState& state) {
    const LatticeMesh& mesh = source_of_mesh(state)->mesh();
    UserBox out;
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t corner : t) {
            const std::array<double, 3> at = mesh.points[corner].doubles();
            for (std::size_t k = 0; k < 3; ++k) {
                out.lo[k] = std::min(out.lo[k], at[k]);
                out.hi[k] = std::max(out.hi[k], at[k]);
            }
        }
    for (std::size_t k = 0; k < 3; ++k) {
        out.lo[k] = std::ldexp(out.lo[k], state.lattice.exponent);
        out.hi[k] = std::ldexp(out.hi[k], state.lattice.exponent);
    }
    return out;
}

}  // namespace trisect::detail
