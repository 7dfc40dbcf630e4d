// SPDX-License-Identifier: Apache-2.0
//
// The files of the public collection of queries of continuous collision detection
// (github.com/Continuous-Collision-Detection/Sample-Queries): rational coordinates, known answers.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <trisect/bsp/interference/moving_points.h>

namespace ccd {

// Eight rows: four points at s = 0, then the same points at s = 1. A vertex and three corners of a
// face, or two ends of an edge and two of another.
struct Query {
    std::array<trisect::LinearPath, 4> points;
    bool is_contact = false;
};

struct File {
    std::string name;
    bool is_edge_edge = false;
    std::vector<Query> queries;
};

// The files in $TRISECT_MODELS/ccd by name; empty when there is no such folder.
std::vector<std::filesystem::path> find_files();

// Throws std::runtime_error with file and line for anything that is not such a file.
File read_file(const std::filesystem::path& path);

std::optional<trisect::AlgebraicNumber> first_contact(const File& file, const Query& query);

}  // namespace ccd
