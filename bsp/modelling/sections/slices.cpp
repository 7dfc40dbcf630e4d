// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/slices.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <trisect/bsp/modelling/sections/arranged_slice.h>
#include <trisect/bsp/modelling/sections/layer_walk.h>
#include <trisect/bsp/modelling/sections/mesh_section.h>
#include <trisect/bsp/modelling/sections/section_edges.h>
#include <trisect/bsp/modelling/sections/section_prism.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/double_pair.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect {
namespace {

using detail::DoublePair;
using detail::LayerOutcome;

void count(SliceCounters& counts, LayerOutcome outcome) {
    switch (outcome) {
        case LayerOutcome::Found:
            ++counts.walked;
            return;
        case LayerOutcome::Faces:
            ++counts.faces;
            break;
        case LayerOutcome::Touching:
            ++counts.touching;
            break;
        case LayerOutcome::Collapsed:
            ++counts.collapsed;
            break;
        case LayerOutcome::Crossing:
            ++counts.crossing;
            break;
    }
    ++counts.arranged;
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
    const detail::SectionEdges edges(mesh);
    std::vector<Slice> found(stack.size());
    EvaluateOptions evaluation = options.evaluate;
    evaluation.threads = 1;
    const detail::ParallelParts parts(stack.size(), threads_within_limits(options.evaluate.threads),
                                      1);
    std::vector<SliceCounters> counts(parts.count());
    const StopScope* const scope = detail::stop_scope_of_thread;
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        detail::LayerWalk walk(mesh, edges);
        for (std::size_t i = begin; i < end; ++i) {
            detail::check_flags(scope);
            const detail::SectionPlane plane = stack.plane(i);
            const LayerOutcome outcome =
                walk.run(plane, options.rule, evaluation.winding, found[i]);
            count(counts[part], outcome);
            if (outcome != LayerOutcome::Found)
                found[i] = detail::arranged_slice(mesh, plane, options.rule, evaluation);
        }
    });
    for (const SliceCounters& c : counts) detail::counters_of_thread<SliceCounters> += c;
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

SliceCounters& SliceCounters::operator+=(const SliceCounters& o) {
    walked += o.walked;
    arranged += o.arranged;
    faces += o.faces;
    touching += o.touching;
    collapsed += o.collapsed;
    crossing += o.crossing;
    return *this;
}

SliceCounters& SliceCounters::operator-=(const SliceCounters& o) {
    walked -= o.walked;
    arranged -= o.arranged;
    faces -= o.faces;
    touching -= o.touching;
    collapsed -= o.collapsed;
    crossing -= o.crossing;
    return *this;
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
