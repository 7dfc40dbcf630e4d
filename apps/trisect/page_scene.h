// SPDX-License-Identifier: Apache-2.0
//
// PageScene: bodies, findings and a timeline on a page.
// Commands other than `view` show what they found on such pages: one HTML file each, which loads
// nothing and needs WebGL.
#pragma once

#include <trisect/brep/brep.h>
#include <trisect/brep/polygon_mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "outcome.h"
#include "page_data.h"

namespace trisect::app {

/// A surface that bodies share.
struct PageShape {
    PolygonMesh mesh;                 ///< of triangles
    std::vector<std::uint32_t> face;  ///< by triangle: the number that it is shown by
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< by number; none: where faces meet
    std::vector<std::uint32_t> source;                ///< by face: its number in the file
};

/// The boundary as interference names it: faces, edges and vertices by their handles.
[[nodiscard]] PageShape shape_of(const Brep& brep);
/// Faces as they are numbered in a file. Polygons of more than three corners become fans.
[[nodiscard]] PageShape shape_of(const PolygonMesh& mesh);

using PosePlace = std::array<double, 12>;  ///< a 3x4 matrix, row by row
inline constexpr PosePlace identity_pose{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

struct PageBody {
    enum class Look : std::uint8_t { Solid, Clear, Hidden };
    std::string name;
    std::size_t shape = 0;
    std::size_t color = 0;  ///< number in the palette
    PosePlace pose = identity_pose;
    Look look = Look::Solid;
};

/// Something at a place, in the world and in the user's units.
struct PageFinding {
    enum class Kind : std::uint8_t { Error, Warning, Note };
    std::string title;
    std::string text;
    Kind kind = Kind::Note;
    std::vector<Point3d> points;
    std::vector<std::array<Point3d, 2>> segments;
    std::vector<std::vector<Point3d>> loops;                   ///< of one plane area, with holes
    std::vector<std::pair<std::size_t, std::uint32_t>> faces;  ///< body, and face of its shape
    std::vector<std::size_t> bodies;                           ///< that it is about; none: all
    std::optional<std::size_t> frame;                          ///< when it is there; none: always
};

/// Poses of bodies at moments of a motion.
struct PageTimeline {
    std::string unit;           ///< what the numbers of moments are: "parameter", "time"
    std::vector<double> times;  ///< ascending
    std::vector<std::size_t> bodies;
    std::vector<PosePlace> poses;        ///< of the first moment for all bodies, then of the next
    std::optional<std::size_t> contact;  ///< a moment
};

struct PageScene {
    std::string kind = "scene";  ///< which program of the page shows it
    std::string title;
    std::vector<std::string> summary;  ///< lines
    std::vector<PageShape> shapes;
    std::vector<PageBody> bodies;
    std::vector<PageFinding> findings;
    std::size_t more_findings = 0;  ///< that are not on the page
    std::optional<PageTimeline> timeline;
};

/// Findings of a page, at most; a list of more could not be read.
inline constexpr std::size_t most_page_findings = 2000;

/// Linear in the size of the scene. `data` and `more` are what its kind needs besides.
[[nodiscard]] std::string page_text(const PageScene& scene, PageData data = {},
                                    const Json& more = Json::object());

/// The file name of a path.
[[nodiscard]] std::string short_name(const std::string& path);

}  // namespace trisect::app
