// SPDX-License-Identifier: Apache-2.0
//
// A plane through lattice points near given corners need not exist within any small distance,
// unless the plane is one of those that are dense in lattice points: the axis-aligned ones. Those
// are what CAD files mean when they write 0.99999994 in one corner and 1 in the others. Moving a
// face alone would pull its corners out of the planes of its neighbours, so faces of one axis that
// share corners form a group with one coordinate. Faces perpendicular to another axis stay in their
// plane, because corners move only along the axis in question.

#include <trisect/brep/import/refit_faces.h>

#include <algorithm>
#include <numeric>
#include <string>

#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

struct CoordinateRange {
    std::int64_t low = coordinate_limit;
    std::int64_t high = -coordinate_limit;

    void add(std::int64_t v) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
    [[nodiscard]] std::int64_t extent() const { return high - low; }
    [[nodiscard]] std::int64_t middle() const { return low + extent() / 2; }
};

class Groups {
public:
    explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

private:
    std::vector<std::uint32_t> parent_;
};

// The axis along which the face extends least.
int flattest_axis(const PreparedMesh& mesh, std::uint32_t face, std::int64_t& extent) {
    int best = 0;
    for (int axis = 0; axis < 3; ++axis) {
        CoordinateRange r;
        for (const std::uint32_t c : mesh.loop(face)) r.add(mesh.points[c][axis].to_integer());
        if (axis == 0 || r.extent() < extent) {
            best = axis;
            extent = r.extent();
        }
    }
    return best;
}

[[noreturn]] void refuse(std::uint32_t face) {
    throw UnsupportedError(
        "face " + std::to_string(face) +
        " is not planar and cannot be made so within the allowed move: only faces "
        "nearly perpendicular to a coordinate axis can");
}

void set_coordinate(LatticePoint& p, int axis, Coordinate v) {
    (axis == 0 ? p.x : (axis == 1 ? p.y : p.z)) = v;
}

std::int64_t refit_axis(const PreparedMesh& mesh, std::span<const std::uint32_t> faces, int axis,
                        std::int64_t max_move, std::vector<LatticePoint>& moved) {
    Groups groups(mesh.points.size());
    for (const std::uint32_t f : faces)
        for (const std::uint32_t c : mesh.loop(f)) groups.join(c, mesh.loop(f)[0]);
    std::vector<CoordinateRange> ranges(mesh.points.size());
    for (const std::uint32_t f : faces)
        for (const std::uint32_t c : mesh.loop(f))
            ranges[groups.root(c)].add(mesh.points[c][axis].to_integer());
    std::int64_t largest = 0;
    for (const std::uint32_t f : faces) {
        for (const std::uint32_t c : mesh.loop(f)) {
            const CoordinateRange& r = ranges[groups.root(c)];
            if (r.extent() > 2 * max_move) refuse(f);
            set_coordinate(moved[c], axis, r.middle());
            largest = std::max(largest, std::abs(r.middle() - mesh.points[c][axis].to_integer()));
        }
    }
    return largest;
}

}  // namespace

std::int64_t refit_faces(const PolygonMesh& input, const PreparedMesh& mesh, std::int64_t max_move,
                         std::span<LatticePoint> points) {
    std::array<std::vector<std::uint32_t>, 3> by_axis;
    for (const std::uint32_t f : mesh.nonplanar_faces) {
        std::int64_t extent = 0;
        const int axis = flattest_axis(mesh, f, extent);
        if (extent > 2 * max_move) refuse(f);
        by_axis[static_cast<std::size_t>(axis)].push_back(f);
    }
    std::vector<LatticePoint> moved = mesh.points;
    std::int64_t largest = 0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, refit_axis(mesh, by_axis[static_cast<std::size_t>(axis)], axis,
                                               max_move, moved));
    for (std::size_t i = 0; i < input.corners.size(); ++i)
        points[input.corners[i]] = moved[mesh.corners[i]];
    return largest;
}

}  // namespace trisect::detail
