// SPDX-License-Identifier: Apache-2.0
//
// MeshGLP: triangles with properties of their vertices, in arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <vector>

#include <manifold/common.h>

// NOLINTBEGIN(readability-identifier-naming): names are those of another library
namespace manifold {

/// Each vertex has `numProp` numbers, of which the first three are its place. Vertices at one place
/// that differ in other properties are one where the merge vectors say so.
template <class Number, class Index>
struct MeshGLP {
    Index numProp = 3;
    std::vector<Number> vertProperties;
    std::vector<Index> triVerts;
    /// Pairs of vertices that are one vertex of the solid.
    std::vector<Index> mergeFromVert;
    std::vector<Index> mergeToVert;
    /// Triangles of one original after the other: where in triVerts each run begins, and the end;
    /// for each run the original's number, the columns of the 3x4 matrix that moved it, and flags;
    /// for each triangle the face of the original.
    std::vector<Index> runIndex;
    std::vector<std::uint32_t> runOriginalID;
    std::vector<Number> runTransform;
    std::vector<std::uint8_t> runFlags;
    std::vector<Index> faceID;
    /// Of smooth surfaces. Not supported: read over.
    std::vector<Number> halfedgeTangent;
    Number tolerance = 0;

    static constexpr std::uint8_t backside_flag = 1;
    static constexpr std::uint8_t normals_flag = 2;

    [[nodiscard]] Index NumVert() const {
        return static_cast<Index>(vertProperties.size()) / numProp;
    }
    [[nodiscard]] Index NumTri() const { return static_cast<Index>(triVerts.size() / 3); }
    [[nodiscard]] Index NumRun() const { return static_cast<Index>(runOriginalID.size()); }

    /// Joins open edges whose ends are at the same place, within the tolerance. False when nothing
    /// is open.
    bool Merge();

    [[nodiscard]] la::vec<Number, 3> GetVertPos(std::size_t v) const {
        return la::vec<Number, 3>(vertProperties.data() + v * numProp);
    }
    [[nodiscard]] la::vec<Index, 3> GetTriVerts(std::size_t t) const {
        return la::vec<Index, 3>(triVerts.data() + 3 * t);
    }
    [[nodiscard]] la::vec<Number, 4> GetTangent(std::size_t h) const {
        return la::vec<Number, 4>(halfedgeTangent.data() + 4 * h);
    }
    [[nodiscard]] mat3x4 GetRunTransform(std::size_t run) const {
        if (runTransform.size() < 12 * (run + 1)) return la::identity;
        return mat3x4(la::mat<Number, 3, 4>(runTransform.data() + 12 * run));
    }
    /// Whether the run's faces were turned over, as those of what was taken away.
    [[nodiscard]] bool Backside(std::size_t run) const { return has(run, backside_flag); }
    /// Whether the first three properties behind the place are normals of the run as it lies.
    [[nodiscard]] bool HasNormals(std::size_t run) const { return has(run, normals_flag); }

private:
    [[nodiscard]] bool has(std::size_t run, std::uint8_t flag) const {
        return run < runFlags.size() && (runFlags[run] & flag) != 0;
    }
};

/// Vertices and triangles of an OBJ file.
MeshGL64 ReadOBJ(std::istream& stream);
bool WriteOBJ(std::ostream& stream, const MeshGL64& mesh);

}  // namespace manifold
// NOLINTEND(readability-identifier-naming)
