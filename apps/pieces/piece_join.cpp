// SPDX-License-Identifier: Apache-2.0
#include "piece_join.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <trisect/kernel/error.h>

#include "piece.h"
#include "piecewise_file.h"

namespace trisect::app {

namespace {

constexpr std::uint64_t joined_block = 65536;

bool ends_with(const std::string& name, std::string_view ending) {
    return std::string_view(name).ends_with(ending);
}

/// A piece whose points have numbers in the whole: those on its lower wall are the ones that the
/// piece below has on its upper wall.
struct PlacedPiece {
    PieceFile file;
    std::vector<std::uint64_t> lower;  ///< numbers of the points on the lower wall
    std::uint64_t first = 0;           ///< number of the first other point

    [[nodiscard]] std::uint64_t number_of(std::uint32_t point) const {
        return point < lower.size() ? lower[point] : first + point - lower.size();
    }
};

using WallEdge = std::array<std::uint64_t, 2>;

std::vector<WallEdge> wall_edges(const WallOutline& wall, const PlacedPiece& piece, bool turned) {
    std::vector<WallEdge> out;
    for (const auto& e : wall.edges) {
        WallEdge edge{piece.number_of(e[0]), piece.number_of(e[1])};
        if (turned) std::swap(edge[0], edge[1]);
        out.push_back(edge);
    }
    std::ranges::sort(out);
    return out;
}

class Placement {
public:
    explicit Placement(const std::vector<std::string>& names) {
        for (const std::string& name : names) place(name);
        if (!upper_.empty()) fail(pieces_.size());
    }
    [[nodiscard]] const std::vector<PlacedPiece>& pieces() const { return pieces_; }
    [[nodiscard]] const JoinedMesh& made() const { return made_; }

private:
    [[noreturn]] static void fail(std::size_t wall) {
        throw Error(ErrorCode::Internal,
                    fmt::format("the two sides of wall {} do not fit; please report this", wall));
    }
    void place(const std::string& name) {
        PlacedPiece piece{PieceFile(name), {}, made_.points};
        const WallOutline lower = piece.file.lower();
        for (const PointName& n : lower.names) {
            const auto at = numbers_.find(n);
            if (at == numbers_.end()) fail(pieces_.size());
            piece.lower.push_back(at->second);
        }
        if (wall_edges(lower, piece, true) != upper_) fail(pieces_.size());
        numbers_.clear();
        const WallOutline upper = piece.file.upper();
        for (const PointName& n : upper.names) numbers_.emplace(n, piece.first + numbers_.size());
        upper_ = wall_edges(upper, piece, false);
        made_.points += piece.file.point_count() - piece.lower.size();
        made_.wall_points += piece.lower.size();
        made_.triangles += piece.file.triangle_count();
        pieces_.push_back(std::move(piece));
    }

    std::vector<PlacedPiece> pieces_;
    std::unordered_map<PointName, std::uint64_t> numbers_;  // on the last piece's upper wall
    std::vector<WallEdge> upper_;
    JoinedMesh made_;
};

template <class Take>
void for_each_triangle(const PlacedPiece& piece, const Take& take) {
    const std::uint64_t all = piece.file.triangle_count();
    for (std::uint64_t at = 0; at < all; at += joined_block)
        for (const auto& t : piece.file.triangles(at, std::min(all, at + joined_block))) take(t);
}

void write_ply(const Placement& placed, OutputStream& out) {
    if (placed.made().points > std::numeric_limits<std::uint32_t>::max())
        throw LimitError("the result has more points than PLY can number; write STL");
    const std::string header = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\n"
        "property double y\nproperty double z\nelement face {}\n"
        "property list uchar uint vertex_indices\nend_header\n",
        placed.made().points, placed.made().triangles);
    out.write(header.data(), header.size());
    for (const PlacedPiece& p : placed.pieces()) {
        const std::uint64_t all = p.file.point_count();
        for (std::uint64_t at = p.lower.size(); at < all; at += joined_block) {
            const auto points = p.file.points(at, std::min(all, at + joined_block));
            out.write(points.data(), points.size() * sizeof(points[0]));
        }
    }
    for (const PlacedPiece& p : placed.pieces())
        for_each_triangle(p, [&](const std::array<std::uint32_t, 3>& t) {
            std::array<char, 13> record{3};
            for (std::size_t i = 0; i < 3; ++i) {
                const auto n = static_cast<std::uint32_t>(p.number_of(t[i]));
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

void write_stl(const Placement& placed, OutputStream& out) {
    if (placed.made().triangles > std::numeric_limits<std::uint32_t>::max())
        throw LimitError("the result has more triangles than STL can count");
    std::array<char, 80> header{};
    std::memcpy(header.data(), "trisect", 7);
    out.write(header);
    out.write(static_cast<std::uint32_t>(placed.made().triangles));
    for (const PlacedPiece& p : placed.pieces()) {
        const std::vector<Point3d> points = p.file.points(0, p.file.point_count());
        for_each_triangle(p, [&](const std::array<std::uint32_t, 3>& t) {
            const std::array<Point3d, 3> corners{points[t[0]], points[t[1]], points[t[2]]};
            out.write(unit_normal(corners));
            for (const Point3d& c : corners) out.write(as_floats(c));
            out.write(std::uint16_t{0});
        });
    }
}

}  // namespace

bool can_join_into(const std::string& output) {
    return ends_with(output, ".ply") || ends_with(output, ".stl");
}

JoinedMesh join_pieces(const std::vector<std::string>& pieces, const std::string& output) {
    if (!can_join_into(output)) throw UsageError(output + ": pieces are joined into .ply or .stl");
    const Placement placed(pieces);
    OutputStream out(output);
    ends_with(output, ".ply") ? write_ply(placed, out) : write_stl(placed, out);
    out.finish();
    return placed.made();
}

}  // namespace trisect::app
