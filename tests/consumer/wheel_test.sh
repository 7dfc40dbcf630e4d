#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# wheel_test.sh SOURCE BUILD PYTHON: makes the wheel, unpacks it into an empty folder, which is all
# that an installer does with it, and uses the package there.
set -eu
source=$1
build=$2
python=$3
TRISECT_BUILD_DIR=$build "$source/scripts/build-wheel" wheel >wheel.txt
wheel=$(tail -n 1 wheel.txt)
rm -rf wheel/unpacked
"$python" -m zipfile -e "$wheel" wheel/unpacked
"$python" -m wheel unpack -d wheel/checked "$wheel" # compares the files with its record
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$PWD/wheel/unpacked "$python" "$source/tests/consumer/use_package.py"
