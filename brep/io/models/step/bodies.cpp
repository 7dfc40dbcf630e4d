// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/step/bodies.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/formats/vertex_welder.h>
#include <trisect/brep/io/models/step/face_normal.h>
#include <trisect/brep/joined_loops.h>
#include <trisect/brep/winding_number.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>

namespace trisect::detail {
namespace {

/// A side of a face, sorted by its ends.
struct SideUse {
    std::uint64_t key = 0;  ///< the lesser end, the greater one
    bool is_forward = true;
    std::uint32_t face = 0;
    std::uint32_t loop = 0;
    std::uint32_t corner = 0;
};

std::uint64_t ends_key(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
}

/// Whether sides cancel by the numbers of their ends.
bool is_closed_by_numbers(const PolygonMesh& mesh) {
    std::vector<std::pair<std::uint64_t, int>> sides;
    sides.reserve(mesh.corners.size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::uint32_t a = face[i];
            const std::uint32_t b = face[(i + 1) % face.size()];
            sides.emplace_back(ends_key(a, b), a < b ? 1 : -1);
        }
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 0; i < sides.size();) {
        int sum = 0;
        const std::uint64_t key = sides[i].first;
        for (; i < sides.size() && sides[i].first == key; ++i) sum += sides[i].second;
        if (sum != 0) return false;
    }
    return true;
}

PolygonMesh welded(const PolygonMesh& mesh) {
    PolygonMesh out;
    VertexWelder welder(out.points, mesh.points.size());
    std::vector<std::uint32_t> numbers;
    numbers.reserve(mesh.points.size());
    for (const Point3d& p : mesh.points) numbers.push_back(welder.vertex(p));
    out.face_begin = mesh.face_begin;
    for (const std::uint32_t c : mesh.corners) out.corners.push_back(numbers[c]);
    return out;
}

class BodyMaker {
public:
    BodyMaker(const PolygonMesh& mesh, double uncertainty, const std::string& name)
        : mesh_(mesh), uncertainty_(uncertainty), name_(name) {}

    StepBodies make() {
        out_.points = mesh_.points;
        for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) add_face(f);
        connect_sides();
        collect_shells();
        nest();
        return std::move(out_);
    }

private:
    [[noreturn]] void refuse(std::uint32_t face, const std::string& why) const {
        throw UnsupportedError(name_ + ": STEP holds planar faces; face " + std::to_string(face) +
                               " " + why);
    }

    void add_face(std::uint32_t f) {
        check_stop();
        const auto polygon = mesh_.face(f);
        for (std::size_t i = 0; i < polygon.size(); ++i)
            if (mesh_.points[polygon[i]] == mesh_.points[polygon[(i + 1) % polygon.size()]])
                refuse(f, "has an edge without length");
        const auto normal = face_normal(mesh_.points, polygon);
        if (!normal) refuse(f, "has no area");
        const double distance = distance_from_plane(mesh_.points, polygon, *normal);
        if (polygon.size() > 3 && distance > uncertainty_)
            refuse(f, "has corners off its plane (triangulate the mesh first)");
        StepFace face;
        face.normal = *normal;
        face.loops = parted_loops(polygon);
        if (!has_outline_first(face)) face.loops = {IndexLoop(polygon.begin(), polygon.end())};
        for (const IndexLoop& loop : face.loops) face.edges.emplace_back(loop.size());
        out_.faces.push_back(std::move(face));
    }

    /// Puts the loop that runs around to the front; false unless there is exactly one.
    bool has_outline_first(StepFace& face) const {
        std::optional<std::size_t> outline;
        for (std::size_t l = 0; l < face.loops.size(); ++l) {
            const auto normal = face_normal(mesh_.points, face.loops[l]);
            if (!normal) return false;
            double side = 0;
            for (std::size_t k = 0; k < 3; ++k) side += (*normal)[k] * face.normal[k];
            if (side > 0 && outline) return false;
            if (side > 0) outline = l;
        }
        if (!outline) return false;
        std::rotate(face.loops.begin(), face.loops.begin() + static_cast<std::ptrdiff_t>(*outline),
                    face.loops.begin() + static_cast<std::ptrdiff_t>(*outline) + 1);
        return true;
    }

    std::uint32_t root(std::uint32_t f) {
        while (parents_[f] != f) f = parents_[f] = parents_[parents_[f]];
        return f;
    }

    /// One edge for each pair of sides that run against each other, and for each side that is left.
    void connect_sides() {
        std::vector<SideUse> uses;
        uses.reserve(mesh_.corners.size());
        for (std::uint32_t f = 0; f < out_.faces.size(); ++f) {
            for (std::uint32_t l = 0; l < out_.faces[f].loops.size(); ++l) {
                const IndexLoop& loop = out_.faces[f].loops[l];
                for (std::uint32_t i = 0; i < loop.size(); ++i) {
                    const std::uint32_t a = loop[i];
                    const std::uint32_t b = loop[(i + 1) % loop.size()];
                    uses.push_back({ends_key(a, b), a < b, f, l, i});
                }
            }
        }
        std::stable_sort(uses.begin(), uses.end(), [](const SideUse& a, const SideUse& b) {
            return a.key != b.key ? a.key < b.key : a.is_forward > b.is_forward;
        });
        parents_.resize(out_.faces.size());
        std::iota(parents_.begin(), parents_.end(), 0U);
        is_open_.assign(out_.faces.size(), false);
        for (std::size_t i = 0; i < uses.size();) {
            std::size_t end = i;
            while (end < uses.size() && uses[end].key == uses[i].key) ++end;
            connect_group(std::span(uses).subspan(i, end - i));
            i = end;
        }
    }

