// SPDX-License-Identifier: Apache-2.0
//
// A guard of the depth of recursive readers.
#pragma once

#include <cstdint>
#include <string>

namespace trisect::detail {

/// One more level while it lives: recursion is as deep as the text.
class NestingLevel {
public:
    /// `exceed` is called with a message, and throws, where there are more levels than `limit`.
    template <class Exceed>
    NestingLevel(std::uint32_t& depth, std::uint32_t limit, const Exceed& exceed) : depth_(depth) {
        if (++depth_ > limit)
            exceed("more than " + std::to_string(limit) + " levels of nodes and lists");
    }
    NestingLevel(const NestingLevel&) = delete;
    NestingLevel& operator=(const NestingLevel&) = delete;
    ~NestingLevel() { --depth_; }

private:
    std::uint32_t& depth_;
};

}  // namespace trisect::detail
