#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# exports_test.sh LIBRARY HEADER: the library exports exactly the functions that the header declares,
# and says so by its version and its name.
set -eu
library=$1
header=$2

nm -D --defined-only "$library" | sed -n 's/.* [TWVBDRu] //p' | grep -v '^TRISECT_0$' | sed 's/@@.*//' |
    LC_ALL=C sort >exported.txt
# A declaration may take several lines.
tr '\n' ' ' <"$header" | sed 's/TRISECT_C_API/\n&/g' |
    sed -n 's/^TRISECT_C_API [^(]*[ *]\(trisect_[a-z_]*\)(.*/\1/p' | LC_ALL=C sort >declared.txt
diff declared.txt exported.txt || {
    echo "exports_test: declared (<) and exported (>) functions differ" >&2
    exit 1
}
[ -s declared.txt ]
readelf -d "$library" | grep -q 'SONAME.*\[libtrisect\.so\.[0-9]*\]' || {
    echo "exports_test: $library has no SONAME" >&2
    exit 1
}
