// SPDX-License-Identifier: Apache-2.0
#include "session.h"

#include <trisect/brep/io/output_file.h>

#include <fmt/format.h>

namespace trisect::app {

Session::Timer::~Timer() {
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start_;
    session_.seconds_[name_] = session_.seconds_.value(name_, 0.0) + time.count();
    session_.detail(fmt::format("{:<12}{:.3f} s", name_, time.count()));
}

EvaluateOptions Session::evaluation_options(const OperandOptions& operands) const {
    EvaluateOptions out;
    out.winding = operands.winding;
    out.lattices = operands.lattices;
    return out;
}

StopLimits Session::limits() const {
    return {&supervisor_.stop_flag(), options_.max_work, options_.max_memory};
}

void Session::write_output(const std::string& name, std::string_view bytes, OutputSafety safety) {
    if (name == "-") return write_descriptor(1, "standard output", bytes);
    supervisor_.watch_output(name);
    write_file(name, bytes, safety);
}

void Session::write_outputs(const std::vector<OutputBytes>& files) {
    std::vector<OutputBytes> regular;
    for (const OutputBytes& file : files) {
        if (file.path == "-") continue;
        supervisor_.watch_output(file.path);
        regular.push_back(file);
    }
    write_files(regular);
    for (const OutputBytes& file : files)
        if (file.path == "-") write_descriptor(1, "standard output", file.bytes);
}

}  // namespace trisect::app
