// SPDX-License-Identifier: Apache-2.0
//
// Parts of C++20's library that libc++ up to 14 lacks, as far as the library uses them.
// Debian's emscripten has libc++ 13. Included before every source of a build for WebAssembly by the
// command line, never by a file. Each part has the meaning of the standard; what is not used is not
// here.
#pragma once

#include <version>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <compare>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <memory>
#include <ranges>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "small_sort.h"

// NOLINTBEGIN(cert-dcl58-cpp): names of the standard, in its namespace
namespace std {

// More special than the sorts of libc++, so taken in their place for arrays, vectors and spans.
template <class T, class C>
void sort(T* first, T* last, C less) {
    trisect_small_sort::sort_unless_sorted(first, last, less);
}
template <class T, class C>
void sort(__wrap_iter<T*> first, __wrap_iter<T*> last, C less) {
    trisect_small_sort::sort_unless_sorted(to_address(first), to_address(last), less);
}
template <class T>
void sort(T* first, T* last) {
    std::sort(first, last, __less<T>());
}
template <class T>
void sort(__wrap_iter<T*> first, __wrap_iter<T*> last) {
    std::sort(to_address(first), to_address(last), __less<T>());
}
template <class T, class C>
void stable_sort(T* first, T* last, C less) requires is_trivially_copyable_v<T> {
    trisect_small_sort::stable_sort(first, last, less);
}
template <class T, class C>
void stable_sort(__wrap_iter<T*> first, __wrap_iter<T*> last,
                 C less) requires is_trivially_copyable_v<T> {
    trisect_small_sort::stable_sort(to_address(first), to_address(last), less);
}

template <class To, class From>
constexpr To bit_cast(const From& v) noexcept {
    return __builtin_bit_cast(To, v);
}

template <class T>
unique_ptr<T> make_unique_for_overwrite(size_t count) requires is_array_v<T> {
    return unique_ptr<T>(new remove_extent_t<T>[count]);
}

template <class T>
class atomic_ref {
public:
    explicit atomic_ref(T& of) : of_(&of) {}
    T load(memory_order /*order*/ = memory_order_seq_cst) const {
        return __atomic_load_n(of_, __ATOMIC_SEQ_CST);
    }
    void store(T v, memory_order /*order*/ = memory_order_seq_cst) const {
        __atomic_store_n(of_, v, __ATOMIC_SEQ_CST);
    }
    bool compare_exchange_strong(T& expected, T v, memory_order /*success*/ = memory_order_seq_cst,
                                 memory_order /*failure*/ = memory_order_seq_cst) const {
        return __atomic_compare_exchange_n(of_, &expected, v, false, __ATOMIC_SEQ_CST,
                                           __ATOMIC_SEQ_CST);
    }
    bool compare_exchange_weak(T& expected, T v, memory_order /*success*/ = memory_order_seq_cst,
                               memory_order /*failure*/ = memory_order_seq_cst) const {
        return compare_exchange_strong(expected, v);
    }
    T fetch_or(T v, memory_order /*order*/ = memory_order_seq_cst) const {
        return __atomic_fetch_or(of_, v, __ATOMIC_SEQ_CST);
    }

private:
    T* of_;
};

// ---------------------------------------------------------------- three-way comparison

template <class T>
constexpr auto trisect_three_way(const T* a, size_t m, const T* b, size_t n) {
    using Order = decltype(*a <=> *b);
    for (size_t i = 0; i < m && i < n; ++i)
        if (const Order order = a[i] <=> b[i]; order != 0) return order;
    return Order(m <=> n);
}
template <class T, size_t N>
constexpr auto operator<=>(const array<T, N>& a, const array<T, N>& b) requires requires {
    a[0] <=> b[0];
}
{ return std::trisect_three_way(a.data(), N, b.data(), N); }
template <class T, class A>
constexpr auto operator<=>(const vector<T, A>& a, const vector<T, A>& b) requires requires {
    a[0] <=> b[0];
}
{ return std::trisect_three_way(a.data(), a.size(), b.data(), b.size()); }

template <class T, class U>
constexpr auto operator<=>(const pair<T, U>& a, const pair<T, U>& b) requires requires {
    a.first <=> b.first;
    a.second <=> b.second;
}
{
    using Order = common_comparison_category_t<decltype(a.first <=> b.first),
                                               decltype(a.second <=> b.second)>;
    if (const Order order = a.first <=> b.first; order != 0) return order;
    return Order(a.second <=> b.second);
}

// ---------------------------------------------------------------- doubles as text

// The shortest digits that read back: those of the least precision at which the C library's
// correctly rounded digits do.
inline to_chars_result to_chars(char* first, char* last, double value) {
    char plain[400];
    char scientific[40];
    int length = 0;
    if (!isfinite(value)) {
        length = snprintf(plain, sizeof(plain), "%f", value);
    } else {
        int digits = 0;
        do {
            snprintf(scientific, sizeof(scientific), "%.*e", digits, value);
        } while (strtod(scientific, nullptr) != value && ++digits < 17);
        const int exponent = atoi(strchr(scientific, 'e') + 1);
        length = snprintf(plain, sizeof(plain), "%.*f", max(digits - exponent, 0), value);
        const int other = static_cast<int>(strlen(scientific));
        if (other < length) {
            memcpy(plain, scientific, static_cast<size_t>(other));
            length = other;
        }
    }
    if (last - first < length) return {last, errc::value_too_large};
    memcpy(first, plain, static_cast<size_t>(length));
    return {first + length, errc()};
}

inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const auto digits = [last](const char* p) {
        while (p != last && *p >= '0' && *p <= '9') ++p;
        return p;
    };
    const char* const number = first != last && *first == '-' ? first + 1 : first;
    const char* end = digits(number);
    auto count = end - number;
    if (end != last && *end == '.') {
        const char* const fraction = digits(end + 1);
        count += fraction - (end + 1);
        if (count != 0) end = fraction;
    }
    if (count == 0) {
        for (const char* word : {"infinity", "inf", "nan"}) {
            const size_t length = strlen(word);
            if (static_cast<size_t>(last - number) < length ||
                strncasecmp(number, word, length) != 0)
                continue;
            value = strtod(word, nullptr);
            if (number != first) value = -value;
            return {number + length, errc()};
        }
        return {first, errc::invalid_argument};
    }
    if (end != last && (*end == 'e' || *end == 'E')) {
        const char* exponent = end + 1;
        if (exponent != last && (*exponent == '-' || *exponent == '+')) ++exponent;
        if (digits(exponent) != exponent) end = digits(exponent);
    }
    const string text(first, end);
    const double read = strtod(text.c_str(), nullptr);
    const bool has_digit = any_of(text.begin(), text.end(), [in_exponent = false](char c) mutable {
        in_exponent = in_exponent || c == 'e' || c == 'E';
        return !in_exponent && c >= '1' && c <= '9';
    });
    if (isinf(read) || (read == 0 && has_digit)) return {end, errc::result_out_of_range};
    value = read;
    return {end, errc()};
}

