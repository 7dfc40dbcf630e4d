// SPDX-License-Identifier: Apache-2.0
#include "trisect/command_line.h"

#ifdef TRISECT_WITH_COMPARISON
#include "trisect/compare_hierarchies_command.h"
#include "trisect/further_command.h"
#endif

int main(int argc, char** argv) {
#ifdef TRISECT_WITH_COMPARISON
    const auto comparison = trisect::app::compare_hierarchies_command();
    return trisect::app::run(argc, argv, comparison.get());
#else
    return trisect::app::run(argc, argv);
#endif
}
