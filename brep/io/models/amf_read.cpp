// SPDX-License-Identifier: Apache-2.0
//
// Reading AMF (ISO/ASTM 52915): plain, or the one entry of a zip archive.
//
// Volumes of an object share its vertices and make one mesh. Constellations place objects and other
// constellations: turned about x, then y, then z, in degrees, then moved. What no constellation
// places is a part where it stands; so is each constellation that no other one places. Edges and
// normals of vertices bend triangles, and are refused; an older way to write materials, `color` in
// an object or volume, is read as a material of its own.
#include <trisect/brep/io/models/models.h>

#include <trisect/brep/io/formats/mesh_builder.h>
#include <trisect/brep/io/models/placement.h>
#include <trisect/brep/io/models/xml_reader.h>
#include <trisect/brep/transform.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#ifdef TRISECT_WITH_ZIP
#include <trisect/brep/io/models/zip_archive.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace trisect::detail {
namespace {

struct AmfInstance {
    std::string object;
    std::array<double, 6> numbers{};  ///< the vector, then degrees about x, y and z
    const char* at = nullptr;
};

/// An object, or a constellation.
struct AmfThing {
    std::string name;
    PolygonMesh mesh;
    std::vector<std::uint32_t> materials;
    std::vector<AmfInstance> instances;
    bool is_placed = false;
    // What it amounts to with all that it places.
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
    std::uint64_t count = 0;
    std::uint64_t height = 0;
    enum class State : std::uint8_t { New, Open, Done } state = State::New;
};

struct AmfFile {
    std::string unit;
    std::vector<ModelMaterial> materials;
    std::vector<std::string> order;  ///< of things, by their numbers
    std::map<std::string, AmfThing> things;
};

constexpr std::array<std::string_view, 6> instance_numbers{"deltax", "deltay", "deltaz",
                                                           "rx",     "ry",     "rz"};

class AmfParser final : public XmlHandler {
public:
    AmfParser(const InputText& source, AmfFile& file) : source_(source), file_(file) {}

    void begin(const XmlElement& element) override {
        if (path_.empty() && element.name != "amf")
            source_.fail(element.at, "<" + std::string(element.name) + "> is no AMF");
        path_.emplace_back(element.name);
        at_ = element.at;
        text_.clear();
        if (path_.size() == 1)
            file_.unit = trimmed_word(element.attribute("unit").value_or("millimeter"));
        if (path_.size() == 2) begin_top(element);
        if (is_at(1, "object")) begin_in_object(element);
        if (is_at(1, "constellation") && is_at(2, "instance") && path_.size() == 3)
            begin_instance(element);
        if (path_.back() == "metadata") metadata_ = element.attribute("type").value_or("");
    }

    void text(std::string_view piece) override {
        const std::uint64_t most = 2 * source_.limits().literal_characters;
        if (text_.size() + piece.size() > most) {
            // Only numbers and names are wanted; of long texts the beginning stays.
            piece = piece.substr(0, static_cast<std::size_t>(most) - text_.size());
        }
        text_ += piece;
    }

    void end() override {
        if (is_at(1, "object")) end_in_object();
        if (is_at(1, "constellation")) end_in_constellation();
        if (is_at(1, "material")) end_in_material();
        if (path_.size() == 2) end_top();
        path_.pop_back();
        text_.clear();
    }

private:
    [[nodiscard]] bool is_at(std::size_t depth, std::string_view name) const {
        return path_.size() > depth && path_[depth] == name;
    }

    void begin_top(const XmlElement& element) {
        if (is_at(1, "object") || is_at(1, "constellation")) {
            thing_ = AmfThing();
            id_ = trimmed_word(element.required(source_, "id"));
            if (file_.things.contains(id_))
                source_.fail(element.at, "two objects with the number " + shown_word(id_));
        }
        if (is_at(1, "object")) {
            builder_.emplace(source_, 0U);
            object_material_ = no_material;
        }
        if (is_at(1, "material")) {
            material_ = ModelMaterial();
            material_id_ = trimmed_word(element.required(source_, "id"));
            color_ = {0, 0, 0, 1};
            has_color_ = false;
        }
    }

    void begin_in_object(const XmlElement& element) {
        const std::string& name = path_.back();
        if (name == "color") {
            color_ = {0, 0, 0, 1};
            has_color_ = false;
        }
        if (name == "edge" || name == "normal") {
            throw UnsupportedError(source_.place(element.at).to_string() + ": <" + name +
                                   "> bends triangles, which is not read");
        }
        if (name == "coordinates") point_.fill(std::nullopt);
        if (name == "triangle") corners_.fill(std::nullopt);
        if (name == "volume") {
            volume_material_ = no_material;
            if (const auto id = element.attribute("materialid"))
                volume_material_ = material_number(std::string(trimmed_word(*id)));
        }
    }

    void begin_instance(const XmlElement& element) {
        AmfInstance made;
        made.object = trimmed_word(element.required(source_, "objectid"));
        made.at = element.at;
        thing_.instances.push_back(std::move(made));
    }

