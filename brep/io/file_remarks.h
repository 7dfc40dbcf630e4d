// SPDX-License-Identifier: Apache-2.0
//
// FileRemark: a property of a file beside its mesh that deserves attention.
// Readers ignore all of it, so no remark ever changes a mesh.
#pragma once

#include <trisect/brep/io/mesh_format.h>
#include <trisect/kernel/error.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trisect {

enum class RemarkKind : std::uint8_t {
    FacetNormalMissing,  ///< STL: a facet's normal is zero, not finite or not there
    FacetNormalOpposed,  ///< STL: a facet's normal points away from where its corners wind
    EmptyIndexField      ///< OBJ: a corner such as `1/2/`, with nothing behind its last slash
};

/// The name in reports and JSON, such as "facet_normal_missing".
[[nodiscard]] std::string_view name_of(RemarkKind kind);

struct FileRemark {
    RemarkKind kind{};
    std::uint64_t count = 0;  ///< of facets or corners
    std::uint64_t of = 0;     ///< of so many
    FilePlace first;
    std::string sentence;
};

/// Remarks on a file that read_mesh accepts, one of each kind, in the order of RemarkKind. Which
/// side a normal points to is decided exactly; facets whose corners lie on a line have none.
/// `name` stands for the file in places. Cost: linear in the size of the file.
[[nodiscard]] std::vector<FileRemark> file_remarks(std::string_view data, MeshFormat format,
                                                   const std::string& name);

}  // namespace trisect
