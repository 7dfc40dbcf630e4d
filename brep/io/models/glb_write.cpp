// SPDX-License-Identifier: Apache-2.0
//
// Writing GLB. Each part is a node with a mesh; all primitives of a mesh share one array of
// positions and are stretches of one array of indices, as EXT_mesh_manifold wants it. Colours are
// diffuse: a solid is no mirror. With properties there are more vertices than places; the extension
// then says by merged indices which are one.
#include <trisect/brep/io/models/models.h>

#include <trisect/brep/io/formats/binary.h>
#include <trisect/brep/io/formats/float_points.h>
#include <trisect/brep/io/models/glb_write_vertices.h>
#include <trisect/brep/io/models/srgb.h>
#include <trisect/brep/io/properties/picture_files.h>
#include <trisect/kernel/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

namespace trisect::detail {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int vertex_target = 34962;
constexpr int index_target = 34963;
constexpr int float_component = 5126;
constexpr int word_component = 5125;

/// Text that JSON takes: what is no UTF-8 is replaced.
std::string json_text(const OrderedJson& json) {
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Every halfedge has exactly one opposite one.
bool is_two_manifold(const PolygonMesh& mesh) {
    std::vector<std::pair<std::uint64_t, bool>> edges;
    edges.reserve(mesh.corners.size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::uint64_t a = face[i];
            const std::uint64_t b = face[(i + 1) % face.size()];
            edges.emplace_back((std::min(a, b) << 32) | std::max(a, b), a < b);
        }
    }
    if (edges.size() % 2 != 0) return false;
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        const bool is_pair =
            edges[i].first == edges[i + 1].first && edges[i].second != edges[i + 1].second;
        const bool is_more = i + 2 < edges.size() && edges[i + 2].first == edges[i].first;
        if (!is_pair || is_more) return false;
    }
    return true;
}

class GlbWriter {
public:
    GlbWriter(const Model& model, const std::string& name) : model_(model), name_(name) {}