    /// Materials may be used before they come, so they have numbers from the first use.
    std::uint32_t material_number(const std::string& id) {
        const auto [known, is_new] =
            numbers_.try_emplace(id, static_cast<std::uint32_t>(file_.materials.size()));
        if (is_new) file_.materials.emplace_back();
        return known->second;
    }

    double number(const char* what) const { return xml_real(source_, text_, what, at_); }

    void end_in_object() {
        const std::string& name = path_.back();
        if (is_at(path_.size() - 2, "coordinates") && name.size() == 1 && name[0] >= 'x' &&
            name[0] <= 'z')
            point_[static_cast<std::size_t>(name[0] - 'x')] = number("a coordinate");
        if (name == "coordinates") end_point();
        if (is_at(path_.size() - 2, "triangle") && name.size() == 2 && name[0] == 'v' &&
            name[1] >= '1' && name[1] <= '3')
            corners_[static_cast<std::size_t>(name[1] - '1')] =
                xml_count(source_, text_, "a vertex index", at_);
        if (name == "triangle") end_triangle();
        if (is_at(path_.size() - 2, "color")) color_channel(name);
        if (name == "color") end_object_color();
        if (name == "metadata" && path_.size() == 3 && metadata_ == "name")
            thing_.name = trimmed_word(text_);
    }

    void end_point() {
        for (const auto& c : point_)
            if (!c) source_.fail(at_, "a vertex without all of x, y and z");
        builder_->add_point({*point_[0], *point_[1], *point_[2]}, at_);
    }

    void end_triangle() {
        for (const auto& v : corners_) {
            if (!v) source_.fail(at_, "a triangle without all of v1, v2 and v3");
            builder_->add_corner(*v, at_);
        }
        builder_->end_face(at_);
        thing_.materials.push_back(volume_material_);
    }

    void color_channel(const std::string& name) {
        constexpr std::string_view channels = "rgba";
        if (name.size() != 1 || channels.find(name[0]) == std::string_view::npos) return;
        // Colours may be formulas of the place; those are looks that are ignored.
        try {
            color_[channels.find(name[0])] = std::clamp(number("a colour"), 0.0, 1.0);
            has_color_ = true;
        } catch (const InputError&) {
            color_[channels.find(name[0])] = 0.5;
        }
    }

    [[nodiscard]] std::optional<ModelColor> made_color() const {
        if (!has_color_) return std::nullopt;
        ModelColor out{};
        for (std::size_t i = 0; i < 4; ++i)
            out[i] = static_cast<std::uint8_t>(std::lround(255 * color_[i]));
        return out;
    }

    /// Of the object or of a volume; those of vertices and triangles are ignored.
    void end_object_color() {
        const bool is_of_volume = path_.size() == 5 && is_at(3, "volume");
        if (path_.size() != 3 && !is_of_volume) return;
        const auto made = static_cast<std::uint32_t>(file_.materials.size());
        file_.materials.push_back({{}, made_color()});
        (is_of_volume ? volume_material_ : object_material_) = made;
    }

    void end_in_constellation() {
        if (path_.size() == 3 && path_.back() == "metadata" && metadata_ == "name")
            thing_.name = trimmed_word(text_);
        if (path_.size() != 4 || !is_at(2, "instance")) return;
        const auto found =
            std::find(instance_numbers.begin(), instance_numbers.end(), path_.back());
        if (found == instance_numbers.end()) return;
        thing_.instances.back()
            .numbers[static_cast<std::size_t>(found - instance_numbers.begin())] =
            number("a part of a place");
    }

    void end_in_material() {
        if (path_.size() == 3 && path_.back() == "metadata" && metadata_ == "name")
            material_.name = trimmed_word(text_);
        if (path_.size() == 4 && is_at(2, "color")) color_channel(path_.back());
        if (path_.size() == 3 && path_.back() == "color") material_.color = made_color();
    }

    void end_top() {
        if (is_at(1, "material")) file_.materials[material_number(material_id_)] = material_;
        if (is_at(1, "object")) {
            thing_.mesh = builder_->finish();
            for (std::uint32_t& m : thing_.materials)
                if (m == no_material) m = object_material_;
        }
        if (!is_at(1, "object") && !is_at(1, "constellation")) return;
        file_.order.push_back(id_);
        file_.things.emplace(id_, std::move(thing_));
    }

    const InputText& source_;
    AmfFile& file_;
    std::vector<std::string> path_;
    const char* at_ = nullptr;  ///< of the last start tag
    std::string text_;
    std::string metadata_;
    std::string id_;
    AmfThing thing_;
    std::optional<MeshBuilder> builder_;
    std::array<std::optional<double>, 3> point_;
    std::array<std::optional<std::uint64_t>, 3> corners_;
    std::uint32_t volume_material_ = no_material;
    std::uint32_t object_material_ = no_material;
    std::map<std::string, std::uint32_t> numbers_;
    std::string material_id_;
    ModelMaterial material_;
    std::array<double, 4> color_{};
    bool has_color_ = false;
};

/// Counts before it places, as 3MF's reader does, for the same reasons.
class AmfAssembly {
public:
    AmfAssembly(const InputText& source, AmfFile& file, ModelReport& report)
        : source_(source), file_(file), report_(report) {}

