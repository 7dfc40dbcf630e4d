// SPDX-License-Identifier: Apache-2.0
#include "piecewise_import.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/kernel/error.h>

#include "piecewise_file.h"
#include "triangle_stream.h"

namespace trisect::app {

namespace {

// Polygons that are cut into triangles together.
constexpr std::size_t corners_at_once = 16384;
constexpr std::size_t numbers_at_once = std::size_t{1} << 16;
// After which mapped memory is given back, so that what a process has is not as large as the file.
constexpr std::size_t bytes_of_a_text = std::size_t{1} << 25;
constexpr std::size_t faces_of_a_mapping = std::size_t{1} << 21;

std::string_view bytes_of(const InputFile& file) {
    return file.size() == 0 ? std::string_view() : std::string_view(file.mapped(), file.size());
}

ReadOptions without_limits() {
    ReadOptions out;
    out.limits.bytes = out.limits.faces = std::numeric_limits<std::uint64_t>::max();
    out.limits.vertices = std::numeric_limits<std::uint32_t>::max();
    return out;
}

/// Points as they are in memory, and of each face how many corners it has and which.
class PointsAndFaces final : public MeshSink {
public:
    PointsAndFaces(const InputFile& from, const std::string& points, const std::string& faces)
        : from_(from), points_(points), faces_(faces) {}
    void take(const PolygonMesh& piece) override {
        has_points_ = has_points_ || !piece.points.empty();
        has_faces_ = has_faces_ || piece.face_count() != 0;
        points_.write(piece.points.data(), piece.points.size() * sizeof(Point3d));
        written_ +=
            piece.points.size() * sizeof(Point3d) + piece.corners.size() * sizeof(std::uint32_t);
        if (written_ >= bytes_of_a_text) {
            from_.release();
            written_ = 0;
        }
        for (std::size_t f = 0; f < piece.face_count(); ++f) {
            const auto face = piece.face(f);
            faces_.write(static_cast<std::uint32_t>(face.size()));
            faces_.write(face.data(), face.size_bytes());
        }
    }
    /// A text that was cut among its points would be an empty solid.
    [[nodiscard]] bool lacks_faces() const { return has_points_ && !has_faces_; }
    void finish() {
        points_.finish();
        faces_.finish();
    }

private:
    const InputFile& from_;
    OutputStream points_;
    OutputStream faces_;
    std::size_t written_ = 0;
    bool has_points_ = false;
    bool has_faces_ = false;
};

/// Numbers of a file, one after the other.
class Numbers {
public:
    explicit Numbers(const std::string& name) : file_(name), left_(file_.size() / size) {}
    bool next(std::uint32_t& out) {
        if (at_ == numbers_.size() && !read()) return false;
        out = numbers_[at_++];
        return true;
    }

private:
    static constexpr std::uint64_t size = sizeof(std::uint32_t);
    bool read() {
        numbers_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(left_, numbers_at_once)));
        file_.read(file_.size() - left_ * size,
                   {reinterpret_cast<char*>(numbers_.data()), numbers_.size() * size});
        left_ -= numbers_.size();
        at_ = 0;
        return !numbers_.empty();
    }

    InputFile file_;
    std::uint64_t left_;
    std::vector<std::uint32_t> numbers_;
    std::size_t at_ = 0;
};

/// Faces with their corners, as triangles.
class TriangleWriter {
public:
    TriangleWriter(const std::string& name, const std::string& points, const std::string& output)
        : name_(name), points_(points), bytes_(bytes_of(points_)), out_(output) {}

    void add(const std::vector<std::uint32_t>& face) {
        if (++faces_ % faces_of_a_mapping == 0) points_.release();
        if (face.size() == 3) {
            for (const std::uint32_t corner : face) out_.write(point(corner));
            return;
        }
        std::vector<std::uint32_t> own;
        for (const std::uint32_t corner : face) {
            own.push_back(static_cast<std::uint32_t>(polygons_.points.size()));
            polygons_.points.push_back(point(corner));
        }
        polygons_.add_face(own);
        if (polygons_.points.size() >= corners_at_once) cut_polygons();
    }
    void finish() {
        cut_polygons();
        out_.finish();
    }

private:
    [[nodiscard]] Point3d point(std::uint32_t number) const {
        Point3d out;
        std::memcpy(&out, bytes_.data() + std::uint64_t{number} * sizeof out, sizeof out);
        for (double& x : out) x += 0.0;
        return out;
    }
    // Each by itself, as in the whole mesh.
    void cut_polygons() {
        ImportOptions options;
        options.require_closed = false;
        options.threads = 1;
        const ImportedMesh imported = import_mesh(std::exchange(polygons_, {}), options);
        if (!imported.report.lattice.lossless)
            throw LimitError(name_ + ": coordinates span more than 126 bits");
        const LatticeMesh& mesh = imported.mesh;
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t corner : triangle) {
                Point3d p{};
                for (int k = 0; k < 3; ++k)
                    p[static_cast<std::size_t>(k)] =
                        mesh.lattice.to_double(mesh.points[corner][k].to_double()) + 0.0;
                out_.write(p);
            }
    }

    const std::string& name_;
    InputFile points_;
    std::size_t faces_ = 0;
    std::string_view bytes_;
    OutputStream out_;
    PolygonMesh polygons_;
};

MeshFormat format_of(const std::string& name, std::string_view bytes) {
    const MeshFormat format = mesh_format_of(name, bytes);
    return format == MeshFormat::Stl ? detect_stl_kind(bytes) : format;
}

}  // namespace

bool is_imported_in_pieces(const std::string& name) {
    const InputFile file(name);
    return is_read_in_pieces(format_of(name, bytes_of(file)));
}

std::uint64_t guessed_triangles(const std::string& name) {
    const InputFile file(name);
    switch (format_of(name, bytes_of(file))) {
        case MeshFormat::StlAscii:
            return file.size() / 200;
        case MeshFormat::StlBinary:
            return file.size() / 50;
        case MeshFormat::Ply:  // of either kind
            return file.size() / 30;
        default:
            return file.size() / 45;
    }
}

void import_in_pieces(const std::string& name, const std::string& output) {
    const std::string points = output + ".points";
    const std::string faces = output + ".faces";
    {
        const InputFile file(name);
        const std::string_view bytes = bytes_of(file);
        PointsAndFaces parts(file, points, faces);
        read_mesh_in_pieces(bytes, format_of(name, bytes), name, parts, without_limits());
        if (parts.lacks_faces())
            throw InputError({name, 0, 0, file.size()}, "the file ends without a face");
        parts.finish();
    }
    {
        TriangleWriter out(name, points, output);
        Numbers numbers(faces);
        std::vector<std::uint32_t> face;
        for (std::uint32_t n = 0; numbers.next(n);) {
            face.resize(n);
            for (std::uint32_t& corner : face) (void)numbers.next(corner);
            out.add(face);
        }
        out.finish();
    }
    std::filesystem::remove(points);
    std::filesystem::remove(faces);
}

}  // namespace trisect::app
