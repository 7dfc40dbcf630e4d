// SPDX-License-Identifier: Apache-2.0
//
// Texture coordinates, normals, colours, materials and further scalars of PLY.
//
// PLY has no names that all programs share. Known are: s, t; u, v; texture_u, texture_v; nx, ny,
// nz; red, green, blue, alpha (whole numbers count from 0 to the largest of their type) of vertices
// and of faces, and r, g, b, a; of faces `texcoord`, two numbers for each corner or none, and
// `texnumber`, `material_index`. Pictures are comments `TextureFile NAME`, names of materials
// comments `material NAME`. Every other scalar of a vertex is a channel of its own name. What a
// vertex has, all its corners have; what a face says of its corners goes before. Numbers that are
// not a number are absent.
#include <trisect/brep/io/properties/mesh_properties.h>

#include <trisect/brep/io/properties/picture_files.h>
#include <trisect/brep/io/properties/ply_scalars.h>
#include <trisect/brep/io/properties/property_collector.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace trisect::detail {
namespace {

/// What a property means: a channel and its column, or one of the others.
enum class PlyRole : std::uint8_t { Passed, Uv, Normal, Color, Other, Wedge, Texture, Material };

struct PlyUse {
    PlyRole role = PlyRole::Passed;
    std::size_t column = 0;
    std::size_t channel = 0;
};

struct KnownName {
    std::string_view name;
    PlyRole role;
    std::size_t column;
};

constexpr std::array<KnownName, 23> known_names{{
    {"s", PlyRole::Uv, 0},
    {"t", PlyRole::Uv, 1},
    {"u", PlyRole::Uv, 0},
    {"v", PlyRole::Uv, 1},
    {"texture_u", PlyRole::Uv, 0},
    {"texture_v", PlyRole::Uv, 1},
    {"nx", PlyRole::Normal, 0},
    {"ny", PlyRole::Normal, 1},
    {"nz", PlyRole::Normal, 2},
    {"red", PlyRole::Color, 0},
    {"green", PlyRole::Color, 1},
    {"blue", PlyRole::Color, 2},
    {"alpha", PlyRole::Color, 3},
    {"r", PlyRole::Color, 0},
    {"g", PlyRole::Color, 1},
    {"b", PlyRole::Color, 2},
    {"a", PlyRole::Color, 3},
    {"diffuse_red", PlyRole::Color, 0},
    {"diffuse_green", PlyRole::Color, 1},
    {"diffuse_blue", PlyRole::Color, 2},
    {"diffuse_alpha", PlyRole::Color, 3},
    {"texture_s", PlyRole::Uv, 0},
    {"texture_t", PlyRole::Uv, 1},
}};

std::optional<KnownName> known_name(std::string_view name) {
    for (const KnownName& known : known_names)
        if (known.name == name) return known;
    return std::nullopt;
}

/// The largest number of an integer type; 1 for others.
double scale_of(PlyType type) {
    switch (type) {
        case PlyType::UInt8:
            return 255;
        case PlyType::UInt16:
            return 65535;
        case PlyType::UInt32:
            return 4294967295.0;
        default:
            return 1;
    }
}

/// The largest index that faces name, and where.
struct LargestIndex {
    std::uint32_t index = 0;
    const char* at = nullptr;
    void meet(std::uint32_t other, const char* place) {
        if (other == no_material || (at != nullptr && other <= index)) return;
        index = other;
        at = place;
    }
};

class PlyPropertyReader {
public:
    PlyPropertyReader(const InputText& source, const InputText& body, PolygonMesh mesh,
                      BesideFiles& files)
        : source_(body),
          header_(read_ply_header(source)),
          values_(body, header_),
          files_(files),
          vertices_(body),
          corners_(body) {
        part_.mesh = std::move(mesh);
    }

    Model read() {
        for (const PlyElement& element : header_.elements) {
            std::vector<PlyUse> uses;
            for (const PlyProperty& p : element.properties) uses.push_back(use_of(element, p));
            if (element.properties.empty()) continue;
            for (std::uint64_t i = 0; i < element.count; ++i) {
                check_stop();
                entry(element, uses, static_cast<std::size_t>(i));
            }
        }
        finish();
        return std::move(model_);
    }

private:
    PlyUse use_of(const PlyElement& element, const PlyProperty& p) {
        const bool is_vertex = element.name == "vertex";
        const bool is_face = element.name == "face";
        const bool is_material = element.name == "material";
        if (is_face && p.is_list && p.name == "texcoord") return {PlyRole::Wedge, 0, 0};
        if (p.is_list || !(is_vertex || is_face || is_material)) return {};
        if (is_face && p.name == "texnumber") return {PlyRole::Texture, 0, 0};
        if (is_face && p.name == "material_index") return {PlyRole::Material, 0, 0};
        const auto known = known_name(p.name);
        if (known && (is_vertex || known->role == PlyRole::Color)) {
            const bool is_new = used_.emplace(element.name, known->role, known->column).second;
            if (is_new) return {known->role, known->column, 0};
        }
        if (!is_vertex || p.name == "x" || p.name == "y" || p.name == "z") return {};
        return {PlyRole::Other, 0, vertices_.channel(PropertyMeaning::Any, 1, p.name)};
    }

