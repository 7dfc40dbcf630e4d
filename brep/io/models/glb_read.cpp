// SPDX-License-Identifier: Apache-2.0
//
// Reading GLB: glTF 2.0 (Khronos Group, glTF 2.0 Specification) in one binary file.
//
// glTF has a vertex for each combination of position, normal and texture, so a solid comes in
// pieces. A mesh with the extension EXT_mesh_manifold says how they hang together, and is read as
// that says; of others, vertices in one place become one, as in STL. Lines and points are ignored.
//
// The nodes of the scene are a tree: each is met once, so meshes are placed no more often than
// there are nodes.
#include <trisect/brep/io/models/models.h>

#include <trisect/brep/io/formats/vertex_welder.h>
#include <trisect/brep/io/models/glb_accessor.h>
#include <trisect/brep/io/models/glb_attributes.h>
#include <trisect/brep/io/models/glb_document.h>
#include <trisect/brep/io/models/glb_textures.h>
#include <trisect/brep/io/models/placement.h>
#include <trisect/brep/io/models/srgb.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace trisect::detail {
namespace {

constexpr std::uint64_t triangles_mode = 4;

/// Extensions that change how a mesh looks and not what it is.
bool is_of_looks_only(std::string_view extension) {
    for (const std::string_view start : {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                         "KHR_lights_", "EXT_lights_", "MSFT_texture_"})
        if (extension.starts_with(start)) return true;
    for (const std::string_view whole :
         {"EXT_mesh_manifold", "KHR_xmp_json_ld", "KHR_animation_pointer", "KHR_node_visibility"})
        if (extension == whole) return true;
    return false;
}

class GlbReader {
public:
    GlbReader(const InputText& source, const ReadOptions& options, ModelReport& report)
        : glb_(source),
          options_(options),
          files_(options, report.remarks),
          textures_(glb_, files_),
          report_(report) {}

    Model read() {
        check_extensions();
        read_materials();
        const auto roots = scene_nodes();
        const GlbValue user = glb_.root();
        for (const std::uint64_t node : roots) place_node(node, user, ExactAffine(), 1);
        model_.textures = textures_.take();
        return std::move(model_);
    }

private:
    struct MeshPart {
        PolygonMesh mesh;
        std::vector<std::uint32_t> materials;
        CornerProperties properties;
    };

    void check_extensions() const {
        for (const GlbValue& e : glb_.array(glb_.root(), "extensionsRequired")) {
            if (!e.json->is_string()) glb_.fail(e, "is no text");
            const auto name = e.json->get<std::string>();
            if (!is_of_looks_only(name))
                glb_.refuse(e,
                            "requires the extension " + shown_word(name) + ", which is not read");
        }
    }

    void read_materials() {
        for (const GlbValue& m : glb_.array(glb_.root(), "materials")) {
            if (!m.json->is_object()) glb_.fail(m, "is no object");
            ModelMaterial made{glb_.text(m, "name"), std::nullopt};
            if (const auto pbr = glb_.object(m, "pbrMetallicRoughness");
                pbr && glb_.has(*pbr, "baseColorFactor")) {
                const auto light = glb_.numbers(*pbr, "baseColorFactor", {1, 1, 1, 1});
                made.color = ModelColor{
                    srgb_of_light(light[0]), srgb_of_light(light[1]), srgb_of_light(light[2]),
                    static_cast<std::uint8_t>(std::lround(255 * std::clamp(light[3], 0.0, 1.0)))};
            }
            if (options_.properties) made.texture = textures_.of_material(m);
            model_.materials.push_back(std::move(made));
        }
    }

    std::vector<std::uint64_t> indices_of(const GlbValue& in, const char* name) const {
        std::vector<std::uint64_t> out;
        for (const GlbValue& v : glb_.array(in, name)) {
            if (!v.json->is_number_unsigned()) glb_.fail(v, "is no index");
            out.push_back(v.json->get<std::uint64_t>());
        }
        return out;
    }

    /// The roots of the scene that the file shows; without scenes, nodes that no
    /// node has.
    std::vector<std::uint64_t> scene_nodes() const {
        const GlbValue root = glb_.root();
        if (!glb_.array(root, "scenes").empty()) {
            const std::uint64_t number = glb_.count(root, "scene").value_or(0);
            return indices_of(glb_.at("scenes", number, root), "nodes");
        }
        const auto nodes = glb_.array(root, "nodes");
        std::set<std::uint64_t> children;
        for (const GlbValue& node : nodes) {
            if (!node.json->is_object()) glb_.fail(node, "is no object");
            for (const std::uint64_t child : indices_of(node, "children")) children.insert(child);
        }
        std::vector<std::uint64_t> out;
        for (std::uint64_t i = 0; i < nodes.size(); ++i)
            if (!children.contains(i)) out.push_back(i);
        return out;
    }

