#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# check_headers.sh ROOT INCLUDE_DIR COMPILER JOBS
#
# Every header must compile alone, whatever was included before it, and must do so for a user who
# has no CGAL licence: CGAL_LICENSE_ERROR turns any use of a GPL part of CGAL into an error.
# interop/cgal.h is left out, since it needs CGAL itself.
set -eu
root=${1:?} include=${2:?} compiler=${3:?} jobs=${4:-1}
cd "$root"
find kernel brep bsp -name '*.h' ! -path '*/interop/*' ! -name trisect.h | LC_ALL=C sort |
    xargs -P "$jobs" -I '{}' sh -c '
        header=$1; shift
        printf "#include <trisect/%s>\n" "$header" | "$@" ||
            { echo "$header does not compile alone" >&2; exit 1; }
    ' sh '{}' "$compiler" -std=c++20 -fsyntax-only -ffp-contract=off -Wall -Wextra -Wpedantic \
        -DCGAL_LICENSE_ERROR=1 -I"$include" -x c++ -
