// SPDX-License-Identifier: Apache-2.0
//
// TriangleStream: the triangles of a file, read piece by piece.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <trisect/kernel/point3d.h>

namespace trisect::app {

using Corners = std::array<Point3d, 3>;

/// Binary STL, and binary PLY of triangles: records of one size, so that any part can be read by
/// itself, in little memory. Corners of PLY files are mapped, which the system may take back.
class TriangleStream {
public:
    TriangleStream() = default;
    TriangleStream(const TriangleStream&) = delete;
    TriangleStream& operator=(const TriangleStream&) = delete;
    virtual ~TriangleStream() = default;

    [[nodiscard]] virtual std::uint64_t size() const = 0;
    /// Whether all coordinates are floats.
    [[nodiscard]] virtual bool is_single() const = 0;
    /// The triangles from `begin` to before `end`, with their numbers. \throw InputError
    virtual void read(std::uint64_t begin, std::uint64_t end,
                      const std::function<void(std::uint64_t, const Corners&)>& take) const = 0;

    /// \throw InputError for a file that is damaged, UnsupportedError for another format
    [[nodiscard]] static std::unique_ptr<TriangleStream> open(const std::string& name);
    /// What gather_triangles() wrote. \throw InputError
    [[nodiscard]] static std::unique_ptr<TriangleStream> open_gathered(const std::string& name);
    /// Whether open() would; by the file's header.
    [[nodiscard]] static bool can_open(const std::string& name);
};

}  // namespace trisect::app
