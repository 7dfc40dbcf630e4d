// SPDX-License-Identifier: Apache-2.0
//
// Writing AMF, plain: an object for each part, a volume for each of its materials. Faces of a part
// are listed by their materials, as in GLB; within a material they keep their order.
#include <trisect/brep/io/models/models.h>

#include <trisect/brep/io/formats/number_text.h>
#include <trisect/brep/io/models/xml_text.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace trisect::detail {
namespace {

std::string name_element(const std::string& name) {
    if (name.empty()) return {};
    return "  <metadata type=\"name\">" + escaped_xml(name) + "</metadata>\n";
}

void append_amf_vertices(std::string& out, const PolygonMesh& mesh) {
    TextWriter text(out);
    for (const Point3d& p : mesh.points) {
        text << "    <vertex><coordinates><x>" << p[0] << "</x><y>" << p[1] << "</y><z>" << p[2]
             << "</z></coordinates></vertex>\n";
    }
    text.finish();
}

void append_amf_triangles(std::string& out, const PolygonMesh& mesh,
                          std::span<const std::size_t> faces) {
    TextWriter text(out);
    for (const std::size_t f : faces) {
        const auto face = mesh.face(f);
        text << "    <triangle><v1>" << std::uint64_t{face[0]} << "</v1><v2>"
             << std::uint64_t{face[1]} << "</v2><v3>" << std::uint64_t{face[2]}
             << "</v3></triangle>\n";
    }
    text.finish();
}

void append_amf_object(std::string& out, const ModelPart& part, std::size_t id) {
    reserve_text(out, part.mesh);
    out += " <object id=\"" + std::to_string(id) + "\">\n" + name_element(part.name) +
           "  <mesh>\n   <vertices>\n";
    append_amf_vertices(out, part.mesh);
    out += "   </vertices>\n";
    const auto material = [&](std::size_t f) {
        return part.materials.empty() ? no_material : part.materials[f];
    };
    std::vector<std::size_t> order(part.mesh.face_count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return material(a) < material(b); });
    for (std::size_t first = 0; first < order.size();) {
        const std::uint32_t m = material(order[first]);
        std::size_t last = first;
        while (last < order.size() && material(order[last]) == m) ++last;
        out += "   <volume";
        if (m != no_material) out += " materialid=\"" + std::to_string(m + 1) + "\"";
        out += ">\n";
        append_amf_triangles(out, part.mesh, std::span(order).subspan(first, last - first));
        out += "   </volume>\n";
        first = last;
    }
    out += "  </mesh>\n </object>\n";
}

/// Numbers of materials count from 1, since 0 is nothing in AMF.
std::string amf_material(const ModelMaterial& material, std::size_t id) {
    std::string out =
        " <material id=\"" + std::to_string(id) + "\">\n" + name_element(material.name);
    if (material.color) {
        constexpr const char* channels = "rgba";
        std::string color;
        TextWriter text(color);
        for (std::size_t i = 0; i < 4; ++i) {
            text << '<' << channels[i] << '>' << (*material.color)[i] / 255.0 << "</" << channels[i]
                 << '>';
        }
        text.finish();
        out += "  <color>" + color + "</color>\n";
    }
    return out + " </material>\n";
}

}  // namespace

FormattedMesh write_amf(const Model& model, const std::string& unit) {
    FormattedMesh out;
    out.bytes =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<amf unit=\"" + unit + "\" version=\"1.1\">\n";
    for (std::size_t i = 0; i < model.parts.size(); ++i) {
        if (model.parts[i].mesh.face_count() == 0) continue;
        append_amf_object(out.bytes, model.parts[i], i);
    }
    for (std::size_t i = 0; i < model.materials.size(); ++i)
        out.bytes += amf_material(model.materials[i], i + 1);
    out.bytes += "</amf>\n";
    return out;
}

}  // namespace trisect::detail
