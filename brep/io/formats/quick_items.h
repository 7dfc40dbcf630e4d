// SPDX-License-Identifier: Apache-2.0
//
// Counters of the readers' fast paths.
// Tests compare them with expected numbers: a fast path that is never taken changes nothing but
// the time.
#pragma once

#include <cstdint>

namespace trisect::detail {

/// Vertices, faces and facets of this thread that were read without the careful way.
inline thread_local std::uint64_t quick_items = 0;

}  // namespace trisect::detail
