// SPDX-License-Identifier: Apache-2.0
//
// Sources of native files: meshes and planes, checked.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <trisect/bsp/cells/source.h>
#include <trisect/bsp/native/native_names.h>
#include <trisect/bsp/native/native_records.h>

namespace trisect::detail {

/// Makes all of them. Of a mesh every corner, that its triangles have area and that it is closed is
/// checked; of a plane its width.
[[nodiscard]] std::vector<std::shared_ptr<const Source>> read_sources(
    const NativeView& view, std::span<const SourceRecord> records, const NativeNameMap& names,
    std::uint32_t threads);

}  // namespace trisect::detail
