// SPDX-License-Identifier: Apache-2.0
//
// CGAL's readers of mesh files as a peer, compiled where CGAL is found.
#pragma once

#include <cstddef>
#include <filesystem>

namespace cgal_readers {

/// The faces of the file as a Surface_mesh (CGAL::IO::read_polygon_mesh); 0 when CGAL refuses.
[[nodiscard]] std::size_t read_mesh(const std::filesystem::path& file);
/// The same as points and lists of indices (CGAL::IO::read_polygon_soup), its quickest way.
[[nodiscard]] std::size_t read_soup(const std::filesystem::path& file);

}  // namespace cgal_readers
