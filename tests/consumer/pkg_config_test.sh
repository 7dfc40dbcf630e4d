#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# pkg_config_test.sh LIBDIR CC CXX FLAGS: compiles and runs the consumers in C and C++ with what
# pkg-config says about the package installed in LIBDIR.
set -eu
libdir=$1
cc=$2
cxx=$3
flags=$4
here=$(dirname "$0")
export PKG_CONFIG_PATH="$libdir/pkgconfig"

# shellcheck disable=SC2046,SC2086 # lists of words
$cc $flags "$here/project_c/main.c" -o by_pkg_config_c $(pkg-config --cflags --libs trisect-c)
LD_LIBRARY_PATH=$libdir ./by_pkg_config_c

# The program in C needs the C interface alone; C++ comes with it.
needed=$(readelf -d by_pkg_config_c | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p')
case $needed in
*libstdc++* | *libtbb* | *libgmp*)
    echo "pkg_config_test: the program in C needs $needed" >&2
    exit 1
    ;;
esac

# shellcheck disable=SC2046,SC2086
$cxx -std=c++20 $flags "$here/project/main.cpp" -o by_pkg_config_cpp \
    $(pkg-config --cflags --libs trisect)
./by_pkg_config_cpp
