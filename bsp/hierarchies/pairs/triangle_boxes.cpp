// SPDX-License-Identifier: Apache-2.0
//
// Vertices are moved in doubles with a bound on the error; a box is grown by that bound and to the
// next doubles, which pays for the rounding of the growing.

#include <trisect/bsp/hierarchies/pairs/triangle_boxes.h>

#include <algorithm>
#include <cmath>

namespace trisect::hierarchies {

TriangleBoxes::TriangleBoxes(const detail::InterferenceModelData& model)
    : corners_(model.positions), error_(model.position_error) {
    fit(model);
}

void TriangleBoxes::move(const detail::InterferenceModelData& model, const Placement& placement) {
    corners_.resize(model.positions.size());
    for (std::size_t v = 0; v < corners_.size(); ++v)
        corners_[v] = placement.to_a(model.positions[v]);
    error_ = placement.b_error;
    fit(model);
}

void TriangleBoxes::fit(const detail::InterferenceModelData& model) {
    boxes_.resize(model.triangles.size());
    bounds_ = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        const auto& v = model.triangles[i].vertex;
        const auto& p = corners_[v[0].index];
        const auto& q = corners_[v[1].index];
        const auto& r = corners_[v[2].index];
        for (std::size_t k = 0; k < 3; ++k) {
            double lo = std::min({p[k], q[k], r[k]});
            double hi = std::max({p[k], q[k], r[k]});
            if (error_ != 0) {
                lo = std::nextafter(lo - error_, -HUGE_VAL);
                hi = std::nextafter(hi + error_, HUGE_VAL);
            }
            boxes_[i].lo[k] = lo;
            boxes_[i].hi[k] = hi;
            bounds_.lo[k] = std::min(bounds_.lo[k], lo);
            bounds_.hi[k] = std::max(bounds_.hi[k], hi);
        }
    }
}

}  // namespace trisect::hierarchies
