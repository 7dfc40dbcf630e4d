// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/interference_model.h>

#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect {

using detail::LazyModel;

const std::shared_ptr<const LazyModel>& InterferenceModel::empty_model() {
    // Never destroyed: models may be used after main().
    static const auto& empty = *new auto(std::make_shared<const LazyModel>(Solid()));
    return empty;
}

InterferenceModel::InterferenceModel() : shared_(empty_model()) {}

InterferenceModel::InterferenceModel(const Solid& solid)
    : shared_(std::make_shared<const LazyModel>(solid)) {}

InterferenceModel::InterferenceModel(const BrepIndex& index)
    : shared_(std::make_shared<const LazyModel>(index)) {}

const Solid& InterferenceModel::solid() const { return shared().solid(); }
const Brep& InterferenceModel::brep() const { return shared().brep(); }
Lattice InterferenceModel::lattice() const { return solid().lattice(); }
bool InterferenceModel::is_empty() const { return solid().is_empty(); }
std::size_t InterferenceModel::triangle_count() const {
    return detail::data_of(*this).triangles.size();
}
const BrepIndex& InterferenceModel::index() const { return shared().index(); }

InterferenceModelStats InterferenceModel::stats() const {
    const detail::InterferenceModelData& data = detail::data_of(*this);
    InterferenceModelStats s;
    s.faces = data.brep.counts().faces;
    s.triangles = data.triangles.size();
    s.shells = data.shell_vertex.size();
    s.bytes = data.bytes();
    s.brep_seconds = shared().brep_seconds();
    s.triangulate_seconds = data.triangulate_seconds;
    s.boxes_seconds = data.boxes_seconds;
    s.box_levels = data.boxes.depth;
    return s;
}

}  // namespace trisect
