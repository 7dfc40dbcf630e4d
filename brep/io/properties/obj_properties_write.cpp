// SPDX-License-Identifier: Apache-2.0
//
// Writing OBJ with properties. A vertex of OBJ has one colour, so it is written once for each
// colour that it has at corners; texture coordinates and normals have indices of their own. Faces
// without a material come first, since no statement ends one.
#include <trisect/brep/io/properties/mesh_properties.h>

#include <trisect/brep/io/formats/number_text.h>
#include <trisect/brep/io/properties/material_library.h>
#include <trisect/brep/io/properties/picture_files.h>
#include <trisect/brep/io/properties/property_collector.h>
#include <trisect/brep/io/properties/written_properties.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace trisect::detail {
namespace {

class ObjPropertyWriter {
public:
    ObjPropertyWriter(const Model& model, const std::string& name)
        : model_(model), name_(name), written_(written_properties(model, name)) {}

    FormattedMesh write() {
        TextWriter text(out_.bytes);
        text << "# Trisect\n";
        text.finish();
        if (!model_.materials.empty()) {
            const std::string library = stem_of(name_) + ".mtl";
            out_.bytes += "mtllib " + library + "\n";
            out_.files = written_.files;
            out_.files.push_back(
                {library, material_library(model_, written_.material_names, written_.pictures)});
        }
        write_vertices();
        const Indexed uv = write_rows("vt", PropertyMeaning::TextureCoordinates, uv_width);
        const Indexed normal = write_rows("vn", PropertyMeaning::Normal, normal_width);
        write_faces(uv, normal);
        note_left_out();
        return std::move(out_);
    }

private:
    /// By corner: a number from 1; 0 for none. Empty where no corner has one.
    using Indexed = std::vector<std::uint64_t>;

    void write_vertices() {
        const ModelPart& part = written_.part;
        const auto column = part.properties.column_of(PropertyMeaning::Color);
        vertex_.assign(part.mesh.corners.begin(), part.mesh.corners.end());
        TextWriter text(out_.bytes);
        if (!column) {
            for (const Point3d& p : part.mesh.points) text << "v " << p << '\n';
            text.finish();
            return;
        }
        const NumberRows rows = corner_rows(part, *column, 3, true);
        const DistinctRows distinct = distinct_rows_by_vertex(rows);
        for (const std::size_t row : distinct.first) {
            text << "v " << part.mesh.points[part.mesh.corners[row]];
            const double* color = rows.values.data() + row * rows.width + 1;
            if (!std::isnan(color[0]))
                text << ' ' << color[0] << ' ' << color[1] << ' ' << color[2];
            text << '\n';
        }
        text.finish();
        for (std::size_t c = 0; c < vertex_.size(); ++c) vertex_[c] = distinct.number[c];
    }

    Indexed write_rows(std::string_view keyword, PropertyMeaning meaning, std::size_t width) {
        const auto column = written_.part.properties.column_of(meaning);
        if (!column) return {};
        const NumberRows rows = corner_rows(written_.part, *column, width, false);
        const DistinctRows distinct = distinct_rows(rows);
        std::vector<std::uint64_t> number(distinct.first.size());
        std::uint64_t next = 0;
        TextWriter text(out_.bytes);
        for (std::size_t i = 0; i < distinct.first.size(); ++i) {
            const double* row = rows.values.data() + distinct.first[i] * width;
            if (std::any_of(row, row + width, [](double x) { return std::isnan(x); })) continue;
            number[i] = ++next;
            text << keyword;
            for (std::size_t k = 0; k < width; ++k) text << ' ' << row[k];
            text << '\n';
        }
        text.finish();
        Indexed out(distinct.number.size());
        for (std::size_t c = 0; c < out.size(); ++c) out[c] = number[distinct.number[c]];
        return out;
    }

    void write_faces(const Indexed& uv, const Indexed& normal) {
        std::vector<std::size_t> order(written_.part.mesh.face_count());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_partition(order.begin(), order.end(),
                              [&](std::size_t f) { return written_.material(f) == no_material; });
        std::uint32_t current = no_material;
        std::optional<TextWriter> text(std::in_place, out_.bytes);
        for (const std::size_t f : order) {
            if (written_.material(f) != current) {
                current = written_.material(f);
                text->finish();
                out_.bytes += "usemtl " + written_.material_names[current] + "\n";
            }
            *text << 'f';
            const PolygonMesh& mesh = written_.part.mesh;
            for (std::size_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
                *text << ' ' << vertex_[c] + 1;
                const bool has_uv = !uv.empty() && uv[c] != 0;
                const bool has_normal = !normal.empty() && normal[c] != 0;
                if (has_uv || has_normal) *text << '/';
                if (has_uv) *text << uv[c];
                if (has_normal) *text << '/' << normal[c];
            }
            *text << '\n';
        }
        text->finish();
    }

    void note_left_out() {
        const auto& channels = written_.part.properties.channels;
        for (const PropertyChannel& channel : channels)
            if (channel.meaning == PropertyMeaning::Any)
                out_.report.left_out.push_back("OBJ has no property " + channel.name);
        const auto color = written_.part.properties.column_of(PropertyMeaning::Color);
        if (!color) return;
        for (std::size_t c = 0; c < written_.part.mesh.corners.size(); ++c) {
            const double opacity = written_.part.properties.at(c)[*color + 3];
            if (std::isnan(opacity) || opacity == 1) continue;
            out_.report.left_out.emplace_back("OBJ has no opacity of corners");
            return;
        }
    }

    const Model& model_;
    const std::string& name_;
    WrittenProperties written_;
    FormattedMesh out_;
    std::vector<std::uint64_t> vertex_;  ///< by corner, from 0
};

}  // namespace

FormattedMesh write_obj_properties(const Model& model, const std::string& name) {
    return ObjPropertyWriter(model, name).write();
}

}  // namespace trisect::detail
