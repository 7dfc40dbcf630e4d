// SPDX-License-Identifier: Apache-2.0
//
// The n-th allocation fails, for every n until there is no n-th one. Each time the call must end in
// std::bad_alloc or in an error of ours, nothing may leak, the operands must still be what they
// were, and the same call must then succeed with the same result. Only operator new fails: GMP has
// its memory from malloc and ends the program when there is none.

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include <trisect/brep/io/exact_boundary.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/prism.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/msp_tree.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

#include "support/failing_new.h"
#include "support/solids.h"

namespace {

using solids::box;
using trisect::Expression;
using trisect::MeshFormat;
using trisect::PolygonMesh;
using trisect::Solid;

std::string bytes_of(const PolygonMesh& mesh) {
    return trisect::format_mesh(mesh, {.format = MeshFormat::Off}).bytes;
}

// `call` gives its result as text, so that results can be compared.
void fail_every_allocation(const std::function<std::string()>& call) {
    const std::string expected = call();  // also fills what is made once and kept
    (void)call();
    const std::int64_t live = trisect::test::live_blocks();
    std::int64_t n = 0;
    for (bool reached = true; reached; ++n) {
        ASSERT_LT(n, 1'000'000) << "no end of allocations";
        std::string result;
        bool threw = false;
        {
            const trisect::test::FailingAllocation failing(n);
            try {
                result = call();
            } catch (const std::bad_alloc&) {
                threw = true;
            } catch (const trisect::Error&) {
                threw = true;
            }
            reached = failing.has_failed();
        }
        // A failure may be survived, by a way that takes less memory; then the result is right.
        if (!threw) {
            ASSERT_EQ(result, expected) << "allocation " << n;
        }
    }
    testing::Test::RecordProperty("allocations", std::to_string(n - 1));
    EXPECT_EQ(call(), expected);
    // What is kept between calls may have grown a little; a leak grows with n.
    EXPECT_LE(trisect::test::live_blocks() - live, 2 + n / 50) << "after " << n << " failures";
}

trisect::EvaluateOptions one_thread() {
    trisect::EvaluateOptions options;
    options.threads = 1;
    options.leaf_polygons = 8;  // so that there is a tree
    return options;
}

TEST(AllocationFailure, Import) {
    const PolygonMesh mesh = trisect::make_icosphere(1, 1);
    fail_every_allocation([&] { return bytes_of(Solid::from_mesh(mesh).to_mesh()); });
}

// Some allocations are made by tasks that the calling thread takes, at times different ones.
TEST(AllocationFailure, ImportAndExportOnTwoThreads) {
    const PolygonMesh mesh = trisect::make_icosphere(1, 6);
    const trisect::SolidOptions options{.import = {.threads = 2}};
    fail_every_allocation([&] {
        const PolygonMesh out = Solid::from_mesh(mesh, options).to_mesh(2);
        return std::to_string(out.points.size()) + " " + std::to_string(out.corners.size());
    });
}

TEST(AllocationFailure, ImportOfPolygonsThatNeedTheLongWay) {
    PolygonMesh mesh = trisect::make_box({0, 0, 0}, {2, 2, 2});
    trisect::ImportOptions options;
    options.require_closed = false;
    fail_every_allocation([&] {
        const auto imported = trisect::import_mesh(mesh, options);
        return std::to_string(imported.mesh.triangles.size());
    });
}

TEST(AllocationFailure, BooleanOfTouchingBoxes) {
    const Solid a = box(0, 2);
    const Solid b = box(1, 3);
    const Solid c = box(2, 4);
    const Expression formula = (a | b) - (c ^ a);
    fail_every_allocation([&] { return bytes_of(evaluate(formula, one_thread()).to_mesh()); });
}

TEST(AllocationFailure, BooleanInGeneralPosition) {
    const Solid a = Solid::from_mesh(trisect::make_icosphere(1, 1));
    const Solid b = box(0.1, 1.5);
    const std::string before = bytes_of(a.to_mesh());
    fail_every_allocation([&] { return bytes_of(evaluate(a - b, one_thread()).to_mesh()); });
    EXPECT_EQ(bytes_of(a.to_mesh()), before);
}

// Large enough not to be divided.
TEST(AllocationFailure, BooleanOfTwoLargeMeshes) {
    PolygonMesh moved = trisect::make_icosphere(1, 3);
    for (auto& p : moved.points) {
        p[0] += 0.73;
        p[1] *= 0.81;
        p[2] += 0.11 * p[0] + 0.03;
    }
    const Solid a = Solid::from_mesh(trisect::make_icosphere(1, 3));
    const Solid b = Solid::from_mesh(moved);
    trisect::EvaluateOptions options;
    options.threads = 1;
    fail_every_allocation([&] { return bytes_of(evaluate(a - b, options).to_mesh(1)); });
}

TEST(AllocationFailure, BooleanOfASolidThatMeetsItself) {
    PolygonMesh mesh = trisect::make_box({0, 0, 0}, {2, 2, 2});
    const PolygonMesh other = trisect::make_box({1, 1, 1}, {3, 3, 3});
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (const std::uint32_t corner : other.corners) mesh.corners.push_back(first + corner);
    for (std::size_t f = 1; f < other.face_begin.size(); ++f)
        mesh.face_begin.push_back(mesh.face_begin[other.face_begin.size() - 1] +
                                  other.face_begin[f]);
    const Solid a =
        Solid::from_mesh(mesh, {.import = {}, .embedding = trisect::Embedding::Resolve});
    fail_every_allocation([&] { return bytes_of(evaluate(a | a, one_thread()).to_mesh()); });
}

TEST(AllocationFailure, BooleanOfOperandsOnDifferentLattices) {
    const Solid a = evaluate(box(0, 2) - box(1, 3), one_thread());
    const Solid b = evaluate(box(0, 0.015625) | box(0.0078125, 0.03125), one_thread());
    fail_every_allocation([&] { return bytes_of(evaluate(a - b, one_thread()).to_mesh()); });
}

// A leaf that is arranged as segments in a plane, and one across the axes.
TEST(AllocationFailure, BooleanOfPrisms) {
    const auto prism = [](std::uint32_t sides, double radius, double low) {
        auto mesh = trisect::make_regular_prism(sides, radius, 2);
        for (auto& p : mesh.points) p[2] += low;
        return Solid::from_mesh(mesh);
    };
    const Solid a = prism(5, 2, 0);
    const Solid b = prism(7, 1.75, 0.5);
    trisect::EvaluateOptions options = one_thread();
    options.leaf_polygons = 25;
    fail_every_allocation([&] { return bytes_of(evaluate(a - b, options).to_mesh()); });
}

// Shares trees, flattens them, cuts fragments again.
TEST(AllocationFailure, ChainOfResults) {
    const Solid ball = Solid::from_mesh(trisect::make_icosphere(1, 1));
    const Solid a = evaluate(ball - box(0.1, 1.5), one_thread());
    const Solid b = evaluate(ball & box(-0.3, 0.7), one_thread());
    fail_every_allocation([&] { return bytes_of(evaluate(a ^ b, one_thread()).to_mesh()); });
}

TEST(AllocationFailure, ExpressionsAreMadeAndEnded) {
    const Solid a = box(0, 2);
    const Solid b = box(1, 3);
    fail_every_allocation([&] {
        Expression e = a;
        for (int i = 0; i < 20; ++i) e = i % 2 == 0 ? (e - b) : (e | ~(a ^ b));
        return std::string("made");
    });
}

TEST(AllocationFailure, MaximalFacesAndTheirMeasures) {
    const Solid s = evaluate(box(0, 2) - box(1, 3), one_thread());
    fail_every_allocation([&] { return trisect::exact_text(s.to_brep()); });
    const trisect::Brep brep = s.to_brep();
    fail_every_allocation([&] { return std::to_string(trisect::volume(brep)); });
}

TEST(AllocationFailure, Readers) {
    const PolygonMesh mesh = trisect::make_icosphere(1, 0);
    for (const MeshFormat format : {MeshFormat::Obj, MeshFormat::Off, MeshFormat::Ply,
                                    MeshFormat::StlAscii, MeshFormat::StlBinary}) {
        const std::string file = trisect::format_mesh(mesh, {.format = format}).bytes;
        fail_every_allocation([&] { return bytes_of(trisect::read_mesh(file, format, "memory")); });
        // Malformed: the error has to be worded with what memory there is.
        const std::string half = file.substr(0, file.size() / 2);
        fail_every_allocation([&]() -> std::string {
            try {
                return bytes_of(trisect::read_mesh(half, format, "memory"));
            } catch (const trisect::Error& e) {
                return e.what();
            }
        });
    }
}

TEST(AllocationFailure, ExactBoundaries) {
    const std::string text =
        trisect::exact_text(evaluate(box(0, 2) - box(1, 3), one_thread()).to_brep());
    fail_every_allocation([&] { return trisect::exact_text(trisect::read_exact(text, "memory")); });
}

TEST(AllocationFailure, Validation) {
    PolygonMesh mesh = trisect::make_icosphere(1, 1);
    mesh.points[0] = {-2, -2, -2};                 // crosses others
    mesh.corners.resize(mesh.corners.size() - 3);  // and is open
    mesh.face_begin.pop_back();
    fail_every_allocation([&] { return trisect::validate(mesh).to_string(); });
}

TEST(AllocationFailure, Index) {
    const Solid s =
        evaluate(Solid::from_mesh(trisect::make_icosphere(1, 2)) - box(0, 2), one_thread());
    fail_every_allocation([&] {
        const trisect::BrepIndex index = trisect::BrepIndex(s).with_brep();
        std::string out;
        for (double x = -1; x <= 1; x += 0.25)
            out += std::to_string(static_cast<int>(index.locate(std::array{x, 0.1, 0.2}).location));
        out += index.first_hit(trisect::Ray{{-3, 0.1, 0.2}, {1, 0, 0}}) ? "hit" : "miss";
        return out;
    });
}

TEST(AllocationFailure, IndexThatIsSharedAndAsked) {
    const Solid s = Solid::from_mesh(trisect::make_icosphere(1, 2));
    const trisect::BrepIndex index(s);
    fail_every_allocation([&] {
        std::string out;
        for (double x = -1; x <= 1; x += 0.0625)
            out += std::to_string(static_cast<int>(index.locate(std::array{x, 0.1, 0.2}).location));
        return out;
    });
}

TEST(AllocationFailure, Interference) {
    const Solid a = Solid::from_mesh(trisect::make_icosphere(1, 1));
    const Solid b = box(0, 1);
    fail_every_allocation([&] {
        const trisect::InterferenceModel model_a(a);
        const trisect::InterferenceModel model_b(b);
        const auto result = interfere(model_a, trisect::Pose(), model_b, trisect::Pose());
        return std::to_string(static_cast<int>(result.relation)) + " " +
               std::to_string(result.contacts.size());
    });
}

TEST(AllocationFailure, MspTrees) {
    const trisect::Brep brep = evaluate(box(0, 2) - box(1, 3), one_thread()).to_brep();
    fail_every_allocation([&] {
        const trisect::MspTree tree = trisect::MspTree::from_brep(brep);
        return std::to_string(tree.stats().nodes[3]);
    });
}

}  // namespace