    Model assemble() {
        for (auto& [id, thing] : file_.things)
            for (const AmfInstance& i : thing.instances) target_of(i).is_placed = true;
        std::uint64_t vertices = 0;
        std::uint64_t faces = 0;
        std::uint64_t count = 0;
        for (auto& [id, thing] : file_.things) {
            count_up(thing, source_.begin(), 0);
            if (thing.is_placed) continue;
            add_up(vertices, thing.vertices);
            add_up(faces, thing.faces);
            add_up(count, thing.count);
        }
        const ReadLimits& limits = source_.limits();
        if (vertices > limits.vertices || faces > limits.faces || count > limits.instances) {
            source_.fail_limit(source_.begin(),
                               "constellations amount to more than the limits for a file allow");
        }
        Model model;
        model.unit = file_.unit;
        model.materials = std::move(file_.materials);
        for (const std::string& id : file_.order) {
            const AmfThing& thing = file_.things.at(id);
            if (thing.is_placed) continue;
            ModelPart part;
            part.name = thing.name;
            place(thing, ExactAffine(), part);
            if (std::all_of(part.materials.begin(), part.materials.end(),
                            [](std::uint32_t m) { return m == no_material; }))
                part.materials.clear();
            if (part.mesh.face_count() != 0) model.parts.push_back(std::move(part));
        }
        return model;
    }

private:
    static void add_up(std::uint64_t& sum, std::uint64_t more) {
        sum = more > UINT64_MAX - sum ? UINT64_MAX : sum + more;
    }

    AmfThing& target_of(const AmfInstance& instance) {
        const auto found = file_.things.find(instance.object);
        if (found == file_.things.end())
            source_.fail(instance.at, "there is no object " + shown_word(instance.object));
        return found->second;
    }

    void count_up(AmfThing& thing, const char* at, std::uint64_t depth) {
        check_stop();
        if (thing.state == AmfThing::State::Open)
            source_.fail(at, "a constellation that contains itself");
        if (depth + thing.height > source_.limits().nesting) {
            source_.fail_limit(
                at, "constellations nest deeper than " + std::to_string(source_.limits().nesting));
        }
        if (thing.state == AmfThing::State::Done) return;
        thing.state = AmfThing::State::Open;
        thing.vertices = thing.mesh.points.size();
        thing.faces = thing.mesh.face_count();
        thing.count = 1;
        for (const AmfInstance& i : thing.instances) {
            AmfThing& target = target_of(i);
            count_up(target, i.at, depth + 1);
            add_up(thing.vertices, target.vertices);
            add_up(thing.faces, target.faces);
            add_up(thing.count, target.count);
            thing.height = std::max(thing.height, target.height + 1);
        }
        thing.state = AmfThing::State::Done;
    }

    static ExactAffine placement_of(const AmfInstance& instance) {
        ExactAffine out;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (instance.numbers[3 + axis] == 0) continue;
            Point3d direction{0, 0, 0};
            direction[axis] = 1;
            const AffineMap turn = AffineMap::rotation(direction, instance.numbers[3 + axis]);
            std::array<double, 12> rows{};
            for (std::size_t i = 0; i < 12; ++i) rows[i] = turn.rows[i / 4][i % 4];
            out = out.then(ExactAffine::from_rows(rows));
        }
        const auto& n = instance.numbers;
        return out.then(ExactAffine::from_rows({1, 0, 0, n[0], 0, 1, 0, n[1], 0, 0, 1, n[2]}));
    }

    void place(const AmfThing& thing, const ExactAffine& placement, ModelPart& part) {
        if (thing.mesh.face_count() != 0) {
            add_placed(part, thing.mesh, placement, report_);
            part.materials.insert(part.materials.end(), thing.materials.begin(),
                                  thing.materials.end());
        }
        for (const AmfInstance& i : thing.instances)
            place(target_of(i), placement_of(i).then(placement), part);
    }

    const InputText& source_;
    AmfFile& file_;
    ModelReport& report_;
};

Model read_amf_text(std::string_view text, const std::string& name, const ReadLimits& limits,
                    ModelReport& report) {
    const InputText source(text, name, limits, false);
    AmfFile file;
    AmfParser parser(source, file);
    read_xml(source, parser);
    return AmfAssembly(source, file, report).assemble();
}

}  // namespace

Model read_amf(std::string_view data, const std::string& name, const ReadLimits& limits,
               ModelReport& report) {
    if (!is_zip(data)) return read_amf_text(data, name, limits, report);
#ifdef TRISECT_WITH_ZIP
    ZipArchive archive(data, name, limits);
    if (archive.entries().size() != 1)
        throw InputError(FilePlace{name, 0, 0, 0}, "an archive of AMF has one entry");
    const std::string entry = archive.entries().front();
    return read_amf_text(*archive.read(entry), archive.name_of(entry), limits, report);
#else
    throw UnsupportedError(name +
                           ": this build of Trisect was made without libzip, which packed "
                           "AMF takes");
#endif
}

}  // namespace trisect::detail
