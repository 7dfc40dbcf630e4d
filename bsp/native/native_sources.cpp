// SPDX-License-Identifier: Apache-2.0
//
// Whether a mesh is closed is found out without sorting its edges: each directed edge adds a random
// number of its two ends, with the sign of its direction. The sum is zero where each edge is used
// equally often both ways, and else with a probability of 2^-64, whatever the file was made for,
// since the numbers are chosen anew in every process.

#include <trisect/bsp/native/native_sources.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <random>
#include <utility>

#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

using Section = NativeSection;

// plane.h
constexpr int normal_bits = 328;
constexpr int offset_bits = 381;
constexpr std::size_t part_size = std::size_t{1} << 14;

std::uint64_t mixed(std::uint64_t v) {
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9U;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebU;
    return v ^ (v >> 31);
}

std::uint64_t random_number() {
    std::random_device device;
    return (std::uint64_t{device()} << 32) | device();
}

// Of an edge from a to b.
std::uint64_t signed_number(std::uint32_t a, std::uint32_t b, std::uint64_t seed) {
    const auto [low, high] = std::minmax(a, b);
    const std::uint64_t n = mixed(mixed(((std::uint64_t{high} << 32) | low) ^ seed) + seed);
    return a < b ? n : 0 - n;
}

class SourceReader {
public:
    SourceReader(const NativeView& view, std::uint32_t threads) : view_(view), threads_(threads) {}

    [[nodiscard]] std::shared_ptr<const Source> read(const SourceRecord& r) const {
        const Lattice lattice{view_.header().exponent};
        if (r.has_planes) return Source::planes(planes(r), lattice, r.box);
        LatticeMesh mesh;
        mesh.lattice = lattice;
        read_points(r, mesh.points);
        read_triangles(r, mesh);
        read_faces(r, mesh.face_of_triangle);
        return Source::make(std::move(mesh), threads_);
    }

    [[nodiscard]] std::vector<FaceSource> names(const SourceRecord& r, std::uint64_t number,
                                                std::uint32_t faces,
                                                const NativeNameMap& map) const {
        std::vector<FaceSource> out;
        if (r.names.count == 0) return out;
        if (faces > r.names.count)
            view_.fail(Section::Sources, number, "a source with fewer names than faces");
        out.reserve(r.names.count);
        for (std::uint64_t i = 0; i < r.names.count; ++i) {
            FaceSource n = name_record(view_, r.names.first + i);
            n.operand = map(n.operand);
            out.push_back(n);
        }
        return out;
    }

private:
    void read_points(const SourceRecord& r, std::vector<LatticePoint>& points) const {
        points.resize(r.points.count);
        const ParallelParts parts(points.size(), threads_, part_size);
        parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                points[i] = point_record(view_, r.points.first + i);
        });
    }

    void read_triangles(const SourceRecord& r, LatticeMesh& mesh) const {
        static const std::uint64_t seed = random_number();
        mesh.triangles.resize(r.triangles.count);
        std::atomic<std::uint64_t> open{0};
        const ParallelParts parts(mesh.triangles.size(), threads_, part_size);
        parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            std::uint64_t sum = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const auto t = mesh.triangles[i] = triangle_record(view_, r, i);
                if (are_collinear(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]))
                    view_.fail(Section::Triangles, r.triangles.first + i,
                               "a triangle without area");
                for (std::size_t k = 0; k < 3; ++k)
                    sum += signed_number(t[k], t[(k + 1) % 3], seed);
            }
            open += sum;
        });
        if (open != 0)
            view_.fail(Section::Triangles, r.triangles.first, "a mesh that is not closed");
    }

    void read_faces(const SourceRecord& r, std::vector<std::uint32_t>& faces) const {
        faces.resize(r.faces.count);
        NativeCursor from(view_.records(Section::Faces, r.faces.first, r.faces.count));
        for (std::uint32_t& f : faces) f = from.next<std::uint32_t>();
    }

    [[nodiscard]] std::vector<Plane> planes(const SourceRecord& r) const {
        std::vector<Plane> out;
        out.reserve(r.planes.count);
        NativeCursor from(view_.records(Section::Planes, r.planes.first, r.planes.count));
        for (std::uint64_t i = 0; i < r.planes.count; ++i) {
            std::array<Plane::Coefficient, 4> c;
            for (Plane::Coefficient& n : c)
                for (int limb = 0; limb < 6; ++limb) n.set_limb(limb, from.next<std::uint64_t>());
            const bool fits = std::ranges::all_of(c, [&c](const auto& n) {
                return n.bit_length() <= (&n == &c[3] ? offset_bits : normal_bits);
            });
            if (!fits || (c[0].is_zero() && c[1].is_zero() && c[2].is_zero()))
                view_.fail(Section::Planes, r.planes.first + i, "an impossible plane");
            out.emplace_back(c[0], c[1], c[2], c[3]);
        }
        return out;
    }

    const NativeView& view_;
    std::uint32_t threads_;
};

std::uint32_t faces_of(const Source& source) {
    if (source.is_half_space()) return source.facet_count();
    const LatticeMesh& mesh = source.mesh();
    if (mesh.face_of_triangle.empty()) return source.facet_count();
    const std::uint32_t last = *std::ranges::max_element(mesh.face_of_triangle);
    return last == ~0U ? last : last + 1;
}

}  // namespace

std::vector<std::shared_ptr<const Source>> read_sources(const NativeView& view,
                                                        std::span<const SourceRecord> records,
                                                        const NativeNameMap& names,
                                                        std::uint32_t threads) {
    const SourceReader reader(view, threads);
    std::vector<std::shared_ptr<const Source>> out;
    out.reserve(records.size());
    for (const SourceRecord& r : records) {
        std::shared_ptr<const Source> source = reader.read(r);
        Source::Stored stored;
        stored.operand = names(r.operand);
        stored.axes = r.axes;
        stored.names = reader.names(r, out.size(), faces_of(*source), names);
        if (r.same_serial) stored.of_same_serial = out.back().get();
        out.push_back(Source::stored(std::move(source), std::move(stored)));
    }
    return out;
}

}  // namespace trisect::detail
