#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""property_seeds FOLDER

Writes small valid files with properties, with the byte in front that chooses their format in fuzz_properties.
"""
import json
import pathlib
import struct
import sys

OBJ, PLY, GLB, MODEL, LIBRARY = range(5)
POINTS = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
CORE = 'http://schemas.microsoft.com/3dmanufacturing/core/2015/02'
LOOKS = 'http://schemas.microsoft.com/3dmanufacturing/material/2015/02'


def obj_text(colors):
    out = 'mtllib a.mtl\n' + ''.join('v %g %g %g%s\n' % (*p, ' 1 0.5 0' if colors else '') for p in POINTS)
    out += 'vt 0 0\nvt 1 0.25\nvt 0.5 1\nvn 0 0 1\nusemtl m\nf 1/1/1 3/2/1 2/3/1\nf 1//1 2//1 4//-1\nusemtl n\n'
    return out + 'f 2/1 3/-1 4/2\nf 3 1 4\n'


def ply_text():
    out = ('ply\nformat ascii 1.0\ncomment TextureFile a.png\ncomment material m\nelement vertex 4\nproperty double x\n'
           'property double y\nproperty double z\nproperty float s\nproperty float t\nproperty uchar red\n'
           'property uchar green\nproperty uchar blue\nproperty int tag\nelement face 4\n'
           'property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\n'
           'property int material_index\nelement material 1\nproperty uchar diffuse_red\nproperty uchar diffuse_green\n'
           'property uchar diffuse_blue\nend_header\n')
    out += ''.join('%g %g %g 0.5 nan 255 0 7 3\n' % p for p in POINTS)
    out += ''.join('3 %d %d %d 6 0 0 1 0 0 1 0 -1\n' % f for f in FACES[:2])
    return out + ''.join('3 %d %d %d 0 -1 0\n' % f for f in FACES[2:]) + '1 2 3\n'


def ply_bytes():
    head = ('ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n'
            'property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\nelement face 4\n'
            'property list uchar int vertex_indices\nend_header\n').encode()
    return (head + b''.join(struct.pack('<8f', *p, 0, 0, 1, 0.5, 0.25) for p in POINTS) +
            b''.join(struct.pack('<B3i', 3, *f) for f in FACES))


def glb_file(manifold):
    parts = [b''.join(struct.pack('<3f', *p) for p in POINTS), struct.pack('<8f', *range(8)),
             b''.join(struct.pack('<4B', 255, 51 * i, 0, 255) for i in range(4)),
             b''.join(struct.pack('<3I', *f) for f in FACES), b'\x89PNG']
    views, offset = [], 0
    for p in parts:
        views.append({'buffer': 0, 'byteOffset': offset, 'byteLength': len(p)})
        offset += len(p)
    mesh = {'primitives': [{'attributes': {'POSITION': 0, 'TEXCOORD_0': 1, 'COLOR_0': 2, 'NORMAL': 0}, 'indices': 3,
                            'material': 0}]}
    if manifold:
        mesh['extensions'] = {'EXT_mesh_manifold': {'manifoldPrimitive': {'attributes': {'POSITION': 0}, 'indices': 3}}}
    document = {
        'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0, 'scale': [1, 2, -1]}], 'meshes': [mesh],
        'materials': [{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}}], 'textures': [{'source': 0, 'sampler': 0}],
        'samplers': [{'wrapS': 33071}], 'images': [{'bufferView': 4, 'mimeType': 'image/png'}],
        'buffers': [{'byteLength': offset}], 'bufferViews': views,
        'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3'},
                      {'bufferView': 1, 'componentType': 5126, 'count': 4, 'type': 'VEC2'},
                      {'bufferView': 2, 'componentType': 5121, 'count': 4, 'type': 'VEC4'},
                      {'bufferView': 3, 'componentType': 5125, 'count': 12, 'type': 'SCALAR'}]}
    text = json.dumps(document, separators=(',', ':')).encode()
    text += b' ' * (-len(text) % 4)
    binary = b''.join(parts)
    chunks = struct.pack('<I', len(text)) + b'JSON' + text + struct.pack('<I', len(binary)) + b'BIN\0' + binary
    return b'glTF' + struct.pack('<2I', 2, 12 + len(chunks)) + chunks


def model_text():
    vertices = ''.join('<vertex x="%g" y="%g" z="%g"/>' % p for p in POINTS)
    groups = ['pid="3" p1="0" p2="1" p3="0"', 'pid="4" p1="0" p2="1" p3="1"', 'pid="5" p1="0" p2="1"', 'pid="1" p1="0"']
    triangles = ''.join('<triangle v1="%d" v2="%d" v3="%d" %s/>' % (*f, g) for f, g in zip(FACES, groups))
    return (f'<model xmlns="{CORE}" xmlns:m="{LOOKS}"><resources><basematerials id="1"><base name="m" '
            'displaycolor="#FF0000"/></basematerials><m:texture2d id="2" path="/p.png" contenttype="image/png"/>'
            '<m:colorgroup id="3"><m:color color="#FF0000"/><m:color color="#00FF0080"/></m:colorgroup>'
            '<m:texture2dgroup id="4" texid="2"><m:tex2coord u="0" v="0.5"/><m:tex2coord u="1" v="0"/></m:texture2dgroup>'
            '<m:multiproperties id="5" pids="1 3 4"><m:multi pindices="0 1 1"/><m:multi pindices="0 0"/></m:multiproperties>'
            f'<object id="6"><mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object>'
            '</resources><build><item objectid="6" transform="0 1 0 1 0 0 0 0 1 0 0 0"/></build></model>')


LIBRARY_TEXT = ('newmtl m\nKd 1 0.5 0\nd 0.5\nmap_Kd -clamp on -o 0 0 -mm 0 1 a b.png\nnewmtl n\nKd spectral a.rfl\nTr 0.25\n'
                'map_Kd a.jpg\n')


def main():
    folder = pathlib.Path(sys.argv[1])
    seeds = [(OBJ, obj_text(False).encode()), (OBJ, obj_text(True).encode()), (PLY, ply_text().encode()),
             (PLY, ply_bytes()), (GLB, glb_file(False)), (GLB, glb_file(True)), (MODEL, model_text().encode()),
             (LIBRARY, LIBRARY_TEXT.encode())]
    for number, (kind, content) in enumerate(seeds):
        (folder / f'seed-property-{number}').write_bytes(bytes([kind]) + content)


if __name__ == '__main__':
    main()
