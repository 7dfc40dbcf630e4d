// SPDX-License-Identifier: Apache-2.0
//
// Putting a 3MF package together: from the relationship that names the model part, over the items
// of its build and their components, to meshes in place.
//
// Components form a graph. It is walked twice: first what each object amounts to is counted, object
// by object, so that a small file that means an endless model is refused before anything of it is
// made; cycles and depth are found on that walk.
#include <trisect/brep/io/models/models.h>

#include <trisect/brep/io/models/placement.h>
#include <trisect/brep/io/models/three_mf_names.h>
#include <trisect/brep/io/models/three_mf_part.h>
#include <trisect/brep/io/models/xml_reader.h>
#include <trisect/brep/io/models/zip_archive.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <map>
#include <memory>

namespace trisect::detail {
namespace {

/// The name of an entry for a path such as "/3D/3dmodel.model". Paths that leave the package or
/// mean another one in a roundabout way are refused.
std::string entry_of(std::string_view path, const InputText& source, const char* at) {
    if (path.starts_with('/')) path.remove_prefix(1);
    const std::string slashed = "/" + std::string(path) + "/";
    for (const char* bad : {"/../", "/./", "//", "\\", ":"}) {
        if (slashed.find(bad) != std::string::npos)
            source.fail(at, shown_word(path) + ", read as a path in the package, is refused");
    }
    return std::string(path);
}

/// Finds the target of the relationship to the model.
class Relations final : public XmlHandler {
public:
    explicit Relations(const InputText& source) : source_(source) {}
    void begin(const XmlElement& element) override {
        if (element.name != "Relationship" || element.space != package_relations) return;
        if (trimmed_word(element.attribute("Type").value_or("")) != three_mf_model_relation) return;
        if (!model.empty()) source_.fail(element.at, "a package with two models");
        if (element.attribute("TargetMode").value_or("") == "External")
            source_.fail(element.at, "the model is outside the package, which is refused");
        model = entry_of(trimmed_word(element.required(source_, "Target")), source_, element.at);
    }
    void end() override {}

    std::string model;

private:
    const InputText& source_;
};

std::string model_entry(ZipArchive& archive, const std::string& name, const ReadLimits& limits) {
    const std::string entry = "_rels/.rels";
    const auto text = archive.read(entry);
    if (!text) {
        throw InputError(FilePlace{name, 0, 0, 0},
                         "no package of 3MF: there is no entry _rels/.rels");
    }
    const InputText source(*text, archive.name_of(entry), limits, false);
    Relations relations(source);
    read_xml(source, relations);
    if (relations.model.empty()) source.fail(source.end(), "the package names no model of 3MF");
    return relations.model;
}

/// What an object amounts to with all its components; sums stop at the largest number.
struct Extent {
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
    std::uint64_t instances = 1;
    std::uint64_t height = 1;  ///< how deep components nest, itself included
    bool is_done = false;      ///< false while its components are looked at
};

void add_up(std::uint64_t& sum, std::uint64_t more) {
    sum = more > UINT64_MAX - sum ? UINT64_MAX : sum + more;
}

class Package {
public:
    Package(std::string_view data, const std::string& name, const ReadOptions& options,
            ModelReport& report)
        : name_(name),
          limits_(options.limits),
          with_properties_(options.properties),
          archive_(data, name, options.limits),
          report_(report) {}

    Model read() {
        const std::string entry = model_entry(archive_, name_, limits_);
        const Loaded& root = part(entry, nullptr, nullptr);
        const InputText& source = root.part->source;
        if (!root.part->has_build) source.fail(source.end(), "a model without a build");
        for (const ThreeMfUse& item : root.part->items) count_item(root, item);
        Model model;
        model.unit = root.part->unit;
        for (const ThreeMfUse& item : root.part->items) {
            const Target target = target_of(root, item);
            if (target.object->is_support) continue;
            ModelPart made;
            made.name = target.object->name;
            pieces_.clear();
            place(target, placement_of(root, item), made);
            made.properties = joined_pieces();
            if (std::all_of(made.materials.begin(), made.materials.end(),
                            [](std::uint32_t m) { return m == no_material; }))
                made.materials.clear();
            model.parts.push_back(std::move(made));
        }
        model.materials = std::move(materials_);
        model.textures = std::move(textures_);
        return model;
    }

private:
    struct Loaded {
        std::unique_ptr<ThreeMfPart> part;
        std::uint32_t first_material = 0;  ///< its materials follow those of parts before it
        std::size_t first_texture = 0;
    };
    struct Target {
        const Loaded* loaded;
        const ThreeMfObject* object;
    };

    /// A part of the package; read when first asked for, by the use at `at` if there is one.
    const Loaded& part(const std::string& entry, const InputText* user, const char* at) {
        const auto found = parts_.find(entry);
        if (found != parts_.end()) return found->second;
        auto text = archive_.read(entry);
        if (!text) {
            const std::string message = "there is no entry " + shown_word(entry);
            if (user != nullptr) user->fail(at, message);
            throw InputError(FilePlace{name_, 0, 0, 0}, message);
        }
        Loaded& made = parts_[entry];
        made.part = parse_three_mf_part(std::move(*text), archive_.name_of(entry), limits_,
                                        with_properties_);
        read_textures(*made.part, made.first_texture = textures_.size());
        made.first_material = static_cast<std::uint32_t>(materials_.size());
        for (ModelMaterial material : made.part->materials) {
            if (material.texture != no_texture)
                material.texture += static_cast<std::uint32_t>(made.first_texture);
            materials_.push_back(std::move(material));
        }
        return made;
    }

