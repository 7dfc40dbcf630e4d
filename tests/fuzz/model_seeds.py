#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""model_seeds FOLDER

Writes a small valid file of each kind that fuzz_models knows, with the byte in front that chooses it.
"""
import io
import json
import pathlib
import struct
import sys
import zipfile

GLB, AMF, MODEL, PACKAGE = range(4)
POINTS = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
CORE = 'http://schemas.microsoft.com/3dmanufacturing/core/2015/02'
RELATIONS = ('<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
             '<Relationship Id="a" Target="/a" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
             '</Relationships>')


def model_text(more=''):
    vertices = ''.join('<vertex x="%g" y="%g" z="%g"/>' % p for p in POINTS)
    triangles = ''.join('<triangle v1="%d" v2="%d" v3="%d"/>' % f for f in FACES)
    return (f'<model xmlns="{CORE}"><resources><basematerials id="1"><base name="m" displaycolor="#FF0000"/>'
            f'</basematerials><object id="2" name="o" pid="1" pindex="0"><mesh><vertices>{vertices}</vertices>'
            f'<triangles>{triangles}</triangles></mesh></object><object id="3"><components>'
            '<component objectid="2" transform="0 1 0 -1 0 0 0 0 1 1 2 3"/><component objectid="2"/></components>'
            f'</object>{more}</resources><build><item objectid="3"/></build></model>')


def amf_text():
    vertices = ''.join('<vertex><coordinates><x>%g</x><y>%g</y><z>%g</z></coordinates></vertex>' % p for p in POINTS)
    triangles = ''.join('<triangle><v1>%d</v1><v2>%d</v2><v3>%d</v3></triangle>' % f for f in FACES)
    return (f'<amf unit="inch"><object id="1"><metadata type="name">o</metadata><mesh><vertices>{vertices}</vertices>'
            f'<volume materialid="2">{triangles}</volume></mesh></object><constellation id="3"><instance objectid="1">'
            '<deltax>1</deltax><rz>90</rz></instance></constellation><material id="2"><color><r>1</r><g>0</g><b>0</b>'
            '</color></material></amf>')


def glb(document, binary):
    text = json.dumps(document, separators=(',', ':')).encode()
    text += b' ' * (-len(text) % 4)
    chunks = struct.pack('<I', len(text)) + b'JSON' + text + struct.pack('<I', len(binary)) + b'BIN\0' + binary
    return b'glTF' + struct.pack('<2I', 2, 12 + len(chunks)) + chunks


def glb_file(manifold):
    binary = b''.join(struct.pack('<3f', *p) for p in POINTS) + b''.join(struct.pack('<3I', *f) for f in FACES)
    mesh = {'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1, 'material': 0}]}
    if manifold:
        mesh['extensions'] = {'EXT_mesh_manifold': {'manifoldPrimitive': {'attributes': {'POSITION': 0}, 'indices': 1}}}
    return glb({
        'scenes': [{'nodes': [0]}],
        'nodes': [{'children': [1], 'translation': [1, 2, 3]}, {'mesh': 0, 'rotation': [0, 0, 1, 1]}],
        'meshes': [mesh], 'materials': [{'pbrMetallicRoughness': {'baseColorFactor': [1, 0, 0, 1]}}],
        'buffers': [{'byteLength': len(binary)}],
        'bufferViews': [{'buffer': 0, 'byteLength': 48}, {'buffer': 0, 'byteOffset': 48, 'byteLength': 48}],
        'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3'},
                      {'bufferView': 1, 'componentType': 5125, 'count': 12, 'type': 'SCALAR'}]}, binary)


def package(kind):
    out = io.BytesIO()
    with zipfile.ZipFile(out, 'w', kind) as archive:
        archive.writestr('_rels/.rels', RELATIONS)
        archive.writestr('a', model_text())
    return out.getvalue()


def main():
    folder = pathlib.Path(sys.argv[1])
    seeds = [(GLB, glb_file(False)), (GLB, glb_file(True)), (AMF, amf_text().encode()), (MODEL, model_text().encode()),
             (PACKAGE, package(zipfile.ZIP_STORED)), (PACKAGE, package(zipfile.ZIP_DEFLATED))]
    for number, (choice, data) in enumerate(seeds):
        (folder / f'seed{number}').write_bytes(bytes([choice]) + data)


if __name__ == '__main__':
    main()
