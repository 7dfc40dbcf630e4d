// SPDX-License-Identifier: Apache-2.0
//
// Options that all sub-commands have, and those of each.
// Plain data, filled by command_line.cpp.
#pragma once

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/mesh_format.h>
#include <trisect/brep/mend/mend.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/first_contact.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "picture_style.h"
#include "plane_request.h"

namespace trisect::app {

enum class Progress : std::uint8_t {
    Auto,  ///< a bar on a terminal, after half a second, unless quiet
    Bar,   ///< the same also when quiet
    None
};

struct CommonOptions {
    bool json = false;
    bool quiet = false;
    bool verbose = false;
    Progress progress = Progress::Auto;
    int threads = 0;                         ///< 0: as many as the machine has
    std::optional<int> lattice;              ///< exponent of the unit
    std::uint64_t max_memory = 0;            ///< bytes; 0: no limit
    double max_seconds = 0;                  ///< 0: no limit
    std::uint64_t max_work = 0;              ///< units of a StopScope; 0: no limit
    std::optional<MeshFormat> format;        ///< of the output and of standard input
    std::optional<MeshFormat> input_format;  ///< of every input
    NonplanarPolicy nonplanar = NonplanarPolicy::Triangulate;
    double refit_move = 0;  ///< how far Refit may move a coordinate
};

/// How operands of booleans are understood.
struct OperandOptions {
    bool assume_embedded = false;
    EvaluateOptions::Winding winding = EvaluateOptions::Winding::Positive;
    EvaluateOptions::Lattices lattices = EvaluateOptions::Lattices::Round;
    bool properties = false;  ///< keep properties of corners, materials and textures
};

struct BooleanOptions {
    std::string operation;
    std::vector<std::string> inputs;
    std::string output;
    OperandOptions operands;
    std::string boundary;  ///< a file for the boundary without loss; empty: none
    bool exact = false;    ///< also the volume as a fraction
    bool faces = false;    ///< assemble faces, although triangles are written
    bool source_faces = false;
    bool certificate = true;
    bool repair = false;      ///< what is written must be certified
    std::uint64_t slabs = 0;  ///< of space, one after the other; 0: as memory asks for
    std::string pieces;       ///< a folder for native files of slabs; empty: none
    bool resume = false;      ///< an interrupted run in slabs
};

struct SplitOptions {
    std::vector<std::string> inputs;  ///< one, or two without planes
    std::vector<PlaneRequest> planes;
    std::vector<std::string> outputs;  ///< one for each part
    OperandOptions operands;
    bool exact = false;  ///< also the volumes as fractions
    bool certificate = true;
};

struct InfoOptions {
    std::string input;
    bool exact = false;
};

struct CheckOptions {
    std::string input;
    std::uint64_t places = 100;  ///< listed defects of each kind
    std::string page;
};

struct DiffOptions {
    std::array<std::string, 2> inputs;
    OperandOptions operands;
    bool exact = false;
};

struct VerifyCommandOptions {
    std::string operation;
    std::vector<std::string> files;  ///< operands, and last the result
    std::optional<double> within;
    std::uint64_t pieces = 10000;
    std::string page;
};

struct CorpusOptions {
    std::string folder;
    std::vector<std::string> families;  ///< empty: all
    std::uint64_t seed = 1;
    std::string results;  ///< folder; empty: write
};

/// A set to be looked at: one mesh, or several combined.
struct QueryOptions {
    std::vector<std::string> inputs;
    std::string operation = "union";
    OperandOptions operands;
};

struct LocateOptions {
    QueryOptions set;
    std::string points_file;                    ///< empty: none; "-": standard input
    std::vector<std::array<double, 3>> points;  ///< of the command line
};

struct SweepOptions {
    std::array<std::string, 2> inputs;
    std::string motion;       ///< a file: how the second one moves
    std::string motion_of_a;  ///< a file; empty: the first one stands still
    ContactEvent event = ContactEvent::Touch;
    /// Of the interval that is printed; 0: 2^-40, or 2^-30 where nothing is exact.
    double width = 0;
    OperandOptions operands;
    std::string page;
    std::uint64_t frames = 120;  ///< of the page
};

struct SectionOptions {
    QueryOptions set;
    PlaneRequest plane;
    std::string output;  ///< empty: none
};

struct ViewOptions {
    QueryOptions set;
    std::string output;
    bool no_inputs = false;
};

struct TreeOptions {
    QueryOptions set;
    PlaneRequest plane = PlaneRequest::from_text("z", "--plane");
    std::string output;  ///< empty: none
    std::string page;
};

struct RenderOptions {
    QueryOptions set;
    std::string output;
    std::string view = "iso";
    std::string up = "z";
    std::optional<PlaneRequest> section;
    double opening = 0;  ///< degrees; 0: parallel rays
    PictureStyle style;
};

struct InterfereOptions {
    std::array<std::string, 2> inputs;
    std::array<std::string, 2> poses;  ///< files; empty: where the mesh is
    OperandOptions operands;
    bool contacts = false;
    bool distance = false;
    std::optional<double> nearer_than;
    std::string page;  ///< a file; empty: none. So in other commands
};

struct ClashOptions {
    std::string manifest;
    std::vector<std::string> outputs;
    OperandOptions operands;
    bool regions = false;
    bool volumes = false;
    std::string pictures;             ///< folder; empty: none
    std::string page;                 ///< a file; empty: none
    std::string shard;                ///< "2/8"; empty: all
    std::vector<std::string> shards;  ///< reports of shards to make one of
    bool resume = false;
    bool keep_going = false;
    std::uint32_t facets = 120;  ///< of a whole circle in GDML
};

struct MillOptions {
    std::string stock;
    std::string tool;
    std::string holder;
    std::vector<std::string> fixtures;
    std::string path;
    OperandOptions operands;
    std::optional<int> grid;  ///< exponent of the unit of tool positions
    double chord = 0.01;      ///< how far chords may be from their arcs
    double feed = 1000;       ///< before the first one of the path, a minute
    double rapid_feed = 10000;
    bool touch = false;       ///< contact of the holder, and with fixtures, counts too
    bool between = true;      ///< check the holder between the ends of moves too
    bool keep_going = false;  ///< after a collision
    std::string output;       ///< files; empty: none
    std::string page;
    std::string picture;
    std::string log;
    std::string checkpoint;
    std::string resume;
    double checkpoint_seconds = 2;
    std::uint64_t frames = 60;            ///< of the page
    std::uint64_t page_bytes = 60 << 20;  ///< the page has fewer frames if it would be larger
};

struct MendCommandOptions {
    std::string input;
    std::string output;
    MendOptions what;
    std::uint64_t places = 100;  ///< listed entries of each kind
    bool properties = false;     ///< keep properties of corners, materials and textures
};

struct ConvertOptions {
    std::string input;
    std::string output;
    std::string matrix;                           ///< a file; empty: none
    std::optional<std::array<double, 4>> rotate;  ///< axis and degrees
    std::optional<std::array<double, 3>> translate;
    std::optional<double> scale;
    bool properties = false;
};

/// How a program is written.
enum class ProgramForm : std::uint8_t { ByName, CsgText, JsonText, Scad };

struct EvalOptions {
    std::string input;
    std::string output;
    ProgramForm form = ProgramForm::ByName;
    std::string openscad;                  ///< the program; empty: the one that is found
    std::vector<std::string> definitions;  ///< for OpenSCAD, NAME=VALUE
    bool openscad_grid = false;            ///< its numbers, for comparison
    bool summary = false;
    bool watch = false;
    bool missing_files_are_empty = false;
    bool keep_going = false;
    bool certificate = true;
};

struct TessellateOptions {
    std::string input;
    std::string output;
    double deviation = 0;
};

}  // namespace trisect::app
