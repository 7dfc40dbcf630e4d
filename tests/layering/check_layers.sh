#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# check_layers.sh ROOT
#
# Reads the #include lines of ROOT/kernel, ROOT/brep and ROOT/bsp and fails where one of them
#   - points up the stack kernel <- brep <- bsp, or out of it (apps, tests, the umbrella header);
#   - is written relative to the file, which would work in the source tree but not once installed;
#   - brings CGAL or Boost into a header, interop/cgal.h excepted: a user who does not ask for CGAL
#     must not need it, and CGAL's licence is not ours;
#   - brings GMP or TBB into a header outside detail/: those stay private to the .cpp files.
set -eu
root=${1:?usage: check_layers.sh ROOT}
cd "$root"

problems=$(mktemp)
trap 'rm -f "$problems"' EXIT

# refuse REASON PATTERN FILE...: every include in FILE that matches the extended regular expression.
refuse() {
    reason=$1 pattern=$2
    shift 2
    [ $# -eq 0 ] || grep -nEH "^[[:space:]]*#[[:space:]]*include[[:space:]]*$pattern" "$@" |
        sed "s|\$|   <- $reason|" >>"$problems" || true
}

# The names of our files hold no blanks, so plain word splitting is enough.
files() { find "$1" -name '*.h' -o -name '*.cpp' | LC_ALL=C sort; }
headers() { find kernel brep bsp -name '*.h' ! -path '*/interop/cgal.h' | LC_ALL=C sort; }
public_headers() { headers | grep -v '/detail/' || true; }

kernel=$(files kernel) brep=$(files brep) bsp=$(files bsp)
[ -n "$kernel" ] || { echo "no sources below $root/kernel" >&2; exit 1; }

refuse "the kernel knows neither meshes nor trees" '[<"](\.\./|trisect/)*(brep|bsp)/' $kernel
refuse "the boundary knows no trees" '[<"](\.\./|trisect/)*bsp/' $brep
refuse "the library knows nothing above it" '[<"](\.\./|trisect/)*(apps|tests|examples|bench)/' \
    $kernel $brep $bsp
refuse "a layer includes what it uses, not the umbrella" '[<"](\.\./)*trisect/trisect\.h' \
    $kernel $brep $bsp
refuse "write <trisect/layer/name.h>" '"' $kernel $brep $bsp
refuse "CGAL and Boost stay out of headers" '[<"](CGAL|boost)/' $(headers)
refuse "GMP and TBB stay inside .cpp files" '[<"](gmp(xx)?\.h|tbb/|oneapi/)' $(public_headers)

cat "$problems" >&2
[ ! -s "$problems" ]
