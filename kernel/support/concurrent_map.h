// SPDX-License-Identifier: Apache-2.0
//
// ConcurrentMap: a hash map into which many threads insert at once.
// It has find, insert, size and iteration; the last two are not for times of insertion.
#pragma once

#ifdef TRISECT_WITHOUT_TBB
#include <unordered_map>
#else
#include <oneapi/tbb/concurrent_unordered_map.h>
#endif

namespace trisect::detail {

#ifdef TRISECT_WITHOUT_TBB
template <class Key, class Value, class Hash>
using ConcurrentMap = std::unordered_map<Key, Value, Hash>;
#else
template <class Key, class Value, class Hash>
using ConcurrentMap = tbb::concurrent_unordered_map<Key, Value, Hash>;
#endif

}  // namespace trisect::detail
