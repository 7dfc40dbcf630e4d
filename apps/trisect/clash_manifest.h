// SPDX-License-Identifier: Apache-2.0
//
// ClashManifest: parts under poses, and the pairs of groups to compare.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "manifest_scan.h"

namespace trisect::app {

struct ClashPart {
    std::string id;    ///< unique: that of the manifest, or the name
    std::string name;  ///< for people
    std::uint32_t file = 0;
    std::uint32_t group = 0;
    std::array<double, 12> pose{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
};

/// What of two parts is a clash.
enum class ClashMode : std::uint8_t {
    Intersection,  ///< interiors meet
    Collision,     ///< that, or they touch
    Clearance      ///< that, or they are nearer than a distance
};

struct ClashSet {
    std::string name;
    std::vector<bool> a;  ///< by group
    std::vector<bool> b;
    ClashMode mode = ClashMode::Intersection;
    double clearance = 0;

    [[nodiscard]] bool has(std::uint32_t first, std::uint32_t second) const {
        return (a[first] && b[second]) || (a[second] && b[first]);
    }
};

struct ClashManifest {
    std::vector<ClashPart> parts;    ///< by id
    std::vector<std::string> files;  ///< as they can be opened, each once, in order
    std::vector<std::string> groups;
    std::vector<ClashSet> sets;
    std::string key;  ///< of all bytes of the file
    /// Of parts, where this process has only some of them.
    std::uint64_t all_parts = 0;

    [[nodiscard]] std::uint64_t size() const {
        return std::max<std::uint64_t>(all_parts, parts.size());
    }
};

/// JSON, or CSV where the name ends so. Files of parts are looked for beside the manifest.
/// \throw InputError with the place
[[nodiscard]] ClashManifest read_clash_manifest(const std::string& file);

/// Parts that follow each other in a manifest, with files and groups of their own.
struct ManifestShare {
    std::vector<ClashPart> parts;
    std::vector<std::string> files;
    std::vector<std::string> groups;
};

/// A manifest whose parts are read in shares, by threads or by processes that see the file. What
/// is not as it should be is no share; the whole is then read in one piece, which says why.
class SharedManifest {
public:
    /// \param readers how many there are; the shares are as many or more, and not large
    SharedManifest(std::string file, std::size_t readers);

    /// None where it can only be read in one piece.
    [[nodiscard]] std::size_t shares() const { return shares_; }
    [[nodiscard]] std::optional<ManifestShare> read(std::size_t share) const;
    /// \param parts all shares. \throw as read_clash_manifest()
    [[nodiscard]] ClashManifest join(std::vector<std::optional<ManifestShare>> parts) const;

    /// All but the parts, of which each process has its own. Nothing where the text is not as it
    /// should be.
    /// \param files, groups of all shares, in order and each once
    /// \param key made of block_id() of all blocks (long_text_id)
    [[nodiscard]] std::optional<ClashManifest> head(std::vector<std::string> files,
                                                    std::vector<std::string> groups,
                                                    std::string key) const;
    [[nodiscard]] std::size_t blocks() const;
    [[nodiscard]] std::string block_id(std::size_t block) const;

private:
    std::string file_;
    std::optional<PartsPlace> place_;
    std::size_t shares_ = 0;
};

/// The place of a part in the list. \throw UsageError where there is none
[[nodiscard]] std::uint32_t part_number(const ClashManifest& manifest, const std::string& id);

}  // namespace trisect::app
