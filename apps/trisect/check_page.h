// SPDX-License-Identifier: Apache-2.0
//
// Pages of meshes with what is wrong with them.
#pragma once

#include <trisect/brep/validate/defect.h>
#include <trisect/bsp/verify.h>

#include <string>
#include <vector>

#include "page_scene.h"

namespace trisect::app {

/// A mesh or boundary that was checked, with each listed defect at its place.
[[nodiscard]] std::string check_page(const std::string& name, PageShape shape,
                                     const ValidationReport& report,
                                     std::vector<std::string> remarks);

/// Operands, to be seen through, the result that was verified, and the witness.
[[nodiscard]] std::string verify_page(const std::string& title,
                                      const std::vector<std::string>& names,
                                      const std::vector<PolygonMesh>& meshes,
                                      const VerifyReport& report, std::vector<std::string> summary);

}  // namespace trisect::app
