// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/certificate/find/from_world.h>

#include <trisect/bsp/interference/certificate/find/proof_vector.h>

namespace trisect::detail {

// Columns of the inverse are cross products of the rows.
FromWorld::FromWorld(const InterferenceModelData& model, const Pose& pose)
    : model_(&model), pose_(&pose) {
    std::array<ExactPoint, 3> rows;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) rows[i][j] = ExactRational(pose.matrix(i, j));
    const ExactRational determinant = dot(rows[0], cross(rows[1], rows[2]));
    for (std::size_t j = 0; j < 3; ++j) {
        columns_[j] = cross(rows[(j + 1) % 3], rows[(j + 2) % 3]);
        for (ExactRational& x : columns_[j]) x /= determinant;
    }
}

ExactPoint FromWorld::moved_back(const ExactPoint& p) const {
    ExactPoint x;
    for (std::size_t j = 0; j < 3; ++j) {
        const ExactRational y =
            p[j] * ExactRational(pose_->denominator()) - ExactRational(pose_->translation(j));
        for (std::size_t i = 0; i < 3; ++i) x[i] += columns_[j][i] * y;
    }
    return x;
}

bool FromWorld::is_inside(const ExactPoint& p) const {
    return model_->model.index().locate(moved_back(p)).location == Location::Inside;
}

}  // namespace trisect::detail
