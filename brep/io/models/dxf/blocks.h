// SPDX-License-Identifier: Apache-2.0
//
// Blocks of a DXF file, with their meshes.
#pragma once

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/model.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace trisect::detail {

struct DxfInsert {
    std::string block;
    Point3d at_point{};
    Point3d scale{1, 1, 1};
    Point3d extrusion{0, 0, 1};
    double degrees = 0;
    std::int64_t columns = 1;
    std::int64_t rows = 1;
    double column_spacing = 0;
    double row_spacing = 0;
    const char* at = nullptr;
};

struct DxfBlock {
    Point3d base{};
    std::vector<ModelPart> parts;  ///< faces of their own, then meshes, named by layers
    std::vector<DxfInsert> inserts;
};

struct DxfFile {
    std::string unit;
    DxfBlock entities;
    std::map<std::string, DxfBlock> blocks;
};

/// \throw InputError, LimitError; UnsupportedError for solids and curved surfaces, by name
[[nodiscard]] DxfFile read_dxf_blocks(const InputText& source);

}  // namespace trisect::detail
