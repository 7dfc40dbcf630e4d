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

GLB, AMF, MODEL, PACKAGE, STEP, DXF = range(6)
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


def short_models():
    """Model parts of a few hundred bytes, each with one feature: longer ones take their time."""
    mesh = ('<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices>'
            '<triangles><triangle v1="0" v2="1" v3="2"%s/></triangles></mesh>')
    with_material = mesh % ' pid="3" p1="0"'
    head = f'<model xmlns="{CORE}"><resources>'
    build = '</resources><build><item objectid="%d"/></build></model>'
    return [f'{head}<object id="1">{mesh % ""}</object>' + build % 1,
            f'{head}<object id="1">{mesh % ""}</object><object id="2"><components><component objectid="1" '
            'transform="0 1 0 -1 0 0 0 0 1 1 2 3"/></components></object>' + build % 2,
            f'{head}<basematerials id="3"><base name="m" displaycolor="#FF0000"/></basematerials><object id="1" pid="3" '
            f'pindex="0">{with_material}</object>' + build % 1]


def short_amf():
    point = '<vertex><coordinates><x>%d</x><y>%d</y><z>0</z></coordinates></vertex>'
    vertices = ''.join(point % p for p in ((0, 0), (1, 0), (0, 1)))
    face = '<volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume>'
    mesh = f'<object id="1"><mesh><vertices>{vertices}</vertices>{face}</mesh></object>'
    return [f'<amf>{mesh}</amf>', f'<amf unit="inch">{mesh}<constellation id="2"><instance objectid="1"><rz>9</rz></instance>'
            '</constellation></amf>']


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


def step_text(voids):
    """Two faces of a square plate with a hole, by edges; or a tetrahedron by points, in an assembly."""
    head = "ISO-10303-21;HEADER;FILE_SCHEMA(('A'));ENDSEC;DATA;"
    if not voids:
        corners = [(0, 0), (4, 0), (4, 4), (0, 4), (1, 1), (1, 3), (3, 3), (3, 1)]
        text = ''
        for i, (x, y) in enumerate(corners):
            j = i // 4 * 4 + (i + 1) % 4
            text += (f"#{10 + i}=CARTESIAN_POINT('',({x}.,{y}.,1.));#{20 + i}=VERTEX_POINT('',#{10 + i});"
                     f"#{30 + i}=EDGE_CURVE('',#{20 + i},#{20 + j},#9,.T.);#{40 + i}=ORIENTED_EDGE('',*,*,#{30 + i},.T.);")
        loops = [','.join(f'#{40 + i}' for i in four) for four in (range(4), range(4, 8))]
        text += (f"#50=EDGE_LOOP('',({loops[0]}));#51=EDGE_LOOP('',({loops[1]}));#52=FACE_OUTER_BOUND('',#50,.T.);"
                 "#53=FACE_BOUND('',#51,.T.);#54=AXIS2_PLACEMENT_3D('',#10,$,$);#55=PLANE('',#54);#9=LINE('',#10,$);"
                 "#56=ADVANCED_FACE('',(#52,#53),#55,.T.);#57=OPEN_SHELL('',(#56));"
                 "#58=SHELL_BASED_SURFACE_MODEL('p',(#57));")
        return head + text + 'ENDSEC;END-ISO-10303-21;'
    text = ''.join(f"#{i + 1}=CARTESIAN_POINT('',({p[0]}.,{p[1]}.,{p[2]}.));" for i, p in enumerate(POINTS))
    for i, f in enumerate(FACES):
        text += (f"#{10 + i}=POLY_LOOP('',({','.join(f'#{c + 1}' for c in f)}));#{20 + i}=FACE_BOUND('',#{10 + i},.T.);"
                 f"#{30 + i}=FACE('',(#{20 + i}));")
    text += ("#40=CLOSED_SHELL('',(#30,#31,#32,#33));#41=ORIENTED_CLOSED_SHELL('',*,#40,.F.);"
             "#42=BREP_WITH_VOIDS('b',#40,(#41));#50=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));"
             "#51=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-7),#50,'','');"
             "#52=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#51))"
             "GLOBAL_UNIT_ASSIGNED_CONTEXT((#50))REPRESENTATION_CONTEXT('',''));"
             "#60=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#42),#52);#61=DIRECTION('',(0.,1.,0.));"
             "#62=AXIS2_PLACEMENT_3D('',#2,$,#61);#63=SHAPE_REPRESENTATION('',(#62,#67),#52);"
             "#64=ITEM_DEFINED_TRANSFORMATION('','',#62,#62);#65=(REPRESENTATION_RELATIONSHIP('','',#60,#63)"
             "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#64)SHAPE_REPRESENTATION_RELATIONSHIP());"
             "#66=REPRESENTATION_MAP(#62,#60);#67=MAPPED_ITEM('',#66,#62);")
    return head + text + 'ENDSEC;END-ISO-10303-21;'


def dxf_text():
    vertices = ''.join('0 VERTEX 70 192 10 %g 20 %g 30 %g ' % p for p in POINTS)
    faces = ''.join('0 VERTEX 70 128 71 %d 72 %d 73 %d ' % tuple(c + 1 for c in f) for f in FACES)
    mesh = ('0 MESH 91 0 92 4 ' + ''.join('10 %g 20 %g 30 %g ' % p for p in POINTS) + '93 16 ' +
            ''.join('90 3 90 %d 90 %d 90 %d ' % f for f in FACES))
    grid = '0 POLYLINE 70 16 71 2 72 2 ' + ''.join('0 VERTEX 10 %g 20 %g ' % p[:2] for p in POINTS) + '0 SEQEND '
    words = ('0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 BLOCKS 0 BLOCK 2 b 10 1 20 2 30 3 0 POLYLINE '
             f'70 64 {vertices}{faces}0 SEQEND 0 ENDBLK 0 ENDSEC 0 SECTION 2 ENTITIES 0 INSERT 2 b 10 1 41 2 50 30 70 2 '
             f'44 5 {mesh}{grid}0 3DFACE 8 w 10 0 20 0 30 0 11 1 21 0 31 0 12 0 22 1 32 0 13 0 23 1 33 0 0 ENDSEC 0 EOF')
    return words.replace(' ', '\n') + '\n'


def main():
    folder = pathlib.Path(sys.argv[1])
    seeds = [(GLB, glb_file(False)), (GLB, glb_file(True)), (AMF, amf_text().encode()), (MODEL, model_text().encode()),
             (PACKAGE, package(zipfile.ZIP_STORED)), (PACKAGE, package(zipfile.ZIP_DEFLATED)), (STEP, step_text(False).encode()),
             (STEP, step_text(True).encode()), (DXF, dxf_text().encode())]
    seeds += [(MODEL, text.encode()) for text in short_models()] + [(AMF, text.encode()) for text in short_amf()]
    for number, (choice, data) in enumerate(seeds):
        (folder / f'seed{number}').write_bytes(bytes([choice]) + data)


if __name__ == '__main__':
    main()
