// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/interference_model.h>

#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect {

using detail::InterferenceModelData;

const std::shared_ptr<const InterferenceModelData>& InterferenceModel::empty_data() {
    // Never destroyed: models may be used after main().
    static const auto& empty = *new auto(std::make_shared<const InterferenceModelData>(Solid()));
    return empty;
}

InterferenceModel::InterferenceModel() : data_(empty_data()) {}

InterferenceModel::InterferenceModel(const Solid& solid)
    : data_(std::make_shared<const InterferenceModelData>(solid)) {}

InterferenceModel::InterferenceModel(const BrepIndex& index)
    : data_(std::make_shared<const InterferenceModelData>(index)) {}

const Solid& InterferenceModel::solid() const { return data().solid; }
const Brep& InterferenceModel::brep() const { return data().brep; }
Lattice InterferenceModel::lattice() const { return data().brep.lattice(); }
bool InterferenceModel::is_empty() const { return data().is_empty(); }
std::size_t InterferenceModel::triangle_count() const { return data().triangles.size(); }
const BrepIndex& InterferenceModel::index() const { return data().index(); }

InterferenceModelStats InterferenceModel::stats() const {
    InterferenceModelStats s;
    s.faces = data().brep.counts().faces;
    s.triangles = data().triangles.size();
    s.shells = data().shell_vertex.size();
    s.bytes = data().bytes();
    s.brep_seconds = data().brep_seconds;
    s.triangulate_seconds = data().triangulate_seconds;
    s.boxes_seconds = data().boxes_seconds;
    s.box_levels = data().boxes.depth;
    return s;
}

}  // namespace trisect
