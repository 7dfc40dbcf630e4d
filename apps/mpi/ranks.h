// SPDX-License-Identifier: Apache-2.0
//
// Messages by MPI: whole strings, from one rank to another.
#pragma once

#include <cstdint>
#include <list>
#include <optional>
#include <string>

#include <mpi.h>

namespace trisect::app {

/// All calls are of the thread that made MPI ready.
class Ranks {
public:
    enum Tag : int { Start = 1, Task = 2, Result = 3, Manifest = 4 };

    [[nodiscard]] static int rank();
    [[nodiscard]] static int count();

    /// Returns at once; the bytes are kept until they have arrived.
    void send(int to, Tag tag, std::string bytes);
    struct Message {
        int from = 0;
        int tag = 0;
        std::string bytes;
    };
    /// What has arrived, from anybody; nothing if nothing has.
    [[nodiscard]] std::optional<Message> receive();

    [[nodiscard]] std::uint64_t messages() const { return messages_; }  ///< sent and received
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] bool has_sent_all();

private:
    struct Sent {
        std::string bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    std::list<Sent> sent_;
    std::uint64_t messages_ = 0;
    std::uint64_t bytes_ = 0;
};

/// Waits a little longer each time that nothing has come: blocking calls of MPI would keep a
/// processor busy, and not look at the flag that ends the run.
class Patience {
public:
    void wait();
    void reset() { microseconds_ = 0; }

private:
    unsigned microseconds_ = 0;
};

}  // namespace trisect::app
