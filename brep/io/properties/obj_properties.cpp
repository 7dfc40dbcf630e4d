// SPDX-License-Identifier: Apache-2.0
//
// Texture coordinates, normals, colours and materials of OBJ.
//
// Faces stand in the file in the order of the mesh, so a pass over the statements needs to count
// them only. Indices of `vt` and `vn` may name statements that come later: the largest one is
// judged at the end, at its place. A corner without an index has no such property. Colours are the
// last three of six or seven numbers of a vertex, in sRGB from 0 to 1.
#include <trisect/brep/io/properties/mesh_properties.h>

#include <trisect/brep/io/formats/text_cursor.h>
#include <trisect/brep/io/properties/material_library.h>
#include <trisect/brep/io/properties/picture_files.h>
#include <trisect/brep/io/properties/property_collector.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace trisect::detail {
namespace {

/// Statements of one keyword, and what corners name of them.
struct ObjRows {
    const char* keyword;
    std::size_t width;
    std::vector<double> values;
    std::vector<std::uint32_t> used{};  ///< by corner: number from 0, or none
    std::uint64_t largest = 0;          ///< number from 1 that a corner names
    const char* largest_at = nullptr;

    [[nodiscard]] std::size_t count() const { return values.size() / width; }
};

constexpr std::uint32_t no_row = 0xFFFF'FFFFU;

class ObjPropertyReader {
public:
    ObjPropertyReader(const InputText& source, PolygonMesh mesh, BesideFiles& files)
        : source_(source),
          text_(source, TextRules{.hash_comments = true, .continuation = true}),
          files_(files) {
        part_.mesh = std::move(mesh);
    }

    Model read() {
        while (text_.next_line()) {
            check_stop();
            statement(text_.word());
        }
        finish();
        return std::move(model_);
    }

private:
    void statement(std::string_view keyword) {
        if (keyword == "v")
            vertex();
        else if (keyword == "vt")
            row(uv_, 1, "a texture coordinate");
        else if (keyword == "vn")
            row(normals_, 3, "a normal");
        else if (keyword == "f" || keyword == "fo")
            face();
        else if (keyword == "usemtl")
            material_ = material_named(std::string(text_.rest_of_line()));
        else if (keyword == "mtllib")
            library();
    }

    /// The last three of six or seven numbers are a colour.
    void vertex() {
        std::array<double, 7> numbers{};
        std::size_t n = 0;
        while (n < numbers.size() && !text_.at_line_end())
            numbers[n++] = text_.any_real("a coordinate or colour");
        if (n < 6) {
            if (!colors_.empty()) colors_.resize(colors_.size() + 3, absent_number);
        } else {
            colors_.resize(3 * vertices_, absent_number);
            for (std::size_t i = n - 3; i < n; ++i)
                colors_.push_back(std::isfinite(numbers[i]) ? numbers[i] : absent_number);
        }
        ++vertices_;
    }

    /// Numbers beyond the first ones that are needed may be missing.
    void row(ObjRows& rows, std::size_t needed, const char* what) {
        for (std::size_t i = 0; i < rows.width; ++i)
            rows.values.push_back(i >= needed && text_.at_line_end() ? 0 : text_.real(what));
    }

    void face() {
        for (; !text_.at_line_end(); ++corner_) {
            (void)text_.leading_integer("a vertex index");
            if (text_.take('/')) index(uv_);
            if (text_.take('/')) index(normals_);
        }
        part_.materials.push_back(material_);
    }

    void index(ObjRows& rows) {
        if (!text_.inside_word() || text_.at('/')) return;
        const char* const at = text_.here();
        const std::int64_t number = text_.leading_integer("a texture or normal index");
        std::uint64_t from_one = static_cast<std::uint64_t>(number);
        if (number <= 0) {
            const std::uint64_t back = std::uint64_t{0} - from_one;
            if (number == 0 || back > rows.count())
                source_.fail(at, "index " + std::to_string(number) + " of '" + rows.keyword +
                                     "'; there are " + std::to_string(rows.count()) + " so far");
            from_one = rows.count() - back + 1;
        }
        if (from_one > rows.largest) {
            rows.largest = from_one;
            rows.largest_at = at;
        }
        rows.used.resize(corner_, no_row);
        rows.used.push_back(static_cast<std::uint32_t>(std::min<std::uint64_t>(from_one, no_row)) -
                            1);
    }