    struct Entry {
        std::array<double, 2> uv{absent_number, absent_number};
        std::array<double, 3> normal{absent_number, absent_number, absent_number};
        std::array<double, 4> color{absent_number, absent_number, absent_number, 1};
        bool has_uv = false;
        bool has_normal = false;
        bool has_color = false;
        std::uint32_t texture = no_texture;
        std::uint32_t material = no_material;
    };

    void entry(const PlyElement& element, const std::vector<PlyUse>& uses, std::size_t number) {
        values_.begin_entry();
        Entry made;
        for (std::size_t k = 0; k < uses.size(); ++k)
            value(element.properties[k], uses[k], number, made);
        if (element.name == "vertex") {
            if (made.has_uv) vertices_.set(vertices_.uv(), number, made.uv, values_.last());
            if (made.has_normal)
                vertices_.set(vertices_.normal(), number, made.normal, values_.last());
            if (made.has_color && !std::isnan(made.color[0]))
                vertices_.set(vertices_.color(), number, made.color, values_.last());
        } else if (element.name == "face") {
            face(number, made);
        } else if (element.name == "material") {
            colors_.push_back(made.has_color ? std::optional(bytes_of(made.color)) : std::nullopt);
        }
    }

    void value(const PlyProperty& p, const PlyUse& use, std::size_t number, Entry& made) {
        if (p.is_list) {
            const auto count = static_cast<std::uint64_t>(values_.next(p.count_type));
            const char* const at = values_.last();
            if (use.role == PlyRole::Wedge) return wedge(p, number, count, at);
            for (std::uint64_t i = 0; i < count; ++i) (void)values_.next(p.type);
            return;
        }
        const double x = values_.next(p.type);
        if (use.role != PlyRole::Passed && std::isinf(x))
            source_.fail(values_.last(), "a value of '" + p.name + "' that is not finite");
        switch (use.role) {
            case PlyRole::Uv:
                made.uv[use.column] = x;
                made.has_uv = true;
                return;
            case PlyRole::Normal:
                made.normal[use.column] = x;
                made.has_normal = true;
                return;
            case PlyRole::Color:
                made.color[use.column] = x / scale_of(p.type);
                made.has_color = true;
                return;
            case PlyRole::Other:
                if (!std::isnan(x))
                    vertices_.set(use.channel, number, std::span(&x, 1), values_.last());
                return;
            case PlyRole::Texture:
                made.texture = whole(x, p);
                return;
            case PlyRole::Material:
                made.material = whole(x, p);
                return;
            default:
                return;
        }
    }

    /// -1 is none.
    std::uint32_t whole(double x, const PlyProperty& p) const {
        if (x == -1) return no_material;
        if (x < 0 || x >= no_material || x != std::floor(x))
            source_.fail(values_.last(), "a value of '" + p.name + "' that is no index");
        return static_cast<std::uint32_t>(x);
    }

    /// Texture coordinates of the corners of a face.
    void wedge(const PlyProperty& p, std::size_t face, std::uint64_t count, const char* at) {
        if (face >= part_.mesh.face_count()) source_.fail(at, "a face that is not there");
        const std::size_t corners = part_.mesh.face(face).size();
        if (count != 0 && count != 2 * corners)
            source_.fail(at, std::to_string(count) + " texture coordinates of a face with " +
                                 std::to_string(corners) + " corners");
        for (std::size_t i = 0; i < count / 2; ++i) {
            std::array<double, 2> uv{};
            for (double& x : uv) {
                x = values_.next(p.type);
                if (std::isinf(x))
                    source_.fail(values_.last(), "a texture coordinate that is not finite");
            }
            corners_.set(corners_.uv(), part_.mesh.face_begin[face] + i, uv, values_.last());
        }
    }

    void face(std::size_t number, const Entry& made) {
        if (made.has_color && !std::isnan(made.color[0]))
            for (std::size_t c = part_.mesh.face_begin[number];
                 c < part_.mesh.face_begin[number + 1]; ++c)
                face_colors_.set(face_colors_.color(), c, made.color, values_.last());
        if (made.texture == no_texture && made.material == no_material) return;
        faces_.resize(part_.mesh.face_count(), {no_material, no_texture});
        faces_[number] = {made.material, made.texture};
        largest_material_.meet(made.material, values_.last());
        largest_texture_.meet(made.texture, values_.last());
    }

    static ModelColor bytes_of(const std::array<double, 4>& color) {
        ModelColor out{};
        for (std::size_t i = 0; i < 4; ++i) {
            const double c = std::isnan(color[i]) ? 0 : std::clamp(color[i], 0.0, 1.0);
            out[i] = static_cast<std::uint8_t>(std::lround(255 * c));
        }
        return out;
    }

