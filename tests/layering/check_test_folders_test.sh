#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# check_test_folders_test.sh PYTHON: check_test_folders.py must accept a clean tree and refuse each
# single violation.
set -eu
python=${1:-python3}
check=$(cd "$(dirname "$0")" && pwd)/check_test_folders.py
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

clean_tree() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree/kernel" "$tree/brep/import" "$tree/tests/kernel" "$tree/tests/brep/import" \
        "$tree/tests/support" "$tree/tests/engines/drawings"
    cat >"$tree/folders.txt" <<'TABLE'
engines :            # a comment
support : engines
rooms : support
TABLE
    : >"$tree/kernel/plane.h"
    : >"$tree/brep/mesh.h"
    : >"$tree/brep/import/mesh.cpp"
    : >"$tree/tests/engines/engines.h"
    echo '#include "engines/engines.h"' >"$tree/tests/engines/drawings/drawing.cpp"
    printf '%s\n' '#include "engines/engines.h"' '#include "matchers.h"' >"$tree/tests/support/solids.h"
    : >"$tree/tests/support/matchers.h"
    : >"$tree/tests/kernel/helper.h"
    printf '%s\n' '#include "helper.h"' '#include "support/solids.h"' '#include <trisect/kernel/plane.h>' \
        >"$tree/tests/kernel/plane_test.cpp"
    printf '%s\n' '#include "bench/shapes.h"' '#include <trisect/brep/mesh.h>' \
        >"$tree/tests/brep/import/mesh_test.cpp"
    echo 'TEST_P(Boxes, Touch) {}' >"$tree/tests/brep/import/touching_boxes_test.cpp"
    echo 'trisect_add_test(brep_import_test mesh_test.cpp LIBS engines SLOW All/Boxes.Touch/* Boxes.Touch)' \
        >"$tree/tests/brep/import/CMakeLists.txt"
}

checked() { "$python" "$check" "$tree" "$tree/folders.txt"; }

refused() { # WHAT
    if checked 2>/dev/null; then
        echo "not refused: $1" >&2
        failures=$((failures + 1))
    fi
}

refuses() { # FILE LINE
    clean_tree
    echo "$2" >>"$tree/$1"
    refused "'$2' in $1"
}

clean_tree
checked || failures=$((failures + 1))

# Includes.
refuses tests/support/solids.h '#include "kernel/helper.h"'
refuses tests/engines/engines.h '#include "support/solids.h"'
refuses tests/kernel/plane_test.cpp '#include "engines/engines.h"'
refuses tests/brep/import/mesh_test.cpp '#include "kernel/helper.h"'
refuses tests/brep/import/mesh_test.cpp '#include "gone.h"'
refuses tests/brep/import/mesh_test.cpp '#include "../../kernel/helper.h"'
# Places.
clean_tree && mkdir "$tree/tests/stray" && : >"$tree/tests/stray/lost_test.cpp"
refused 'a folder that is in no table'
clean_tree && mkdir "$tree/tests/brep/face" && : >"$tree/tests/brep/face/loop_test.cpp"
refused 'a folder of no room'
clean_tree && mv "$tree/tests/brep/import/mesh_test.cpp" "$tree/tests/kernel/mesh_test.cpp"
refused 'a test of another room'
clean_tree && rm -r "$tree/tests"/*/
refused 'a tree without tests'
refuses tests/brep/import/CMakeLists.txt 'trisect_add_test(one one.cpp SLOW Boxes.Touch Boxes.Cross)'
# The table.
refuses folders.txt 'engines : '
refuses folders.txt 'nobodys :'
refuses folders.txt 'kernel : nobodys'
refuses folders.txt 'nonsense'

[ $failures -eq 0 ]
