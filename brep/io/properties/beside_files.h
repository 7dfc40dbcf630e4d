// SPDX-License-Identifier: Apache-2.0
//
// BesideFiles: files that another one names, in its folder and below.
#pragma once

#include <trisect/brep/io/read_mesh.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::detail {

/// Names that leave the folder (absolute ones, with "..", of devices) are not followed. What was
/// not found is a remark.
class BesideFiles {
public:
    BesideFiles(const ReadOptions& options, std::vector<std::string>& remarks)
        : folder_(options.folder), left_(options.limits.bytes), remarks_(&remarks) {}

    /// The bytes of a file; nothing where it is not there.
    /// \throw LimitError when all of them are larger than a file may be
    [[nodiscard]] std::optional<std::string> read(std::string_view name);
    [[nodiscard]] bool is_there(std::string_view name) const;
    void remark(std::string text);

private:
    [[nodiscard]] std::optional<std::filesystem::path> path_of(std::string_view name) const;

    std::optional<std::filesystem::path> folder_;
    std::uint64_t left_;  ///< bytes that may still be read
    std::vector<std::string>* remarks_;
};

}  // namespace trisect::detail