    ExactAffine placement_of(const GlbValue& node) const {
        if (!glb_.has(node, "matrix")) {
            const auto s = glb_.numbers(node, "scale", {1, 1, 1});
            const auto q = glb_.numbers(node, "rotation", {0, 0, 0, 1});
            const auto t = glb_.numbers(node, "translation", {0, 0, 0});
            if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0)
                glb_.fail(node, "a rotation by the quaternion 0");
            return ExactAffine::from_parts({s[0], s[1], s[2]}, {q[0], q[1], q[2], q[3]},
                                           {t[0], t[1], t[2]});
        }
        // Column by column.
        const auto m = glb_.numbers(node, "matrix", std::vector<double>(16));
        if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
            glb_.fail(node, "a matrix whose last row is not 0 0 0 1");
        std::array<double, 12> rows{};
        for (std::size_t i = 0; i < 12; ++i) rows[i] = m[4 * (i % 4) + i / 4];
        return ExactAffine::from_rows(rows);
    }

    void place_node(std::uint64_t index, const GlbValue& user, const ExactAffine& around,
                    std::uint64_t depth) {
        check_stop();
        const GlbValue node = glb_.at("nodes", index, user);
        if (!met_.insert(index).second) glb_.fail(node, "is met twice; nodes form a tree");
        if (depth > glb_.source().limits().nesting) {
            glb_.source().fail_limit(
                glb_.source().begin(),
                "nodes nest deeper than " + std::to_string(glb_.source().limits().nesting));
        }
        const ExactAffine placement = placement_of(node).then(around);
        if (const auto mesh = glb_.count(node, "mesh")) place_mesh(*mesh, node, placement);
        for (const std::uint64_t child : indices_of(node, "children"))
            place_node(child, node, placement, depth + 1);
    }

    void place_mesh(std::uint64_t index, const GlbValue& node, const ExactAffine& placement) {
        if (glb_.has(node, "skin")) glb_.refuse(node, "meshes with skins are not read");
        if (const auto extensions = glb_.object(node, "extensions");
            extensions && glb_.has(*extensions, "EXT_mesh_gpu_instancing"))
            glb_.refuse(node, "EXT_mesh_gpu_instancing is not read");
        if (placement.orientation() == 0) glb_.fail(node, "a transform that makes space flat");
        const GlbValue value = glb_.at("meshes", index, node);
        refuse_morphs(value, node);
        const MeshPart& mesh = mesh_part(index, value);
        if (mesh.mesh.corners.empty()) return;
        vertices_ += mesh.mesh.points.size();
        faces_ += mesh.mesh.face_count();
        const ReadLimits& limits = glb_.source().limits();
        if (vertices_ > limits.vertices || faces_ > limits.faces ||
            model_.parts.size() >= limits.instances)
            glb_.source().fail_limit(glb_.source().begin(),
                                     "nodes place more meshes than the limits "
                                     "for a file allow");
        ModelPart part;
        part.name = glb_.text(node, "name");
        if (part.name.empty()) part.name = glb_.text(value, "name");
        add_placed(part, mesh.mesh, placement, report_);
        part.materials = mesh.materials;
        numbers_ += mesh.properties.values.size();
        if (numbers_ > limits.property_numbers)
            glb_.source().fail_limit(glb_.source().begin(),
                                     "nodes place more numbers at corners than the limits for a "
                                     "file allow");
        part.properties = placed_properties(mesh.properties, mesh.mesh, placement);
        model_.parts.push_back(std::move(part));
    }

    void refuse_morphs(const GlbValue& mesh, const GlbValue& node) const {
        for (const GlbValue* owner : {&mesh, &node}) {
            for (const GlbValue& weight : glb_.array(*owner, "weights")) {
                if (!weight.json->is_number()) glb_.fail(weight, "is no number");
                if (weight.json->get<double>() != 0) glb_.refuse(weight, "morphs are not read");
            }
        }
    }

    const MeshPart& mesh_part(std::uint64_t index, const GlbValue& value) {
        const auto [known, is_new] = meshes_.try_emplace(index);
        if (!is_new) return known->second;
        MeshPart& part = known->second;
        const auto extensions = glb_.object(value, "extensions");
        const auto manifold =
            extensions ? glb_.object(*extensions, "EXT_mesh_manifold") : std::nullopt;
        PropertyCollector properties(glb_.source());
        if (manifold)
            read_manifold(value, *manifold, part, properties);
        else
            read_primitives(value, part, properties);
        part.properties = properties.finish(part.mesh.corners.size());
        if (std::all_of(part.materials.begin(), part.materials.end(),
                        [](std::uint32_t m) { return m == no_material; }))
            part.materials.clear();
        return part;
    }

