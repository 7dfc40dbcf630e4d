// SPDX-License-Identifier: Apache-2.0
#include "piece.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include <trisect/brep/exact_rational.h>
#include <trisect/kernel/error.h>

#include "edge_balance.h"
#include "piecewise_file.h"

namespace trisect::app {

namespace {

PointName exact_name(const Point& point, Lattice lattice) {
    const HomogeneousPoint h = point.homogeneous();
    const ExactRational w(h.w);
    PointName out;
    for (const auto& x : h.xyz) {
        const ExactRational c = ExactRational(x) / w;
        out += c.scaled(lattice.exponent).to_string();
        out += ' ';
    }
    return out;
}

/// Of the walls, the edges without another triangle of a wall beside them, turned over: so they
/// run in the triangles of the boundary.
std::vector<DirectedEdge> outline_of(const ExactMesh& mesh, std::uint32_t window) {
    std::vector<DirectedEdge> edges;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.source[t].operand != window) continue;
        for (std::size_t i = 0; i < 3; ++i)
            edges.push_back({mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]});
    }
    return missing_edges(std::move(edges));
}

constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();

/// Numbers for the points that a piece has, in the order in which they are asked for.
class PointNumbers {
public:
    PointNumbers(const ExactMesh& mesh, Piece& piece)
        : mesh_(mesh), piece_(piece), number_(mesh.points.size(), no_number) {}

    std::uint32_t operator()(std::uint32_t point) {
        std::uint32_t& n = number_[point];
        if (n == no_number) {
            n = static_cast<std::uint32_t>(piece_.points.size());
            Point3d rounded = mesh_.points[point].nearest();
            for (double& x : rounded) x = mesh_.lattice.to_double(x) + 0.0;
            piece_.points.push_back(rounded);
        }
        return n;
    }

private:
    const ExactMesh& mesh_;
    Piece& piece_;
    std::vector<std::uint32_t> number_;
};

constexpr std::array<char, 8> piece_magic{'T', 'R', 'I', 'P', 'I', 'E', 'C', '1'};

struct PieceHeader {
    std::array<char, 8> magic{};
    std::uint64_t points = 0;
    std::uint64_t triangles = 0;
    std::array<std::uint64_t, 2> outline_bytes{};
};

std::string outline_bytes(const WallOutline& outline) {
    std::string out;
    const auto add = [&](const void* bytes, std::size_t n) {
        out.append(static_cast<const char*>(bytes), n);
    };
    const auto add_count = [&](std::uint64_t n) { add(&n, sizeof n); };
    add_count(outline.names.size());
    add_count(outline.edges.size());
    for (const PointName& n : outline.names) {
        add_count(n.size());
        out += n;
    }
    for (const DirectedEdge& e : outline.edges) add(e.data(), sizeof e);
    return out;
}

/// Numbers and texts from memory that may end too early.
class OutlineReader {
public:
    OutlineReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}
    std::string_view take(std::uint64_t n) {
        if (n > bytes_.size()) throw InputError({name_, 0, 0, 0}, "is damaged");
        const std::string_view out = bytes_.substr(0, n);
        bytes_.remove_prefix(n);
        return out;
    }
    std::uint64_t count() {
        std::uint64_t n = 0;
        std::memcpy(&n, take(sizeof n).data(), sizeof n);
        return n;
    }

private:
    std::string_view bytes_;
    const std::string& name_;
};

template <class T>
std::vector<T> records(const std::string& name, std::uint64_t offset, std::uint64_t begin,
                       std::uint64_t end) {
    std::vector<T> out(end - begin);
    if (out.empty()) return out;
    InputFile(name).read(offset + begin * sizeof(T),
                         {reinterpret_cast<char*>(out.data()), out.size() * sizeof(T)});
    return out;
}

}  // namespace

