// SPDX-License-Identifier: Apache-2.0
//
// Context state, and numbers of originals.
#pragma once

#include <atomic>

#include <manifold/manifold.h>

namespace manifold {

struct ExecutionContext::Impl {
    std::atomic<bool> cancelled{false};
    /// What theirs counts to tell its progress; nothing is put off here.
    std::atomic<int> totalBooleans{0};  // NOLINT(readability-identifier-naming)
};

}  // namespace manifold