    void read_textures(const ThreeMfPart& part, std::size_t first) {
        textures_.reserve(first + part.textures.size());
        for (const ThreeMfTexture& texture : part.textures) {
            textures_.push_back(texture.texture);
            auto bytes = archive_.read(entry_of(texture.path, part.source, texture.at));
            if (!bytes)
                part.source.fail(texture.at, "there is no entry " + shown_word(texture.path));
            textures_.back().bytes = *std::move(bytes);
        }
    }

    CornerProperties joined_pieces() const {
        std::vector<PropertyPiece> all;
        for (const auto& [properties, corners] : pieces_) all.push_back({&properties, corners});
        return joined_properties(all);
    }

    Target target_of(const Loaded& from, const ThreeMfUse& use) {
        const InputText& source = from.part->source;
        const Loaded& in =
            use.path.empty() ? from : part(entry_of(use.path, source, use.at), &source, use.at);
        const auto object = in.part->objects.find(use.object);
        if (object == in.part->objects.end())
            source.fail(use.at, "there is no object " + std::to_string(use.object));
        if (from.part->unit != in.part->unit)
            source.fail(use.at, "parts of one model in different units");
        return {&in, &object->second};
    }

    static ExactAffine placement_of(const Loaded& from, const ThreeMfUse& use) {
        ExactAffine placement = ExactAffine::from_rows(use.rows);
        if (placement.orientation() == 0)
            from.part->source.fail(use.at, "a transform that makes space flat");
        return placement;
    }

    void count_item(const Loaded& root, const ThreeMfUse& item) {
        const Extent extent = count(root, item, 0);
        add_up(total_.vertices, extent.vertices);
        add_up(total_.faces, extent.faces);
        add_up(total_.instances, extent.instances);
        const auto check = [&](std::uint64_t n, std::uint64_t limit, const char* what) {
            if (n > limit) {
                root.part->source.fail_limit(item.at, "components amount to more than " +
                                                          std::to_string(limit) + " " + what);
            }
        };
        check(total_.vertices, limits_.vertices, "vertices, the limit for a file");
        check(total_.faces, limits_.faces, "faces, the limit for a file");
        check(total_.instances, limits_.instances, "instances of meshes");
    }

    Extent count(const Loaded& from, const ThreeMfUse& use, std::uint64_t depth) {
        check_stop();
        const InputText& source = from.part->source;
        const Target target = target_of(from, use);
        const auto [known, is_new] = extents_.try_emplace(target.object);
        if (!is_new && !known->second.is_done)
            source.fail(use.at, "an object that contains itself");
        if (depth + known->second.height > limits_.nesting) {
            source.fail_limit(use.at,
                              "components nest deeper than " + std::to_string(limits_.nesting));
        }
        if (!is_new) return known->second;
        Extent extent;
        extent.vertices = target.object->mesh.points.size();
        extent.faces = target.object->mesh.face_count();
        for (const ThreeMfUse& component : target.object->components) {
            const Extent more = count(*target.loaded, component, depth + 1);
            add_up(extent.vertices, more.vertices);
            add_up(extent.faces, more.faces);
            add_up(extent.instances, more.instances);
            extent.height = std::max(extent.height, more.height + 1);
        }
        extent.is_done = true;
        return known->second = extent;
    }

    void place(const Target& target, const ExactAffine& placement, ModelPart& made) {
        const ThreeMfObject& object = *target.object;
        if (object.is_support) return;
        if (object.has_mesh) {
            add_placed(made, object.mesh, placement, report_);
            numbers_ += object.properties.values.size();
            if (numbers_ > limits_.property_numbers)
                target.loaded->part->source.fail_limit(
                    object.at, "components amount to more numbers at corners than the limit");
            if (with_properties_)
                pieces_.emplace_back(placed_properties(object.properties, object.mesh, placement),
                                     object.mesh.corners.size());
            for (const std::uint32_t m : object.materials)
                made.materials.push_back(m == no_material ? m : target.loaded->first_material + m);
            made.materials.resize(made.mesh.face_count(), no_material);
        }
        for (const ThreeMfUse& component : object.components) {
            place(target_of(*target.loaded, component),
                  placement_of(*target.loaded, component).then(placement), made);
        }
    }

    const std::string& name_;
    const ReadLimits& limits_;
    bool with_properties_;
    ZipArchive archive_;
    ModelReport& report_;
    std::map<std::string, Loaded> parts_;
    std::vector<ModelMaterial> materials_;
    std::vector<ModelTexture> textures_;
    std::vector<std::pair<CornerProperties, std::size_t>> pieces_;  ///< of the item being placed
    std::uint64_t numbers_ = 0;
    std::map<const ThreeMfObject*, Extent> extents_;
    Extent total_{0, 0, 0, 0, false};
};

}  // namespace

Model read_three_mf(std::string_view data, const std::string& name, const ReadOptions& options,
                    ModelReport& report) {
    return Package(data, name, options, report).read();
}

}  // namespace trisect::detail
