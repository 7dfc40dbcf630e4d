// SPDX-License-Identifier: Apache-2.0
//
// Limits: --threads and --max-memory, in force during the object's lifetime.
// It has the last resort for failures without a handler, too.
#pragma once

#include <memory>

#include "console.h"
#include "options.h"

namespace trisect::app {

/// The memory limit is one of the system on the data of this process (RLIMIT_DATA): an allocation
/// beyond it fails, which leaves as exit code 5.
class Limits {
public:
    explicit Limits(const CommonOptions& options);
    Limits(const Limits&) = delete;
    Limits& operator=(const Limits&) = delete;
    ~Limits();

private:
    struct Threads;
    std::unique_ptr<Threads> threads_;
    unsigned long previous_ = 0;
    bool is_set_ = false;
};

/// An exception that leaves a noexcept function, such as an allocation that failed there, ends in
/// the documented exit codes too.
void install_terminate_handler(Console& console, bool json);

}  // namespace trisect::app
