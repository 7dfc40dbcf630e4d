// SPDX-License-Identifier: Apache-2.0

#include "ccd_file.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace ccd {

namespace {

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    if (!fields.empty() && !fields.back().empty() && fields.back().back() == '\r')
        fields.back().pop_back();
    return fields;
}

}  // namespace

std::vector<std::filesystem::path> find_files() {
    std::vector<std::filesystem::path> files;
    const char* models = std::getenv("TRISECT_MODELS");
    if (models == nullptr) return files;
    const std::filesystem::path folder = std::filesystem::path(models) / "ccd";
    if (!std::filesystem::is_directory(folder)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".csv") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

File read_file(const std::filesystem::path& path) {
    File file;
    file.name = path.stem().string();
    file.is_edge_edge = file.name.find("edge-edge") != std::string::npos;
    std::ifstream stream(path);
    std::string line;
    std::size_t row = 0;
    for (; std::getline(stream, line); ++row) {
        const std::vector<std::string> f = split(line);
        if (f.size() != 7)
            throw std::runtime_error(path.string() + ":" + std::to_string(row + 1) +
                                     ": seven columns expected");
        if (row % 8 == 0) file.queries.emplace_back().is_contact = f[6] == "1";
        trisect::LinearPath& point = file.queries.back().points[row % 4];
        auto& place = row % 8 < 4 ? point.from : point.to;
        for (std::size_t i = 0; i < 3; ++i)
            place[i] = trisect::ExactRational::from_string(f[2 * i]) /
                       trisect::ExactRational::from_string(f[2 * i + 1]);
    }
    if (row == 0 || row % 8 != 0)
        throw std::runtime_error(path.string() + ": eight rows a query expected");
    return file;
}

std::optional<trisect::AlgebraicNumber> first_contact(const File& file, const Query& query) {
    const auto& p = query.points;
    if (file.is_edge_edge) return trisect::first_contact({p[0], p[1]}, {p[2], p[3]});
    return trisect::first_contact(p[0], {p[1], p[2], p[3]});
}

}  // namespace ccd
