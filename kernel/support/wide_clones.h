// SPDX-License-Identifier: Apache-2.0
//
// Mark for functions compiled for wider vector registers as well.
// Such a function is compiled twice, and the loader takes the version that the processor can run.
// Both give the same bits: the wider one must contain no floating-point arithmetic that could be
// contracted or reordered.
#pragma once

// The loader's choice (an ifunc) comes before a sanitizer is ready; clang 14 has no such clones of
// functions in anonymous namespaces.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TRISECT_WIDE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define TRISECT_WIDE_CLONES
#endif
