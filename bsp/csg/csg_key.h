// SPDX-License-Identifier: Apache-2.0
//
// Keys of subtrees: equal for equal content in equal places.
#pragma once

#include <cstdint>
#include <string>

#include <trisect/bsp/csg/csg_frame.h>
#include <trisect/bsp/csg/csg_program.h>

namespace trisect::detail {

/// `children_only`: without the node's own arguments.
[[nodiscard]] std::string csg_key(const CsgProgram& program, std::uint32_t n, const CsgFrame& frame,
                                  bool children_only = false);

}  // namespace trisect::detail
