// SPDX-License-Identifier: Apache-2.0
//
// Writing 3MF: an object and an item of the build for each part, base materials for its materials.
// Base materials are surfaces that all readers know; those without a colour get a grey, because
// 3MF wants one.
#include <trisect/brep/io/models/models.h>

#include <trisect/brep/io/formats/number_text.h>
#include <trisect/brep/io/models/three_mf_names.h>
#include <trisect/brep/io/models/three_mf_write_looks.h>
#include <trisect/brep/io/models/xml_text.h>
#include <trisect/brep/io/models/zip_archive.h>
#include <trisect/brep/io/property_colors.h>

#include <array>

namespace trisect::detail {
namespace {

constexpr std::string_view xml_head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
constexpr ModelColor grey{0xc8, 0xc8, 0xc8, 0xff};

std::string hex_text(const ModelColor& color) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string out = "#";
    for (const std::uint8_t channel : color) {
        out += digits[channel / 16];
        out += digits[channel % 16];
    }
    return out;
}

std::string materials_text(const Model& model) {
    std::string out = "  <basematerials id=\"1\">\n";
    for (const ModelMaterial& m : model.materials) {
        out += "   <base name=\"" + escaped_xml(m.name) + "\" displaycolor=\"" +
               hex_text(m.color.value_or(grey)) + "\"/>\n";
    }
    return out + "  </basematerials>\n";
}

void append_vertices(std::string& out, const PolygonMesh& mesh) {
    TextWriter text(out);
    for (const Point3d& p : mesh.points) {
        text << "     <vertex x=\"" << p[0] << "\" y=\"" << p[1] << "\" z=\"" << p[2] << "\"/>\n";
    }
    text.finish();
}

void append_triangles(std::string& out, const ModelPart& part) {
    TextWriter text(out);
    for (std::size_t f = 0; f < part.mesh.face_count(); ++f) {
        const auto face = part.mesh.face(f);
        text << "     <triangle v1=\"" << std::uint64_t{face[0]} << "\" v2=\""
             << std::uint64_t{face[1]} << "\" v3=\"" << std::uint64_t{face[2]};
        if (!part.materials.empty() && part.materials[f] != no_material)
            text << "\" pid=\"1\" p1=\"" << std::uint64_t{part.materials[f]};
        text << "\"/>\n";
    }
    text.finish();
}

/// The material that the specification wants for an object some of whose triangles have one.
std::string object_properties(const ModelPart& part) {
    for (const std::uint32_t m : part.materials)
        if (m == no_material) return {};
    if (part.materials.empty()) return {};
    return " pid=\"1\" pindex=\"" + std::to_string(part.materials.front()) + "\"";
}

/// With colours and textures of corners.
void append_looking_triangles(std::string& out, const ModelPart& part,
                              const ThreeMfWrittenLooks& looks) {
    TextWriter text(out);
    for (std::size_t f = 0; f < part.mesh.face_count(); ++f) {
        const auto face = part.mesh.face(f);
        text << "     <triangle v1=\"" << std::uint64_t{face[0]} << "\" v2=\""
             << std::uint64_t{face[1]} << "\" v3=\"" << std::uint64_t{face[2]};
        const ThreeMfWrittenLooks::Reference& r = looks.of_face(f);
        if (r.group != 0) {
            text << "\" pid=\"" << std::uint64_t{r.group} << "\" p1=\"" << std::uint64_t{r.index[0]}
                 << "\" p2=\"" << std::uint64_t{r.index[1]} << "\" p3=\""
                 << std::uint64_t{r.index[2]};
        }
        text << "\"/>\n";
    }
    text.finish();
}

std::string object_looks(const ModelPart& part, const ThreeMfWrittenLooks& looks) {
    for (std::size_t f = 0; f < part.mesh.face_count(); ++f)
        if (looks.of_face(f).group == 0) return {};
    const ThreeMfWrittenLooks::Reference& first = looks.of_face(0);
    return " pid=\"" + std::to_string(first.group) + "\" pindex=\"" +
           std::to_string(first.index[0]) + "\"";
}

void append_object(std::string& out, const ModelPart& part, std::size_t id,
                   const ThreeMfWrittenLooks& looks) {
    reserve_text(out, part.mesh);
    out += "  <object id=\"" + std::to_string(id) + "\" type=\"model\"";
    if (!part.name.empty()) out += " name=\"" + escaped_xml(part.name) + "\"";
    out += (looks.is_needed() ? object_looks(part, looks) : object_properties(part)) +
           ">\n   <mesh>\n    <vertices>\n";
    append_vertices(out, part.mesh);
    out += "    </vertices>\n    <triangles>\n";
    if (looks.is_needed())
        append_looking_triangles(out, part, looks);
    else
        append_triangles(out, part);
    out += "    </triangles>\n   </mesh>\n  </object>\n";
}

std::string model_text(const Model& model, const std::string& unit, ThreeMfWrittenLooks& looks) {
    std::string out(xml_head);
    out += "<model unit=\"" + unit + "\" xml:lang=\"en-US\" xmlns=\"" + std::string(three_mf_core);
    if (looks.is_needed())
        out += "\" xmlns:m=\"" + std::string(three_mf_materials) + "\" requiredextensions=\"m";
    out += "\">\n <metadata name=\"Application\">Trisect</metadata>\n <resources>\n";
    if (!model.materials.empty()) out += materials_text(model);
    out += looks.textures_text();
    std::string build = " <build>\n";
    for (std::size_t i = 0; i < model.parts.size(); ++i) {
        if (model.parts[i].mesh.face_count() == 0) continue;  // an object has a triangle at least
        if (looks.is_needed()) out += looks.begin_part(model.parts[i]);
        const std::size_t id = looks.take_id();
        append_object(out, model.parts[i], id, looks);
        build += "  <item objectid=\"" + std::to_string(id) + "\"/>\n";
    }
    return out + " </resources>\n" + build + " </build>\n</model>\n";
}

std::string content_types(bool has_pictures) {
    const std::string pictures =
        has_pictures ? " <Default Extension=\"png\" ContentType=\"image/png\"/>\n <Default "
                       "Extension=\"jpg\" ContentType=\"image/jpeg\"/>\n"
                     : "";
    return std::string(xml_head) + "<Types xmlns=\"" + std::string(package_content_types) +
           "\">\n <Default Extension=\"rels\" ContentType=\"application/"
           "vnd.openxmlformats-package.relationships+xml\"/>\n <Default Extension=\"model\" "
           "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n" +
           pictures + "</Types>\n";
}

std::string relations() {
    return std::string(xml_head) + "<Relationships xmlns=\"" + std::string(package_relations) +
           "\">\n <Relationship Id=\"rel0\" Target=\"/3D/3dmodel.model\" Type=\"" +
           std::string(three_mf_model_relation) + "\"/>\n</Relationships>\n";
}

}  // namespace

FormattedMesh write_three_mf(const Model& given, const std::string& unit) {
    Model model = given;
    for (ModelPart& part : model.parts) convert_colors(part.properties, false);
    ThreeMfWrittenLooks looks(model, 2);
    std::vector<std::pair<std::string, std::string>> entries{
        {"[Content_Types].xml", content_types(looks.has_pictures())},
        {"_rels/.rels", relations()},
        {"3D/3dmodel.model", model_text(model, unit, looks)}};
    for (auto& file : looks.files()) entries.push_back(std::move(file));
    FormattedMesh out;
    out.bytes = zip_bytes(entries);
    return out;
}

}  // namespace trisect::detail
