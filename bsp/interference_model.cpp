// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference_model.h>

#include <trisect/bsp/detail/interference_model_data.h>

namespace trisect {

using detail::InterferenceModelData;

InterferenceModel::InterferenceModel() {
    static const auto empty = std::make_shared<const InterferenceModelData>(Solid());
    data_ = empty;
}

InterferenceModel::InterferenceModel(const Solid& solid)
    : data_(std::make_shared<const InterferenceModelData>(solid)) {}

InterferenceModel::InterferenceModel(const BrepIndex& index)
    : data_(std::make_shared<const InterferenceModelData>(index)) {}

const Solid& InterferenceModel::solid() const { return data_->solid; }
const Brep& InterferenceModel::brep() const { return data_->brep; }
Lattice InterferenceModel::lattice() const { return data_->brep.lattice(); }
bool InterferenceModel::is_empty() const { return data_->is_empty(); }
std::size_t InterferenceModel::triangle_count() const { return data_->triangles.size(); }
const BrepIndex& InterferenceModel::index() const { return data_->index(); }

InterferenceModelStats InterferenceModel::stats() const {
    InterferenceModelStats s;
    s.faces = data_->brep.counts().faces;
    s.triangles = data_->triangles.size();
    s.shells = data_->shell_vertex.size();
    s.bytes = data_->bytes();
    s.brep_seconds = data_->brep_seconds;
    s.triangulate_seconds = data_->triangulate_seconds;
    s.boxes_seconds = data_->boxes_seconds;
    s.box_levels = data_->boxes.depth;
    return s;
}

}  // namespace trisect