    void library() {
        const std::string whole(text_.rest_of_line());
        if (files_.is_there(whole)) return read_library(whole);
        std::string_view words = whole;
        while (!words.empty()) {
            const std::size_t blank = std::min(words.find_first_of(" \t"), words.size());
            if (blank != 0) read_library(std::string(words.substr(0, blank)));
            words.remove_prefix(std::min(blank + 1, words.size()));
        }
    }

    void read_library(const std::string& name) {
        if (const auto text = files_.read(name))
            read_material_library(*text, name, source_.limits(), files_, library_);
    }

    std::uint32_t material_named(const std::string& name) {
        const auto [known, is_new] =
            materials_.emplace(name, static_cast<std::uint32_t>(model_.materials.size()));
        if (is_new) model_.materials.push_back({name, std::nullopt});
        return known->second;
    }

    void finish() {
        for (ModelMaterial& material : model_.materials) describe(material);
        PropertyCollector properties(source_);
        for (ObjRows* rows : {&uv_, &normals_}) {
            if (rows->largest > rows->count())
                source_.fail(rows->largest_at, "index " + std::to_string(rows->largest) + " of '" +
                                                   rows->keyword + "'; the file has " +
                                                   std::to_string(rows->count()));
        }
        collect(properties, properties.uv(), uv_);
        collect(properties, properties.normal(), normals_);
        collect_colors(properties);
        part_.properties = properties.finish(part_.mesh.corners.size());
        if (model_.materials.empty()) part_.materials.clear();
        model_.parts.push_back(std::move(part_));
    }

    void describe(ModelMaterial& material) {
        const auto found = library_.find(material.name);
        if (found == library_.end()) return;
        const LibraryMaterial& from = found->second;
        material.color = from.color;
        if (from.picture.empty()) return;
        const auto [known, is_new] = textures_.emplace(
            std::pair(from.picture, from.wrap), static_cast<std::uint32_t>(model_.textures.size()));
        if (is_new) {
            ModelTexture texture;
            texture.file = from.picture;
            texture.bytes = files_.read(from.picture).value_or("");
            texture.media_type = media_type_of(texture.bytes, texture.file);
            texture.wrap = {from.wrap, from.wrap};
            model_.textures.push_back(std::move(texture));
        }
        material.texture = known->second;
    }

    void collect(PropertyCollector& properties, std::size_t channel, const ObjRows& rows) const {
        for (std::size_t c = 0; c < rows.used.size(); ++c)
            if (rows.used[c] != no_row)
                properties.set(
                    channel, c,
                    std::span(rows.values).subspan(rows.width * rows.used[c], rows.width),
                    rows.largest_at);
    }

    void collect_colors(PropertyCollector& properties) const {
        const std::size_t channel = properties.color();
        for (std::size_t c = 0; c < part_.mesh.corners.size(); ++c) {
            const std::size_t v = 3 * std::size_t{part_.mesh.corners[c]};
            if (v + 3 > colors_.size() || std::isnan(colors_[v])) continue;
            const std::array<double, 4> color{colors_[v], colors_[v + 1], colors_[v + 2], 1};
            properties.set(channel, c, color, source_.end());
        }
    }

    const InputText& source_;
    TextCursor text_;
    BesideFiles& files_;
    Model model_;
    ModelPart part_;
    ObjRows uv_{"vt", uv_width, {}};
    ObjRows normals_{"vn", normal_width, {}};
    std::vector<double> colors_;  ///< three of each vertex; empty while none has one
    std::size_t vertices_ = 0;
    std::size_t corner_ = 0;
    std::uint32_t material_ = no_material;
    std::map<std::string, std::uint32_t> materials_;
    std::map<std::string, LibraryMaterial> library_;
    std::map<std::pair<std::string, TextureWrap>, std::uint32_t> textures_;
};

}  // namespace

Model read_obj_properties(const InputText& source, PolygonMesh mesh, BesideFiles& files) {
    return ObjPropertyReader(source, std::move(mesh), files).read();
}

}  // namespace trisect::detail