    /// Forward sides of one segment, then backward ones.
    void connect_group(std::span<const SideUse> group) {
        std::size_t forward = 0;
        while (forward < group.size() && group[forward].is_forward) ++forward;
        const std::size_t backward = group.size() - forward;
        const auto first = static_cast<std::uint32_t>(out_.edges.size());
        for (std::size_t i = 0; i < std::max(forward, backward); ++i) {
            out_.edges.push_back({static_cast<std::uint32_t>(group[0].key >> 32),
                                  static_cast<std::uint32_t>(group[0].key & 0xFFFF'FFFFU)});
            const bool is_pair = i < forward && i < backward;
            if (is_pair) parents_[root(group[i].face)] = root(group[forward + i].face);
        }
        for (std::size_t i = 0; i < group.size(); ++i) {
            const SideUse& use = group[i];
            const std::size_t number = use.is_forward ? i : i - forward;
            out_.faces[use.face].edges[use.loop][use.corner] = {
                first + static_cast<std::uint32_t>(number), use.is_forward};
            if (number >= std::min(forward, backward)) is_open_[use.face] = true;
        }
    }

    void collect_shells() {
        constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> shell_of(out_.faces.size(), none);
        for (std::uint32_t f = 0; f < out_.faces.size(); ++f) {
            std::uint32_t& shell = shell_of[root(f)];
            if (shell == none) {
                shell = static_cast<std::uint32_t>(out_.shells.size());
                out_.shells.emplace_back();
            }
            out_.shells[shell].faces.push_back(f);
            if (is_open_[f]) out_.shells[shell].is_closed = false;
        }
    }

    /// A shell as a mesh of its own on a lattice.
    struct Side {
        std::uint32_t shell = 0;
        ImportedMesh imported;
        Point3d low{};
        Point3d high{};
        std::vector<std::uint32_t> points;
    };

    Side side_of_shell(std::uint32_t number) const {
        Side out;
        out.shell = number;
        PolygonMesh mesh;
        mesh.points = out_.points;
        out.low.fill(std::numeric_limits<double>::infinity());
        out.high.fill(-std::numeric_limits<double>::infinity());
        std::vector<std::uint32_t> numbers;
        for (const std::uint32_t f : out_.shells[number].faces)
            for (const std::uint32_t c : mesh_.face(f)) out.points.push_back(c);
        std::sort(out.points.begin(), out.points.end());
        out.points.erase(std::unique(out.points.begin(), out.points.end()), out.points.end());
        mesh.points.clear();
        for (const std::uint32_t c : out.points) {
            mesh.points.push_back(out_.points[c]);
            for (std::size_t k = 0; k < 3; ++k) {
                out.low[k] = std::min(out.low[k], out_.points[c][k]);
                out.high[k] = std::max(out.high[k], out_.points[c][k]);
            }
        }
        for (const std::uint32_t f : out_.shells[number].faces) {
            numbers.clear();
            for (const std::uint32_t c : mesh_.face(f))
                numbers.push_back(static_cast<std::uint32_t>(
                    std::lower_bound(out.points.begin(), out.points.end(), c) -
                    out.points.begin()));
            mesh.add_face(numbers);
        }
        ImportOptions options;
        options.require_closed = false;
        out.imported = import_mesh(mesh, options);
        return out;
    }

    /// Exactly; by a point of the void that is not on the shell.
    [[nodiscard]] bool is_around(const Side& shell, const Side& hole) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (hole.low[k] < shell.low[k] || hole.high[k] > shell.high[k]) return false;
        for (const std::uint32_t c : hole.points) {
            ExactPoint p;
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = ExactRational::from_double(out_.points[c][k]);
            if (const auto winding = winding_number(shell.imported.mesh, p)) return *winding > 0;
        }
        return false;
    }

    void nest() {
        std::vector<Side> outer;
        std::vector<Side> holes;
        if (out_.shells.size() > 1) {
            for (std::uint32_t s = 0; s < out_.shells.size(); ++s) {
                if (!out_.shells[s].is_closed) continue;
                Side side = side_of_shell(s);
                (side.imported.report.inside_out ? holes : outer).push_back(std::move(side));
            }
        }
        std::vector<std::vector<std::uint32_t>> voids(out_.shells.size());
        std::vector<bool> is_void(out_.shells.size(), false);
        for (const Side& hole : holes) {
            check_stop();
            // Of shells around one void that do not cross, the innermost has no other one in it.
            const Side* best = nullptr;
            for (const Side& shell : outer)
                if (is_around(shell, hole) && (best == nullptr || is_around(*best, shell)))
                    best = &shell;
            if (best == nullptr) continue;
            voids[best->shell].push_back(hole.shell);
            is_void[hole.shell] = true;
        }
        for (std::uint32_t s = 0; s < out_.shells.size(); ++s)
            if (!is_void[s]) out_.bodies.push_back({s, std::move(voids[s])});
    }

    const PolygonMesh& mesh_;
    double uncertainty_;
    const std::string& name_;
    StepBodies out_;
    std::vector<std::uint32_t> parents_;  ///< of faces
    std::vector<bool> is_open_;           ///< by face
};

}  // namespace

StepBodies step_bodies(const PolygonMesh& mesh, double uncertainty, const std::string& name) {
    if (is_closed_by_numbers(mesh)) return BodyMaker(mesh, uncertainty, name).make();
    const PolygonMesh joined = welded(mesh);
    return BodyMaker(joined, uncertainty, name).make();
}

}  // namespace trisect::detail
