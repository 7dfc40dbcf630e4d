// SPDX-License-Identifier: Apache-2.0
#include "ranks.h"

#include <trisect/kernel/error.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>
#include <utility>

namespace trisect::app {

int Ranks::rank() {
    int out = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &out);
    return out;
}

int Ranks::count() {
    int out = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &out);
    return out;
}

void Ranks::send(int to, Tag tag, std::string bytes) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw UnsupportedError("a message of more than 2 GiB");
    if (to == rank()) {
        own_.push_back({to, tag, std::move(bytes)});
        return;
    }
    (void)has_sent_all();
    ++messages_;
    bytes_ += bytes.size();
    Sent& sent = sent_.emplace_back();
    sent.bytes = std::move(bytes);
    MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, to, tag,
              MPI_COMM_WORLD, &sent.request);
}

std::optional<Ranks::Message> Ranks::receive() {
    if (!own_.empty()) {
        Message out = std::move(own_.front());
        own_.pop_front();
        return out;
    }
    int is_there = 0;
    MPI_Message handle{};
    MPI_Status status{};
    MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &handle, &status);
    if (is_there == 0) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Message out{status.MPI_SOURCE, status.MPI_TAG,
                std::string(static_cast<std::size_t>(size), '\0')};
    MPI_Mrecv(out.bytes.data(), size, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
    ++messages_;
    bytes_ += out.bytes.size();
    return out;
}

bool Ranks::has_sent_all() {
    sent_.remove_if([](Sent& s) {
        int is_done = 0;
        MPI_Test(&s.request, &is_done, MPI_STATUS_IGNORE);
        return is_done != 0;
    });
    return sent_.empty();
}

void Ranks::leave() {
    MPI_Request request = MPI_REQUEST_NULL;
    Patience patience;
    for (int is_done = 0; is_done == 0; patience.wait()) {
        while (receive()) continue;
        if (request == MPI_REQUEST_NULL && has_sent_all()) MPI_Ibarrier(MPI_COMM_WORLD, &request);
        if (request != MPI_REQUEST_NULL) MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
    }
}

void Patience::wait() { std::this_thread::sleep_for(next()); }

std::chrono::microseconds Patience::next() {
    const std::chrono::microseconds now(microseconds_);
    microseconds_ = std::min(microseconds_ + 25, most);
    return now;
}

}  // namespace trisect::app