Piece piece_of(const ExactMesh& mesh, std::uint32_t window, std::size_t axis, double middle) {
    Piece piece;
    PointNumbers number(mesh, piece);
    const std::vector<DirectedEdge> edges = outline_of(mesh, window);
    for (const bool is_upper : {false, true}) {
        WallOutline& wall = is_upper ? piece.upper : piece.lower;
        for (const DirectedEdge& e : edges) {
            const double at = mesh.lattice.to_double(mesh.points[e[0]].nearest()[axis]);
            if ((at > middle) != is_upper) continue;
            for (const std::uint32_t p : e) {
                const std::size_t before = piece.points.size();
                if (number(p) == before)
                    wall.names.push_back(exact_name(mesh.points[p], mesh.lattice));
            }
            wall.edges.push_back({number(e[0]), number(e[1])});
        }
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.source[t].operand == window) continue;
        const auto& c = mesh.triangles[t];
        const std::uint32_t first = number(c[0]);
        const std::uint32_t second = number(c[1]);
        piece.triangles.push_back({first, second, number(c[2])});
    }
    return piece;
}

void write_piece(const std::string& name, const Piece& piece) {
    const std::array<std::string, 2> outlines{outline_bytes(piece.lower),
                                              outline_bytes(piece.upper)};
    OutputStream out(name);
    out.write(PieceHeader{piece_magic,
                          piece.points.size(),
                          piece.triangles.size(),
                          {outlines[0].size(), outlines[1].size()}});
    for (const std::string& o : outlines) out.write(o.data(), o.size());
    out.write(piece.points.data(), piece.points.size() * sizeof(Point3d));
    out.write(piece.triangles.data(), piece.triangles.size() * sizeof(piece.triangles[0]));
    out.finish();
}

PieceFile::PieceFile(std::string name) : name_(std::move(name)) {
    const InputFile file(name_);
    PieceHeader header;
    file.read(0, {reinterpret_cast<char*>(&header), sizeof header});
    points_ = header.points;
    triangles_ = header.triangles;
    outline_bytes_ = header.outline_bytes;
    const std::uint64_t all = file.size();
    if (header.magic != piece_magic || points_ > all || triangles_ > all ||
        outline_bytes_[0] > all || outline_bytes_[1] > all ||
        sizeof(PieceHeader) + outline_bytes_[0] + outline_bytes_[1] + points_ * sizeof(Point3d) +
                triangles_ * 12 !=
            all)
        throw InputError({name_, 0, 0, 0}, "is damaged");
}

WallOutline PieceFile::lower() const { return outline(0); }

WallOutline PieceFile::upper() const { return outline(1); }

WallOutline PieceFile::outline(std::size_t which) const {
    std::string bytes(outline_bytes_[which], '\0');
    InputFile(name_).read(sizeof(PieceHeader) + (which == 0 ? 0 : outline_bytes_[0]), bytes);
    OutlineReader reader(bytes, name_);
    WallOutline out;
    const std::uint64_t names = reader.count();
    const std::uint64_t edges = reader.count();
    for (std::uint64_t i = 0; i < names; ++i) out.names.emplace_back(reader.take(reader.count()));
    for (std::uint64_t i = 0; i < edges; ++i) {
        DirectedEdge e{};
        std::memcpy(e.data(), reader.take(sizeof e).data(), sizeof e);
        out.edges.push_back(e);
    }
    return out;
}

std::vector<Point3d> PieceFile::points(std::uint64_t begin, std::uint64_t end) const {
    return records<Point3d>(name_, sizeof(PieceHeader) + outline_bytes_[0] + outline_bytes_[1],
                            begin, end);
}

std::vector<std::array<std::uint32_t, 3>> PieceFile::triangles(std::uint64_t begin,
                                                               std::uint64_t end) const {
    return records<std::array<std::uint32_t, 3>>(
        name_,
        sizeof(PieceHeader) + outline_bytes_[0] + outline_bytes_[1] + points_ * sizeof(Point3d),
        begin, end);
}

}  // namespace trisect::app
