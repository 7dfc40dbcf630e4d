// SPDX-License-Identifier: Apache-2.0
//
// Messages by MPI: whole strings, from one rank to another.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <list>
#include <optional>
#include <string>

#include <mpi.h>

namespace trisect::app {

/// All calls are of the thread that made MPI ready.
class Ranks {
public:
    enum Tag : int {
        Hashes = 1,  ///< of identities, to compare
        Summary,     ///< of a manifest
        Start,
        Order,
        Result,
        Files,
        Survey,   ///< of parts
        Regions,  ///< of space
        Parts,    ///< for the rank that has their region
        Tiles,    ///< of the regions of a rank
        Fetch,    ///< an order whose tile is of the rank that is asked
        Task      ///< the answer
    };

    [[nodiscard]] static int rank();
    [[nodiscard]] static int count();

    /// Returns at once; the bytes are kept until they have arrived. A rank may send to itself.
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
    /// Returns when all ranks are here and all messages have arrived; what comes is dropped.
    void leave();

private:
    struct Sent {
        std::string bytes;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    std::list<Sent> sent_;
    std::deque<Message> own_;  // to itself
    std::uint64_t messages_ = 0;
    std::uint64_t bytes_ = 0;
};

/// Waits a little longer each time that nothing has come: blocking calls of MPI would keep a
/// processor busy, and not look at the flag that ends the run.
class Patience {
public:
    void wait();
    /// How long to wait now.
    [[nodiscard]] std::chrono::microseconds next();
    void reset() { microseconds_ = least; }

private:
    // Ranks have work ahead of them meanwhile, and asking takes as long as a pair or two.
    static constexpr unsigned least = 50;
    static constexpr unsigned most = 2000;
    unsigned microseconds_ = least;
};

}  // namespace trisect::app
