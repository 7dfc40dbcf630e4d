// SPDX-License-Identifier: Apache-2.0
//
// Peers of BrepIndex behind one interface, each compiled with what it needs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <trisect/brep/polygon_mesh.h>

namespace query_peers {

using Point = std::array<double, 3>;

/// The time that this thread has had of a processor.
[[nodiscard]] inline double thread_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Ray {
    Point origin;
    Point direction;
};

/// 0 outside, 1 inside, 2 on the boundary.
using Side = std::int8_t;

class Peer {
public:
    virtual ~Peer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    [[nodiscard]] virtual double build_seconds() const = 0;
    virtual void locate(std::span<const Point> points, std::span<Side> sides) const = 0;
    /// The number of the first triangle that is hit, or -1.
    virtual void first_hits(std::span<const Ray> rays, std::span<std::int64_t> hits) const = 0;
    /// Rounded squared distances; nothing when the peer has no such query.
    virtual void squared_distances(std::span<const Point>, std::span<double>) const {}
};

/// CGAL with exact predicates and rounded constructions: Side_of_triangle_mesh, AABB_tree.
[[nodiscard]] std::unique_ptr<Peer> make_cgal(const trisect::PolygonMesh& mesh);
/// Embree in single precision: parity of all crossings; null when it is not there.
[[nodiscard]] std::unique_ptr<Peer> make_embree(const trisect::PolygonMesh& mesh, bool robust);

}  // namespace query_peers