    FormattedMesh write() {
        json_["asset"] = {{"version", "2.0"}, {"generator", "Trisect"}};
        json_["scene"] = 0;
        json_["scenes"] = OrderedJson::array({OrderedJson::object()});
        for (const ModelPart& part : model_.parts)
            if (part.mesh.face_count() != 0) add_part(part);
        for (const ModelMaterial& m : model_.materials) add_material(m);
        for (const ModelTexture& t : model_.textures) add_texture(t);
        if (uses_manifold_) json_["extensionsUsed"] = {"EXT_mesh_manifold"};
        if (!binary_.empty()) json_["buffers"] = {{{"byteLength", binary_.size()}}};
        join();
        return std::move(out_);
    }

private:
    void add_material(const ModelMaterial& m) {
        OrderedJson made = OrderedJson::object();
        if (!m.name.empty()) made["name"] = m.name;
        made["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", 0.6}};
        if (m.color) {
            const ModelColor& c = *m.color;
            made["pbrMetallicRoughness"]["baseColorFactor"] = {
                light_of_srgb(c[0]), light_of_srgb(c[1]), light_of_srgb(c[2]), c[3] / 255.0};
            if (c[3] != 255) made["alphaMode"] = "BLEND";
        }
        if (m.texture != no_texture)
            made["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", m.texture}};
        json_["materials"].push_back(std::move(made));
    }

    static int number_of(TextureWrap wrap) {
        if (wrap == TextureWrap::Clamp) return 33071;
        return wrap == TextureWrap::Mirror ? 33648 : 10497;
    }

    /// Each picture has an image and a sampler of its number.
    void add_texture(const ModelTexture& t) {
        const std::size_t number = json_["images"].size();
        const std::string type =
            t.media_type.empty() ? media_type_of(t.bytes, t.file) : t.media_type;
        OrderedJson image = OrderedJson::object();
        if (t.bytes.empty()) {
            image["uri"] = t.file.empty() ? "none" : t.file;
        } else {
            const std::size_t offset = binary_.size();
            binary_ += t.bytes;
            image["bufferView"] = add_view(offset, 0);
            image["mimeType"] = type.empty() ? "image/png" : type;
            binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
        }
        json_["images"].push_back(std::move(image));
        json_["samplers"].push_back({{"magFilter", 9729},
                                     {"minFilter", 9987},
                                     {"wrapS", number_of(t.wrap[0])},
                                     {"wrapT", number_of(t.wrap[1])}});
        json_["textures"].push_back({{"sampler", number}, {"source", number}});
    }

    /// Target 0 is none.
    std::size_t add_view(std::size_t offset, int target) {
        OrderedJson view = {
            {"buffer", 0}, {"byteOffset", offset}, {"byteLength", binary_.size() - offset}};
        if (target != 0) view["target"] = target;
        json_["bufferViews"].push_back(std::move(view));
        return json_["bufferViews"].size() - 1;
    }

    std::size_t add_accessor(OrderedJson accessor) {
        json_["accessors"].push_back(std::move(accessor));
        return json_["accessors"].size() - 1;
    }

    std::size_t add_positions(const PolygonMesh& mesh, const GlbVertices& vertices) {
        const std::vector<FloatPoint> places = float_points(mesh, name_, "GLB", out_.report);
        std::vector<FloatPoint> points;
        points.reserve(vertices.place.size());
        for (const std::uint32_t v : vertices.place) points.push_back(places[v]);
        const std::size_t offset = binary_.size();
        FloatPoint low = points.front();
        FloatPoint high = low;
        for (const FloatPoint& p : points) {
            for (std::size_t k = 0; k < 3; ++k) {
                store(binary_, p[k], false);
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        }
        return add_accessor({{"bufferView", add_view(offset, vertex_target)},
                             {"componentType", float_component},
                             {"count", points.size()},
                             {"type", "VEC3"},
                             {"min", low},
                             {"max", high}});
    }

    /// Numbers of all vertices; nothing where none has any.
    std::optional<std::size_t> add_numbers(const std::vector<float>& numbers, std::size_t width) {
        if (numbers.empty()) return std::nullopt;
        const std::size_t offset = binary_.size();
        for (const float number : numbers) store(binary_, number, false);
        return add_accessor({{"bufferView", add_view(offset, vertex_target)},
                             {"componentType", float_component},
                             {"count", numbers.size() / width},
                             {"type", "VEC" + std::to_string(width)}});
    }

    std::size_t add_words(const std::vector<std::uint32_t>& words) {
        const std::size_t offset = binary_.size();
        for (const std::uint32_t word : words) store(binary_, word, false);
        return add_view(offset, 0);
    }

    std::size_t add_indices(std::size_t view, std::size_t first, std::size_t count) {
        return add_accessor({{"bufferView", view},
                             {"byteOffset", 12 * first},
                             {"componentType", word_component},
                             {"count", 3 * count},
                             {"type", "SCALAR"}});
    }

    /// The arrays of a part in the file.
    struct PartArrays {
        std::size_t positions = 0;
        std::optional<std::size_t> uv;
        std::optional<std::size_t> normal;
        std::optional<std::size_t> color;
        std::size_t indices = 0;  ///< view

        [[nodiscard]] OrderedJson primitive(unsigned kinds, std::size_t accessor) const {
            OrderedJson attributes = {{"POSITION", positions}};
            if ((kinds & GlbVertices::has_normal) != 0) attributes["NORMAL"] = *normal;
            if ((kinds & GlbVertices::has_uv) != 0) attributes["TEXCOORD_0"] = *uv;
            if ((kinds & GlbVertices::has_color) != 0) attributes["COLOR_0"] = *color;
            return {{"attributes", attributes}, {"indices", accessor}, {"mode", 4}};
        }
    };

    void add_part(const ModelPart& part) {
        const GlbVertices vertices = glb_vertices(part, name_);
        // Stretches of one material whose corners have the same kinds of numbers.
        const auto kind = [&](std::size_t f) {
            return std::pair(part.materials.empty() ? no_material : part.materials[f],
                             unsigned{vertices.kinds[f]});
        };
        std::vector<std::size_t> order(part.mesh.face_count());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return kind(a) < kind(b); });
        PartArrays arrays;
        arrays.positions = add_positions(part.mesh, vertices);
        arrays.uv = add_numbers(vertices.uv, 2);
        arrays.normal = add_numbers(vertices.normal, 3);
        arrays.color = add_numbers(vertices.color, 4);
        std::vector<std::uint32_t> corners;
        corners.reserve(part.mesh.corners.size());
        for (const std::size_t f : order)
            for (std::size_t c = part.mesh.face_begin[f]; c < part.mesh.face_begin[f + 1]; ++c)
                corners.push_back(vertices.corner[c]);
        const std::size_t offset = binary_.size();
        for (const std::uint32_t corner : corners) store(binary_, corner, false);
        arrays.indices = add_view(offset, index_target);
        OrderedJson mesh;
        if (!part.name.empty()) mesh["name"] = part.name;
        mesh["primitives"] = OrderedJson::array();
        for (std::size_t first = 0; first < order.size();) {
            const auto [m, kinds] = kind(order[first]);
            std::size_t last = first;
            while (last < order.size() && kind(order[last]) == std::pair(m, kinds)) ++last;
            OrderedJson primitive =
                arrays.primitive(kinds, add_indices(arrays.indices, first, last - first));
            if (m != no_material) primitive["material"] = m;
            mesh["primitives"].push_back(std::move(primitive));
            first = last;
        }
        if (is_two_manifold(part.mesh)) add_manifold(mesh, arrays, vertices, corners);
        add_node(part, std::move(mesh));
    }

    /// All triangles, with the indices that make vertices in one place one.
    void add_manifold(OrderedJson& mesh, const PartArrays& arrays, const GlbVertices& vertices,
                      const std::vector<std::uint32_t>& corners) {
        std::vector<std::uint32_t> where;
        std::vector<std::uint32_t> what;
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            const std::uint32_t first = vertices.first[corners[i]];
            if (first == corners[i]) continue;
            where.push_back(i);
            what.push_back(first);
        }
        const bool is_single = where.empty() && mesh["primitives"].size() == 1;
        const std::size_t all = is_single ? mesh["primitives"][0]["indices"].get<std::size_t>()
                                          : add_indices(arrays.indices, 0, corners.size() / 3);
        OrderedJson& manifold = mesh["extensions"]["EXT_mesh_manifold"];
        manifold["manifoldPrimitive"] = arrays.primitive(0, all);
        uses_manifold_ = true;
        if (where.empty()) return;
        const std::size_t where_view = add_words(where);
        const std::size_t what_view = add_words(what);
        json_["accessors"][all]["sparse"] = {
            {"count", where.size()},
            {"indices", {{"bufferView", where_view}, {"componentType", word_component}}},
            {"values", {{"bufferView", what_view}}}};
        manifold["mergeIndices"] = add_accessor({{"bufferView", where_view},
                                                 {"componentType", word_component},
                                                 {"count", where.size()},
                                                 {"type", "SCALAR"}});
        manifold["mergeValues"] = add_accessor({{"bufferView", what_view},
                                                {"componentType", word_component},
                                                {"count", where.size()},
                                                {"type", "SCALAR"}});
    }

    void add_node(const ModelPart& part, OrderedJson mesh) {
        json_["meshes"].push_back(std::move(mesh));
        OrderedJson node;
        if (!part.name.empty()) node["name"] = part.name;
        node["mesh"] = json_["meshes"].size() - 1;
        json_["nodes"].push_back(std::move(node));
        json_["scenes"][0]["nodes"].push_back(json_["nodes"].size() - 1);
    }

    void join() {
        std::string text = json_text(json_);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::size_t size = 20 + text.size() + (binary_.empty() ? 0 : 8 + binary_.size());
        if (size > std::numeric_limits<std::uint32_t>::max())
            throw LimitError(name_ + ": cannot write: a GLB file has at most 4 GiB");
        std::string& out = out_.bytes;
        out.reserve(size);
        out += "glTF";
        store(out, std::uint32_t{2}, false);
        store(out, static_cast<std::uint32_t>(size), false);
        store(out, static_cast<std::uint32_t>(text.size()), false);
        out += "JSON";
        out += text;
        if (binary_.empty()) return;
        store(out, static_cast<std::uint32_t>(binary_.size()), false);
        out.append("BIN\0", 4);
        out += binary_;
    }

    const Model& model_;
    const std::string& name_;
    FormattedMesh out_;
    OrderedJson json_;
    std::string binary_;
    bool uses_manifold_ = false;
};

}  // namespace

FormattedMesh write_glb(const Model& model, const std::string& name) {
    return GlbWriter(model, name).write();
}

}  // namespace trisect::detail