    std::uint32_t material_of(const GlbValue& primitive) const {
        const auto material = glb_.count(primitive, "material");
        if (!material) return no_material;
        if (*material >= model_.materials.size())
            glb_.fail(primitive, "there is no materials[" + std::to_string(*material) + "]");
        return static_cast<std::uint32_t>(*material);
    }

    /// False for lines and points.
    bool has_triangles(const GlbValue& primitive) const {
        if (!primitive.json->is_object()) glb_.fail(primitive, "is no object");
        const std::uint64_t mode = glb_.count(primitive, "mode").value_or(triangles_mode);
        if (mode > 6) glb_.fail(primitive, "has the mode " + std::to_string(mode));
        if (mode > triangles_mode)
            glb_.refuse(primitive, "strips and fans of triangles are not read");
        return mode == triangles_mode;
    }

    /// The accessor of positions; nothing where a primitive has none.
    std::optional<GlbAccessor> positions_of(const GlbValue& primitive) const {
        const auto attributes = glb_.object(primitive, "attributes");
        if (!attributes) glb_.fail(primitive, "has no attributes");
        const auto index = glb_.count(*attributes, "POSITION");
        if (!index) return std::nullopt;
        const GlbValue accessor = glb_.at("accessors", *index, primitive);
        if (const auto extensions = glb_.object(primitive, "extensions");
            extensions && glb_.has(*extensions, "KHR_draco_mesh_compression") &&
            !glb_.has(accessor, "bufferView"))
            glb_.refuse(primitive, "KHR_draco_mesh_compression is not read");
        return glb_accessor(glb_, *index, primitive, "VEC3");
    }

    void check_corners(std::uint64_t more, const GlbValue& user) {
        corners_ += more;
        if (more % 3 != 0) glb_.fail(user, "a number of indices that no triangles have");
        if (corners_ / 3 > glb_.source().limits().faces) {
            glb_.source().fail_limit(glb_.source().begin(),
                                     "more than " + std::to_string(glb_.source().limits().faces) +
                                         " faces, the limit for a file");
        }
    }

    /// Points of an accessor; shared by primitives that share it.
    const std::vector<Point3d>& points_of(const GlbAccessor& accessor) {
        const auto [known, is_new] = points_.try_emplace(accessor.data);
        if (is_new || known->second.size() != accessor.count)
            known->second = glb_points(glb_, accessor);
        return known->second;
    }

    /// What the vertices of a primitive have; nothing where it is not asked for.
    std::optional<GlbAttributes> attributes_of(const GlbValue& primitive,
                                               std::uint64_t vertices) const {
        if (!options_.properties) return std::nullopt;
        const std::uint32_t material = material_of(primitive);
        return GlbAttributes(glb_, primitive, vertices, textures_.set_of_material(material));
    }

    void read_primitives(const GlbValue& mesh, MeshPart& part, PropertyCollector& properties) {
        VertexWelder welder(part.mesh.points, 0);
        for (const GlbValue& primitive : glb_.array(mesh, "primitives")) {
            if (!has_triangles(primitive)) continue;
            const auto positions = positions_of(primitive);
            if (!positions || positions->count == 0) continue;
            const std::vector<Point3d>& points = points_of(*positions);
            const std::vector<std::uint32_t> indices = corners_of(primitive, points.size());
            const std::uint32_t material = material_of(primitive);
            const auto attributes = attributes_of(primitive, points.size());
            std::array<std::uint32_t, 3> t{};
            for (std::size_t i = 0; i < indices.size(); ++i) {
                check_stop();
                if (indices[i] >= points.size())
                    glb_.fail(primitive, "there is no vertex " + std::to_string(indices[i]));
                if (attributes)
                    attributes->collect(indices[i], part.mesh.corners.size() + i % 3, properties);
                t[i % 3] = welder.vertex(points[indices[i]]);
                if (i % 3 != 2) continue;
                part.mesh.add_face(t);
                part.materials.push_back(material);
            }
        }
    }

    std::vector<std::uint32_t> corners_of(const GlbValue& primitive, std::size_t points) {
        if (const auto index = glb_.count(primitive, "indices")) {
            const GlbAccessor accessor = glb_accessor(glb_, *index, primitive, "SCALAR");
            check_corners(accessor.count, primitive);
            return glb_indices(glb_, accessor);
        }
        check_corners(points, primitive);
        std::vector<std::uint32_t> out(points);
        for (std::size_t i = 0; i < points; ++i) out[i] = static_cast<std::uint32_t>(i);
        return out;
    }

