// SPDX-License-Identifier: Apache-2.0
//
// Helpers of the tests of readers and writers: reading literals, expecting errors with places, and
// a folder that goes away.
#pragma once

#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/kernel/error.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace trisect::io_test {

inline PolygonMesh read(const std::string& text, MeshFormat format, const ReadOptions& o = {}) {
    return read_mesh(text, format, "test", o);
}

/// The message of the InputError that reading must give; empty, with a failure, if it gives none.
inline std::string input_error(const std::string& text, MeshFormat format,
                               const ReadOptions& o = {}) {
    try {
        (void)read(text, format, o);
    } catch (const InputError& e) {
        return e.what();
    } catch (const std::exception& e) {
        ADD_FAILURE() << "another error: " << e.what();
        return {};
    }
    ADD_FAILURE() << "read without an error";
    return {};
}

/// Expects an InputError at "test:LINE:COLUMN" whose message contains `part`.
inline void expect_error_at(const std::string& text, MeshFormat format, const std::string& place,
                            const std::string& part) {
    const std::string message = input_error(text, format);
    EXPECT_TRUE(message.starts_with("test" + place + ": ")) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

inline std::vector<std::vector<std::uint32_t>> loops(const PolygonMesh& mesh) {
    std::vector<std::vector<std::uint32_t>> result;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        result.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
    }
    return result;
}

using Loops = std::vector<std::vector<std::uint32_t>>;

/// Equality of every bit, which tells -0.0 from 0.0.
inline bool same_bits(const PolygonMesh& a, const PolygonMesh& b) {
    if (a.face_begin != b.face_begin || a.corners != b.corners) return false;
    if (a.points.size() != b.points.size()) return false;
    for (std::size_t v = 0; v < a.points.size(); ++v) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (std::bit_cast<std::uint64_t>(a.points[v][i]) !=
                std::bit_cast<std::uint64_t>(b.points[v][i])) {
                return false;
            }
        }
    }
    return true;
}

inline PolygonMesh tetrahedron() {
    PolygonMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.add_triangle(0, 2, 1);
    mesh.add_triangle(0, 1, 3);
    mesh.add_triangle(1, 2, 3);
    mesh.add_triangle(2, 0, 3);
    return mesh;
}

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "trisect-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path_ = pattern;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::permissions(path_, std::filesystem::perms::owner_all, ignored);
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    [[nodiscard]] std::size_t entries() const {
        const std::filesystem::directory_iterator all(path_);
        return static_cast<std::size_t>(std::distance(begin(all), end(all)));
    }

private:
    std::filesystem::path path_;
};

}  // namespace trisect::io_test
