// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/glb_write_vertices.h>

#include <trisect/brep/io/properties/distinct_rows.h>
#include <trisect/brep/io/property_colors.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/nearest_float.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace trisect::detail {
namespace {

// Columns of a row: the vertex of the mesh, u and v, a normal, a colour, what of these is there.
constexpr std::size_t uv_at = 1;
constexpr std::size_t normal_at = 3;
constexpr std::size_t color_at = 6;
constexpr std::size_t kinds_at = 10;
constexpr std::size_t row_width = 11;
using Row = std::array<double, row_width>;

class RowMaker {
public:
    RowMaker(const CornerProperties& properties, const std::string& name)
        : properties_(properties),
          name_(name),
          uv_(properties.column_of(PropertyMeaning::TextureCoordinates)),
          normal_(properties.column_of(PropertyMeaning::Normal)),
          color_(properties.column_of(PropertyMeaning::LinearColor)) {}

    [[nodiscard]] Row row(std::uint32_t vertex, std::size_t corner) const {
        Row out{};
        out[0] = vertex;
        unsigned kinds = 0;
        if (take(uv_, 2, corner, out, uv_at)) {
            out[uv_at + 1] = in_float(1 - out[uv_at + 1]);
            kinds |= GlbVertices::has_uv;
        }
        if (take(normal_, 3, corner, out, normal_at) && make_unit(out))
            kinds |= GlbVertices::has_normal;
        if (take(color_, 4, corner, out, color_at)) kinds |= GlbVertices::has_color;
        for (std::size_t i = uv_at; i < kinds_at; ++i) out[i] = in_float(out[i]);
        for (std::size_t i = color_at; i < kinds_at; ++i) out[i] = std::clamp(out[i], 0.0, 1.0);
        out[kinds_at] = kinds;
        return out;
    }

private:
    [[nodiscard]] double in_float(double value) const {
        if (std::fabs(value) > static_cast<double>(std::numeric_limits<float>::max()))
            throw LimitError(name_ + ": cannot write: a property beyond the range of GLB (floats)");
        return detail::nearest_float(value);
    }

    [[nodiscard]] bool take(std::optional<std::size_t> column, std::size_t width,
                            std::size_t corner, Row& out, std::size_t to) const {
        if (!column) return false;
        const auto numbers = properties_.at(corner).subspan(*column, width);
        if (std::any_of(numbers.begin(), numbers.end(), [](double x) { return std::isnan(x); }))
            return false;
        std::copy(numbers.begin(), numbers.end(), out.begin() + static_cast<std::ptrdiff_t>(to));
        return true;
    }

    /// False where a normal has no direction.
    static bool make_unit(Row& out) {
        const double length = std::hypot(out[normal_at], out[normal_at + 1], out[normal_at + 2]);
        const bool has_direction = length > 0 && std::isfinite(length);
        for (std::size_t i = normal_at; i < normal_at + 3; ++i)
            out[i] = has_direction ? out[i] / length : 0;
        return has_direction;
    }

    const CornerProperties& properties_;
    const std::string& name_;
    std::optional<std::size_t> uv_;
    std::optional<std::size_t> normal_;
    std::optional<std::size_t> color_;
};

void append_floats(std::vector<float>& to, const double* row, std::size_t first, std::size_t n) {
    for (std::size_t i = first; i < first + n; ++i) to.push_back(static_cast<float>(row[i]));
}

GlbVertices plain_vertices(const PolygonMesh& mesh) {
    GlbVertices out;
    out.corner = mesh.corners;
    out.place.resize(mesh.points.size());
    std::iota(out.place.begin(), out.place.end(), 0U);
    out.first = out.place;
    out.kinds.assign(mesh.face_count(), 0);
    return out;
}

}  // namespace

GlbVertices glb_vertices(const ModelPart& part, const std::string& name) {
    if (part.properties.width == 0) return plain_vertices(part.mesh);
    CornerProperties properties = part.properties;
    convert_colors(properties, true);
    const RowMaker maker(properties, name);
    NumberRows rows;
    rows.width = row_width;
    rows.values.reserve(row_width * part.mesh.corners.size());
    for (std::size_t c = 0; c < part.mesh.corners.size(); ++c) {
        const Row row = maker.row(part.mesh.corners[c], c);
        rows.values.insert(rows.values.end(), row.begin(), row.end());
    }
    DistinctRows distinct = distinct_rows_by_vertex(rows);
    GlbVertices out;
    out.corner = std::move(distinct.number);
    const std::uint32_t none = 0xFFFF'FFFFU;
    std::vector<std::uint32_t> first(part.mesh.points.size(), none);
    unsigned any = 0;
    for (std::uint32_t v = 0; v < distinct.first.size(); ++v) {
        const double* const row = rows.values.data() + distinct.first[v] * row_width;
        const auto place = static_cast<std::uint32_t>(row[0]);
        if (first[place] == none) first[place] = v;
        out.place.push_back(place);
        out.first.push_back(first[place]);
        append_floats(out.uv, row, uv_at, 2);
        append_floats(out.normal, row, normal_at, 3);
        append_floats(out.color, row, color_at, 4);
    }
    out.kinds.reserve(part.mesh.face_count());
    for (std::size_t f = 0; f < part.mesh.face_count(); ++f) {
        unsigned all = GlbVertices::has_uv | GlbVertices::has_normal | GlbVertices::has_color;
        for (std::size_t c = part.mesh.face_begin[f]; c < part.mesh.face_begin[f + 1]; ++c)
            all &= static_cast<unsigned>(rows.values[c * row_width + kinds_at]);
        out.kinds.push_back(static_cast<std::uint8_t>(all));
        any |= all;
    }
    if ((any & GlbVertices::has_uv) == 0) out.uv.clear();
    if ((any & GlbVertices::has_normal) == 0) out.normal.clear();
    if ((any & GlbVertices::has_color) == 0) out.color.clear();
    return out;
}

}  // namespace trisect::detail
