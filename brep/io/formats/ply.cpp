// SPDX-License-Identifier: Apache-2.0
//
// Reading PLY (G. Turk, The PLY Polygon File Format, 1994) in its three encodings.
//
// The header is a schema, so the body is read by walking it: every entry of every element, every
// property, taking x, y, z of `vertex` and the index list of `face` and skipping the rest. The walk
// is written once over a source of values; one source reads words, the other bytes. The naive
// reader trusts the counts; here an element whose stated entries cannot fit in the rest of the file
// is refused before anything is allocated, and the length of each list is checked likewise.
//
// Leniencies: any scalar types for coordinates and any integer types for indices, any additional
// properties and elements in any order; faces before vertices; `vertex_index` or `vertex_indices`;
// no face element at all (a mesh without faces). In ASCII each entry stands on its own line, blank
// lines are skipped, and the text of a number counts, not the type that the header declares: `0.1`
// under `float` is the double nearest to 0.1. Refused: triangle strips, which would be dropped in
// silence otherwise; more values on a line than the header says; anything but white space (binary:
// or zero bytes) after the last entry.
#include <trisect/brep/io/formats/binary.h>
#include <trisect/brep/io/formats/formats.h>
#include <trisect/brep/io/formats/mesh_builder.h>
#include <trisect/brep/io/formats/ply_header.h>
#include <trisect/brep/io/formats/quick_items.h>
#include <trisect/brep/io/formats/quick_loop.h>
#include <trisect/brep/io/formats/quick_text.h>
#include <trisect/brep/io/formats/text_cursor.h>
#include <trisect/brep/io/formats/trailing.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace trisect::detail {
namespace {

/// What a property means for the mesh.
enum class Role : std::uint8_t { X = 0, Y = 1, Z = 2, Indices, Other };

/// Values written as words; an entry is a line.
class TextValues {
public:
    TextValues(const InputText& source, const char* body)
        : source_(source), text_(source, TextRules{}, body), quick_(source) {}

    /// Adds plain entries from number i on and returns the number of the first other one.
    std::uint64_t quick_entries(const PlyElement& element, const std::vector<Role>& roles,
                                std::uint64_t i, MeshBuilder& mesh) {
        const bool faces = roles.size() == 1 && roles[0] == Role::Indices;
        const bool vertices = element.name == "vertex" &&
                              std::none_of(element.properties.begin(), element.properties.end(),
                                           [](const PlyProperty& p) { return p.is_list; });
        if (!faces && !vertices) return i;
        const char* line = text_.after_line();
        for (; i < element.count && line < quick_.end(); ++i, line = quick_.here()) {
            quick_.begin(line);
            if (faces ? !quick_loop(quick_, mesh) : !quick_vertex(roles, line, mesh)) break;
            ++quick_items;
        }
        text_.resume_at(line);
        return i;
    }

    static std::uint64_t least_size(PlyType) noexcept { return 2; }  // a digit and a separator
    [[nodiscard]] const char* here() const noexcept { return text_.here(); }
    [[nodiscard]] const char* last() const noexcept { return text_.last_number(); }

    void begin_entry() {
        if (!text_.seek_word()) source_.fail(source_.end(), "the file ends inside its data");
    }
    void end_entry() { text_.expect_line_end(); }
    double real(PlyType) { return text_.real("a coordinate"); }
    std::uint64_t count(PlyType) { return text_.count("a count or an index"); }
    void skip(PlyType, std::uint64_t n) {
        for (; n > 0; --n) (void)text_.any_real("a value");
    }
    void end() {
        if (text_.seek_word()) source_.fail(text_.here(), "more text after the last entry");
    }

private:
    bool quick_vertex(const std::vector<Role>& roles, const char* line, MeshBuilder& mesh) {
        std::array<double, 4> values;  // x, y, z and what is ignored
        for (const Role role : roles) {
            const std::size_t place = std::min<std::size_t>(static_cast<std::size_t>(role), 3);
            if (!quick_.number(values[place])) return false;
        }
        if (!quick_.line_end()) return false;
        mesh.add_point({values[0], values[1], values[2]}, line);
        return true;
    }

    const InputText& source_;
    TextCursor text_;
    QuickText quick_;
};

/// Values as bytes.
template <bool Big>
class ByteValues {
public:
    ByteValues(const InputText& source, const char* body) : source_(source), here_(body) {}

    static std::uint64_t quick_entries(const PlyElement&, const std::vector<Role>&, std::uint64_t i,
                                       MeshBuilder&) noexcept {
        return i;
    }
    static std::uint64_t least_size(PlyType type) noexcept { return size_of(type); }
    [[nodiscard]] const char* here() const noexcept { return here_; }
    [[nodiscard]] const char* last() const noexcept { return last_; }

