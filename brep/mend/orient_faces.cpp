// SPDX-License-Identifier: Apache-2.0
//
// Two faces of an edge that run along it in one direction differ in orientation. From the first
// face of each part the difference to all others follows over such pairs; where two ways to a face
// disagree, the part has no orientation.

#include <trisect/brep/mend/orient_faces.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include <trisect/brep/import/edge_table.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

struct FacePair {
    std::array<std::uint32_t, 2> faces;
    std::array<std::uint32_t, 2> edge;
    bool differ;
};

std::vector<FacePair> pairs_of(const MendingMesh& mesh) {
    std::vector<FacePair> out;
    const EdgeTable edges(mesh.points.size(), mesh.loop_begin, mesh.corners);
    edges.for_each_edge([&](std::uint32_t low, std::uint32_t high, std::span<const EdgeUse> uses) {
        if (uses.size() != 2 || uses[0].face() == uses[1].face()) return;
        out.push_back({{uses[0].face(), uses[1].face()},
                       {low, high},
                       uses[0].is_forward() == uses[1].is_forward()});
    });
    return out;
}

// The pairs of each face, side by side.
class PairsOfFaces {
public:
    PairsOfFaces(std::size_t face_count, std::span<const FacePair> pairs)
        : begin_(face_count + 2, 0), list_(2 * pairs.size()) {
        for (const FacePair& p : pairs)
            for (const std::uint32_t f : p.faces) ++begin_[std::size_t{f} + 2];
        for (std::size_t f = 2; f < begin_.size(); ++f) begin_[f] += begin_[f - 1];
        for (std::size_t i = 0; i < pairs.size(); ++i)
            for (const std::uint32_t f : pairs[i].faces)
                list_[begin_[std::size_t{f} + 1]++] = static_cast<std::uint32_t>(i);
    }
    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t face) const {
        return {list_.data() + begin_[face], list_.data() + begin_[std::size_t{face} + 1]};
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> list_;
};

enum class Turn : std::uint8_t { Unknown, Kept, Over };

struct ConnectedPart {
    std::vector<std::uint32_t> faces;
    std::optional<std::array<std::uint32_t, 2>> contradiction;
};

class Orientation {
public:
    explicit Orientation(const MendingMesh& mesh)
        : pairs_(pairs_of(mesh)),
          of_face_(mesh.face_count(), pairs_),
          turn_(mesh.face_count(), Turn::Unknown) {}

    [[nodiscard]] bool is_known(std::uint32_t face) const { return turn_[face] != Turn::Unknown; }
    [[nodiscard]] bool is_over(std::uint32_t face) const { return turn_[face] == Turn::Over; }

    [[nodiscard]] ConnectedPart follow(std::uint32_t first) {
        ConnectedPart part;
        turn_[first] = Turn::Kept;
        part.faces.push_back(first);
        for (std::size_t i = 0; i < part.faces.size(); ++i) visit(part.faces[i], part);
        check_stop(part.faces.size());
        return part;
    }

private:
    void visit(std::uint32_t face, ConnectedPart& part) {
        for (const std::uint32_t i : of_face_.of(face)) {
            const FacePair& p = pairs_[i];
            const std::uint32_t other = p.faces[0] == face ? p.faces[1] : p.faces[0];
            const Turn wanted = is_over(face) != p.differ ? Turn::Over : Turn::Kept;
            if (turn_[other] == Turn::Unknown) {
                turn_[other] = wanted;
                part.faces.push_back(other);
            } else if (turn_[other] != wanted && !part.contradiction) {
                part.contradiction = p.edge;
            }
        }
    }

    std::vector<FacePair> pairs_;
    PairsOfFaces of_face_;
    std::vector<Turn> turn_;
};

}  // namespace

void turn_face(MendingMesh& mesh, std::size_t face) {
    if (mesh.loop(face).empty()) return;
    std::reverse(mesh.corners.begin() + mesh.loop_begin[face] + 1,
                 mesh.corners.begin() + mesh.loop_begin[face + 1]);
}

void orient_faces(MendingMesh& mesh, std::vector<bool>& turned, MendReport& report) {
    Orientation orientation(mesh);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (orientation.is_known(f)) continue;
        const ConnectedPart part = orientation.follow(f);
        if (part.contradiction) {
            const auto [a, b] = *part.contradiction;
            report.unorientable.push_back({mesh.face_source[f],
                                           part.faces.size(),
                                           {mesh.source_point[a], mesh.source_point[b]}});
            continue;
        }
        const auto over = static_cast<std::size_t>(std::ranges::count_if(
            part.faces, [&](std::uint32_t g) { return orientation.is_over(g); }));
        const bool fewer = 2 * over <= part.faces.size();
        for (const std::uint32_t g : part.faces) {
            if (orientation.is_over(g) != fewer) continue;
            turn_face(mesh, g);
            turned[g] = !turned[g];
        }
    }
}

}  // namespace trisect::detail
