// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/slices.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <trisect/brep/measure/double_pair.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/flat/flat_mesh.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/mesh_section.h>
#include <trisect/bsp/modelling/plane_region.h>
#include <trisect/bsp/modelling/section_prism.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect {
namespace {

using detail::DoublePair;

Slice slice_of(detail::SectionPrism section, double height) {
    Slice out;
    out.height = height;
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
    const auto& form = std::get<detail::FlatPrism>(detail::state_of(section.prism)->form);
    out.regions = detail::flat_regions(form.operand->resolved());
    out.is_exact = section.is_exact && flat->is_exact;
    return out;
}

/// Limits are kept by the thread that has them.
std::uint32_t threads_within_limits(std::uint32_t threads) {
    const StopScope* const scope = detail::stop_scope_of_thread;
    if (scope == nullptr) return threads;
    return scope->work_left().max_work != 0 || scope->max_memory() != 0 ? 1 : threads;
}

std::vector<Slice> slices_of(const detail::MeshSection& mesh, std::span<const double> heights,
                             const SliceOptions& options) {
    const detail::SectionStack stack(mesh, heights);
    std::vector<Slice> found(stack.size());
    EvaluateOptions evaluation = options.evaluate;
    evaluation.threads = 1;
    const detail::ParallelParts parts(stack.size(), threads_within_limits(options.evaluate.threads),
                                      1);
    const StopScope* const scope = detail::stop_scope_of_thread;
    parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            detail::check_flags(scope);
            const detail::SectionPlane plane = stack.plane(i);
            if (plane.triangles.empty())
                found[i].height = plane.height;
            else
                found[i] =
                    slice_of(section_prism(mesh, plane, options.rule, evaluation), plane.height);
        }
    });
    // Each goes to the last one that has its height, and is copied for others.
    std::vector<std::size_t> left(stack.size(), 0);
    std::vector<std::size_t> places;
    places.reserve(heights.size());
    for (const double height : heights) {
        const auto at = std::ranges::lower_bound(stack.heights(), height);
        places.push_back(static_cast<std::size_t>(at - stack.heights().begin()));
        ++left[places.back()];
    }
    std::vector<Slice> out;
    out.reserve(heights.size());
    for (const std::size_t i : places)
        if (--left[i] == 0)
            out.push_back(std::move(found[i]));
        else
            out.push_back(found[i]);
    return out;
}

DoublePair twice_area(const Slice& slice, const std::vector<std::uint32_t>& loop) {
    DoublePair out;
    const Point2d& o = slice.points[loop[0]];
    const auto from_first = [&](std::uint32_t n, std::size_t k) {
        return detail::two_sum(slice.points[n][k], -o[k]);
    };
    for (std::size_t i = 2; i < loop.size(); ++i) {
        const std::uint32_t a = loop[i - 1];
        const std::uint32_t b = loop[i];
        out = add(out, subtract(multiply(from_first(a, 0), from_first(b, 1)),
                                multiply(from_first(a, 1), from_first(b, 0))));
    }
    return out;
}

double half_stretched(const DoublePair& twice, const SliceFrame& frame) {
    return frame.stretch() * (twice.high + twice.low) / 2;
}

}  // namespace

std::vector<Slice> slices(const Solid& solid, std::span<const double> heights,
                          const SliceOptions& options) {
    return slices(detail::mesh_of_bounded(solid, options.evaluate), heights, options);
}

std::vector<Slice> slices(const ExactMesh& boundary, std::span<const double> heights,
                          const SliceOptions& options) {
    return slices_of(detail::MeshSection(boundary, options.frame), heights, options);
}

std::vector<Slice> slices(const Solid& solid, std::span<const double> heights,
                          const EvaluateOptions& options) {
    SliceOptions all;
    all.evaluate = options;
    return slices(solid, heights, all);
}

std::vector<Slice> slices_of_mesh(const PolygonMesh& mesh, std::span<const double> heights,
                                  const SliceOptions& options) {
    return slices_of(detail::MeshSection(mesh, options.frame), heights, options);
}

double area(const Slice& slice, const SliceFrame& frame) {
    DoublePair twice;
    for (const auto& loop : slice.loops) twice = add(twice, twice_area(slice, loop));
    return half_stretched(twice, frame);
}

double area_of_region(const Slice& slice, std::size_t region, const SliceFrame& frame) {
    DoublePair twice;
    for (const std::uint32_t loop : slice.regions[region])
        twice = add(twice, twice_area(slice, slice.loops[loop]));
    return half_stretched(twice, frame);
}

double perimeter(const Slice& slice, const SliceFrame& frame) {
    double out = 0;
    for (const auto& loop : slice.loops) {
        Point3d from = frame.space(slice.points[loop.back()], slice.height);
        for (const std::uint32_t n : loop) {
            const Point3d to = frame.space(slice.points[n], slice.height);
            out += std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
            from = to;
        }
    }
    return out;
}

}  // namespace trisect
