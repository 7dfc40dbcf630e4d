#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# compile_headers_test.sh PYTHON COMPILER: compile_headers.py must accept headers that compile alone,
# and refuse one that does not, wherever it is in a chain.
set -eu
python=${1:-python3}
compiler=${2:-c++}
check=$(cd "$(dirname "$0")" && pwd)/compile_headers.py
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

clean_tree() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree/kernel" "$tree/brep/interop" "$tree/include"
    ln -s .. "$tree/include/trisect"
    echo 'struct Side {};' >"$tree/kernel/side.h"
    printf '%s\n' '#pragma once' '#include <trisect/kernel/side.h>' 'inline Side above() { return {}; }' \
        >"$tree/kernel/plane.h"
    printf '%s\n' '#pragma once' '// #include <trisect/brep/mesh.h>' '#include <trisect/kernel/plane.h>' \
        'inline Side below() { return above(); }' >"$tree/brep/mesh.h"
    echo 'Nothing that compiles' >"$tree/brep/interop/cgal.h"
    sed -i '1i #pragma once' "$tree/kernel/side.h"
}

checked() { "$python" "$check" "$tree" "$tree/include" "$compiler" 2; }

refused() { # WHAT
    if checked 2>/dev/null; then
        echo "not refused: $1" >&2
        failures=$((failures + 1))
    fi
}

clean_tree
checked || failures=$((failures + 1))

clean_tree && printf '%s\n' '#pragma once' 'inline Side beyond() { return {}; }' >"$tree/kernel/ray.h"
refused 'a header without what it needs'
clean_tree && sed -i '/include/d' "$tree/kernel/plane.h"
refused 'a header in a chain without what it needs'
clean_tree && echo 'inline int half() { return std::abs(2); }' >>"$tree/kernel/side.h"
refused 'a header without what it needs of the standard library'
rm -rf "${tree:?}"/*
refused 'a tree without headers'

[ $failures -eq 0 ]
