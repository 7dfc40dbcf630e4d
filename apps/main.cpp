// SPDX-License-Identifier: Apache-2.0
#include "program_commands.h"
#include "trisect/command_line.h"
#include "trisect/large_pages.h"

int main(int argc, char** argv) {
    trisect::app::demand_large_pages(argc, argv);
    return trisect::app::run(argc, argv, trisect::app::program_commands());
}
