// SPDX-License-Identifier: Apache-2.0
//
// Parsing a model part of 3MF (3MF Core Specification 1.3, Materials and Properties Extension, of
// the Production Extension the paths).
//
// What an element is depends on the element around it. Elements of other namespaces, and what is in
// them, are ignored, as the specification has it; those that must not be ignored are listed in
// `requiredextensions`, and refused there. Of a triangle's properties the first corner's counts.
// Textures and mixtures are no materials: their triangles have none; with properties
// (three_mf_looks.h) all of them count.
#include <trisect/brep/io/models/three_mf_part.h>

#include <trisect/brep/io/formats/mesh_builder.h>
#include <trisect/brep/io/models/three_mf_looks.h>
#include <trisect/brep/io/models/three_mf_names.h>
#include <trisect/brep/io/models/xml_reader.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <map>
#include <optional>

namespace trisect::detail {
namespace {

enum class Kind : std::uint8_t {
    Document,
    Ignored,
    Model,
    Resources,
    Build,
    BaseMaterials,
    ColorGroup,
    Texture,
    TextureGroup,
    Mixtures,
    Object,
    Mesh,
    Vertices,
    Triangles,
    Components,
    Leaf
};

Kind kind_of_core(Kind around, std::string_view name) {
    switch (around) {
        case Kind::Document:
            return name == "model" ? Kind::Model : Kind::Ignored;
        case Kind::Model:
            if (name == "resources") return Kind::Resources;
            return name == "build" ? Kind::Build : Kind::Ignored;
        case Kind::Resources:
            if (name == "object") return Kind::Object;
            return name == "basematerials" ? Kind::BaseMaterials : Kind::Ignored;
        case Kind::Object:
            if (name == "mesh") return Kind::Mesh;
            return name == "components" ? Kind::Components : Kind::Ignored;
        case Kind::Mesh:
            if (name == "vertices") return Kind::Vertices;
            return name == "triangles" ? Kind::Triangles : Kind::Ignored;
        case Kind::Vertices:
            return name == "vertex" ? Kind::Leaf : Kind::Ignored;
        case Kind::Triangles:
            return name == "triangle" ? Kind::Leaf : Kind::Ignored;
        case Kind::Components:
            return name == "component" ? Kind::Leaf : Kind::Ignored;
        case Kind::Build:
            return name == "item" ? Kind::Leaf : Kind::Ignored;
        case Kind::BaseMaterials:
            return name == "base" ? Kind::Leaf : Kind::Ignored;
        default:
            return Kind::Ignored;
    }
}

Kind kind_of_looks(Kind around, std::string_view name) {
    if (around == Kind::TextureGroup) return name == "tex2coord" ? Kind::Leaf : Kind::Ignored;
    if (around == Kind::Mixtures) return name == "multi" ? Kind::Leaf : Kind::Ignored;
    if (around != Kind::Resources) return Kind::Ignored;
    if (name == "texture2d") return Kind::Texture;
    if (name == "texture2dgroup") return Kind::TextureGroup;
    return name == "multiproperties" ? Kind::Mixtures : Kind::Ignored;
}

Kind kind_of(Kind around, const XmlElement& element, bool with_properties) {
    if (element.space == three_mf_core) return kind_of_core(around, element.name);
    if (element.space != three_mf_materials) return Kind::Ignored;
    if (with_properties) {
        const Kind kind = kind_of_looks(around, element.name);
        if (kind != Kind::Ignored) return kind;
    }
    if (around == Kind::Resources && element.name == "colorgroup") return Kind::ColorGroup;
    return around == Kind::ColorGroup && element.name == "color" ? Kind::Leaf : Kind::Ignored;
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// "#RRGGBB" or "#RRGGBBAA".
std::optional<ModelColor> color_of(std::string_view text) {
    const std::string_view word = trimmed_word(text);
    if ((word.size() != 7 && word.size() != 9) || word[0] != '#') return std::nullopt;
    ModelColor color{0, 0, 0, 255};
    for (std::size_t i = 0; 2 * i + 2 < word.size(); ++i) {
        const int high = hex_digit(word[2 * i + 1]);
        const int low = hex_digit(word[2 * i + 2]);
        if (high < 0 || low < 0) return std::nullopt;
        color[i] = static_cast<std::uint8_t>(16 * high + low);
    }
    return color;
}

class Parser final : public XmlHandler {
public:
    Parser(ThreeMfPart& part, bool with_properties) : part_(part), source_(part.source) {
        if (with_properties) looks_.emplace(part);
    }

    void declare(std::string_view prefix, std::string_view uri) override {
        prefixes_[std::string(prefix)] = uri;
    }

    void begin(const XmlElement& element) override {
        const Kind kind = kind_of(around_.back(), element, looks_.has_value());
        if (around_.back() == Kind::Document && kind != Kind::Model)
            source_.fail(element.at, "<" + std::string(element.name) + "> is no model of 3MF");
        if (kind == Kind::Leaf)
            leaf(element);
        else
            group(kind, element);
        around_.push_back(kind);
    }

    void end() override {
        const Kind kind = around_.back();
        around_.pop_back();
        if (kind == Kind::Mesh) end_mesh();
        if (kind == Kind::Object) end_object();
    }

private:
    /// The materials with one resource number: consecutive ones of the part.
    struct Group {
        std::size_t first = 0;
        std::size_t count = 0;
    };

    void group(Kind kind, const XmlElement& element) {
        if (kind == Kind::Model) begin_model(element);
        if (kind == Kind::Build) part_.has_build = true;
        if (kind == Kind::BaseMaterials || kind == Kind::ColorGroup) begin_materials(element);
        if (kind == Kind::TextureGroup || kind == Kind::Mixtures) begin_materials(element);
        if (kind == Kind::ColorGroup && looks_) looks_->begin_colors(group_);
        if (kind == Kind::Texture) looks_->add_texture(element);
        if (kind == Kind::TextureGroup) looks_->begin_coordinates(group_, element);
        if (kind == Kind::Mixtures) looks_->begin_mixtures(group_, element);
        if (kind == Kind::Object) begin_object(element);
        if (kind == Kind::Mesh) begin_mesh(element);
    }

    void leaf(const XmlElement& element) {
        switch (around_.back()) {
            case Kind::Vertices:
                return vertex(element);
            case Kind::Triangles:
                return triangle(element);
            case Kind::Components:
                object_.components.push_back(use(element));
                if (object_.has_mesh)
                    source_.fail(element.at, "an object with a mesh and components");
                return;
            case Kind::Build:
                part_.items.push_back(use(element));
                return;
            case Kind::BaseMaterials:
                return material(std::string(element.attribute("name").value_or("")),
                                element.attribute("displaycolor"), element);
            case Kind::TextureGroup:
                return looks_->add_coordinates(element);
            case Kind::Mixtures:
                return looks_->add_mixture(element);
            default:
                return colour(element);
        }
    }

    void begin_model(const XmlElement& element) {
        if (const auto unit = element.attribute("unit")) part_.unit = trimmed_word(*unit);
        std::string_view required = element.attribute("requiredextensions").value_or("");
        for (std::string_view p = take_word(required); !p.empty(); p = take_word(required)) {
            const auto found = prefixes_.find(std::string(p));
            if (found == prefixes_.end())
                source_.fail(element.at, "the prefix " + shown_word(p) + " is not declared");
            const std::string& uri = found->second;
            if (uri == three_mf_core || uri == three_mf_materials || uri == three_mf_production ||
                uri == three_mf_triangle_sets)
                continue;
            throw UnsupportedError(source_.place(element.at).to_string() +
                                   ": requires an extension that is not read: " + uri);
        }
    }

    void new_resource(std::uint64_t id, const XmlElement& element) {
        if (!resources_.emplace(id, Group{part_.materials.size(), 0}).second)
            source_.fail(element.at, "two resources with the number " + std::to_string(id));
    }
    std::uint64_t index(std::string_view word, const char* what, const XmlElement& element) const {
        return xml_count(source_, word, what, element.at);
    }

    void begin_materials(const XmlElement& element) {
        group_ = index(element.required(source_, "id"), "the number of a resource", element);
        new_resource(group_, element);
    }

    /// Of a group of colours: those of corners, or materials.
    void colour(const XmlElement& element) {
        const std::string_view text = element.required(source_, "color");
        const auto color = color_of(text);
        if (!color) source_.fail(element.at, shown_word(text) + ", read as a colour, is none");
        if (looks_)
            looks_->add_color(*color);
        else
            material({}, text, element);
    }

    void material(std::string name, std::optional<std::string_view> color,
                  const XmlElement& element) {
        ModelMaterial made{std::move(name), std::nullopt};
        if (color) made.color = color_of(*color);
        if (color && !made.color)
            source_.fail(element.at, shown_word(*color) + ", read as a colour, is none");
        part_.materials.push_back(std::move(made));
        ++resources_[group_].count;
    }

    void begin_object(const XmlElement& element) {
        object_ = ThreeMfObject();
        object_.at = element.at;
        object_.name = element.attribute("name").value_or("");
        const std::string_view type = trimmed_word(element.attribute("type").value_or("model"));
        object_.is_support = type == "support" || type == "solidsupport";
        if (!object_.is_support && type != "model" && type != "surface" && type != "other")
            source_.fail(element.at, "an object of the type " + shown_word(type));
        object_id_ = index(element.required(source_, "id"), "the number of a resource", element);
        new_resource(object_id_, element);
        object_group_ = element.attribute("pid")
                            ? std::optional(index(*element.attribute("pid"),
                                                  "the number of a resource", element))
                            : std::nullopt;
        object_index_ = element.attribute("pindex") ? index(*element.attribute("pindex"),
                                                            "the index of a property", element)
                                                    : 0;
    }

    void end_object() { part_.objects.emplace(object_id_, std::move(object_)); }

    void begin_mesh(const XmlElement& element) {
        if (object_.has_mesh) source_.fail(element.at, "an object with two meshes");
        if (!object_.components.empty())
            source_.fail(element.at, "an object with a mesh and components");
        object_.has_mesh = true;
        mesh_.emplace(source_, 0U);
    }

    void end_mesh() {
        object_.mesh = mesh_->finish();
        mesh_.reset();
        if (looks_) object_.properties = looks_->finish_mesh(object_.mesh.corners.size());
        const auto& m = object_.materials;
        if (std::all_of(m.begin(), m.end(), [](std::uint32_t i) { return i == no_material; }))
            object_.materials.clear();
    }

    double real(const XmlElement& element, std::string_view name, const char* what) const {
        return xml_real(source_, element.required(source_, name), what, element.at);
    }

    void vertex(const XmlElement& element) {
        const double x = real(element, "x", "the x coordinate of a vertex");
        const double y = real(element, "y", "the y coordinate of a vertex");
        const double z = real(element, "z", "the z coordinate of a vertex");
        mesh_->add_point({x, y, z}, element.at);
    }

    void triangle(const XmlElement& element) {
        for (const char* corner : {"v1", "v2", "v3"}) {
            mesh_->add_corner(index(element.required(source_, corner), "a vertex index", element),
                              element.at);
        }
        mesh_->end_face(element.at);
        std::optional<std::uint64_t> group = object_group_;
        std::uint64_t number = object_index_;
        if (const auto first = element.attribute("p1")) {
            number = index(*first, "the index of a property", element);
            if (const auto own = element.attribute("pid"))
                group = index(*own, "the number of a resource", element);
        }
        if (looks_)
            object_.materials.push_back(look(group, number, element));
        else
            object_.materials.push_back(material_index(group, number, element));
    }

    /// Collects what the corners have, and returns the material.
    std::uint32_t look(std::optional<std::uint64_t> group, std::uint64_t number,
                       const XmlElement& element) {
        if (!group) return no_material;
        std::array<std::uint64_t, 3> numbers{number, number, number};
        if (element.attribute("p1")) {
            if (const auto p2 = element.attribute("p2"))
                numbers[1] = index(*p2, "the index of a property", element);
            if (const auto p3 = element.attribute("p3"))
                numbers[2] = index(*p3, "the index of a property", element);
        }
        const auto base = [&](std::uint64_t id, std::uint64_t n) {
            return material_index(id, n, element);
        };
        return looks_->triangle(*group, numbers, 3 * object_.materials.size(), base, element);
    }

    std::uint32_t material_index(std::optional<std::uint64_t> group, std::uint64_t number,
                                 const XmlElement& element) const {
        if (!group) return no_material;
        const auto found = resources_.find(*group);
        if (found == resources_.end() || found->second.count == 0) return no_material;
        if (number >= found->second.count) {
            source_.fail(element.at, "property " + std::to_string(number) + " of resource " +
                                         std::to_string(*group) + ", which has " +
                                         std::to_string(found->second.count));
        }
        return static_cast<std::uint32_t>(found->second.first + number);
    }

    ThreeMfUse use(const XmlElement& element) const {
        ThreeMfUse out;
        out.at = element.at;
        out.object =
            index(element.required(source_, "objectid"), "the number of an object", element);
        out.path = element.attribute(three_mf_production, "path").value_or("");
        auto words = element.attribute("transform");
        if (!words) return out;
        // Twelve numbers of the matrix by which a row (x y z 1) is multiplied, row by row.
        for (std::size_t i = 0; i < 12; ++i) {
            const std::string_view word = take_word(*words);
            if (word.empty())
                source_.fail(element.at, "a transform with fewer than twelve numbers");
            out.rows[4 * (i % 3) + i / 3] = xml_real(source_, word, "a transform", element.at);
        }
        if (!take_word(*words).empty())
            source_.fail(element.at, "a transform with more than twelve numbers");
        return out;
    }

    ThreeMfPart& part_;
    const InputText& source_;
    std::vector<Kind> around_{Kind::Document};
    std::map<std::string, std::string> prefixes_;
    std::map<std::uint64_t, Group> resources_;
    std::uint64_t group_ = 0;
    ThreeMfObject object_;
    std::uint64_t object_id_ = 0;
    std::optional<std::uint64_t> object_group_;
    std::uint64_t object_index_ = 0;
    std::optional<MeshBuilder> mesh_;
    std::optional<ThreeMfLooks> looks_;  ///< with properties
};

}  // namespace

std::unique_ptr<ThreeMfPart> parse_three_mf_part(std::string text, const std::string& name,
                                                 const ReadLimits& limits, bool with_properties) {
    auto part = std::make_unique<ThreeMfPart>(std::move(text), name, limits);
    Parser parser(*part, with_properties);
    read_xml(part->source, parser);
    return part;
}

}  // namespace trisect::detail
