#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# exports_test.sh MODULE: the module exports its entry and nothing else, so that what is in it cannot meet
# what another library of the process has.
set -eu
exported=$(nm -D --defined-only "$1" | sed -n 's/.* [TWVBDRui] //p' | sed 's/@@.*//')
if [ "$exported" != PyInit__trisect ]; then
    echo "exports_test: $1 exports" $exported >&2
    exit 1
fi
