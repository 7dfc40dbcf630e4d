// SPDX-License-Identifier: Apache-2.0
#ifdef TRISECT_WITH_COMPARISON
#include "trisect/compare_hierarchies_command.h"
#else
#include "trisect/command_line.h"
#endif
#include "trisect/large_pages.h"

int main(int argc, char** argv) {
    trisect::app::demand_large_pages(argc, argv);
#ifdef TRISECT_WITH_COMPARISON
    return trisect::app::run_with_comparison(argc, argv);
#else
    return trisect::app::run(argc, argv);
#endif
}
