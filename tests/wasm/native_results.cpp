// SPDX-License-Identifier: Apache-2.0
//
// Booleans of a file of cases, by the native library through the C interface.
//
//     native_results CASES RESULTS
//
// Both files are what package_test.mjs describes; it compares RESULTS with what the package for
// JavaScript made of the same arrays.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <trisect-c/trisect.h>

namespace {

void require(trisect_status status) {
    if (status == TRISECT_OK) return;
    std::fprintf(stderr, "native_results: %s\n", trisect_error_message());
    std::exit(1);
}

struct FreeSolid {
    void operator()(trisect_solid* s) const { trisect_solid_free(s); }
};
using SolidHandle = std::unique_ptr<trisect_solid, FreeSolid>;

class Cases {
public:
    explicit Cases(std::vector<char> bytes) : bytes_(std::move(bytes)) {}
    [[nodiscard]] bool is_at_end() const { return at_ == bytes_.size(); }
    std::uint32_t word() { return array<std::uint32_t>(1)[0]; }
    template <class T>
    std::vector<T> array(std::size_t count) {
        std::vector<T> out(count);
        const auto* from = reinterpret_cast<const unsigned char*>(bytes_.data()) + at_;
        std::copy(from, from + count * sizeof(T), reinterpret_cast<unsigned char*>(out.data()));
        at_ += count * sizeof(T);
        return out;
    }

private:
    std::vector<char> bytes_;
    std::size_t at_ = 0;
};

class Results {
public:
    explicit Results(const char* path) : out_(path, std::ios::binary) {}
    template <class T>
    void add(const T* from, std::size_t count) {
        out_.write(reinterpret_cast<const char*>(from),
                   static_cast<std::streamsize>(count * sizeof(T)));
    }

private:
    std::ofstream out_;
};

SolidHandle read_operand(Cases& cases) {
    const std::uint32_t vertex_count = cases.word();
    const std::uint32_t face_count = cases.word();
    const auto vertices = cases.array<double>(3 * std::size_t{vertex_count});
    const auto faces = cases.array<std::uint32_t>(3 * std::size_t{face_count});
    trisect_solid* made = nullptr;
    require(trisect_solid_from_triangles(vertices.data(), vertex_count, faces.data(), face_count,
                                         nullptr, &made));
    return SolidHandle(made);
}

// Operands by their numbers: what they are called depends on all that was made before.
std::vector<std::uint32_t> renamed_sources(const trisect_mesh* mesh,
                                           const std::vector<SolidHandle>& operands) {
    const std::uint32_t* from = trisect_mesh_sources(mesh);
    std::vector<std::uint32_t> out(from, from + 2 * trisect_mesh_face_count(mesh));
    for (std::size_t i = 0; i < out.size(); i += 2)
        for (std::uint32_t k = 0; k < operands.size(); ++k) {
            std::uint32_t id = 0;
            require(trisect_solid_source_id(operands[k].get(), &id));
            if (id != from[i]) continue;
            out[i] = k;
            break;
        }
    return out;
}

void write_result(const trisect_solid* solid, const std::vector<SolidHandle>& operands,
                  Results& results) {
    trisect_mesh* mesh = nullptr;
    require(trisect_solid_mesh(solid, &mesh));
    const std::uint32_t counts[2] = {static_cast<std::uint32_t>(trisect_mesh_vertex_count(mesh)),
                                     static_cast<std::uint32_t>(trisect_mesh_face_count(mesh))};
    results.add(counts, 2);
    results.add(trisect_mesh_vertices(mesh), 3 * std::size_t{counts[0]});
    results.add(trisect_mesh_faces(mesh), 3 * std::size_t{counts[1]});
    const auto sources = renamed_sources(mesh, operands);
    results.add(sources.data(), sources.size());
    trisect_mesh_free(mesh);
    double measures[2] = {0, 0};
    require(trisect_volume(solid, &measures[0]));
    require(trisect_area(solid, &measures[1]));
    results.add(measures, 2);
    trisect_text* text = nullptr;
    require(trisect_exact_volume(solid, &text));
    std::size_t length = 0;
    const char* data = trisect_text_data(text, &length);
    const auto size = static_cast<std::uint32_t>(length);
    results.add(&size, 1);
    results.add(data, length);
    trisect_text_free(text);
}

void run_case(Cases& cases, Results& results) {
    const auto operation = static_cast<trisect_operation>(cases.word());
    const std::uint32_t count = cases.word();
    std::vector<SolidHandle> operands;
    std::vector<const trisect_solid*> pointers;
    for (std::uint32_t i = 0; i < count; ++i) {
        operands.push_back(read_operand(cases));
        pointers.push_back(operands.back().get());
    }
    const auto points = cases.array<double>(3 * std::size_t{cases.word()});
    const auto rows = cases.array<double>(12);

    trisect_solid* result = nullptr;
    require(trisect_boolean(operation, pointers.data(), count, &result));
    const SolidHandle owner(result);
    write_result(result, operands, results);
    std::vector<std::uint8_t> places(points.size() / 3);
    require(trisect_locate(result, points.data(), places.size(), places.data()));
    results.add(places.data(), places.size());

    trisect_pose* pose = nullptr;
    require(trisect_pose_from_rows(rows.data(), &pose));
    trisect_relation relation = TRISECT_DISJOINT;
    require(trisect_interfere(pointers[0], nullptr, pointers[1], pose, &relation));
    trisect_pose_free(pose);
    const auto word = static_cast<std::uint32_t>(relation);
    results.add(&word, 1);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: native_results CASES RESULTS\n", stderr);
        return 2;
    }
    std::ifstream in(argv[1], std::ios::binary);
    Cases cases({std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
    Results results(argv[2]);
    while (!cases.is_at_end()) run_case(cases, results);
    return 0;
}
