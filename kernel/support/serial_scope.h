// SPDX-License-Identifier: Apache-2.0
//
// SerialScope: the serial of what a thread makes next.
#pragma once

#include <cstdint>
#include <utility>

namespace trisect::detail {

/// While it lives, the first thing of a kind with serials that the calling thread makes has that
/// one, which was taken beforehand. So threads make things whose serials have an order. Others get
/// their own as usual. None within another one.
class SerialScope {
public:
    explicit SerialScope(std::uint64_t serial) { next = serial; }
    SerialScope(const SerialScope&) = delete;
    SerialScope& operator=(const SerialScope&) = delete;
    ~SerialScope() { next = 0; }

    /// That serial, once; 0 where there is none.
    [[nodiscard]] static std::uint64_t take() { return std::exchange(next, 0); }

private:
    inline static thread_local std::uint64_t next = 0;
};

}  // namespace trisect::detail
