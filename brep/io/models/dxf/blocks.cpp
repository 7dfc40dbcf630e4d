// SPDX-License-Identifier: Apache-2.0
//
// Read are 3DFACE, POLYLINE where it is a polyface or polygon mesh, MESH without subdivision, and
// INSERT. All that is drawn in lines, and all on paper, is passed over; solids and surfaces that
// DXF keeps as data of another format, or that are smoothed, are refused.
#include <trisect/brep/io/models/dxf/blocks.h>

#include <trisect/brep/io/formats/mesh_builder.h>
#include <trisect/brep/io/formats/vertex_welder.h>
#include <trisect/brep/io/models/dxf/pairs.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <optional>

namespace trisect::detail {
namespace {

constexpr std::array<std::string_view, 10> refused_entities{
    "3DSOLID",       "ACAD_PROXY_ENTITY", "BODY",         "EXTRUDEDSURFACE",
    "LOFTEDSURFACE", "NURBSURFACE",       "PLANESURFACE", "REVOLVEDSURFACE",
    "SURFACE",       "SWEPTSURFACE"};

constexpr std::int64_t closed_in_m = 1;
constexpr std::int64_t polygon_mesh = 16;
constexpr std::int64_t closed_in_n = 32;
constexpr std::int64_t polyface_mesh = 64;
constexpr std::int64_t polyface_record = 128;

std::string unit_of_code(std::int64_t code) {
    switch (code) {
        case 1:
            return "inch";
        case 2:
            return "foot";
        case 4:
            return "millimeter";
        case 5:
            return "centimeter";
        case 6:
            return "meter";
        case 7:
            return "kilometer";
        case 12:
            return "nanometer";
        case 13:
            return "micron";
        case 14:
            return "decimeter";
        case 15:
            return "decameter";
        default:
            return {};
    }
}

/// Corners of one place become one, as in STL.
struct FaceSoup {
    explicit FaceSoup(const InputText& source) : builder(source, 0), welder(builder.points(), 0) {}
    MeshBuilder builder;
    VertexWelder welder;
    std::string layer;
    bool has_faces = false;
    bool has_one_layer = true;
};

class DxfBlockReader {
public:
    explicit DxfBlockReader(const InputText& source) : pairs_(source) {}

    DxfFile read() {
        pairs_.next();
        while (!pairs_.is(0, "EOF")) {
            if (!pairs_.is(0, "SECTION"))
                pairs_.fail("SECTION or EOF expected, not " + shown_word(pairs_.value()));
            pairs_.next();
            if (pairs_.code() != 2) pairs_.fail("the name of the section expected");
            const std::string_view name = pairs_.value();
            pairs_.next();
            if (name == "HEADER")
                read_header();
            else if (name == "BLOCKS")
                read_blocks();
            else if (name == "ENTITIES")
                read_entities(file_.entities, "ENDSEC");
            else
                while (!pairs_.is(0, "ENDSEC")) pairs_.next();
            pairs_.next();
        }
        pairs_.expect_end();
        return std::move(file_);
    }

private:
    void read_header() {
        bool is_units = false;
        for (; !pairs_.is(0, "ENDSEC"); pairs_.next()) {
            if (pairs_.code() == 9) is_units = pairs_.value() == "$INSUNITS";
            if (is_units && pairs_.code() == 70) file_.unit = unit_of_code(pairs_.integer());
        }
    }

    void read_blocks() {
        while (!pairs_.is(0, "ENDSEC")) {
            if (!pairs_.is(0, "BLOCK")) pairs_.fail("BLOCK or ENDSEC expected");
            const char* at = pairs_.at();
            DxfBlock block;
            std::string name;
            for (pairs_.next(); pairs_.code() != 0; pairs_.next()) {
                if (pairs_.code() == 2) name = pairs_.value();
                coordinate(block.base, 10);
            }
            read_entities(block, "ENDBLK");
            for (pairs_.next(); pairs_.code() != 0;) pairs_.next();
            // One without a name cannot be inserted.
            if (name.empty()) continue;
            if (!file_.blocks.emplace(std::move(name), std::move(block)).second)
                pairs_.source().fail(at, "a second block of the same name");
        }
    }

    /// Sets a coordinate where the pair is one of a point with that first code.
    bool coordinate(Point3d& point, int first) const {
        const int k = pairs_.code() - first;
        if (k != 0 && k != 10 && k != 20) return false;
        point[static_cast<std::size_t>(k / 10)] = pairs_.real();
        return true;
    }

