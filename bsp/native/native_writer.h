// SPDX-License-Identifier: Apache-2.0
//
// Writer of native files.
#pragma once

#include <cstdint>
#include <string>

#include <trisect/bsp/cells/solid_state.h>

namespace trisect::detail {

/// The bytes of a solid that has a tree. `refined`: cells are those of refinements, where there are
/// some. \throw LimitError when there are more than 2^32 - 2 sources or fragments
[[nodiscard]] std::string native_bytes_of(const SolidState& state, bool refined,
                                          std::uint32_t threads);

}  // namespace trisect::detail
