#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# check_definitions_test.sh PYTHON: check_definitions.py must accept a clean tree and refuse each
# single pair. A check that never fires looks exactly like a clean code base.
set -eu
python=${1:-python3}
check=$(cd "$(dirname "$0")" && pwd)/check_definitions.py
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

# Names that may stand in two files: in other namespaces, anonymous ones, inside of types, declared
# only, in comments and strings, specialisations, overloads, and aliases that agree.
clean_tree() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree/kernel" "$tree/brep" "$tree/bsp" "$tree/tests/reference" "$tree/tests/a" \
        "$tree/tests/b"
    cat >"$tree/brep/sheet.h" <<'END'
namespace trisect::detail {
struct OutlineEdge { int from; struct Place {}; };
class Box;
template <class T> struct Of {};
template <> struct Of<int> {};
using Row = std::vector<int>;
inline int twice(int x) { return 2 * x; }
inline constexpr int limit{3};
}
END
    cat >"$tree/bsp/outline.h" <<'END'
// struct OutlineEdge {};
namespace trisect { struct OutlineEdge {}; }
namespace trisect::detail {
class Box {};
struct Outline { struct Place {}; const char* name = "struct Sheet { "; };
template <> struct Of<double> {};
using Row = std::vector<int>;
inline double twice(double x) { return 2 * x; }
}
END
    cat >"$tree/bsp/outline.cpp" <<'END'
namespace trisect::detail {
namespace { struct OutlineEdge : Box { int to{0}; }; int twice(int x) { return x + x; } }
}
END
    echo 'namespace trisect { namespace { struct Scene {}; } }' >"$tree/tests/a/a_test.cpp"
    echo 'namespace trisect { struct Scene {}; }' >"$tree/tests/a/scene.h"
    echo 'namespace trisect { struct Scene {}; }' >"$tree/tests/b/scene.h"
}

refuses() { # FILE TEXT
    clean_tree
    printf '%s\n' "$2" >>"$tree/$1"
    if "$python" "$check" "$tree" 2>/dev/null; then
        echo "not refused: '$2' in $1" >&2
        failures=$((failures + 1))
    fi
}

clean_tree
"$python" "$check" "$tree" || failures=$((failures + 1))

refuses bsp/facet.h 'namespace trisect::detail { struct OutlineEdge { double at[2]; }; }'
refuses bsp/facet.h 'namespace trisect { namespace detail { class OutlineEdge final : Box {}; } }'
refuses bsp/facet.h 'namespace trisect::detail { template <class T> struct Of { T t; }; }'
refuses bsp/facet.h 'namespace trisect::detail { enum class [[nodiscard]] Box : int { A }; }'
refuses bsp/facet.h 'namespace trisect::detail { using Row = std::array<int, 3>; }'
refuses bsp/facet.h 'namespace trisect::detail { using OutlineEdge = int; }'
refuses bsp/facet.h 'namespace trisect::detail { constexpr int twice(int y) { return y; } }'
refuses bsp/facet.h 'namespace trisect::detail { inline constexpr long limit = 4; }'
refuses bsp/facet.cpp 'namespace trisect::detail { struct OutlineEdge { double at[2]; }; }'
refuses bsp/facet.cpp 'namespace trisect::detail { struct NobodyElses {}; }'
refuses tests/reference/scene.h 'namespace trisect { struct Scene {}; }'
refuses tests/a/other_test.cpp 'namespace trisect { struct Scene {}; }'
refuses tests/b/b_test.cpp 'namespace trisect::detail { struct Box {}; }'

[ $failures -eq 0 ]
