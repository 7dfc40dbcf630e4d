#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
#
# use_packages.sh: to be run as root in a clean Debian, with Debian packages, README.md, docs and
# tests/consumer in /trisect. Installs the packages by apt, first without compilers, and runs what users
# run; then removes them and looks for what they left. scripts/test-debs calls it.
set -eu
cd /trisect
export DEBIAN_FRONTEND=noninteractive PYTHONDONTWRITEBYTECODE=1
install() { apt-get install -y -q --no-install-recommends "$@" >/apt.log 2>&1 || {
    cat /apt.log >&2
    exit 1
}; }
step() { echo "== $*"; }

apt-get update -q >/dev/null

step 'command, Python and documentation, without a compiler'
begin=$(date +%s)
install ./trisect_*.deb ./python3-trisect_*.deb ./trisect-doc_*.deb
echo "installed in $(($(date +%s) - begin)) s: $(dpkg-query -W -f '${Package} ${Version}, ' '*trisect*')"
if command -v g++ >/dev/null; then
    echo 'use_packages: this root is not clean: it has a compiler' >&2
    exit 1
fi
mkdir /work && cd /work
python3 /trisect/tests/consumer/readme_test.py /trisect python=/usr/bin/python3 command=/usr/bin/trisect
python3 /trisect/tests/consumer/use_package.py
python3 -m trisect --version

step 'manual pages and completion'
pages=$(dpkg -L trisect | sed -n 's|.*/man1/\(.*\)\.1\.gz$|\1|p')
count=0
for page in $pages; do
    man -w "$page" >/dev/null
    man --warnings "$page" 2>/warnings >/page
    if [ -s /warnings ] || ! grep -q NAME /page; then
        cat /warnings >&2
        exit 1
    fi
    count=$((count + 1))
done
echo "$count pages"
[ "$count" -gt 15 ]
bash -c '. /usr/share/bash-completion/completions/trisect
    COMP_WORDS=(trisect rend) COMP_CWORD=1
    _trisect
    [ "${COMPREPLY[*]}" = render ]'

step 'C: shared library, pkg-config'
install /trisect/libtrisect0_*.deb /trisect/libtrisect-dev_*.deb gcc libc6-dev pkg-config
python3 /trisect/tests/consumer/readme_test.py /trisect cc=gcc
cc /trisect/tests/consumer/project_c/main.c -o c_program $(pkg-config --cflags --libs trisect-c)
./c_program

step 'C++: find_package and pkg-config'
install g++ cmake ninja-build
for project in project project_c; do
    cmake -G Ninja -S /trisect/tests/consumer/$project -B /work/$project >/work/$project.log
    cmake --build /work/$project >>/work/$project.log
done
project/consumer
project/from_manifold
project_c/consumer_c
python3 /trisect/tests/consumer/readme_test.py /trisect cxx=g++

step 'nothing is left behind'
apt-get purge -y -q '*trisect*' >/apt.log 2>&1
left=$(find /usr /etc /var/lib /opt -name '*trisect*' ! -path '/var/lib/dpkg/*' ! -path '/var/lib/apt/*')
if [ -n "$left" ]; then
    echo "use_packages: left behind: $left" >&2
    exit 1
fi
echo 'all steps passed'
