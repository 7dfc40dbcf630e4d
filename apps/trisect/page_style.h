// SPDX-License-Identifier: Apache-2.0
//
// Head of all pages up to the end of their common style.
#pragma once

namespace trisect::app {

/// Up to the style element, which is left open.
extern const char* const page_start;
/// Light and dark, as the reader's system has it.
extern const char* const page_style;

}  // namespace trisect::app
