// SPDX-License-Identifier: Apache-2.0
//
// GlbTextures: pictures of the materials of a GLB file.
#pragma once

#include <trisect/brep/io/model.h>
#include <trisect/brep/io/models/glb_document.h>
#include <trisect/brep/io/properties/beside_files.h>

#include <cstdint>
#include <map>
#include <vector>

namespace trisect::detail {

/// Of a material the picture of its base colour. Pictures stand in the file or beside it.
class GlbTextures {
public:
    GlbTextures(const GlbDocument& glb, BesideFiles& files) : glb_(glb), files_(files) {}

    /// The number of the picture of the next material, or no_texture. To be called in order.
    [[nodiscard]] std::uint32_t of_material(const GlbValue& material);
    /// Which set of texture coordinates a material takes; 0 where there is no such material.
    [[nodiscard]] std::uint64_t set_of_material(std::uint32_t material) const {
        return material < sets_.size() ? sets_[material] : 0;
    }
    [[nodiscard]] std::vector<ModelTexture> take() { return std::move(textures_); }

private:
    [[nodiscard]] ModelTexture read(std::uint64_t index, const GlbValue& user);
    void read_image(std::uint64_t index, const GlbValue& user, ModelTexture& out);

    const GlbDocument& glb_;
    BesideFiles& files_;
    std::vector<ModelTexture> textures_;
    std::map<std::uint64_t, std::uint32_t> known_;  ///< by the file's number
    std::vector<std::uint64_t> sets_;               ///< by material
    std::uint64_t bytes_ = 0;
};

}  // namespace trisect::detail
