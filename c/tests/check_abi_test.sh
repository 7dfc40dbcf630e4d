#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# check_abi_test.sh PYTHON HEADER RECORD CC: check_abi.py must accept the header as it is and refuse each
# change of a copy.
set -eu
python=$1
header=$2
record=$3
cc=$4
check=$(dirname "$0")/check_abi.py
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

fail() {
    echo "check_abi_test: $1" >&2
    failures=$((failures + 1))
}
checked() { "$python" "$check" "$folder/trisect.h" "$folder/abi.txt" "$cc" "$@" 2>"$folder/says"; }
copy() { # released or not
    cp "$header" "$folder/trisect.h"
    sed "s/^\(version [0-9.]*\).*/\1$1/" "$record" >"$folder/abi.txt"
}
change() { # expression of sed
    copy ''
    sed "$1" "$header" >"$folder/trisect.h"
    ! cmp -s "$header" "$folder/trisect.h" || fail "$1 changes nothing"
    ! checked || fail "not refused: $1"
    ! checked --update || fail "recorded although it was released: $1"
}

copy ''
checked || fail 'the header as it is is refused'
change '/TRISECT_C_API.* trisect_version(/d'
change 's/trisect_area(const trisect_solid\* solid, double\* area)/trisect_area(const trisect_solid* solid, float* area)/'
change 's/TRISECT_LIMIT = 5/TRISECT_LIMIT = 9/'
change 's/^    uint32_t threads;.*/    uint64_t threads;/'
change 's/^    int accept_inside_out;.*/&\n    int further;/'
change 's/^TRISECT_C_API const char\* trisect_version(void);/&\nTRISECT_C_API int trisect_further(void);/'

# Another minor version, and what was not released yet, may be recorded; the next check accepts it.
for released in '' ' not released'; do
    copy "$released"
    sed 's/TRISECT_LIMIT = 5/TRISECT_LIMIT = 9/' "$header" >"$folder/trisect.h"
    [ -n "$released" ] || sed -i 's/\(C_VERSION_MINOR\) .*/\1 99/' "$folder/trisect.h"
    ! checked || fail 'a change is accepted that was not recorded'
    checked --update || fail "not recorded: $(cat "$folder/says")"
    checked || fail 'what was recorded is refused'
done
[ $failures -eq 0 ]