// ---------------------------------------------------------------- algorithms of ranges

namespace ranges {

template <class Compare, class Projection>
constexpr auto trisect_order(Compare& compare, Projection& of) {
    return [&compare, &of](auto&& a, auto&& b) -> bool {
        return std::invoke(compare, std::invoke(of, a), std::invoke(of, b));
    };
}
template <class Predicate, class Projection>
constexpr auto trisect_test(Predicate& predicate, Projection& of) {
    return [&predicate, &of](auto&& a) -> bool {
        return static_cast<bool>(std::invoke(predicate, std::invoke(of, a)));
    };
}

// Both forms of an algorithm of that name: of iterators, and of a range.
#define TRISECT_ORDERING(name, order)                                                    \
    template <input_or_output_iterator I, class C = order, class P = identity>           \
    constexpr auto name(I first, I last, C c = {}, P p = {}) {                           \
        return std::name(first, last, ranges::trisect_order(c, p));                      \
    }                                                                                    \
    template <range R, class C = order, class P = identity>                              \
    constexpr auto name(R&& r, C c = {}, P p = {}) {                                     \
        return std::name(ranges::begin(r), ranges::end(r), ranges::trisect_order(c, p)); \
    }
#define TRISECT_TEST(name)                                                              \
    template <input_or_output_iterator I, class F, class P = identity>                  \
    constexpr auto name(I first, I last, F f, P p = {}) {                               \
        return std::name(first, last, ranges::trisect_test(f, p));                      \
    }                                                                                   \
    template <range R, class F, class P = identity>                                     \
    constexpr auto name(R&& r, F f, P p = {}) {                                         \
        return std::name(ranges::begin(r), ranges::end(r), ranges::trisect_test(f, p)); \
    }
#define TRISECT_VALUE(name, test)                                                        \
    template <input_or_output_iterator I, class T, class P = identity>                   \
    constexpr auto name(I first, I last, const T& v, P p = {}) {                         \
        return std::test(first, last, [&](auto&& e) { return std::invoke(p, e) == v; }); \
    }                                                                                    \
    template <range R, class T, class P = identity>                                      \
    constexpr auto name(R&& r, const T& v, P p = {}) {                                   \
        return ranges::name(ranges::begin(r), ranges::end(r), v, std::move(p));          \
    }
#define TRISECT_SEARCH(name)                                                                  \
    template <range R, class T, class C = less, class P = identity>                           \
    constexpr auto name(R&& r, const T& v, C c = {}, P p = {}) {                              \
        return ranges::name(ranges::begin(r), ranges::end(r), v, std::move(c), std::move(p)); \
    }

TRISECT_ORDERING(sort, less)
TRISECT_ORDERING(stable_sort, less)
TRISECT_ORDERING(max_element, less)
TRISECT_ORDERING(min_element, less)
TRISECT_ORDERING(minmax_element, less)
TRISECT_ORDERING(push_heap, less)
TRISECT_ORDERING(pop_heap, less)
TRISECT_ORDERING(is_sorted, less)
TRISECT_ORDERING(adjacent_find, equal_to)
TRISECT_TEST(all_of)
TRISECT_TEST(any_of)
TRISECT_TEST(none_of)
TRISECT_TEST(find_if)
TRISECT_TEST(count_if)
TRISECT_TEST(partition_point)
TRISECT_VALUE(find, find_if)
TRISECT_VALUE(count, count_if)

template <input_or_output_iterator I, class T, class C = less, class P = identity>
constexpr I lower_bound(I first, I last, const T& v, C c = {}, P p = {}) {
    return std::partition_point(first, last,
                                [&](auto&& e) { return std::invoke(c, std::invoke(p, e), v); });
}
template <input_or_output_iterator I, class T, class C = less, class P = identity>
constexpr I upper_bound(I first, I last, const T& v, C c = {}, P p = {}) {
    return std::partition_point(first, last,
                                [&](auto&& e) { return !std::invoke(c, v, std::invoke(p, e)); });
}
template <input_or_output_iterator I, class T, class C = less, class P = identity>
constexpr bool binary_search(I first, I last, const T& v, C c = {}, P p = {}) {
    const I at = ranges::lower_bound(first, last, v, c, p);
    return at != last && !std::invoke(c, v, std::invoke(p, *at));
}
TRISECT_SEARCH(lower_bound)
TRISECT_SEARCH(upper_bound)
TRISECT_SEARCH(binary_search)

#undef TRISECT_ORDERING
#undef TRISECT_TEST
#undef TRISECT_VALUE
#undef TRISECT_SEARCH

template <range R, class C = less, class P = identity>
constexpr auto max(R&& r, C c = {}, P p = {}) {
    return *ranges::max_element(r, std::move(c), std::move(p));
}
template <range R, class C = less, class P = identity>
constexpr auto min(R&& r, C c = {}, P p = {}) {
    return *ranges::min_element(r, std::move(c), std::move(p));
}
template <class T>
struct minmax_result {
    T min;
    T max;
};
template <range R, class C = less, class P = identity>
constexpr auto minmax(R&& r, C c = {}, P p = {}) {
    const auto [low, high] = ranges::minmax_element(r, std::move(c), std::move(p));
    return minmax_result<range_value_t<R>>{*low, *high};
}

template <class I, class O>
struct in_out_result {
    I in;
    O out;
};
template <range R, class O>
constexpr auto copy(R&& r, O to) {
    return in_out_result<iterator_t<R>, O>{ranges::end(r),
                                           std::copy(ranges::begin(r), ranges::end(r), to)};
}
template <range R, class O>
constexpr auto move(R&& r, O to) {
    return in_out_result<iterator_t<R>, O>{ranges::end(r),
                                           std::move(ranges::begin(r), ranges::end(r), to)};
}
template <range R, class O, class F, class P = identity>
constexpr auto copy_if(R&& r, O to, F f, P p = {}) {
    return in_out_result<iterator_t<R>, O>{
        ranges::end(r),
        std::copy_if(ranges::begin(r), ranges::end(r), to, ranges::trisect_test(f, p))};
}
template <range R, class F, class P = identity>
constexpr void for_each(R&& r, F f, P p = {}) {
    for (auto&& e : r) std::invoke(f, std::invoke(p, e));
}
template <range R, class T>
constexpr void fill(R&& r, const T& v) {
    std::fill(ranges::begin(r), ranges::end(r), v);
}
template <range R>
constexpr void reverse(R&& r) {
    std::reverse(ranges::begin(r), ranges::end(r));
}
template <range R, class S, class C = equal_to>
constexpr bool equal(R&& r, S&& s, C c = {}) {
    return std::equal(ranges::begin(r), ranges::end(r), ranges::begin(s), ranges::end(s), c);
}
template <range R, class C = less, class P = identity>
constexpr void nth_element(R&& r, iterator_t<R> nth, C c = {}, P p = {}) {
    std::nth_element(ranges::begin(r), nth, ranges::end(r), ranges::trisect_order(c, p));
}
template <range R>
constexpr auto unique(R&& r) {
    return subrange(std::unique(ranges::begin(r), ranges::end(r)), ranges::end(r));
}
template <class I>
struct in_found_result {
    I in;
    bool found;
};
template <range R>
constexpr auto next_permutation(R&& r) {
    const bool found = std::next_permutation(ranges::begin(r), ranges::end(r));
    return in_found_result<iterator_t<R>>{ranges::end(r), found};
}
template <range R, class G>
void shuffle(R&& r, G&& random) {
    std::shuffle(ranges::begin(r), ranges::end(r), random);
}
template <range R, range S, class O>
constexpr void set_union(R&& r, S&& s, O to) {
    std::set_union(ranges::begin(r), ranges::end(r), ranges::begin(s), ranges::end(s), to);
}
template <range R, range S, class O, class C = less>
constexpr void set_intersection(R&& r, S&& s, O to, C c = {}) {
    std::set_intersection(ranges::begin(r), ranges::end(r), ranges::begin(s), ranges::end(s), to,
                          c);
}

}  // namespace ranges

}  // namespace std
// NOLINTEND(cert-dcl58-cpp)

#endif
