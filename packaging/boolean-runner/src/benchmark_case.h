// SPDX-License-Identifier: Apache-2.0
//
// One case of the open boolean benchmark.
#pragma once

#include <trisect/trisect.h>

#include <nlohmann/json_fwd.hpp>

namespace runner {

struct Settings {
    trisect::SolidOptions import;
    trisect::EvaluateOptions evaluate;
};

/// Does the operations of a request's entry one after the other, writes each result to
/// `out_dir`/op_N.obj, and returns the entry of the result: status, times in milliseconds, files.
/// Stops at the first operation that fails. Throws nothing but for lack of memory.
[[nodiscard]] nlohmann::json run_case(const nlohmann::json& request, const Settings& settings);

}  // namespace runner
