// SPDX-License-Identifier: Apache-2.0
//
// Writing GLB. Each part is a node with a mesh; all primitives of a mesh share one array of
// positions and are stretches of one array of indices, as EXT_mesh_manifold wants it. Colours are
// diffuse: a solid is no mirror.
#include <trisect/brep/io/models/models.h>

#include <trisect/brep/io/formats/binary.h>
#include <trisect/brep/io/formats/float_points.h>
#include <trisect/brep/io/models/srgb.h>
#include <trisect/kernel/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

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
        json_["materials"].push_back(std::move(made));
    }

    std::size_t add_view(std::size_t offset, int target) {
        json_["bufferViews"].push_back({{"buffer", 0},
                                        {"byteOffset", offset},
                                        {"byteLength", binary_.size() - offset},
                                        {"target", target}});
        return json_["bufferViews"].size() - 1;
    }

    std::size_t add_accessor(OrderedJson accessor) {
        json_["accessors"].push_back(std::move(accessor));
        return json_["accessors"].size() - 1;
    }

    std::size_t add_positions(const PolygonMesh& mesh) {
        const std::vector<FloatPoint> points = float_points(mesh, name_, "GLB", out_.report);
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

    std::size_t add_indices(std::size_t view, std::size_t first, std::size_t count) {
        return add_accessor({{"bufferView", view},
                             {"byteOffset", 12 * first},
                             {"componentType", word_component},
                             {"count", 3 * count},
                             {"type", "SCALAR"}});
    }

    void add_part(const ModelPart& part) {
        const auto material = [&](std::size_t f) {
            return part.materials.empty() ? no_material : part.materials[f];
        };
        std::vector<std::size_t> order(part.mesh.face_count());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return material(a) < material(b); });
        const std::size_t positions = add_positions(part.mesh);
        const std::size_t offset = binary_.size();
        for (const std::size_t f : order)
            for (const std::uint32_t corner : part.mesh.face(f)) store(binary_, corner, false);
        const std::size_t view = add_view(offset, index_target);
        OrderedJson mesh;
        if (!part.name.empty()) mesh["name"] = part.name;
        mesh["primitives"] = OrderedJson::array();
        for (std::size_t first = 0; first < order.size();) {
            const std::uint32_t m = material(order[first]);
            std::size_t last = first;
            while (last < order.size() && material(order[last]) == m) ++last;
            OrderedJson primitive = primitive_of(positions, add_indices(view, first, last - first));
            if (m != no_material) primitive["material"] = m;
            mesh["primitives"].push_back(std::move(primitive));
            first = last;
        }
        if (is_two_manifold(part.mesh)) {
            const std::size_t all = mesh["primitives"].size() == 1
                                        ? mesh["primitives"][0]["indices"].get<std::size_t>()
                                        : add_indices(view, 0, order.size());
            mesh["extensions"]["EXT_mesh_manifold"]["manifoldPrimitive"] =
                primitive_of(positions, all);
            uses_manifold_ = true;
        }
        add_node(part, std::move(mesh));
    }

    static OrderedJson primitive_of(std::size_t positions, std::size_t indices) {
        return {{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"mode", 4}};
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
