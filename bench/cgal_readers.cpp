// SPDX-License-Identifier: Apache-2.0

#include "cgal_readers.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

namespace cgal_readers {

namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

}  // namespace

std::size_t read_mesh(const std::filesystem::path& file) {
    CGAL::Surface_mesh<Point> mesh;
    return CGAL::IO::read_polygon_mesh(file.string(), mesh) ? mesh.number_of_faces() : 0;
}

std::size_t read_soup(const std::filesystem::path& file) {
    std::vector<Point> points;
    std::vector<std::vector<std::size_t>> faces;
    return CGAL::IO::read_polygon_soup(file.string(), points, faces) ? faces.size() : 0;
}

}  // namespace cgal_readers