    void begin_entry() const noexcept {}
    void end_entry() const noexcept {}

    double real(PlyType type) {
        const char* at = take(size_of(type));
        double value = 0;
        with_type(type, [&](auto t) { value = static_cast<double>(load<decltype(t), Big>(at)); });
        if (!std::isfinite(value)) source_.fail(at, "a coordinate that is not finite");
        return value;
    }

    std::uint64_t count(PlyType type) {
        const char* at = take(size_of(type));
        std::uint64_t value = 0;
        bool negative = false;
        with_type(type, [&](auto t) {
            const auto loaded = load<decltype(t), Big>(at);
            negative = loaded < decltype(t){};
            value = static_cast<std::uint64_t>(loaded);
        });
        if (negative) source_.fail(at, "a count or an index that is negative");
        return value;
    }

    void skip(PlyType type, std::uint64_t n) {
        if (n > left() / size_of(type)) fail_short();
        here_ += n * size_of(type);
    }

    void end() const { refuse_trailing_bytes(source_, here_, "the last entry"); }

private:
    template <class Function>
    static void with_type(PlyType type, const Function& f) {
        switch (type) {
            case PlyType::Int8:
                return f(std::int8_t{});
            case PlyType::UInt8:
                return f(std::uint8_t{});
            case PlyType::Int16:
                return f(std::int16_t{});
            case PlyType::UInt16:
                return f(std::uint16_t{});
            case PlyType::Int32:
                return f(std::int32_t{});
            case PlyType::UInt32:
                return f(std::uint32_t{});
            case PlyType::Int64:
                return f(std::int64_t{});
            case PlyType::UInt64:
                return f(std::uint64_t{});
            case PlyType::Float32:
                return f(float{});
            case PlyType::Float64:
                return f(double{});
        }
    }

    [[nodiscard]] std::uint64_t left() const noexcept {
        return static_cast<std::uint64_t>(source_.end() - here_);
    }
    const char* take(std::uint64_t n) {
        if (n > left()) fail_short();
        last_ = here_;
        here_ += n;
        return last_;
    }
    [[noreturn]] void fail_short() const {
        source_.fail(source_.end(), "the file ends inside its data");
    }

    const InputText& source_;
    const char* here_;
    const char* last_ = nullptr;
};

Role role_of(const PlyElement& element, const PlyProperty& p) {
    if (element.name == "vertex") {
        if (p.name == "x") return Role::X;
        if (p.name == "y") return Role::Y;
        if (p.name == "z") return Role::Z;
    }
    const bool indices = p.name == "vertex_indices" || p.name == "vertex_index";
    return element.name == "face" && indices ? Role::Indices : Role::Other;
}

/// Checks that `element` has each of the properties that give it a meaning once, of a usable kind.
std::vector<Role> checked_roles(const InputText& source, const PlyElement& element) {
    std::vector<Role> roles;
    for (const PlyProperty& p : element.properties) {
        const Role role = role_of(element, p);
        if (role != Role::Other && std::count(roles.begin(), roles.end(), role) != 0) {
            source.fail(p.at, "a second property of the meaning of " + shown_word(p.name));
        }
        if (role < Role::Indices && p.is_list) source.fail(p.at, "a coordinate that is a list");
        if (role == Role::Indices && !(p.is_list && is_integer(p.type))) {
            source.fail(p.at, "vertex indices that are not a list of integers");
        }
        roles.push_back(role);
    }
    const auto has = [&](Role r) { return std::count(roles.begin(), roles.end(), r) != 0; };
    if (element.name == "vertex" && !(has(Role::X) && has(Role::Y) && has(Role::Z))) {
        source.fail(element.at, "vertices without x, y and z");
    }
    if (element.name == "face" && element.count != 0 && !has(Role::Indices)) {
        source.fail(element.at, "faces without a list 'vertex_indices'");
    }
    return roles;
}

template <class Values>
class BodyReader {
public:
    BodyReader(const InputText& source, const PlyHeader& header)
        : source_(source), header_(header), values_(source, header.body), mesh_(source, 0) {}

    PolygonMesh read(const std::vector<std::vector<Role>>& roles) {
        for (std::size_t e = 0; e < header_.elements.size(); ++e) {
            element(header_.elements[e], roles[e]);
        }
        values_.end();
        return mesh_.finish();
    }

private:
    void element(const PlyElement& element, const std::vector<Role>& roles) {
        if (element.properties.empty()) return;  // its entries take no room
        check_count(element);
        const auto quick = [&](std::uint64_t i) {
            return values_.quick_entries(element, roles, i, mesh_);
        };
        for (std::uint64_t i = quick(0); i < element.count; i = quick(i + 1)) entry(element, roles);
    }

