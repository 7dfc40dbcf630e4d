// SPDX-License-Identifier: Apache-2.0

#include "call.h"

#include <exception>
#include <new>

#include "handles.h"

namespace trisect::c {

namespace {

// Of this thread; a message that does not fit into memory is replaced by its kind.
thread_local std::string message_of_thread;

void keep(const char* message) noexcept {
    try {
        message_of_thread = message;
    } catch (...) {
        message_of_thread.clear();
    }
}

}  // namespace

ThreadLimits& limits_of_thread() noexcept {
    thread_local ThreadLimits limits;
    return limits;
}

trisect_status keep_error() noexcept {
    try {
        throw;
    } catch (const Error& error) {
        keep(error.what());
        return static_cast<trisect_status>(error.code());
    } catch (const std::bad_alloc&) {
        keep("out of memory");
        return TRISECT_NO_MEMORY;
    } catch (const std::exception& error) {
        keep(error.what());
    } catch (...) {
        keep("an exception of unknown type");
    }
    return TRISECT_INTERNAL;
}

}  // namespace trisect::c

using namespace trisect;  // NOLINT(google-build-using-namespace)

const char* trisect_version(void) { return TRISECT_VERSION; }

int trisect_is_compatible(int major, int minor) {
    // Before 1.0 a minor version may break the interface.
    return major == TRISECT_C_VERSION_MAJOR && minor == TRISECT_C_VERSION_MINOR ? 1 : 0;
}

const char* trisect_error_message(void) { return c::message_of_thread.c_str(); }

trisect_status trisect_cancel_create(trisect_cancel** cancel) {
    if (cancel != nullptr) *cancel = nullptr;
    return c::call([&] { c::required(cancel, "cancel") = new trisect_cancel; });
}

void trisect_cancel_set(trisect_cancel* cancel, int is_set) {
    if (cancel != nullptr) cancel->flag = is_set != 0;
}

void trisect_cancel_free(trisect_cancel* cancel) { delete cancel; }

trisect_status trisect_set_limits(const trisect_limits* limits) {
    c::limits_of_thread() = {};
    return c::call([&] {
        if (limits == nullptr) return;
        if (limits->size != sizeof(trisect_limits))
            throw UsageError("limits: size must be sizeof(trisect_limits)");
        c::ThreadLimits own;
        own.threads = limits->threads;
        own.stop.cancel = limits->cancel != nullptr ? &limits->cancel->flag : nullptr;
        own.stop.max_work = limits->max_work;
        own.stop.max_memory = limits->max_memory;
        c::limits_of_thread() = own;
    });
}

const char* trisect_text_data(const trisect_text* text, size_t* length) {
    if (length != nullptr) *length = text != nullptr ? text->text.size() : 0;
    return text != nullptr ? text->text.c_str() : "";
}

void trisect_text_free(trisect_text* text) { delete text; }
