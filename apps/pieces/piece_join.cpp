// SPDX-License-Identifier: Apache-2.0
#include "piece_join.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <trisect/kernel/error.h>

#include "piece.h"
#include "piecewise_file.h"

namespace trisect::app {

namespace {

constexpr std::uint64_t joined_block = 65536;
constexpr std::uint64_t ply_point_bytes = sizeof(Point3d);
constexpr std::uint64_t ply_face_bytes = 13;
constexpr std::uint64_t stl_header_bytes = 84;
constexpr std::uint64_t stl_face_bytes = 50;

bool ends_with(const std::string& name, std::string_view ending) {
    return std::string_view(name).ends_with(ending);
}

bool is_ply(const JoinFiles& files) { return ends_with(files.output, ".ply"); }

[[noreturn]] void fail_at_wall(std::size_t wall) {
    throw Error(ErrorCode::Internal,
                fmt::format("the two sides of wall {} do not fit; please report this", wall));
}

using WallEdge = std::array<std::uint32_t, 2>;

/// For each point of a lower wall, which point of the upper wall below it is.
using WallLink = std::vector<std::uint32_t>;

WallLink link_of(const WallOutline& lower, const WallOutline& below, std::size_t wall) {
    std::unordered_map<std::string_view, std::uint32_t> numbers;
    for (const PointName& n : below.names)
        numbers.emplace(n, static_cast<std::uint32_t>(numbers.size()));
    WallLink out;
    for (const PointName& n : lower.names) {
        const auto at = numbers.find(n);
        if (at == numbers.end()) fail_at_wall(wall);
        out.push_back(at->second);
    }
    return out;
}

void require_same_edges(const WallOutline& lower, const WallLink& link, const WallOutline& below,
                        std::uint32_t first_below, std::size_t wall) {
    std::vector<WallEdge> ours;
    std::vector<WallEdge> theirs;
    for (const WallEdge& e : lower.edges) ours.push_back({link[e[1]], link[e[0]]});
    for (const WallEdge& e : below.edges)
        theirs.push_back({e[0] - first_below, e[1] - first_below});
    std::ranges::sort(ours);
    std::ranges::sort(theirs);
    if (ours != theirs) fail_at_wall(wall);
}

/// A piece whose points have numbers in the whole: those on its lower wall are of the piece below.
struct PlacedPiece {
    PieceFile file;
    std::uint64_t lower = 0;        ///< how many points are on the lower wall
    std::uint64_t first_below = 0;  ///< number of the first point of the piece below
    std::uint64_t first = 0;        ///< number of the first other point
    std::uint64_t first_triangle = 0;
};

class Layout {
public:
    explicit Layout(const JoinFiles& files) : files_(files) {
        std::uint64_t first_below = 0;
        for (std::size_t i = 0; i < files.pieces.size(); ++i) {
            PlacedPiece piece{PieceFile(files.pieces[i]),
                              InputFile(files.links[i]).size() / sizeof(std::uint32_t), first_below,
                              made_.points, made_.triangles};
            first_below = made_.points;
            made_.points += piece.file.point_count() - piece.lower;
            made_.triangles += piece.file.triangle_count();
            made_.wall_points += piece.lower;
            pieces_.push_back(std::move(piece));
        }
    }
    [[nodiscard]] const JoinedMesh& made() const { return made_; }
    [[nodiscard]] const PlacedPiece& piece(std::size_t i) const { return pieces_[i]; }
    /// The pieces of a share: about so many triangles each, from the first to before the second.
    [[nodiscard]] std::array<std::size_t, 2> pieces_of(std::size_t share,
                                                       std::size_t shares) const {
        const auto begin_of = [&](std::size_t s) {
            const auto at = std::ranges::lower_bound(pieces_, made_.triangles * s / shares, {},
                                                     &PlacedPiece::first_triangle);
            return static_cast<std::size_t>(at - pieces_.begin());
        };
        return {begin_of(share), share + 1 == shares ? pieces_.size() : begin_of(share + 1)};
    }
    [[nodiscard]] WallLink link(std::size_t i) const {
        WallLink out(pieces_[i].lower);
        if (!out.empty())
            InputFile(files_.links[i])
                .read(0, {reinterpret_cast<char*>(out.data()), out.size() * sizeof(out[0])});
        return out;
    }

private:
    const JoinFiles& files_;
    std::vector<PlacedPiece> pieces_;
    JoinedMesh made_;
};

template <class Take>
void for_each_triangle(const PlacedPiece& piece, const Take& take) {
    const std::uint64_t all = piece.file.triangle_count();
    for (std::uint64_t at = 0; at < all; at += joined_block)
        for (const auto& t : piece.file.triangles(at, std::min(all, at + joined_block))) take(t);
}

std::string ply_header(const JoinedMesh& made) {
    return fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\n"
        "property double y\nproperty double z\nelement face {}\n"
        "property list uchar uint vertex_indices\nend_header\n",
        made.points, made.triangles);
}

void write_points(const PlacedPiece& p, OutputPart& out) {
    const std::uint64_t all = p.file.point_count();
    for (std::uint64_t at = p.lower; at < all; at += joined_block) {
        const auto points = p.file.points(at, std::min(all, at + joined_block));
        out.write(points.data(), points.size() * sizeof(points[0]));
    }
}

void write_faces(const PlacedPiece& p, const WallLink& link, OutputPart& out) {
    for_each_triangle(p, [&](const std::array<std::uint32_t, 3>& t) {
        std::array<char, ply_face_bytes> record{3};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto n = static_cast<std::uint32_t>(t[i] < p.lower ? p.first_below + link[t[i]]
                                                                     : p.first + t[i] - p.lower);
            std::memcpy(record.data() + 1 + 4 * i, &n, sizeof n);
        }
        out.write(record);
    });
}

