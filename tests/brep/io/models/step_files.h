// SPDX-License-Identifier: Apache-2.0
//
// Texts of STEP files for tests.
#pragma once

#include <string>

namespace trisect::io_test {

inline std::string step_file(const std::string& data) {
    return "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n" + data +
           "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// A facetted tetrahedron: points #1 to #4, planes #20 to #23, faces #40 to #43, shell #50, solid
/// #60.
inline std::string tetrahedron_entities() {
    return "#1=CARTESIAN_POINT('',(0.,0.,0.));\n#2=CARTESIAN_POINT('',(1.,0.,0.));\n"
           "#3=CARTESIAN_POINT('',(0.,1.,0.));\n#4=CARTESIAN_POINT('',(0.,0.,1.));\n"
           "#10=DIRECTION('',(0.,0.,-1.));\n#11=DIRECTION('',(0.,-1.,0.));\n"
           "#12=DIRECTION('',(1.,1.,1.));\n#13=DIRECTION('',(-1.,0.,0.));\n"
           "#14=AXIS2_PLACEMENT_3D('',#1,#10,$);\n#15=AXIS2_PLACEMENT_3D('',#1,#11,$);\n"
           "#16=AXIS2_PLACEMENT_3D('',#2,#12,$);\n#17=AXIS2_PLACEMENT_3D('',#1,#13,$);\n"
           "#20=PLANE('',#14);\n#21=PLANE('',#15);\n#22=PLANE('',#16);\n#23=PLANE('',#17);\n"
           "#24=POLY_LOOP('',(#1,#3,#2));\n#25=POLY_LOOP('',(#1,#2,#4));\n"
           "#26=POLY_LOOP('',(#2,#3,#4));\n#27=POLY_LOOP('',(#3,#1,#4));\n"
           "#30=FACE_OUTER_BOUND('',#24,.T.);\n#31=FACE_OUTER_BOUND('',#25,.T.);\n"
           "#32=FACE_OUTER_BOUND('',#26,.T.);\n#33=FACE_OUTER_BOUND('',#27,.T.);\n"
           "#40=FACE_SURFACE('',(#30),#20,.T.);\n#41=FACE_SURFACE('',(#31),#21,.T.);\n"
           "#42=FACE_SURFACE('',(#32),#22,.T.);\n#43=FACE_SURFACE('',(#33),#23,.T.);\n"
           "#50=CLOSED_SHELL('',(#40,#41,#42,#43));\n#60=FACETED_BREP('block',#50);\n";
}

/// Units of millimetres, and a representation #70 of the solid.
inline std::string tetrahedron_representation() {
    return "#65=(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.));\n"
           "#66=(GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNIT_ASSIGNED_CONTEXT((#65)) "
           "REPRESENTATION_CONTEXT('',''));\n"
           "#70=FACETED_BREP_SHAPE_REPRESENTATION('',(#60),#66);\n";
}

inline std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    return at == std::string::npos ? std::string() : text.replace(at, from.size(), to);
}

}  // namespace trisect::io_test