    /// One mesh as the extension gives it; its primitives say which triangles have which material.
    void read_manifold(const GlbValue& mesh, const GlbValue& manifold, MeshPart& part,
                       PropertyCollector& properties) {
        const auto primitive = glb_.object(manifold, "manifoldPrimitive");
        if (!primitive) glb_.fail(manifold, "has no manifoldPrimitive");
        if (!has_triangles(*primitive)) glb_.fail(*primitive, "has no triangles");
        const auto positions = positions_of(*primitive);
        if (!positions) glb_.fail(*primitive, "has no positions");
        const GlbAccessor accessor = glb_accessor(glb_, glb_.required_count(*primitive, "indices"),
                                                  *primitive, "SCALAR", true);
        check_corners(accessor.count, *primitive);
        std::vector<std::uint32_t> indices = glb_indices(glb_, accessor);
        const std::vector<std::uint32_t> unmerged =
            options_.properties ? indices : std::vector<std::uint32_t>();
        merge(manifold, indices);
        part.mesh.points = glb_points(glb_, *positions);
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            check_stop();
            for (std::size_t k = 0; k < 3; ++k) {
                if (indices[i + k] >= part.mesh.points.size())
                    glb_.fail(*primitive, "there is no vertex " + std::to_string(indices[i + k]));
            }
            part.mesh.add_triangle(indices[i], indices[i + 1], indices[i + 2]);
        }
        part.materials.assign(part.mesh.face_count(), no_material);
        for (const GlbValue& p : glb_.array(mesh, "primitives"))
            color_range(p, accessor, part, unmerged, properties);
    }

    void merge(const GlbValue& manifold, std::vector<std::uint32_t>& indices) {
        const auto where = glb_.count(manifold, "mergeIndices");
        const auto what = glb_.count(manifold, "mergeValues");
        if (where.has_value() != what.has_value())
            glb_.fail(manifold, "has one of mergeIndices and mergeValues");
        if (!where) return;
        const auto places = glb_indices(glb_, glb_accessor(glb_, *where, manifold, "SCALAR"));
        const auto values = glb_indices(glb_, glb_accessor(glb_, *what, manifold, "SCALAR"));
        if (places.size() != values.size())
            glb_.fail(manifold, "as many places as values to merge");
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (places[i] >= indices.size())
                glb_.fail(manifold, "merges an index that is not there");
            indices[places[i]] = values[i];
        }
    }

    /// Gives the triangles of a primitive its material and the properties of its vertices; they are
    /// a part of the same view.
    void color_range(const GlbValue& primitive, const GlbAccessor& all, MeshPart& part,
                     const std::vector<std::uint32_t>& unmerged,
                     PropertyCollector& properties) const {
        if (!has_triangles(primitive)) glb_.fail(primitive, "is not of triangles");
        const std::uint32_t material = material_of(primitive);
        if (material == no_material && !options_.properties) return;
        const GlbAccessor own =
            glb_accessor(glb_, glb_.required_count(primitive, "indices"), primitive, "SCALAR");
        const std::uint64_t size = 3 * all.stride;
        if (own.view != all.view || own.stride != all.stride || own.offset < all.offset ||
            (own.offset - all.offset) % size != 0)
            glb_.fail(primitive, "its indices are no part of the manifold's");
        const std::uint64_t first = (own.offset - all.offset) / size;
        const std::uint64_t count = own.count / 3;
        if (first > part.materials.size() || count > part.materials.size() - first)
            glb_.fail(primitive, "its indices are no part of the manifold's");
        std::fill_n(part.materials.begin() + static_cast<std::ptrdiff_t>(first), count, material);
        const auto positions = options_.properties ? positions_of(primitive) : std::nullopt;
        if (!positions) return;
        const auto attributes = attributes_of(primitive, positions->count);
        for (std::uint64_t i = 3 * first; i < 3 * (first + count); ++i) {
            if (unmerged[i] >= positions->count)
                glb_.fail(primitive, "there is no vertex " + std::to_string(unmerged[i]));
            attributes->collect(unmerged[i], i, properties);
        }
    }

    GlbDocument glb_;
    const ReadOptions& options_;
    BesideFiles files_;
    GlbTextures textures_;
    ModelReport& report_;
    Model model_;
    std::set<std::uint64_t> met_;
    std::map<std::uint64_t, MeshPart> meshes_;
    std::map<const char*, std::vector<Point3d>> points_;
    std::uint64_t corners_ = 0;
    std::uint64_t vertices_ = 0;
    std::uint64_t faces_ = 0;
    std::uint64_t numbers_ = 0;
};

}  // namespace

Model read_glb(std::string_view data, const std::string& name, const ReadOptions& options,
               ModelReport& report) {
    const InputText source(data, name, options.limits, true);
    return GlbReader(source, options, report).read();
}

}  // namespace trisect::detail
