#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# check_layers_test.sh: check_layers.sh must accept a clean tree and refuse each single violation.
# A check that never fires looks exactly like a clean code base.
set -eu
check=$(cd "$(dirname "$0")" && pwd)/check_layers.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

clean_tree() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree/kernel/detail" "$tree/brep/interop" "$tree/bsp"
    echo '#include <trisect/kernel/side.h>' >"$tree/kernel/plane.h"
    echo '#include <gmp.h>' >"$tree/kernel/plane.cpp"
    echo '#include <trisect/kernel/plane.h>' >"$tree/brep/mesh.h"
    echo '#include <CGAL/Surface_mesh.h>' >"$tree/brep/interop/cgal.h"
    echo '#include <trisect/brep/mesh.h> // not bsp/' >"$tree/bsp/solid.h"
    echo '#include <boost/container/small_vector.hpp>' >"$tree/bsp/solid.cpp"
}

refuses() { # FILE LINE
    clean_tree
    echo "$2" >>"$tree/$1"
    if sh "$check" "$tree" 2>/dev/null; then
        echo "not refused: '$2' in $1" >&2
        failures=$((failures + 1))
    fi
}

clean_tree
sh "$check" "$tree" || failures=$((failures + 1))

refuses kernel/plane.h '#include <trisect/brep/mesh.h>'
refuses kernel/plane.cpp '#  include "../bsp/solid.h"'
refuses kernel/plane.cpp '#include <trisect/apps/json.h>'
refuses brep/mesh.h '#include <trisect/bsp/solid.h>'
refuses brep/mesh.h '#include "polygon_mesh.h"'
refuses bsp/solid.h '#include <trisect/trisect.h>'
refuses bsp/solid.h '#include <boost/container/small_vector.hpp>'
refuses kernel/plane.h '#include <CGAL/Gmpq.h>'
refuses kernel/detail/filter.h '#include <boost/config.hpp>'
refuses brep/mesh.h '#include <gmpxx.h>'
refuses bsp/solid.h '#include <tbb/parallel_for.h>'

[ $failures -eq 0 ]
