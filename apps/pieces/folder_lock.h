// SPDX-License-Identifier: Apache-2.0
//
// FolderLock: a folder of one run, which no other run may change meanwhile.
#pragma once

#include <string>

namespace trisect::app {

/// A lock on the file `job.lock` of a folder, for the time that this object lives. The first
/// process of a run takes it for itself, makes the folder what it must be, and shares it with the
/// processes of the same run; the next run begins when all of them have ended. The system drops
/// the lock of a process that is killed.
///
/// Processes of a run whose launcher was killed live on for some seconds and still write files:
/// without the lock they removed what the next run was about to read.
///
/// Where the file system has no locks nothing is held, and nothing is waited for.
class FolderLock {
public:
    FolderLock() = default;
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&& other) noexcept;
    ~FolderLock();

    /// Makes the folder where it is missing, and waits for all who hold it.
    /// \throw Error (Input) if it cannot be made, or is still held after `seconds`
    void take(const std::string& folder, double seconds);
    /// Of what take() has: others may share it from now on.
    void share() const;
    /// Holds, in another process, the folder that the first one shares.
    /// \throw Error (Input) where a run has it for itself or it is missing
    void join(const std::string& folder);
    [[nodiscard]] bool is_held() const { return file_ >= 0; }

private:
    void close() noexcept;

    int file_ = -1;
};

/// \throw Error (Input) if it cannot be made; it may be there
void make_folder(const std::string& name);

/// The name of the file within the folder.
[[nodiscard]] std::string lock_name(const std::string& folder);

}  // namespace trisect::app
