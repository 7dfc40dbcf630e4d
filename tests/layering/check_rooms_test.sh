#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# check_rooms_test.sh PYTHON: check_rooms.py must accept a clean tree and refuse each single
# violation. A check that never fires looks exactly like a clean code base.
set -eu
python=${1:-python3}
check=$(cd "$(dirname "$0")" && pwd)/check_rooms.py
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

clean_tree() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree/kernel/number" "$tree/brep/interop" "$tree/brep/face" "$tree/bsp/cells" \
        "$tree/bsp/leaf" "$tree/bsp/evaluate"
    cat >"$tree/rooms.txt" <<'TABLE'
floor kernel/base = kernel/side.h
public kernel/base :          # a comment
kernel/number : kernel/base
public kernel : kernel/number
public brep : kernel
public brep/interop : brep
brep/face : brep
public bsp : brep
bsp/cells : bsp
bsp/leaf : bsp/cells
bsp/evaluate : =bsp/leaf bsp brep/face
split bsp/cells/deferred.h bsp/leaf/deferred.cpp # made when asked
up bsp/cells/cell.cpp bsp/leaf/leaf.h # for one number
TABLE
    echo '#pragma once' >"$tree/kernel/side.h"
    echo '#include <trisect/kernel/side.h>' >"$tree/kernel/number/digits.h"
    echo '#include <trisect/kernel/side.h>' >"$tree/kernel/plane.h"
    echo '#include <gmpxx.h>' >"$tree/kernel/number/gmp.h"
    printf '%s\n' '#include <trisect/kernel/plane.h>' '#include <trisect/kernel/number/gmp.h>' \
        '#include <trisect/kernel/number/digits.h>' >"$tree/kernel/plane.cpp"
    echo '#include <trisect/kernel/plane.h>' >"$tree/brep/mesh.h"
    echo '#include <CGAL/Surface_mesh.h>' >"$tree/brep/interop/cgal.h"
    echo '#include <trisect/brep/mesh.h>' >"$tree/brep/face/loop.h"
    echo '#include <trisect/brep/mesh.h> // not bsp/' >"$tree/bsp/solid.h"
    echo '#include <trisect/kernel/number/gmp.h>' >"$tree/bsp/cells/cell.h"
    printf '%s\n' '#include <trisect/bsp/cells/cell.h>' '#include <trisect/bsp/leaf/leaf.h>' \
        >"$tree/bsp/cells/cell.cpp"
    echo '#include <trisect/bsp/solid.h>' >"$tree/bsp/cells/deferred.h"
    echo '#include <trisect/bsp/cells/deferred.h>' >"$tree/bsp/leaf/deferred.cpp"
    echo '#include <trisect/bsp/cells/cell.h>' >"$tree/bsp/leaf/leaf.h"
    printf '%s\n' '#include <trisect/bsp/solid.h>' '#include <boost/container/small_vector.hpp>' \
        '#include <trisect/bsp/leaf/leaf.h>' '#include <trisect/brep/face/loop.h>' \
        >"$tree/bsp/evaluate/solid.cpp"
    mkdir "$tree/apps" && echo '#include <CLI/CLI.hpp>' >"$tree/apps/main.cpp"
    echo 'trisect_add_subfolders(cells evaluate)' >"$tree/bsp/CMakeLists.txt"
    : >"$tree/bsp/cells/CMakeLists.txt"
    : >"$tree/bsp/evaluate/CMakeLists.txt"
}

checked() { "$python" "$check" "$tree" "$tree/rooms.txt"; }

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

# Up the stack, and out of it.
refuses kernel/side.h '#include <trisect/kernel/number/digits.h>'
refuses kernel/number/digits.h '#include <trisect/kernel/plane.h>'
refuses kernel/plane.h '#include <trisect/brep/mesh.h>'
refuses kernel/plane.cpp '#  include "../bsp/solid.h"'
refuses kernel/plane.cpp '#include <trisect/apps/json.h>'
refuses brep/mesh.h '#include <trisect/bsp/solid.h>'
refuses brep/mesh.h '#include "polygon_mesh.h"'
refuses bsp/solid.h '#include <trisect/trisect.h>'
refuses bsp/solid.h '#include <trisect/bsp/cells/cell.h>'
refuses bsp/cells/cell.h '#include <trisect/bsp/leaf/leaf.h>'
refuses bsp/leaf/leaf.h '#include <trisect/brep/face/loop.h>'
refuses bsp/leaf/leaf.h '#include <trisect/bsp/cells/gone.h>'
refuses bsp/evaluate/solid.cpp '#include <trisect/bsp/cells/cell.h>'
# What belongs to others.
refuses bsp/solid.h '#include <boost/container/small_vector.hpp>'
refuses kernel/plane.h '#include <CGAL/Gmpq.h>'
refuses kernel/number/digits.h '#include <boost/config.hpp>'
refuses brep/mesh.h '#include <gmpxx.h>'
refuses bsp/solid.h '#include <tbb/parallel_for.h>'
refuses brep/mesh.h '#include <trisect/kernel/number/gmp.h>'
# GMP and oneTBB not by their doors.
refuses bsp/cells/cell.cpp '#include <gmpxx.h>'
refuses bsp/cells/cell.cpp '#include <tbb/parallel_for.h>'
refuses kernel/number/gmp.h '#include <oneapi/tbb/task_group.h>'
refuses apps/main.cpp '#include <oneapi/tbb/task_group.h>'
refuses apps/main.cpp '#include <gmp.h>'
# Files and folders without a room, and a room without files.
clean_tree && mkdir "$tree/bsp/stray" && : >"$tree/bsp/stray/lost.h"
refused 'a file in no room'
clean_tree && rm "$tree/brep/face/loop.h" && sed -i '$d' "$tree/bsp/evaluate/solid.cpp"
refused 'a room without files'
refuses bsp/CMakeLists.txt 'trisect_add_subfolders(nobodys)'
refuses bsp/CMakeLists.txt 'add_subdirectory(nobodys)'
# The table.
refuses rooms.txt 'bsp/cells : bsp'
refuses rooms.txt 'bsp/one : bsp/two'
refuses rooms.txt 'nonsense'
refuses rooms.txt 'up bsp/leaf/leaf.h bsp/evaluate/solid.h # not there'
refuses rooms.txt 'split bsp/leaf/leaf.h bsp/evaluate/leaf.cpp # not there'
clean_tree && sed -i '/leaf\/leaf.h/d' "$tree/bsp/cells/cell.cpp"
refused 'an include that is not needed any more'
clean_tree && mv "$tree/bsp/leaf/deferred.cpp" "$tree/bsp/cells/deferred.cpp"
refused 'a split that is not needed any more'
clean_tree && echo '#include <trisect/bsp/cells/cell.h>' >"$tree/bsp/leaf/cell.cpp" &&
    rm "$tree/bsp/cells/cell.cpp" && sed -i '/^up /d' "$tree/rooms.txt"
refused 'a pair in two rooms'
clean_tree && i=0
while [ $i -lt 60 ]; do : >"$tree/bsp/cells/file_$i.h" && i=$((i + 1)); done
refused 'a flat folder'

[ $failures -eq 0 ]
