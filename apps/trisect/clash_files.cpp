// SPDX-License-Identifier: Apache-2.0
#include "clash_files.h"

#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>

#include "operand.h"

namespace trisect::app {

ClashFileModel read_clash_file(Session& session, const OperandOptions& options,
                               const std::string& name) {
    const std::vector<Operand> read = read_operands(session, std::span(&name, 1), options);
    ClashFileModel out;
    out.model = InterferenceModel(read[0].solid);
    out.file.box = bounds(out.model.solid());
    const Json& facts = read[0].facts;
    for (const char* count : {"triangles", "faces"})
        if (out.file.triangles == 0 && facts.contains(count))
            out.file.triangles = facts.at(count).get<std::uint64_t>();
    return out;
}

std::string clash_files_state(const ClashManifest& manifest) {
    namespace fs = std::filesystem;
    std::string out;
    for (const std::string& name : manifest.files) {
        std::error_code error;
        const auto size = fs::file_size(name, error);
        const auto time = fs::last_write_time(name, error).time_since_epoch().count();
        out += fmt::format("{}|{}|{}\n", name, error ? 0 : size, error ? 0 : time);
    }
    return out;
}

std::vector<ClashBox> clash_boxes(const ClashManifest& manifest,
                                  const std::vector<ClashFile>& files) {
    std::vector<ClashBox> out;
    out.reserve(manifest.parts.size());
    for (std::uint32_t i = 0; i < manifest.parts.size(); ++i) {
        const ClashPart& part = manifest.parts[i];
        if (const auto& box = files[part.file].box)
            out.push_back({posed_box(*box, part.pose), i, part.group});
    }
    return out;
}

std::vector<Json> missing_files(const ClashManifest& manifest,
                                const std::vector<ClashFile>& files) {
    std::vector<std::vector<std::string>> parts(files.size());
    for (const ClashPart& part : manifest.parts)
        if (!files[part.file].failure.empty()) parts[part.file].push_back(part.id);
    return missing_files(manifest.files, files, std::move(parts));
}

std::vector<Json> missing_files(const std::vector<std::string>& names,
                                const std::vector<ClashFile>& files,
                                std::vector<std::vector<std::string>> parts) {
    std::vector<Json> out;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (files[i].failure.empty()) continue;
        Json record;
        record["file"] = names[i];
        record["error"] = files[i].failure;
        record["parts"] = std::move(parts[i]);
        out.push_back(std::move(record));
    }
    return out;
}

// Numbers of 53 bits within 2^-64 and 2^64 span fewer bits than a pose may, and no product of three
// of them leaves the doubles; so the determinant is wrong by less than 2^-48 of the sum of its
// products.
bool is_pose_for_certain(const std::array<double, 12>& pose) {
    constexpr double largest = 0x1p64;
    static_assert(Pose::bits > 2 * 64 + 53);
    const auto is_moderate = [](double v) {
        return v == 0 || (std::abs(v) >= 1 / largest && std::abs(v) <= largest);
    };
    if (!std::ranges::all_of(pose, is_moderate)) return false;
    const auto m = [&](std::size_t i, std::size_t j) { return pose[4 * i + j % 3]; };
    double determinant = 0;
    double size = 0;
    for (std::size_t j = 0; j < 3; ++j)
        for (const std::size_t turn : {1U, 2U}) {
            const double product = m(0, j) * m(1, j + turn) * m(2, j + 3 - turn);
            determinant += turn == 1 ? product : -product;
            size += std::abs(product);
        }
    return std::abs(determinant) > 0x1p-48 * size;
}

Pose clash_pose(const std::string& manifest, const std::string& part,
                const std::array<double, 12>& pose) {
    try {
        return Pose::from_doubles(pose);
    } catch (const UsageError& e) {
        throw InputError(FilePlace{manifest, 0, 0, 0},
                         fmt::format("part '{}': {}", part, e.what()));
    }
}

}  // namespace trisect::app
