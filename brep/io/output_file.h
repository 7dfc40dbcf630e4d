// SPDX-License-Identifier: Apache-2.0
//
// Atomic output of a file, complete or not at all.
//
// The bytes go to a new file in the folder of the target, which is then renamed onto it; a reader
// sees the old file or the new one, and after a failure (full disk, folder not writable) the old
// one is there and nothing else. The new file has the permissions of the one it replaces. Through a
// symbolic link the file it points to is replaced, or made where there is none yet. A target that
// is not a regular file (a pipe, a device) is written directly, since renaming would replace it.
//
// Errors: Error with ErrorCode::Input, naming the file and the reason of the system. A reader that
// closes its end of a pipe is such an error too and raises no signal.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace trisect {

/// The file that write_file writes: what symbolic links lead to, whether it is there or not.
/// Links in the names of folders are left as they are. Errors: as above, for links in a circle.
[[nodiscard]] std::filesystem::path output_target(const std::filesystem::path& path);

/// What a failure of the power leaves.
enum class OutputSafety : std::uint8_t {
    Renamed,  ///< the old file or the new one; where there was none, perhaps none or a part
    Flushed   ///< the old file, or none, or the new one; waits for the disk
};

void write_file(const std::filesystem::path& path, std::string_view bytes,
                OutputSafety safety = OutputSafety::Renamed);

/// Bytes of one of several files.
struct OutputBytes {
    std::filesystem::path path;
    std::string bytes;
    OutputSafety safety = OutputSafety::Renamed;
};

/// All of them or none: each is complete in its folder before the first one is renamed. Where a
/// file cannot be renamed after others were, these are put back; for that files that are replaced
/// have a second name meanwhile, as far as the file system can give one. What is not a regular file
/// is written before the first one is renamed. \pre different targets
void write_files(std::span<const OutputBytes> files);

/// Writes to an open descriptor, such as 1 for the standard output, which stays open; `name` stands
/// for it in messages. What was written before a failure cannot be taken back.
void write_descriptor(int descriptor, const std::string& name, std::string_view bytes);

}  // namespace trisect
