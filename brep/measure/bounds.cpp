// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/measure.h>

#include <algorithm>
#include <cstddef>

namespace trisect {

namespace {

class BoundsCollector {
public:
    void add(const std::array<double, 3>& p) {
        if (!box_) box_ = Bounds{p, p};
        for (std::size_t i = 0; i < 3; ++i) {
            box_->lo[i] = std::min(box_->lo[i], p[i]);
            box_->hi[i] = std::max(box_->hi[i], p[i]);
        }
    }
    [[nodiscard]] const std::optional<Bounds>& box() const { return box_; }
    std::optional<Bounds> in_units_of(Lattice lattice) const {
        if (!box_) return std::nullopt;
        Bounds b = *box_;
        for (std::size_t i = 0; i < 3; ++i) {
            b.lo[i] = lattice.to_double(b.lo[i]);
            b.hi[i] = lattice.to_double(b.hi[i]);
        }
        return b;
    }

private:
    std::optional<Bounds> box_;  // lattice units
};

}  // namespace

std::optional<Bounds> bounds(const Brep& brep) {
    BoundsCollector box;
    for (const Point& p : brep.points()) box.add(p.nearest());
    return box.in_units_of(brep.lattice());
}

std::optional<Bounds> bounds(const ExactMesh& mesh) {
    BoundsCollector box;
    for (const Point& p : mesh.points) box.add(p.nearest());
    return box.in_units_of(mesh.lattice);
}

std::optional<Bounds> bounds(const PolygonMesh& mesh) {
    BoundsCollector box;
    for (const std::uint32_t v : mesh.corners) box.add(mesh.points[v]);
    return box.box();
}

std::optional<Bounds> bounds(const LatticeMesh& mesh) {
    BoundsCollector box;
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t v : t) box.add(approximate(mesh.points[v]).c);
    return box.in_units_of(mesh.lattice);
}

}  // namespace trisect
