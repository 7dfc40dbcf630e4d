// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/glb_textures.h>

#include <trisect/brep/io/models/glb_accessor.h>
#include <trisect/brep/io/properties/picture_files.h>

namespace trisect::detail {
namespace {

TextureWrap wrap_of(std::uint64_t number) {
    if (number == 33071) return TextureWrap::Clamp;
    return number == 33648 ? TextureWrap::Mirror : TextureWrap::Repeat;
}

}  // namespace

std::uint32_t GlbTextures::of_material(const GlbValue& material) {
    sets_.push_back(0);
    const auto pbr = glb_.object(material, "pbrMetallicRoughness");
    const auto info = pbr ? glb_.object(*pbr, "baseColorTexture") : std::nullopt;
    if (!info) return no_texture;
    sets_.back() = glb_.count(*info, "texCoord").value_or(0);
    if (const auto extensions = glb_.object(*info, "extensions");
        extensions && glb_.has(*extensions, "KHR_texture_transform"))
        files_.remark("pictures are not moved or scaled: KHR_texture_transform is passed over");
    const std::uint64_t index = glb_.required_count(*info, "index");
    const auto [found, is_new] =
        known_.emplace(index, static_cast<std::uint32_t>(textures_.size()));
    if (is_new) textures_.push_back(read(index, *info));
    return found->second;
}

ModelTexture GlbTextures::read(std::uint64_t index, const GlbValue& user) {
    const GlbValue texture = glb_.at("textures", index, user);
    ModelTexture out;
    if (const auto sampler = glb_.count(texture, "sampler")) {
        const GlbValue value = glb_.at("samplers", *sampler, texture);
        out.wrap = {wrap_of(glb_.count(value, "wrapS").value_or(0)),
                    wrap_of(glb_.count(value, "wrapT").value_or(0))};
    }
    if (const auto source = glb_.count(texture, "source"))
        read_image(*source, texture, out);
    else
        files_.remark("pictures of extensions of glTF are not read");
    return out;
}

void GlbTextures::read_image(std::uint64_t index, const GlbValue& user, ModelTexture& out) {
    const GlbValue image = glb_.at("images", index, user);
    out.media_type = glb_.text(image, "mimeType");
    if (const auto view = glb_.count(image, "bufferView")) {
        out.bytes = glb_view(glb_, *view, image);
        bytes_ += out.bytes.size();
        // Many textures may share one image.
        if (bytes_ > glb_.source().limits().unpacked_bytes)
            glb_.source().fail_limit(glb_.source().begin(),
                                     "pictures of more bytes than the limit");
    } else {
        const std::string uri = glb_.text(image, "uri");
        if (uri.starts_with("data:")) {
            files_.remark("pictures in addresses of the scheme data are not read");
            return;
        }
        out.file = uri;
        out.bytes = files_.read(uri).value_or("");
    }
    if (out.media_type.empty()) out.media_type = media_type_of(out.bytes, out.file);
}

}  // namespace trisect::detail
