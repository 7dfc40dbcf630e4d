// SPDX-License-Identifier: Apache-2.0
//
// Readers and writers of formats with parts, called by read_model and write_model.
// Each is compiled where the build found what it takes. Writers are given a model that was checked
// (see write_model.cpp).
#pragma once

#include <trisect/brep/io/model.h>
#include <trisect/brep/io/read_model.h>
#include <trisect/brep/io/write_model.h>

#include <string>
#include <string_view>
#include <vector>

namespace trisect::detail {

[[nodiscard]] Model read_three_mf(std::string_view data, const std::string& name,
                                  const ReadOptions& options, ModelReport& report);
[[nodiscard]] Model read_amf(std::string_view data, const std::string& name,
                             const ReadLimits& limits, ModelReport& report);
[[nodiscard]] Model read_glb(std::string_view data, const std::string& name,
                             const ReadOptions& options, ModelReport& report);

[[nodiscard]] Model read_step(std::string_view data, const std::string& name,
                              const ReadLimits& limits, ModelReport& report);
[[nodiscard]] Model read_dxf_model(std::string_view data, const std::string& name,
                                   const ReadLimits& limits, ModelReport& report);

[[nodiscard]] FormattedMesh write_three_mf(const Model& model, const std::string& unit);
[[nodiscard]] FormattedMesh write_amf(const Model& model, const std::string& unit);
[[nodiscard]] FormattedMesh write_step(const Model& model, const std::string& name);
[[nodiscard]] std::vector<std::vector<std::uint32_t>> faces_off_planes_of(const Model& model);
[[nodiscard]] FormattedMesh write_glb(const Model& model, const std::string& name);

/// The first bytes of zip archives.
[[nodiscard]] inline bool is_zip(std::string_view data) noexcept {
    return data.starts_with(std::string_view("PK\3\4", 4));
}

}  // namespace trisect::detail
