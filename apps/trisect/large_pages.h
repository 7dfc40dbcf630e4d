// SPDX-License-Identifier: Apache-2.0
//
// Large pages for the memory of the command.
#pragma once

namespace trisect::app {

/// Begins the program again with large pages where the system gives them on demand only
/// (transparent huge pages: madvise) and its allocator can demand them (glibc 2.35 and later, by
/// its tunable). A large boolean takes a third less time so: most of its memory is new. Does
/// nothing where GLIBC_TUNABLES is set, for calls of a single word, and for meshes and programs
/// (.csg) of a few hundred kilobytes, whose answers come sooner than a program begins.
void demand_large_pages(int argc, char** argv);

}  // namespace trisect::app
