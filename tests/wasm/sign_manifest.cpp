// SPDX-License-Identifier: Apache-2.0
//
// Sign manifest as a module of WebAssembly.

#include "support/sign_manifest.h"

extern "C" __attribute__((export_name("sign_manifest_hash"))) std::uint64_t sign_manifest_hash() {
    return sign_manifest::of_all_families().hash();
}
