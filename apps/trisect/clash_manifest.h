// SPDX-License-Identifier: Apache-2.0
//
// ClashManifest: parts under poses, and the pairs of groups to compare.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

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
};

/// JSON, or CSV where the name ends so. Files of parts are looked for beside the manifest.
/// \throw InputError with the place
[[nodiscard]] ClashManifest read_clash_manifest(const std::string& file);

/// The place of a part in the list. \throw UsageError where there is none
[[nodiscard]] std::uint32_t part_number(const ClashManifest& manifest, const std::string& id);

}  // namespace trisect::app