    void finish() {
        spread();
        read_comments();
        // One picture and no numbers: it is on all faces.
        if (faces_.empty() && model_.textures.size() == 1)
            faces_.assign(part_.mesh.face_count(), {no_material, 0});
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
        // Materials of the file keep their numbers, also where no face has them.
        for (std::size_t i = 0; i < colors_.size(); ++i)
            model_.materials.push_back({i < names_.size() ? names_[i] : "", colors_[i]});
        std::vector<bool> taken(colors_.size(), false);
        for (const auto& [material, texture] : faces_) {
            if (material == no_material && texture == no_texture) {
                part_.materials.push_back(no_material);
                continue;
            }
            const auto [found, is_new] = known.try_emplace({material, texture}, 0);
            if (is_new) found->second = new_material(material, texture, taken);
            part_.materials.push_back(found->second);
        }
        model_.parts.push_back(std::move(part_));
    }

    std::uint32_t new_material(std::uint32_t material, std::uint32_t texture,
                               std::vector<bool>& taken) {
        if (material != no_material && material >= colors_.size())
            source_.fail(largest_material_.at, "material " + std::to_string(material) +
                                                   " of a face; there " + "are " +
                                                   std::to_string(colors_.size()));
        if (texture != no_texture && texture >= model_.textures.size())
            source_.fail(largest_texture_.at, "texture " + std::to_string(texture) +
                                                  " of a face; there " + "are " +
                                                  std::to_string(model_.textures.size()));
        if (material != no_material && !taken[material]) {
            taken[material] = true;
            model_.materials[material].texture = texture;
            return material;
        }
        model_.materials.push_back(
            material == no_material
                ? ModelMaterial{"", std::nullopt}
                : ModelMaterial{model_.materials[material].name, colors_[material]});
        model_.materials.back().texture = texture;
        return static_cast<std::uint32_t>(model_.materials.size() - 1);
    }

    void read_comments() {
        for (const std::string_view comment : header_.comments) {
            const std::size_t blank = std::min(comment.find(' '), comment.size());
            const std::string_view keyword = comment.substr(0, blank);
            std::string rest(comment.substr(std::min(blank + 1, comment.size())));
            if (keyword == "material") names_.push_back(std::move(rest));
            if (keyword != "TextureFile") continue;
            ModelTexture texture;
            texture.bytes = files_.read(rest).value_or("");
            texture.media_type = media_type_of(texture.bytes, rest);
            texture.file = std::move(rest);
            model_.textures.push_back(std::move(texture));
        }
    }

    /// From vertices to their corners. What faces say of their corners is kept, colours of faces
    /// give way to those of vertices.
    void spread() {
        const PolygonMesh& mesh = part_.mesh;
        const CornerProperties by_vertex = vertices_.finish(mesh.points.size());
        const CornerProperties wedges = corners_.finish(mesh.corners.size());
        const bool has_colors = by_vertex.column_of(PropertyMeaning::Color).has_value();
        const bool has_wedges = wedges.width != 0;
        PropertyCollector all(source_);
        std::size_t first = 0;
        for (const PropertyChannel& channel : by_vertex.channels) {
            const std::size_t column = first;
            first += channel.width;
            if (has_wedges && channel.meaning == PropertyMeaning::TextureCoordinates) continue;
            const std::size_t to = all.channel(channel.meaning, channel.width, channel.name);
            for (std::size_t c = 0; c < mesh.corners.size(); ++c)
                all.set(to, c, by_vertex.at(mesh.corners[c]).subspan(column, channel.width),
                        source_.end());
        }
        for (std::size_t c = 0; has_wedges && c < mesh.corners.size(); ++c)
            all.set(all.uv(), c, wedges.at(c), source_.end());
        const CornerProperties flat = face_colors_.finish(mesh.corners.size());
        for (std::size_t c = 0; !has_colors && flat.width != 0 && c < mesh.corners.size(); ++c)
            all.set(all.color(), c, flat.at(c), source_.end());
        part_.properties = all.finish(mesh.corners.size());
    }

    const InputText& source_;
    PlyHeader header_;
    PlyScalars values_;
    BesideFiles& files_;
    Model model_;
    ModelPart part_;
    PropertyCollector vertices_;
    PropertyCollector corners_;
    PropertyCollector face_colors_{source_};
    std::set<std::tuple<std::string, PlyRole, std::size_t>> used_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> faces_;  ///< material and texture
    LargestIndex largest_material_;
    LargestIndex largest_texture_;
    std::vector<std::optional<ModelColor>> colors_;  ///< of the materials of the file
    std::vector<std::string> names_;
};

}  // namespace

Model read_ply_properties(const InputText& source, PolygonMesh mesh, BesideFiles& files) {
    const bool is_text = read_ply_header(source).encoding == PlyEncoding::Ascii;
    const InputText body = is_text ? source : source.as_binary();
    return PlyPropertyReader(source, body, std::move(mesh), files).read();
}

}  // namespace trisect::detail
