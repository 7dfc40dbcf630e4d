// SPDX-License-Identifier: Apache-2.0
//
// Names of 3MF: namespaces, kinds of relationships and content.
#pragma once

#include <string_view>

namespace trisect::detail {

inline constexpr std::string_view three_mf_core =
    "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
inline constexpr std::string_view three_mf_materials =
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";
inline constexpr std::string_view three_mf_production =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
inline constexpr std::string_view three_mf_triangle_sets =
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07";
inline constexpr std::string_view three_mf_model_relation =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
inline constexpr std::string_view package_relations =
    "http://schemas.openxmlformats.org/package/2006/relationships";
inline constexpr std::string_view package_content_types =
    "http://schemas.openxmlformats.org/package/2006/content-types";

}  // namespace trisect::detail