    void read_entities(DxfBlock& block, std::string_view end) {
        FaceSoup soup(pairs_.source());
        while (!pairs_.is(0, end)) {
            if (pairs_.code() != 0) pairs_.fail("an entity expected");
            const std::string_view type = pairs_.value();
            if (type == "EOF" || type == "ENDSEC" || type == "SECTION")
                pairs_.fail("before " + std::string(end));
            const bool is_refused = std::find(refused_entities.begin(), refused_entities.end(),
                                              type) != refused_entities.end();
            if (is_refused)
                throw UnsupportedError(pairs_.source().place(pairs_.at()).to_string() + ": " +
                                       std::string(type) + " is not read");
            if (type == "3DFACE")
                read_face(soup);
            else if (type == "POLYLINE")
                read_polyline(block);
            else if (type == "MESH")
                read_mesh_entity(block);
            else if (type == "INSERT")
                read_insert(block);
            else
                skip_entity();
        }
        if (!soup.has_faces) return;
        if (!soup.has_one_layer) soup.layer.clear();
        block.parts.insert(block.parts.begin(), {soup.layer, soup.builder.finish(), {}});
    }

    void skip_entity() {
        for (pairs_.next(); pairs_.code() != 0;) pairs_.next();
    }

    /// Codes that all entities have.
    struct Common {
        std::string layer;
        bool is_on_paper = false;
    };
    void common(Common& out) const {
        if (pairs_.code() == 8) out.layer = pairs_.value();
        if (pairs_.code() == 67) out.is_on_paper = pairs_.integer() != 0;
    }

    void read_face(FaceSoup& soup) {
        const char* at = pairs_.at();
        std::array<Point3d, 4> corners{};
        std::array<unsigned, 4> given{};
        Common entity;
        for (pairs_.next(); pairs_.code() != 0; pairs_.next()) {
            common(entity);
            for (int i = 0; i < 4; ++i)
                if (coordinate(corners[static_cast<std::size_t>(i)], 10 + i))
                    given[static_cast<std::size_t>(i)] |= 1U << ((pairs_.code() - 10 - i) / 10);
        }
        if (entity.is_on_paper) return;
        for (std::size_t i = 0; i < 3; ++i)
            if ((given[i] & 3U) != 3U)
                pairs_.source().fail(at, "a 3DFACE without all of its corners");
        const bool has_four = given[3] != 0 && corners[3] != corners[2];
        for (std::size_t i = 0; i < (has_four ? 4U : 3U); ++i) {
            soup.builder.add_corner(soup.welder.vertex(corners[i]), at);
            soup.builder.check_point_count(at);
        }
        soup.builder.end_face(at);
        soup.has_one_layer = soup.has_one_layer && (!soup.has_faces || soup.layer == entity.layer);
        soup.layer = entity.layer;
        soup.has_faces = true;
    }

    struct Polyline {
        Common entity;
        std::int64_t flags = 0;
        std::int64_t m = 0;
        std::int64_t n = 0;
        const char* at = nullptr;
    };

    void read_polyline(DxfBlock& block) {
        Polyline line;
        line.at = pairs_.at();
        std::int64_t smooth = 0;
        for (pairs_.next(); pairs_.code() != 0; pairs_.next()) {
            common(line.entity);
            if (pairs_.code() == 70) line.flags = pairs_.integer();
            if (pairs_.code() == 71) line.m = pairs_.integer();
            if (pairs_.code() == 72) line.n = pairs_.integer();
            if (pairs_.code() == 75) smooth = pairs_.integer();
        }
        const bool is_mesh = (line.flags & (polygon_mesh | polyface_mesh)) != 0;
        if (is_mesh && smooth != 0)
            throw UnsupportedError(pairs_.source().place(line.at).to_string() +
                                   ": POLYLINE that is smoothed is not read");
        MeshBuilder builder(pairs_.source(), 1);
        while (pairs_.is(0, "VERTEX")) read_vertex(builder, line);
        if (!pairs_.is(0, "SEQEND")) pairs_.fail("VERTEX or SEQEND expected");
        skip_entity();
        if (!is_mesh || line.entity.is_on_paper) return;
        if ((line.flags & polyface_mesh) == 0) add_grid(builder, line);
        PolygonMesh mesh = builder.finish();
        if (mesh.face_count() != 0) block.parts.push_back({line.entity.layer, std::move(mesh), {}});
    }

    void read_vertex(MeshBuilder& builder, const Polyline& line) {
        const char* at = pairs_.at();
        Point3d point{};
        std::int64_t flags = 0;
        std::array<std::int64_t, 4> corners{};
        for (pairs_.next(); pairs_.code() != 0; pairs_.next()) {
            coordinate(point, 10);
            if (pairs_.code() == 70) flags = pairs_.integer();
            if (pairs_.code() >= 71 && pairs_.code() <= 74)
                corners[static_cast<std::size_t>(pairs_.code() - 71)] = pairs_.integer();
        }
        const bool is_mesh = (line.flags & (polygon_mesh | polyface_mesh)) != 0;
        if (!is_mesh) return;
        const bool is_face = (line.flags & polyface_mesh) != 0 && (flags & polyface_record) != 0 &&
                             (flags & polyface_mesh) == 0;
        if (!is_face) return builder.add_point(point, at);
        // A number below zero hides the side that begins there; two corners are a line.
        if (corners[2] == 0) return;
        for (const std::int64_t c : corners) {
            if (c == 0) break;
            const auto number =
                c < 0 ? 0 - static_cast<std::uint64_t>(c) : static_cast<std::uint64_t>(c);
            builder.add_corner(number - 1, at);
        }
        builder.end_face(at);
    }

