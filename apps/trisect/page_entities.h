// SPDX-License-Identifier: Apache-2.0
//
// Entities of boundaries and places under poses, for pages.
#pragma once

#include <trisect/brep/brep.h>
#include <trisect/bsp/interference/interference.h>

#include <CLI/CLI.hpp>

#include <string>

#include "page_scene.h"
#include "session.h"

namespace trisect::app {

/// --page FILE, of commands that print an answer, too.
void add_page_option(CLI::App& command, std::string& page);
/// Before the work begins. \throw UsageError
void check_page_name(const Session& session, const std::string& page);

/// Where a pose puts a point; rounded.
[[nodiscard]] Point3d placed_point(const PosePlace& pose, const Point3d& point);

/// "edge 12 of gear.stl"; of a face also its number in the file.
[[nodiscard]] std::string entity_words(const BoundaryEntity& entity, const Brep& brep,
                                       const std::string& body);

/// Shows an entity of a body under a pose as part of a finding.
void mark_entity(PageFinding& finding, std::size_t body, const BoundaryEntity& entity,
                 const Brep& brep, const PosePlace& pose);

}  // namespace trisect::app
