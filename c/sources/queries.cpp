// SPDX-License-Identifier: Apache-2.0
//
// Points, rays, distances and sections.

#include <limits>
#include <span>
#include <vector>

#include <trisect/bsp/brep_index.h>

#include "call.h"
#include "handles.h"

using namespace trisect;  // NOLINT(google-build-using-namespace)
using c::required;

namespace {

std::span<const Point3d> points_of(const double* numbers, std::size_t count, const char* name) {
    if (count > std::numeric_limits<std::size_t>::max() / 3) throw UsageError("count: too large");
    (void)c::array_of(numbers, 3 * count, name);
    return {reinterpret_cast<const Point3d*>(numbers), count};
}

}  // namespace

trisect_status trisect_locate(const trisect_solid* solid, const double* points, size_t count,
                              uint8_t* locations) {
    return c::call([&] {
        static_assert(static_cast<int>(Location::Inside) == TRISECT_INSIDE);
        const auto list = points_of(points, count, "points");
        (void)c::array_of(locations, count, "locations");
        BrepIndex(required(solid, "solid").solid)
            .classify(list, std::span(reinterpret_cast<Location*>(locations), count),
                      c::limits_of_thread().threads);
    });
}

trisect_status trisect_first_hits(const trisect_solid* solid, const double* origins,
                                  const double* directions, size_t count, double* parameters,
                                  uint32_t* faces) {
    return c::call([&] {
        const auto from = points_of(origins, count, "origins");
        const auto along = points_of(directions, count, "directions");
        (void)c::array_of(parameters, count, "parameters");
        const BrepIndex index(required(solid, "solid").solid);
        for (std::size_t i = 0; i < count; ++i) {
            detail::check_stop();
            const auto hit = index.first_facet(Ray{from[i], along[i]});
            parameters[i] =
                hit ? hit->lo + (hit->hi - hit->lo) / 2 : std::numeric_limits<double>::infinity();
            if (faces == nullptr) continue;
            faces[2 * i] = hit ? hit->face.operand : 0;
            faces[2 * i + 1] = hit ? hit->face.face : 0;
        }
    });
}

trisect_status trisect_signed_distances(const trisect_solid* solid, const double* points,
                                        size_t count, double* distances) {
    return c::call([&] {
        const auto list = points_of(points, count, "points");
        (void)c::array_of(distances, count, "distances");
        const BrepIndex index(required(solid, "solid").solid);
        std::vector<Location> locations(count);
        index.classify(list, locations, c::limits_of_thread().threads);
        for (std::size_t i = 0; i < count; ++i) {
            detail::check_stop();
            if (locations[i] != Location::Inside && locations[i] != Location::Outside) {
                distances[i] = 0;
                continue;
            }
            const auto bounds = index.distance(list[i]);
            const double d = bounds ? bounds->lo + (bounds->hi - bounds->lo) / 2
                                    : std::numeric_limits<double>::infinity();
            distances[i] = locations[i] == Location::Inside ? -d : d;
        }
    });
}

trisect_status trisect_solid_section(const trisect_solid* solid, const double plane[4],
                                     trisect_section** section) {
    return c::make_handle(section, "section", [&] {
        (void)required(plane, "plane");
        std::vector<SectionRegion> regions = BrepIndex(required(solid, "solid").solid)
                                                 .section({plane[0], plane[1], plane[2], plane[3]});
        std::vector<trisect_section::Loop> loops;
        for (std::size_t r = 0; r < regions.size(); ++r) {
            loops.push_back({r, false, std::move(regions[r].outer.rounded)});
            for (SectionLoop& hole : regions[r].holes)
                loops.push_back({r, true, std::move(hole.rounded)});
        }
        return loops;
    });
}

size_t trisect_section_loop_count(const trisect_section* section) {
    return section != nullptr ? section->loops.size() : 0;
}

size_t trisect_section_region(const trisect_section* section, size_t loop) {
    return loop < trisect_section_loop_count(section) ? section->loops[loop].region : 0;
}

int trisect_section_is_hole(const trisect_section* section, size_t loop) {
    return loop < trisect_section_loop_count(section) && section->loops[loop].is_hole ? 1 : 0;
}

const double* trisect_section_points(const trisect_section* section, size_t loop, size_t* count) {
    const bool exists = loop < trisect_section_loop_count(section);
    if (count != nullptr) *count = exists ? section->loops[loop].points.size() : 0;
    return exists ? reinterpret_cast<const double*>(section->loops[loop].points.data()) : nullptr;
}

void trisect_section_free(trisect_section* section) { delete section; }