    void add_grid(MeshBuilder& builder, const Polyline& line) const {
        const std::uint64_t count = builder.point_count();
        const auto m = static_cast<std::uint64_t>(line.m);
        const auto n = static_cast<std::uint64_t>(line.n);
        const bool is_grid =
            line.m >= 2 && line.n >= 2 && m <= count && n <= count && m * n == count;
        if (!is_grid)
            pairs_.source().fail(line.at, "a polygon mesh of " + std::to_string(line.m) + " by " +
                                              std::to_string(line.n) + " has " +
                                              std::to_string(count) + " vertices");
        const std::uint64_t rows = (line.flags & closed_in_m) != 0 ? m : m - 1;
        const std::uint64_t columns = (line.flags & closed_in_n) != 0 ? n : n - 1;
        for (std::uint64_t i = 0; i < rows; ++i) {
            for (std::uint64_t j = 0; j < columns; ++j) {
                const std::uint64_t below = (i + 1) % m;
                const std::uint64_t right = (j + 1) % n;
                for (const std::uint64_t c :
                     {i * n + j, below * n + j, below * n + right, i * n + right})
                    builder.add_corner(c, line.at);
                builder.end_face(line.at);
            }
        }
    }

    void read_mesh_entity(DxfBlock& block) {
        const char* at = pairs_.at();
        MeshBuilder builder(pairs_.source(), 0);
        Common entity;
        std::optional<Point3d> point;
        std::vector<std::int64_t> faces;
        std::int64_t list = 0;
        std::int64_t level = 0;
        std::int64_t left = 0;
        for (pairs_.next(); pairs_.code() != 0; pairs_.next()) {
            const int code = pairs_.code();
            common(entity);
            if (code == 91) level = pairs_.integer();
            if (code >= 92 && code <= 95) {
                list = code;
                left = code == 93 ? pairs_.integer() : 0;
            }
            if (list == 92 && code == 10) {
                if (point) builder.add_point(*point, at);
                point = Point3d{};
            }
            if (list == 92 && point) coordinate(*point, 10);
            if (list == 93 && code == 90 && left > 0) {
                faces.push_back(pairs_.integer());
                --left;
            }
        }
        if (point) builder.add_point(*point, at);
        if (level > 0)
            throw UnsupportedError(pairs_.source().place(at).to_string() + ": MESH with " +
                                   std::to_string(level) + " levels of subdivision is not read");
        if (left > 0) pairs_.source().fail(at, "a MESH with fewer corners than it states");
        for (std::size_t i = 0; i < faces.size();) {
            const std::int64_t corners = faces[i++];
            if (corners < 3 || static_cast<std::uint64_t>(corners) > faces.size() - i)
                pairs_.source().fail(at,
                                     "a face of MESH with " + std::to_string(corners) + " corners");
            for (std::int64_t c = 0; c < corners; ++c, ++i) {
                if (faces[i] < 0) pairs_.source().fail(at, "a vertex of MESH below 0");
                builder.add_corner(static_cast<std::uint64_t>(faces[i]), at);
            }
            builder.end_face(at);
        }
        PolygonMesh mesh = builder.finish();
        if (!entity.is_on_paper && mesh.face_count() != 0)
            block.parts.push_back({entity.layer, std::move(mesh), {}});
    }

    void read_insert(DxfBlock& block) {
        DxfInsert made;
        made.at = pairs_.at();
        Common entity;
        for (pairs_.next(); pairs_.code() != 0; pairs_.next()) {
            const int code = pairs_.code();
            common(entity);
            coordinate(made.at_point, 10);
            coordinate(made.extrusion, 210);
            if (code == 2) made.block = pairs_.value();
            if (code >= 41 && code <= 43)
                made.scale[static_cast<std::size_t>(code - 41)] = pairs_.real();
            if (code == 44) made.column_spacing = pairs_.real();
            if (code == 45) made.row_spacing = pairs_.real();
            if (code == 50) made.degrees = pairs_.real();
            if (code == 70) made.columns = pairs_.integer();
            if (code == 71) made.rows = pairs_.integer();
        }
        if (!entity.is_on_paper) block.inserts.push_back(std::move(made));
    }

    DxfPairs pairs_;
    DxfFile file_;
};

}  // namespace

DxfFile read_dxf_blocks(const InputText& source) { return DxfBlockReader(source).read(); }

}  // namespace trisect::detail
