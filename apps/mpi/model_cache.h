// SPDX-License-Identifier: Apache-2.0
//
// ModelCache: models of files, as many as fit.
#pragma once

#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <unordered_map>

#include "trisect/clash_files.h"

namespace trisect::app {

/// Models that were needed last, up to a number of bytes, which are estimated from the triangles:
/// `bytes_of_a_triangle` each, with all that questions make. The one that is asked for is always
/// kept, and models that are in use live on until they are not.
/// Safe to use from many threads; one reads at a time.
class ModelCache {
public:
    /// Twice what was measured of meshes of 1,000 to 10,000 triangles: the solid, its boundary, the
    /// boxes and triangles of the model.
    static constexpr std::uint64_t bytes_of_a_triangle = 1500;
    static constexpr std::uint64_t bytes_of_a_model = std::uint64_t{1} << 14;

    ModelCache(Session& session, const OperandOptions& options, std::uint64_t most_bytes)
        : session_(session), options_(options), most_bytes_(most_bytes) {}

    /// Reads the file unless it is here. \throw what read_clash_file throws
    [[nodiscard]] ClashFileModel get(const std::string& name);

    [[nodiscard]] std::uint64_t reads() const { return reads_; }

private:
    struct Entry {
        std::string name;
        ClashFileModel read;
        std::uint64_t bytes = 0;
    };

    Session& session_;
    const OperandOptions& options_;
    std::uint64_t most_bytes_;
    std::mutex mutex_;
    std::list<Entry> entries_;  // the last one that was used first
    std::unordered_map<std::string, std::list<Entry>::iterator> places_;
    std::uint64_t bytes_ = 0;
    std::uint64_t reads_ = 0;
};

}  // namespace trisect::app
