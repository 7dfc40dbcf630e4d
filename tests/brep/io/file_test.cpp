// SPDX-License-Identifier: Apache-2.0
//
// Files: choosing the format, unreadable and unwritable places, and leaving nothing behind.
#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/output_file.h>

#include "support/mesh_files.h"

#include <csignal>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>

#include <sys/stat.h>
#include <unistd.h>

namespace {

using namespace trisect;
using namespace trisect::io_test;
namespace fs = std::filesystem;

std::string content(const fs::path& path) { return std::string(read_file(path, 1U << 30).view()); }

void put(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

std::string write_error(const fs::path& path) {
    try {
        write_mesh(path, tetrahedron(), {.format = MeshFormat::Obj});
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::Input);
        return e.what();
    }
    ADD_FAILURE() << "written";
    return {};
}

TEST(Files, FormatByExtension) {
    const TemporaryFolder folder;
    for (const std::string name : {"a.obj", "a.OBJ", "a.stl", "a.STL", "a.off", "a.ply"}) {
        const fs::path path = folder.path() / name;
        write_mesh(path, tetrahedron());
        EXPECT_EQ(read_mesh(path).face_count(), 4U) << name;
    }
    EXPECT_THROW(write_mesh(folder.path() / "a.xyz", tetrahedron()), UsageError);
    EXPECT_THROW(write_mesh(folder.path() / "a", tetrahedron()), UsageError);
    EXPECT_EQ(folder.entries(), 6U);
}

TEST(Files, FormatByContent) {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "mesh";
    for (const MeshFormat f : {MeshFormat::Obj, MeshFormat::Off, MeshFormat::Ply,
                               MeshFormat::StlBinary, MeshFormat::StlAscii}) {
        write_mesh(path, tetrahedron(), {.format = f});
        EXPECT_EQ(detect_mesh_format(content(path)), f);
        EXPECT_EQ(read_mesh(path).face_count(), 4U);
    }
    put(path, "hello\n");
    EXPECT_THROW((void)read_mesh(path), InputError);
    EXPECT_THROW((void)read_mesh(path, {.format = MeshFormat::Obj, .limits = {}}), InputError);
}

TEST(Files, FormatNames) {
    for (const MeshFormat f :
         {MeshFormat::Obj, MeshFormat::Stl, MeshFormat::StlAscii, MeshFormat::StlBinary,
          MeshFormat::Off, MeshFormat::Ply, MeshFormat::ThreeMf, MeshFormat::Glb, MeshFormat::Amf,
          MeshFormat::Step, MeshFormat::Dxf}) {
        EXPECT_EQ(mesh_format_from_name(to_string(f)), f);
    }
    EXPECT_EQ(mesh_format_from_name("igs"), std::nullopt);
    EXPECT_EQ(mesh_format_from_name("PLY"), MeshFormat::Ply);
}

TEST(Files, UnreadableFiles) {
    const TemporaryFolder folder;
    const auto message = [](const fs::path& path) {
        try {
            (void)read_mesh(path);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    EXPECT_NE(message(folder.path() / "none.obj").find("none.obj"), std::string::npos);
    EXPECT_NE(message(folder.path()).find("cannot read"), std::string::npos);
    put(folder.path() / "empty.stl", "");
    EXPECT_NE(message(folder.path() / "empty.stl").find("is empty"), std::string::npos);
    EXPECT_THROW((void)read_file("/dev/zero", 1000), LimitError);
    put(folder.path() / "long.obj", std::string(1001, '\n'));
    EXPECT_THROW((void)read_file(folder.path() / "long.obj", 1000), LimitError);
    EXPECT_EQ(read_file(folder.path() / "long.obj", 1001).view().size(), 1001U);
}

TEST(Files, UnwritablePlacesLeaveNothing) {
    const TemporaryFolder folder;
    EXPECT_NE(write_error(folder.path() / "none" / "a.obj").find("a.obj"), std::string::npos);
    const fs::path sub = folder.path() / "a.obj";
    fs::create_directory(sub);
    EXPECT_NE(write_error(sub).find("a.obj"), std::string::npos);
    EXPECT_EQ(folder.entries(), 1U);
    EXPECT_NE(write_error(folder.path() / std::string(300, 'n')).find("nnn"), std::string::npos);
    EXPECT_EQ(folder.entries(), 1U);
    if (::geteuid() == 0) {
        std::cout << "running as root: folders without write permission not tested\n";
        return;
    }
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_NE(write_error(folder.path() / "b.obj").find("b.obj"), std::string::npos);
    EXPECT_EQ(folder.entries(), 1U);
}

TEST(Files, FullDeviceIsAnError) {
    if (!fs::exists("/dev/full")) {
        std::cout << "no /dev/full here: not tested\n";
        return;
    }
    EXPECT_NE(write_error("/dev/full").find("/dev/full: cannot write"), std::string::npos);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(Files, ReplacingKeepsPermissionsAndLinks) {
    const TemporaryFolder folder;
    const fs::path target = folder.path() / "a.obj";
    const fs::path link = folder.path() / "b.obj";
    put(target, "old");
    fs::permissions(target, fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink(target, link);
    write_mesh(link, tetrahedron());
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(read_mesh(target).face_count(), 4U);
    EXPECT_EQ(fs::status(target).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(folder.entries(), 2U);
    PolygonMesh broken = tetrahedron();
    broken.corners[0] = 9;
    EXPECT_THROW(write_mesh(target, broken), UsageError);
    EXPECT_EQ(read_mesh(target).face_count(), 4U);
}

TEST(Files, LinksToFilesThatAreNotThereAreFollowed) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "there");
    fs::create_symlink("there/mesh.obj", folder.path() / "first");
    fs::create_symlink("first", folder.path() / "second");
    EXPECT_EQ(output_target(folder.path() / "second"), folder.path() / "there/mesh.obj");
    write_file(folder.path() / "second", "text");
    EXPECT_TRUE(fs::is_symlink(folder.path() / "first"));
    EXPECT_TRUE(fs::is_symlink(folder.path() / "second"));
    EXPECT_EQ(content(folder.path() / "there/mesh.obj"), "text");

    fs::create_symlink("nowhere/mesh.obj", folder.path() / "astray");
    fs::create_symlink("circle", folder.path() / "circle");
    EXPECT_NE(write_error(folder.path() / "astray").find("No such file"), std::string::npos);
    EXPECT_NE(write_error(folder.path() / "circle").find("symbolic links"), std::string::npos);
    EXPECT_TRUE(fs::is_symlink(folder.path() / "astray"));
    const auto entries = fs::recursive_directory_iterator(folder.path());
    EXPECT_EQ(std::distance(begin(entries), end(entries)), 6);
}

TEST(Files, PipesAreReadAndAClosedPipeIsAnError) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    write_descriptor(ends[1], "pipe", "OFF 0 0 0\n");
    ::close(ends[1]);
    EXPECT_EQ(read_descriptor(ends[0], "pipe", 1000).view(), "OFF 0 0 0\n");
    ::close(ends[0]);
    ASSERT_EQ(::pipe(ends), 0);
    ::close(ends[0]);
    // Without protection this would end the process by SIGPIPE.
    EXPECT_THROW(write_descriptor(ends[1], "pipe", "x"), Error);
    EXPECT_THROW(write_descriptor(ends[1], "pipe", "x"), Error);
    ::close(ends[1]);
    sigset_t pending;
    sigemptyset(&pending);
    sigpending(&pending);
    EXPECT_EQ(sigismember(&pending, SIGPIPE), 0);
}

// Its size is not known before: the buffer grows several times.
TEST(Files, PipesOfManyBytesAreReadWhole) {
    std::string sent;
    while (sent.size() < 1'000'000) sent += std::to_string(sent.size()) + " ";
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    std::thread writer([&] {
        write_descriptor(ends[1], "pipe", sent);
        ::close(ends[1]);
    });
    const FileBytes received = read_descriptor(ends[0], "pipe", 2'000'000);
    writer.join();
    ::close(ends[0]);
    EXPECT_TRUE(received.view() == sent);
}

TEST(Files, EndlessPipesStopAtTheLimit) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    std::thread writer([&] {
        // Until nobody reads any more.
        EXPECT_THROW(write_descriptor(ends[1], "pipe", std::string(5'000'000, 'x')), Error);
        ::close(ends[1]);
    });
    EXPECT_THROW((void)read_descriptor(ends[0], "pipe", 100'000), LimitError);
    ::close(ends[0]);
    writer.join();
}

TEST(Files, BytesAndTextReadAlike) {
    const FormattedMesh file = format_mesh(tetrahedron(), {.format = MeshFormat::Ply});
    EXPECT_EQ(read_mesh(std::as_bytes(std::span(file.bytes)), MeshFormat::Ply, "x"), tetrahedron());
}

}  // namespace