std::array<float, 3> as_floats(const Point3d& p) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

std::array<float, 3> unit_normal(const std::array<Point3d, 3>& c) {
    Point3d u{};
    Point3d v{};
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = c[1][k] - c[0][k];
        v[k] = c[2][k] - c[0][k];
    }
    const Point3d n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    if (!(length > 0)) return {0, 0, 0};
    return as_floats({n[0] / length, n[1] / length, n[2] / length});
}

void write_stl(const PlacedPiece& p, OutputPart& out) {
    const std::vector<Point3d> points = p.file.points(0, p.file.point_count());
    for_each_triangle(p, [&](const std::array<std::uint32_t, 3>& t) {
        const std::array<Point3d, 3> corners{points[t[0]], points[t[1]], points[t[2]]};
        out.write(unit_normal(corners));
        for (const Point3d& c : corners) out.write(as_floats(c));
        out.write(std::uint16_t{0});
    });
}

}  // namespace

bool can_join_into(const std::string& output) {
    return ends_with(output, ".ply") || ends_with(output, ".stl");
}

PieceJoin::PieceJoin(JoinFiles files) : files_(std::move(files)) {
    if (!can_join_into(files_.output))
        throw UsageError(files_.output + ": pieces are joined into .ply or .stl");
}

void PieceJoin::link(std::size_t piece) const {
    const PieceFile file(files_.pieces[piece]);
    const bool is_last = piece + 1 == files_.pieces.size();
    if (is_last && !file.upper().edges.empty()) fail_at_wall(piece + 1);
    const WallOutline lower = file.lower();
    WallOutline below;
    std::uint32_t first_below = 0;
    if (piece != 0) {
        const PieceFile other(files_.pieces[piece - 1]);
        below = other.upper();
        first_below = static_cast<std::uint32_t>(other.lower().names.size());
    }
    const WallLink link = link_of(lower, below, piece);
    require_same_edges(lower, link, below, first_below, piece);
    OutputStream out(files_.links[piece]);
    out.write(link.data(), link.size() * sizeof(link[0]));
    out.finish();
}

JoinedMesh PieceJoin::begin() const {
    const JoinedMesh made = Layout(files_).made();
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (is_ply(files_) && made.points > most)
        throw LimitError("the result has more points than PLY can number; write STL");
    if (!is_ply(files_) && made.triangles > most)
        throw LimitError("the result has more triangles than STL can count");
    std::string header(stl_header_bytes, '\0');
    const auto triangles = static_cast<std::uint32_t>(made.triangles);
    header.replace(0, 7, "trisect");
    std::memcpy(header.data() + 80, &triangles, sizeof triangles);
    std::uint64_t bytes = stl_header_bytes + made.triangles * stl_face_bytes;
    if (is_ply(files_)) {
        header = ply_header(made);
        bytes = header.size() + made.points * ply_point_bytes + made.triangles * ply_face_bytes;
    }
    make_file(files_.unfinished, bytes);
    OutputPart out(files_.unfinished, 0);
    out.write(header.data(), header.size());
    out.finish();
    return made;
}

void PieceJoin::write(std::size_t share, std::size_t shares) const {
    const Layout layout(files_);
    const auto [begin, end] = layout.pieces_of(share, shares);
    if (begin == end) return;
    const PlacedPiece& first = layout.piece(begin);
    if (!is_ply(files_)) {
        OutputPart out(files_.unfinished, stl_header_bytes + first.first_triangle * stl_face_bytes);
        for (std::size_t i = begin; i < end; ++i) write_stl(layout.piece(i), out);
        out.finish();
        return;
    }
    const std::uint64_t header = ply_header(layout.made()).size();
    OutputPart points(files_.unfinished, header + first.first * ply_point_bytes);
    for (std::size_t i = begin; i < end; ++i) write_points(layout.piece(i), points);
    points.finish();
    OutputPart faces(files_.unfinished, header + layout.made().points * ply_point_bytes +
                                            first.first_triangle * ply_face_bytes);
    for (std::size_t i = begin; i < end; ++i) write_faces(layout.piece(i), layout.link(i), faces);
    faces.finish();
}

void PieceJoin::finish() const { rename_file(files_.unfinished, files_.output); }

}  // namespace trisect::app
