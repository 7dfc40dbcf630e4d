// SPDX-License-Identifier: Apache-2.0
//
// Files of an assembly, and boxes of their parts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/kernel/pose.h>

#include "clash_manifest.h"
#include "clash_pairs.h"
#include "outcome.h"
#include "session.h"

namespace trisect::app {

struct ClashFile {
    std::optional<Bounds> box;    ///< none: the empty solid, or a file that is left out
    std::uint64_t triangles = 0;  ///< or faces, of a file that has no triangles
    std::string failure;          ///< why it is left out
};

/// A file that was read.
struct ClashFileModel {
    InterferenceModel model;
    ClashFile file;
};

/// \throw what read_operands throws
[[nodiscard]] ClashFileModel read_clash_file(Session& session, const OperandOptions& options,
                                             const std::string& name);

/// Names, sizes and times of files.
[[nodiscard]] std::string clash_files_state(const ClashManifest& manifest);

/// Of each part whose file has a box, in order.
[[nodiscard]] std::vector<ClashBox> clash_boxes(const ClashManifest& manifest,
                                                const std::vector<ClashFile>& files);

/// Files that are left out, each with its parts, as reports have them.
[[nodiscard]] std::vector<Json> missing_files(const ClashManifest& manifest,
                                              const std::vector<ClashFile>& files);

/// The same, where the parts of each file are known.
[[nodiscard]] std::vector<Json> missing_files(const std::vector<std::string>& names,
                                              const std::vector<ClashFile>& files,
                                              std::vector<std::vector<std::string>> parts);

/// Whether twelve numbers are a pose for certain, by doubles: clash_pose() would not throw.
[[nodiscard]] bool is_pose_for_certain(const std::array<double, 12>& pose);

/// The exact pose of a part. \throw InputError where it is none
[[nodiscard]] Pose clash_pose(const std::string& manifest, const std::string& part,
                              const std::array<double, 12>& pose);

}  // namespace trisect::app
