// SPDX-License-Identifier: Apache-2.0
//
// Writing PLY with properties: on vertices, which are written once for each combination that they
// have at corners, since programs read no others. Names are those that ply_properties.cpp lists
// first. Colours have a byte each; corners without one have that of their material, or white.
// Other numbers are doubles, and absent ones are not a number.
#include <trisect/brep/io/properties/mesh_properties.h>

#include <trisect/brep/io/formats/binary.h>
#include <trisect/brep/io/formats/number_text.h>
#include <trisect/brep/io/properties/written_properties.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trisect::detail {
namespace {

/// Scalars in one of the encodings.
class PlyOutput {
public:
    PlyOutput(std::string& out, PlyEncoding encoding) : out_(out), encoding_(encoding) {}

    void real(double value) {
        if (encoding_ == PlyEncoding::Ascii) return word(value);
        store(out_, value, encoding_ == PlyEncoding::BinaryBigEndian);
    }
    void byte(std::uint8_t value) {
        if (encoding_ == PlyEncoding::Ascii) return word(std::uint64_t{value});
        store(out_, value, false);
    }
    void word32(std::uint32_t value) {
        if (encoding_ == PlyEncoding::Ascii) {
            // -1 is none.
            if (value == no_material) {
                out_ += "-1 ";
                return;
            }
            return word(std::uint64_t{value});
        }
        store(out_, value, encoding_ == PlyEncoding::BinaryBigEndian);
    }
    void end_entry() {
        if (encoding_ == PlyEncoding::Ascii) out_.back() = '\n';
    }

private:
    template <class Number>
    void word(Number value) {
        char text[32];
        char* const end = std::to_chars(text, text + sizeof text, value).ptr;
        out_.append(text, end);
        out_ += ' ';
    }
    std::string& out_;
    PlyEncoding encoding_;
};

std::string encoding_name(PlyEncoding encoding) {
    if (encoding == PlyEncoding::Ascii) return "ascii";
    return encoding == PlyEncoding::BinaryBigEndian ? "binary_big_endian" : "binary_little_endian";
}

std::uint8_t byte_of(double value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

class PlyPropertyWriter {
public:
    PlyPropertyWriter(const Model& model, PlyEncoding encoding, const std::string& name)
        : model_(model), written_(written_properties(model, name)), encoding_(encoding) {}

    FormattedMesh write() {
        fill_colors();
        const NumberRows rows = corner_rows(written_.part, 0, written_.part.properties.width, true);
        const DistinctRows distinct = distinct_rows_by_vertex(rows);
        const PolygonMesh& mesh = written_.part.mesh;
        is_large_ = std::any_of(mesh.face_begin.begin() + 1, mesh.face_begin.end(),
                                [last = std::uint32_t{0}](std::uint32_t end) mutable {
                                    return end - std::exchange(last, end) > 255;
                                });
        header(distinct.first.size());
        PlyOutput out(out_.bytes, encoding_);
        for (const std::size_t row : distinct.first) vertex(out, row);
        for (std::size_t f = 0; f < mesh.face_count(); ++f) face(out, f, distinct);
        for (const ModelMaterial& material : model_.materials) {
            const ModelColor color = material.color.value_or(ModelColor{255, 255, 255, 255});
            for (const std::uint8_t level : color) out.byte(level);
            out.end_entry();
        }
        out_.files = std::move(written_.files);
        return std::move(out_);
    }

private:
    void fill_colors() {
        ModelPart& part = written_.part;
        const auto column = part.properties.column_of(PropertyMeaning::Color);
        if (!column) return;
        for (std::size_t f = 0; f < part.mesh.face_count(); ++f) {
            std::array<double, 4> own{1, 1, 1, 1};
            const std::uint32_t m = written_.material(f);
            if (m != no_material && model_.materials[m].color)
                for (std::size_t i = 0; i < 4; ++i)
                    own[i] = (*model_.materials[m].color)[i] / 255.0;
            for (std::size_t c = part.mesh.face_begin[f]; c < part.mesh.face_begin[f + 1]; ++c)
                for (std::size_t i = 0; i < 4; ++i) {
                    double& x = part.properties.values[c * part.properties.width + *column + i];
                    if (std::isnan(x)) x = own[i];
                    x = byte_of(x);  // so that rows that end as the same bytes are one vertex
                }
        }
    }

    static std::string plain_name(const std::string& name, std::size_t i, std::size_t width) {
        std::string out = name.empty() ? "property" : name;
        for (char& c : out)
            if (c <= ' ' || c > '~') c = '_';
        if (out == "x" || out == "y" || out == "z") out += '_';
        return width == 1 ? out : out + "_" + std::to_string(i);
    }

    void header(std::size_t vertices) {
        std::string& out = out_.bytes;
        out += "ply\nformat " + encoding_name(encoding_) + " 1.0\ncomment Trisect\n";
        for (const std::string& name : written_.material_names)
            out += "comment material " + name + "\n";
        for (const std::string& picture : written_.pictures)
            out += "comment TextureFile " + picture + "\n";
        out += "element vertex " + std::to_string(vertices) +
               "\nproperty double x\nproperty double y\nproperty double z\n";
        for (const PropertyChannel& channel : written_.part.properties.channels)
            for (std::size_t i = 0; i < channel.width; ++i) scalar(channel, i);
        const PolygonMesh& mesh = written_.part.mesh;
        out += "element face " + std::to_string(mesh.face_count()) + "\nproperty list " +
               (is_large_ ? "uint" : "uchar") + (vertices <= 0x8000'0000U ? " int" : " uint") +
               " vertex_indices\n";
        if (!model_.materials.empty()) out += "property int material_index\n";
        if (!model_.textures.empty()) out += "property int texnumber\n";
        if (!model_.materials.empty())
            out += "element material " + std::to_string(model_.materials.size()) +
                   "\nproperty uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar "
                   "diffuse_blue\nproperty uchar diffuse_alpha\n";
        out += "end_header\n";
    }

    void scalar(const PropertyChannel& channel, std::size_t i) {
        static constexpr std::array<const char*, 2> uv{"s", "t"};
        static constexpr std::array<const char*, 3> normal{"nx", "ny", "nz"};
        static constexpr std::array<const char*, 4> color{"red", "green", "blue", "alpha"};
        const bool is_color = channel.meaning == PropertyMeaning::Color;
        std::string name = plain_name(channel.name, i, channel.width);
        if (channel.meaning == PropertyMeaning::TextureCoordinates) name = uv[i];
        if (channel.meaning == PropertyMeaning::Normal) name = normal[i];
        if (is_color) name = color[i];
        out_.bytes += std::string("property ") + (is_color ? "uchar " : "double ") + name + "\n";
    }

    void vertex(PlyOutput& out, std::size_t corner) {
        const ModelPart& part = written_.part;
        for (const double c : part.mesh.points[part.mesh.corners[corner]]) out.real(c);
        const auto numbers =
            part.properties.width == 0 ? std::span<const double>() : part.properties.at(corner);
        std::size_t column = 0;
        for (const PropertyChannel& channel : part.properties.channels)
            for (std::size_t i = 0; i < channel.width; ++i, ++column) {
                if (channel.meaning == PropertyMeaning::Color)
                    out.byte(static_cast<std::uint8_t>(numbers[column]));
                else
                    out.real(numbers[column]);
            }
        out.end_entry();
    }

    void face(PlyOutput& out, std::size_t f, const DistinctRows& distinct) {
        const PolygonMesh& mesh = written_.part.mesh;
        const std::size_t n = mesh.face(f).size();
        if (is_large_)
            out.word32(static_cast<std::uint32_t>(n));
        else
            out.byte(static_cast<std::uint8_t>(n));
        for (std::size_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
            out.word32(distinct.number[c]);
        const std::uint32_t material = written_.material(f);
        if (!model_.materials.empty()) out.word32(material);
        if (!model_.textures.empty())
            out.word32(material == no_material ? no_texture : model_.materials[material].texture);
        out.end_entry();
    }

    const Model& model_;
    WrittenProperties written_;
    PlyEncoding encoding_;
    FormattedMesh out_;
    bool is_large_ = false;  ///< a face has more than 255 corners
};

}  // namespace

FormattedMesh write_ply_properties(const Model& model, PlyEncoding encoding,
                                   const std::string& name) {
    return PlyPropertyWriter(model, encoding, name).write();
}

}  // namespace trisect::detail
