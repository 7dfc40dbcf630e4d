#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""reader_seeds FOLDER

Writes a small valid file of each format that fuzz_readers knows, with the byte in front that chooses
the format. From there a fuzzer gets in minutes where it does not get from nothing in hours.
"""
import pathlib
import struct
import sys

POINTS = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
OBJ, OFF, PLY, STL_ASCII, STL_BINARY, STL = range(6)

PLY_HEADER = '''ply
format %s 1.0
comment a
element vertex 4
property double x
property double y
property double z
element face 4
property list uchar int vertex_indices
end_header
'''


def rows(items, form):
    return ''.join(form % tuple(item) for item in items)


def stl_text():
    facets = ('facet normal 0 0 0\nouter loop\n' + rows((POINTS[i] for i in face), 'vertex %g %g %g\n') +
              'endloop\nendfacet\n' for face in FACES)
    return 'solid a\n' + ''.join(facets) + 'endsolid a\n'


def stl_bytes():
    facets = (struct.pack('<12fH', 0, 0, 0, *(float(c) for i in face for c in POINTS[i]), 0) for face in FACES)
    return bytes(80) + struct.pack('<I', len(FACES)) + b''.join(facets)


def binary_ply(encoding, order):
    return (PLY_HEADER % encoding).encode() + b''.join(struct.pack(order + '3d', *p) for p in POINTS) + \
        b''.join(struct.pack(order + 'B3i', 3, *f) for f in FACES)


SEEDS = [
    (OBJ, '# c\n' + rows(POINTS, 'v %g %g %g\n') + rows(([i + 1 for i in f] for f in FACES), 'f %d %d %d\n')),
    (OBJ, 'o a\ng x\nusemtl k\nv 1e-3 -2.5 .5\nv 1 0 0 1\nvt 0 0\nvn 0 0 1\nv 0 1 0\nf 1/1/1 2//1 -1\ns off\n'),
    (OFF, 'OFF\n4 4 0\n' + rows(POINTS, '%g %g %g\n') + rows(FACES, '3 %d %d %d\n')),
    (OFF, 'OFF # x\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n'),
    (PLY, PLY_HEADER % 'ascii' + rows(POINTS, '%g %g %g\n') + rows(FACES, '3 %d %d %d\n')),
    (PLY, binary_ply('binary_little_endian', '<')),
    (PLY, binary_ply('binary_big_endian', '>')),
    (STL_ASCII, stl_text()),
    (STL_BINARY, stl_bytes()),
    (STL, stl_text()),
    (STL, stl_bytes()),
]


def main():
    folder = pathlib.Path(sys.argv[1])
    for number, (choice, file) in enumerate(SEEDS):
        data = file if isinstance(file, bytes) else file.encode()
        (folder / f'seed{number}').write_bytes(bytes([choice]) + data)


if __name__ == '__main__':
    main()
