// SPDX-License-Identifier: Apache-2.0
//
// SerialScope: the serial of the source that a thread makes next.
#pragma once

#include <cstdint>

namespace trisect::detail {

/// While it lives, the first source that the calling thread makes has that serial, which is one of
/// Source::take_serials(). So threads make sources whose serials have an order. Others get their
/// own as usual. None within another one.
class SerialScope {
public:
    explicit SerialScope(std::uint64_t serial);
    SerialScope(const SerialScope&) = delete;
    SerialScope& operator=(const SerialScope&) = delete;
    ~SerialScope();
};

}  // namespace trisect::detail
