// SPDX-License-Identifier: Apache-2.0
#include "trisect/command_line.h"

int main(int argc, char** argv) { return trisect::app::run(argc, argv); }
