// SPDX-License-Identifier: Apache-2.0
//
// Everything that takes long can be stopped, at every place where it looks: the budget of a scope
// is set to every number of units that a call takes, and the call has to end in LimitError, without
// a trace, until the budget suffices.

#include <trisect/kernel/stop_scope.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include <trisect/brep/io/exact_boundary.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_transform.h>

namespace {

using trisect::MeshFormat;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::StopScope;

std::string bytes_of(const PolygonMesh& mesh) {
    return trisect::format_mesh(mesh, {.format = MeshFormat::Off}).bytes;
}

// `least`: places at which the call has to look.
void stop_everywhere(std::uint64_t least, const std::function<std::string()>& call) {
    std::string expected;
    std::uint64_t units = 0;
    {
        const StopScope counting(nullptr);
        expected = call();
        units = counting.work();
    }
    EXPECT_GE(units, least);
    std::uint64_t stopped = 0;
    for (std::uint64_t budget = 1; budget <= units; budget += 1 + units / 400) {
        const StopScope scope({.max_work = budget});
        try {
            EXPECT_EQ(call(), expected);
            EXPECT_EQ(budget, units);
        } catch (const trisect::LimitError& e) {
            ++stopped;
            EXPECT_NE(std::string(e.what()).find("work budget"), std::string::npos);
        }
    }
    EXPECT_GT(stopped, 0U);
    const std::atomic<bool> cancel = true;
    const StopScope scope(&cancel);
    EXPECT_THROW((void)call(), trisect::CancelledError);
}

Solid cut_ball() {
    const Solid ball = Solid::from_mesh(trisect::make_icosphere(1, 3));
    const Solid box = Solid::from_mesh(trisect::make_box({0, 0, 0}, {2, 2, 2}));
    trisect::EvaluateOptions options;
    options.threads = 1;
    return evaluate(ball - box, options);
}

TEST(Stop, ImportOfTriangles) {
    const PolygonMesh mesh = trisect::make_icosphere(1, 3);
    stop_everywhere(mesh.face_count(), [&] {
        return std::to_string(trisect::import_mesh(mesh).mesh.triangles.size());
    });
}

TEST(Stop, ImportOfPolygons) {
    const PolygonMesh mesh = trisect::make_uv_sphere(1, 24, 16);
    stop_everywhere(mesh.face_count(), [&] {
        return std::to_string(trisect::import_mesh(mesh).mesh.triangles.size());
    });
}

TEST(Stop, Readers) {
    const PolygonMesh mesh = trisect::make_icosphere(1, 2);
    for (const MeshFormat format :
         {MeshFormat::Obj, MeshFormat::Off, MeshFormat::StlAscii, MeshFormat::StlBinary}) {
        const std::string file = trisect::format_mesh(mesh, {.format = format}).bytes;
        stop_everywhere(1, [&] { return bytes_of(trisect::read_mesh(file, format, "memory")); });
    }
}

TEST(Stop, Validation) {
    const PolygonMesh mesh = trisect::make_icosphere(1, 2);
    stop_everywhere(mesh.face_count(), [&] { return trisect::validate(mesh).to_string(); });
}

TEST(Stop, AssemblyOfTriangles) {
    const Solid s = cut_ball();
    stop_everywhere(100, [&] { return bytes_of(s.to_mesh()); });
}

TEST(Stop, AssemblyOfMaximalFaces) {
    const Solid s = cut_ball();
    stop_everywhere(100, [&] { return trisect::exact_text(s.to_brep()); });
}

TEST(Stop, EvaluationTakesTheFlagOfItsThread) {
    const Solid a = Solid::from_mesh(trisect::make_icosphere(1, 3));
    const Solid b = Solid::from_mesh(trisect::make_box({0, 0, 0}, {2, 2, 2}));
    std::atomic<bool> cancel = true;
    std::atomic<bool> other = false;
    const StopScope scope(&cancel);
    EXPECT_THROW((void)evaluate(a - b), trisect::CancelledError);
    const StopScope inner(&other);  // what stops the outer scope stops it, too
    EXPECT_THROW((void)evaluate(a - b), trisect::CancelledError);
    cancel = false;
    EXPECT_FALSE(evaluate(a - b).is_empty());
    other = true;
    EXPECT_THROW((void)evaluate(a - b), trisect::CancelledError);
}

// Threads of an evaluation look at the flags, too, and a scope inside without a flag hides none.
TEST(Stop, EvaluationTakesTheNextFlagAroundIt) {
    const Solid a = Solid::from_mesh(trisect::make_icosphere(1, 5));
    const Solid b = Solid::from_mesh(trisect::make_uv_sphere(1.01, 160, 80));
    const std::atomic<bool> cancel = true;
    const StopScope scope(&cancel);
    const StopScope inner({.max_memory = std::uint64_t{1} << 40});
    trisect::EvaluateOptions options;
    options.threads = 4;
    EXPECT_THROW((void)evaluate(a ^ b, options), trisect::CancelledError);
}

Solid slanted_box(const trisect::Point3d& low, const trisect::Point3d& high) {
    PolygonMesh mesh = trisect::make_box(low, high);
    for (trisect::Point3d& p : mesh.points) p = {p[0] - p[1] / 4, p[1] + p[0] / 4, p[2]};
    return Solid::from_mesh(mesh);
}

// A plate with a pocket is outlined first, and cut when the next operation needs its tree.
TEST(Stop, CuttingOfAnOutlinedOperand) {
    const Solid plate = slanted_box({0, 0, 0}, {9, 9, 3});
    const Solid pocket = slanted_box({2, 2, 1}, {4, 4, 5});
    trisect::EvaluateOptions options;
    options.leaf_polygons = 0;
    const Solid part = evaluate(plate - pocket, options);
    const auto outlined = trisect::detail::state_of(part)->lazy_tree();
    ASSERT_NE(outlined, nullptr);
    const std::atomic<bool> cancel = true;
    {
        const StopScope scope(&cancel);
        EXPECT_THROW((void)evaluate(part | pocket, options), trisect::CancelledError);
        EXPECT_FALSE(outlined->is_cut());
    }
    {
        // The tree counts in the scope of the call that needs it, and is not kept in part.
        const StopScope scope({.max_work = 1});
        EXPECT_THROW((void)evaluate(part | pocket), trisect::LimitError);
        EXPECT_FALSE(outlined->is_cut());
    }
    {
        const StopScope scope({.max_memory = 1});
        EXPECT_THROW((void)evaluate(part | pocket), trisect::LimitError);
        EXPECT_FALSE(outlined->is_cut());
    }
    {
        const StopScope scope(&cancel);
        EXPECT_THROW((void)part.to_brep(), trisect::CancelledError);
        EXPECT_THROW((void)evaluate(part | pocket), trisect::CancelledError);
        EXPECT_FALSE(outlined->is_cut());
    }
    EXPECT_EQ(part.to_brep().vertices().size(), 16U);
    EXPECT_FALSE(outlined->is_cut());
    EXPECT_FALSE(evaluate(part | pocket).is_empty());
    EXPECT_TRUE(outlined->is_cut());
}

TEST(Stop, OuterScopesStopInnerOnes) {
    const StopScope outer({.max_work = 10});
    StopScope inner({.max_work = 1000});
    trisect::detail::check_stop(10);
    EXPECT_THROW(trisect::detail::check_stop(), trisect::LimitError);
    EXPECT_EQ(inner.work(), 11U);
    EXPECT_EQ(outer.work(), 11U);
}

// Goes on so many times.
class Patience final : public trisect::StopAttendant {
public:
    explicit Patience(std::uint64_t times) : left_(times) {}
    [[nodiscard]] bool goes_on(bool) noexcept override {
        ++asked_;
        return left_ != 0 && left_-- != 0;
    }
    [[nodiscard]] std::uint64_t asked() const { return asked_; }

private:
    std::uint64_t left_;
    std::uint64_t asked_ = 0;
};

TEST(Stop, AnAttendantIsAskedAtEveryEighthLook) {
    Patience patience(3);
    const StopScope scope({.attendant = &patience});
    for (int i = 0; i < 31; ++i) trisect::detail::check_stop();
    EXPECT_EQ(patience.asked(), 3U);
    EXPECT_THROW(trisect::detail::check_stop(), trisect::CancelledError);
    EXPECT_EQ(patience.asked(), 4U);
}

TEST(Stop, AnAttendantIsAskedAfterLongSteps) {
    Patience patience(2);
    const StopScope scope({.attendant = &patience});
    trisect::detail::check_stop(1'000'000);
    trisect::detail::end_step();
    EXPECT_EQ(patience.asked(), 2U);
    EXPECT_THROW(trisect::detail::end_step(), trisect::CancelledError);
}

// Import looks a few times only, after all of a large mesh.
TEST(Stop, AnAttendantStopsImportAndValidation) {
    const PolygonMesh mesh = trisect::make_icosphere(1, 5);
    const auto import_as = [&](trisect::Embedding embedding) {
        return Solid::from_mesh(mesh, {.embedding = embedding});
    };
    const std::function<void()> calls[] = {[&] { (void)import_as(trisect::Embedding::Assume); },
                                           [&] { (void)import_as(trisect::Embedding::Check); },
                                           [&] { (void)import_as(trisect::Embedding::Resolve); },
                                           [&] { (void)validate(mesh); }};
    for (const auto& call : calls) {
        Patience endless(~std::uint64_t{0});
        {
            const StopScope scope({.attendant = &endless});
            call();
        }
        EXPECT_GE(endless.asked(), 3U);
        for (std::uint64_t times = 0; times < endless.asked(); times += 1 + times / 4) {
            Patience patience(times);
            const StopScope scope({.attendant = &patience});
            EXPECT_THROW(call(), trisect::CancelledError);
        }
    }
}

TEST(Stop, AnAttendantStopsEvaluation) {
    const Solid ball = Solid::from_mesh(trisect::make_icosphere(1, 4));
    const Solid part = cut_ball();
    Patience endless(~std::uint64_t{0});
    {
        const StopScope scope({.attendant = &endless});
        EXPECT_FALSE(evaluate(ball - part).to_mesh(1).points.empty());
    }
    EXPECT_GT(endless.asked(), 1U);
    Patience patience(endless.asked() / 2);
    const StopScope scope({.attendant = &patience});
    EXPECT_THROW((void)evaluate(ball - cut_ball()).to_mesh(1), trisect::CancelledError);
}

// Works with a solid whenever it may, as a handler of an interpreter would.
class User final : public trisect::StopAttendant {
public:
    explicit User(Solid solid) : solid_(std::move(solid)) {}
    [[nodiscard]] bool goes_on(bool holds_locks) noexcept override {
        if (holds_locks) ++refused_;
        if (is_busy_) return true;
        is_busy_ = true;
        if (!holds_locks && ++used_ % 64 == 1)
            is_outside_ = is_outside_ &&
                          trisect::BrepIndex(solid_).locate(trisect::Point3d{3, 0, 0}).location ==
                              trisect::Location::Outside;
        is_busy_ = false;
        return true;
    }
    [[nodiscard]] std::uint64_t used() const { return used_; }
    [[nodiscard]] std::uint64_t refused() const { return refused_; }
    [[nodiscard]] bool found_the_point_outside() const { return is_outside_; }

private:
    Solid solid_;
    std::uint64_t used_ = 0;
    std::uint64_t refused_ = 0;
    bool is_outside_ = true;
    bool is_busy_ = false;
};

TEST(Stop, AnAttendantMayUseTheSolidsUnlessLocksAreHeld) {
    const Solid ball = Solid::from_mesh(trisect::make_icosphere(1, 5));
    trisect::EvaluateOptions one_thread;
    one_thread.threads = 1;
    const Solid moved =
        transformed(ball, trisect::AffineMap::translation(trisect::Point3d{0.5, 0.1, 0.2}));
    // Its tree is made at the first question.
    const Solid part = evaluate(ball - moved, one_thread);
    User user(part);
    const StopScope scope({.attendant = &user});
    (void)trisect::BrepIndex(part).locate(trisect::Point3d{0, 0, 0.5});
    EXPECT_FALSE(evaluate(part | moved).to_mesh(1).points.empty());
    EXPECT_TRUE(user.found_the_point_outside());
    EXPECT_GT(user.used(), 0U);
    EXPECT_GT(user.refused(), 0U);
}

TEST(Stop, OtherThreadsAskNoAttendant) {
    Patience patience(0);
    const StopScope scope({.attendant = &patience});
    std::thread([&] {
        for (int i = 0; i < 100; ++i) scope.check_flags();
    }).join();
    EXPECT_EQ(patience.asked(), 0U);
}

TEST(Stop, NothingIsCountedOutsideOfAScope) {
    { const StopScope scope({.max_work = 1}); }
    EXPECT_NO_THROW(trisect::detail::check_stop(1'000'000));
}

TEST(Stop, TheLeastThatIsLeftHolds) {
    StopScope outer({.max_work = 100, .max_memory = 7});
    EXPECT_EQ(outer.work_left().units, 100U);
    const StopScope inner({.max_work = 60});
    EXPECT_EQ(inner.work_left().units, 60U);
    EXPECT_EQ(inner.max_memory(), 7U);
    outer.count(90);  // by a call of an inner scope that has ended
    EXPECT_EQ(inner.work_left().units, 10U);
    EXPECT_EQ(inner.work_left().max_work, 100U);
    outer.count(90);
    EXPECT_EQ(inner.work_left().units, 0U);
    const StopScope smaller({.max_memory = 5});
    const StopScope larger({.max_memory = 9});
    EXPECT_EQ(larger.max_memory(), 5U);
    EXPECT_EQ(larger.work_left().units, 0U);
}

}  // namespace
