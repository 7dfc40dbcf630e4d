// SPDX-License-Identifier: Apache-2.0
//
// Locks of folders: one run at a time, of any number of processes.

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>

#include <trisect/kernel/error.h>

#include "pieces/folder_lock.h"
#include "scratch.h"

namespace {

using trisect::Error;
using trisect::app::FolderLock;

class FolderLockTest : public trisect::test::Scratch {
protected:
    [[nodiscard]] std::string folder() const { return path("out.slabs"); }
};

TEST_F(FolderLockTest, OneRunHoldsAFolder) {
    FolderLock first;
    first.take(folder(), 0);
    EXPECT_TRUE(first.is_held());
    FolderLock second;
    EXPECT_THROW(second.take(folder(), 0), Error);
    EXPECT_THROW(second.join(folder()), Error);
    EXPECT_FALSE(second.is_held());
    first = FolderLock();
    second.take(folder(), 0);
    EXPECT_TRUE(second.is_held());
}

TEST_F(FolderLockTest, ProcessesOfOneRunShareIt) {
    FolderLock first;
    first.take(folder(), 0);
    first.share();
    FolderLock second;
    second.join(folder());
    FolderLock moved(std::move(second));
    first = FolderLock();
    FolderLock next;
    EXPECT_THROW(next.take(folder(), 0), Error);
    moved = FolderLock();
    next.take(folder(), 0);
    EXPECT_TRUE(next.is_held());
}

TEST_F(FolderLockTest, TheNextRunWaitsForTheLastOne) {
    FolderLock first;
    first.take(folder(), 0);
    first.share();
    std::thread last([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        std::filesystem::remove_all(folder());  // its end
        first = FolderLock();
    });
    FolderLock next;
    EXPECT_NO_THROW(next.take(folder(), 60));
    last.join();
    EXPECT_TRUE(next.is_held());
    EXPECT_TRUE(std::filesystem::exists(trisect::app::lock_name(folder())));
}

TEST_F(FolderLockTest, NoFolderIsAnError) {
    FolderLock lock;
    EXPECT_THROW(lock.join(folder()), Error);
    const std::string file = write("file", "x");
    EXPECT_THROW(lock.take(file + "/out.slabs", 0), Error);
    EXPECT_FALSE(lock.is_held());
}

}  // namespace