    /// Refuses a count that the rest of the file cannot hold, and makes room for a possible one.
    void check_count(const PlyElement& element) {
        const auto left = static_cast<std::uint64_t>(source_.end() - values_.here()) + 1;
        std::uint64_t least = 0;
        for (const PlyProperty& p : element.properties) {
            least += Values::least_size(p.is_list ? p.count_type : p.type);
        }
        if (element.count > left / least) {
            source_.fail(source_.end(), "the header states " + std::to_string(element.count) +
                                            " entries of " + shown_word(element.name) +
                                            ", more than the rest of the file can hold");
        }
        if (element.name == "vertex") mesh_.reserve(element.count, 0, 0);
        // A face with its three indices takes at least four bytes.
        const std::uint64_t faces = std::min(element.count, left / 4);
        if (element.name == "face") mesh_.reserve(0, faces, 3 * faces);
    }

    void entry(const PlyElement& element, const std::vector<Role>& roles) {
        values_.begin_entry();
        const char* at = values_.here();
        Point3d point{};
        for (std::size_t k = 0; k < roles.size(); ++k) {
            const PlyProperty& p = element.properties[k];
            if (roles[k] < Role::Indices) {
                point[static_cast<std::size_t>(roles[k])] = values_.real(p.type);
            } else if (roles[k] == Role::Indices) {
                face(p, at);
            } else {
                values_.skip(p.type, p.is_list ? values_.count(p.count_type) : 1);
            }
        }
        values_.end_entry();
        if (element.name == "vertex") mesh_.add_point(point, at);
    }

    void face(const PlyProperty& p, const char* at) {
        const std::uint64_t n = values_.count(p.count_type);
        for (std::uint64_t i = 0; i < n; ++i) {
            const std::uint64_t index = values_.count(p.type);
            mesh_.add_corner(index, values_.last());
        }
        mesh_.end_face(at);
    }

    const InputText& source_;
    const PlyHeader& header_;
    Values values_;
    MeshBuilder mesh_;
};

std::vector<std::vector<Role>> checked_roles(const InputText& source, const PlyHeader& header) {
    std::vector<std::vector<Role>> roles;
    bool vertices = false;
    for (const PlyElement& element : header.elements) {
        roles.push_back(checked_roles(source, element));
        vertices = vertices || element.name == "vertex";
        if (element.name == "tristrips" && element.count != 0) {
            source.fail(element.at, "triangle strips cannot be read");
        }
    }
    if (!vertices) source.fail(header.body, "the header has no element 'vertex'");
    return roles;
}

/// What nearly all binary files hold: vertices of scalars, x, y, z of one type among them, then
/// faces of nothing but a list of indices with a byte for the count.
struct CommonLayout {
    PlyType coordinate{};
    std::array<std::size_t, 3> offset{};
    std::size_t stride = 0;
    std::size_t vertices = 0;
    std::size_t faces = 0;
};

std::optional<CommonLayout> common_layout(const PlyHeader& header,
                                          const std::vector<std::vector<Role>>& roles) {
    if (header.elements.size() != 2) return std::nullopt;
    const PlyElement& vertex = header.elements[0];
    const PlyElement& face = header.elements[1];
    if (vertex.name != "vertex" || face.name != "face") return std::nullopt;
    CommonLayout out;
    bool known = false;
    for (std::size_t k = 0; k < vertex.properties.size(); ++k) {
        const PlyProperty& p = vertex.properties[k];
        if (p.is_list) return std::nullopt;
        if (roles[0][k] < Role::Indices) {
            if (is_integer(p.type) || (known && p.type != out.coordinate)) return std::nullopt;
            known = true;
            out.coordinate = p.type;
            out.offset[static_cast<std::size_t>(roles[0][k])] = out.stride;
        }
        out.stride += size_of(p.type);
    }
    if (face.properties.size() != 1 || roles[1][0] != Role::Indices) return std::nullopt;
    const PlyProperty& list = face.properties[0];
    const bool four_bytes = list.type == PlyType::Int32 || list.type == PlyType::UInt32;
    if (list.count_type != PlyType::UInt8 || !four_bytes) return std::nullopt;
    if (vertex.count > 0x7FFF'FFFFU || face.count > 0x4000'0000U) return std::nullopt;
    out.vertices = static_cast<std::size_t>(vertex.count);
    out.faces = static_cast<std::size_t>(face.count);
    return out;
}

/// Reads the common layout where nothing is wrong and all limits are far; gives up otherwise, and
/// BodyReader says what it is.
template <bool Big>
class QuickBody {
public:
    QuickBody(const InputText& source, const CommonLayout& layout, const char* body)
        : source_(source), layout_(layout), here_(body) {}

