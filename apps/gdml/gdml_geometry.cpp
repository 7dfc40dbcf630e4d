// SPDX-License-Identifier: Apache-2.0
#include "gdml_geometry.h"

#include <algorithm>

#include "gdml_copies.h"

namespace trisect::app {
namespace {

constexpr std::size_t deepest_assembly = 64;  // of assemblies in assemblies
constexpr std::size_t most_daughters = 1U << 22;

class VolumeReader {
public:
    VolumeReader(const GdmlSource& source, const GdmlSolids& solids)
        : source_(source), solids_(solids) {
        for (const GdmlElement& section : source.document.root().children) {
            if (section.name != "structure") continue;
            for (const GdmlElement& e : section.children) {
                if (e.name != "volume" && e.name != "assembly") continue;
                if (!named_.try_emplace(source.document.required(e, "name"), &e).second)
                    source.document.fail(e, "two volumes with one name");
                if (e.name == "volume") volumes_.push_back(&e);
            }
        }
    }

    std::vector<GdmlVolume> read() {
        std::vector<GdmlVolume> out;
        for (const GdmlElement* e : volumes_) {
            GdmlVolume& volume = out.emplace_back();
            volume.name = source_.document.required(*e, "name");
            volume.solid = solid_of(*e);
            add_placements(volume, *e, AffineMap(), "", 0);
        }
        return out;
    }

private:
    std::uint32_t solid_of(const GdmlElement& volume) const {
        const GdmlElement* reference = volume.child("solidref");
        if (reference == nullptr) source_.document.fail(volume, "<volume> without <solidref>");
        const std::string& name = source_.document.required(*reference, "ref");
        const auto solid = solids_.find(name);
        if (!solid) source_.document.fail(*reference, "no solid is called '" + name + "'");
        return *solid;
    }

    void add_placements(GdmlVolume& out, const GdmlElement& in, const AffineMap& at,
                        const std::string& path, std::size_t depth) {
        if (depth > deepest_assembly) source_.document.fail_limit(in, "assemblies nest too deeply");
        for (const GdmlElement& e : in.children) {
            if (e.name == "physvol")
                add_placement(out, e, at, path, depth);
            else if (e.name == "replicavol" || e.name == "divisionvol")
                add_copies(out, e, in, at, path, depth);
            else if (e.name == "paramvol")
                leave_out(out, e, "<" + e.name + "> is not supported");
        }
    }

    /// What a replica or a division places, each copy by itself: NAME/0 and so on.
    void add_copies(GdmlVolume& out, const GdmlElement& e, const GdmlElement& mother,
                    const AffineMap& at, const std::string& path, std::size_t depth) {
        const GdmlElement* reference = e.child("volumeref");
        if (reference == nullptr) source_.document.fail(e, "<" + e.name + "> without <volumeref>");
        const auto& [name, volume] = named(*reference);
        std::vector<Point3d> moves;
        try {
            moves = e.name == "replicavol"
                        ? gdml_replica_moves(source_, e)
                        : gdml_division_moves(source_, e, solids_.element(solid_of(mother)),
                                              solids_.element(solid_of(*volume)));
        } catch (const UnsupportedError& error) {
            out.left_out.emplace_back(error.what());
            return;
        }
        for (std::size_t i = 0; i < moves.size(); ++i)
            add_volume(out, e, *volume, compose(at, AffineMap::translation(moves[i])),
                       path + name + "/" + std::to_string(i), depth);
    }

    void leave_out(GdmlVolume& out, const GdmlElement& e, const std::string& what) const {
        try {
            source_.document.fail_unsupported(e, what);
        } catch (const UnsupportedError& error) {
            out.left_out.emplace_back(error.what());
        }
    }

    void add_placement(GdmlVolume& out, const GdmlElement& e, const AffineMap& at,
                       const std::string& path, std::size_t depth) {
        const GdmlElement* reference = e.child("volumeref");
        if (reference == nullptr) {
            leave_out(out, e, "<physvol> of another file is not supported");
            return;
        }
        const auto& [name, volume] = named(*reference);
        const std::string label = path + (e.text("name").empty() ? name : e.text("name"));
        add_volume(out, e, *volume, compose(at, placement(e)), label, depth);
    }

    /// The name of a volume or an assembly that is referred to, and its element.
    const std::pair<const std::string, const GdmlElement*>& named(
        const GdmlElement& reference) const {
        const std::string& name = source_.document.required(reference, "ref");
        const auto found = named_.find(name);
        if (found == named_.end())
            source_.document.fail(reference, "no volume is called '" + name + "'");
        return *found;
    }

    void add_volume(GdmlVolume& out, const GdmlElement& e, const GdmlElement& volume,
                    const AffineMap& map, const std::string& label, std::size_t depth) {
        if (volume.name == "assembly") {
            add_placements(out, volume, map, label + "/", depth + 1);
            return;
        }
        if (++count_ > most_daughters) source_.document.fail_limit(e, "too many placements");
        GdmlDaughter& daughter = out.daughters.emplace_back();
        daughter.name = label;
        daughter.solid = solid_of(volume);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 4; ++k) daughter.pose[4 * i + k] = map.rows[i][k];
        daughter.is_rounded = is_rounded(map);
    }

    /// Geant4 turns by the inverse of the rotation that is given, and ROOT does as well.
    AffineMap placement(const GdmlElement& e) const {
        const AffineMap turned = compose(gdml_inverse_rotation(source_.values.rotation(e)),
                                         AffineMap::scaling(source_.values.scale(e)));
        return compose(AffineMap::translation(source_.values.position(e)), turned);
    }

    const GdmlSource& source_;
    const GdmlSolids& solids_;
    std::unordered_map<std::string, const GdmlElement*> named_;
    std::vector<const GdmlElement*> volumes_;
    std::size_t count_ = 0;
};

}  // namespace

std::vector<GdmlVolume> gdml_volumes(const GdmlSource& source, const GdmlSolids& solids) {
    return VolumeReader(source, solids).read();
}

}  // namespace trisect::app