    std::optional<PolygonMesh> read() {
        const ReadLimits& limits = source_.limits();
        if (layout_.vertices > limits.vertices || layout_.faces > limits.faces) return std::nullopt;
        if (limits.loop_corners < 255 || layout_.stride == 0) return std::nullopt;
        if (layout_.vertices > left() / layout_.stride) return std::nullopt;
        const bool finite = layout_.coordinate == PlyType::Float64 ? points<double, std::uint64_t>()
                                                                   : points<float, std::uint32_t>();
        if (!finite || layout_.faces > left() / 13 || !faces()) return std::nullopt;
        refuse_trailing_bytes(source_, here_, "the last entry");
        quick_items += layout_.vertices + layout_.faces;
        return std::move(mesh_);
    }

private:
    [[nodiscard]] std::size_t left() const {
        return static_cast<std::size_t>(source_.end() - here_);
    }

    template <class Real, class Bits>
    bool points() {
        constexpr Bits infinity = std::bit_cast<Bits>(std::numeric_limits<Real>::infinity());
        Bits largest = 0;
        mesh_.points.resize(layout_.vertices);
        for (Point3d& p : mesh_.points) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto bits = load<Bits, Big>(here_ + layout_.offset[k]);
                largest = std::max(largest, static_cast<Bits>(bits << 1));
                p[k] = static_cast<double>(std::bit_cast<Real>(bits));
            }
            here_ += layout_.stride;
        }
        return largest < static_cast<Bits>(infinity << 1);
    }

    bool faces() {
        mesh_.face_begin.resize(layout_.faces + 1);
        mesh_.corners.resize(3 * layout_.faces);
        std::uint32_t largest = 0;
        const std::size_t done = triangles(largest);
        mesh_.corners.resize(3 * done);
        if (!polygons(done + 1, largest)) return false;
        return largest < mesh_.points.size() || mesh_.corners.empty();
    }

    /// The leading triangles, which mostly are all there is.
    std::size_t triangles(std::uint32_t& largest) {
        std::uint32_t* corner = mesh_.corners.data();
        for (std::size_t f = 0; f < layout_.faces; ++f, here_ += 13) {
            if (left() < 13 || *here_ != 3) return f;
            for (std::size_t i = 0; i < 3; ++i, ++corner) {
                *corner = load<std::uint32_t, Big>(here_ + 1 + 4 * i);
                largest = std::max(largest, *corner);
            }
            mesh_.face_begin[f + 1] = static_cast<std::uint32_t>(3 * (f + 1));
        }
        return layout_.faces;
    }

    bool polygons(std::size_t first, std::uint32_t& largest) {
        for (std::size_t f = first; f <= layout_.faces; ++f) {
            if (left() == 0) return false;
            const auto n = load<std::uint8_t, Big>(here_);
            if (n < 3 || left() < 1 + 4 * std::size_t{n}) return false;
            ++here_;
            for (std::size_t i = 0; i < n; ++i, here_ += 4) {
                const auto index = load<std::uint32_t, Big>(here_);
                largest = std::max(largest, index);
                mesh_.corners.push_back(index);
            }
            if (mesh_.corners.size() > 0xFFFF'FFFFU) return false;
            mesh_.face_begin[f] = static_cast<std::uint32_t>(mesh_.corners.size());
        }
        return true;
    }

    const InputText& source_;
    const CommonLayout& layout_;
    const char* here_;
    PolygonMesh mesh_;
};

template <bool Big>
PolygonMesh read_bytes(const InputText& source, const PlyHeader& header,
                       const std::vector<std::vector<Role>>& roles) {
    const bool is_quick = source.allows_quick() && source.sink() == nullptr;
    if (const auto layout = common_layout(header, roles); layout && is_quick)
        if (auto mesh = QuickBody<Big>(source, *layout, header.body).read())
            return *std::move(mesh);
    return BodyReader<ByteValues<Big>>(source, header).read(roles);
}

}  // namespace

PolygonMesh read_ply(const InputText& source) {
    const PlyHeader header = read_ply_header(source);
    const auto roles = checked_roles(source, header);
    switch (header.encoding) {
        case PlyEncoding::Ascii:
            return BodyReader<TextValues>(source, header).read(roles);
        case PlyEncoding::BinaryLittleEndian:
            return read_bytes<false>(source.as_binary(), header, roles);
        case PlyEncoding::BinaryBigEndian:
            break;
    }
    return read_bytes<true>(source.as_binary(), header, roles);
}

}  // namespace trisect::detail
