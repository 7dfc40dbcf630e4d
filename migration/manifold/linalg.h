// SPDX-License-Identifier: Apache-2.0
//
// Vectors and matrices of two to four numbers, under the names that programs for Manifold use.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

// NOLINTBEGIN(readability-identifier-naming): names are those of another library
namespace linalg {

/// A vector of M numbers. Arithmetic is by element.
template <class T, int M>
struct vec;

template <class T>
struct vec<T, 2> {
    T x{};
    T y{};
    constexpr vec() = default;
    constexpr vec(T x_, T y_) : x(x_), y(y_) {}
    constexpr explicit vec(T all) : x(all), y(all) {}
    constexpr explicit vec(const T* p) : x(p[0]), y(p[1]) {}
    template <class U>
    constexpr explicit vec(const vec<U, 2>& v) : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)) {}
    constexpr explicit vec(const vec<T, 3>& v);
    constexpr T& operator[](int i) { return i == 0 ? x : y; }
    constexpr const T& operator[](int i) const { return i == 0 ? x : y; }
};

template <class T>
struct vec<T, 3> {
    T x{};
    T y{};
    T z{};
    constexpr vec() = default;
    constexpr vec(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
    constexpr explicit vec(T all) : x(all), y(all), z(all) {}
    constexpr explicit vec(const T* p) : x(p[0]), y(p[1]), z(p[2]) {}
    constexpr vec(const vec<T, 2>& v, T z_) : x(v.x), y(v.y), z(z_) {}
    constexpr explicit vec(const vec<T, 4>& v);
    template <class U>
    constexpr explicit vec(const vec<U, 3>& v)
        : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}
    constexpr vec<T, 2> xy() const { return {x, y}; }
    constexpr T& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
    constexpr const T& operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
};

template <class T>
struct vec<T, 4> {
    T x{};
    T y{};
    T z{};
    T w{};
    constexpr vec() = default;
    constexpr vec(T x_, T y_, T z_, T w_) : x(x_), y(y_), z(z_), w(w_) {}
    constexpr explicit vec(T all) : x(all), y(all), z(all), w(all) {}
    constexpr explicit vec(const T* p) : x(p[0]), y(p[1]), z(p[2]), w(p[3]) {}
    constexpr vec(const vec<T, 3>& v, T w_) : x(v.x), y(v.y), z(v.z), w(w_) {}
    template <class U>
    constexpr explicit vec(const vec<U, 4>& v)
        : x(static_cast<T>(v.x)),
          y(static_cast<T>(v.y)),
          z(static_cast<T>(v.z)),
          w(static_cast<T>(v.w)) {}
    constexpr vec<T, 3> xyz() const { return {x, y, z}; }
    constexpr T& operator[](int i) { return i == 0 ? x : (i == 1 ? y : (i == 2 ? z : w)); }
    constexpr const T& operator[](int i) const {
        return i == 0 ? x : (i == 1 ? y : (i == 2 ? z : w));
    }
};

template <class T>
constexpr vec<T, 2>::vec(const vec<T, 3>& v) : x(v.x), y(v.y) {}
template <class T>
constexpr vec<T, 3>::vec(const vec<T, 4>& v) : x(v.x), y(v.y), z(v.z) {}

namespace detail {

template <class T, int M, class F>
constexpr auto map(const vec<T, M>& a, F f) {
    vec<std::decay_t<decltype(f(a[0]))>, M> r;
    for (int i = 0; i < M; ++i) r[i] = f(a[i]);
    return r;
}
template <class T, int M, class F>
constexpr auto map(const vec<T, M>& a, const vec<T, M>& b, F f) {
    vec<std::decay_t<decltype(f(a[0], b[0]))>, M> r;
    for (int i = 0; i < M; ++i) r[i] = f(a[i], b[i]);
    return r;
}
// Keeps a scalar operand from taking part in the deduction of the element type.
template <class T>
using Scalar = std::type_identity_t<T>;

}  // namespace detail

template <class T, int M>
constexpr bool operator==(const vec<T, M>& a, const vec<T, M>& b) {
    for (int i = 0; i < M; ++i)
        if (!(a[i] == b[i])) return false;
    return true;
}
template <class T, int M>
constexpr vec<T, M> operator-(const vec<T, M>& a) {
    return detail::map(a, [](T x) { return static_cast<T>(-x); });
}
template <class T, int M>
constexpr vec<T, M> operator+(const vec<T, M>& a, const vec<T, M>& b) {
    return detail::map(a, b, [](T x, T y) { return static_cast<T>(x + y); });
}
template <class T, int M>
constexpr vec<T, M> operator-(const vec<T, M>& a, const vec<T, M>& b) {
    return detail::map(a, b, [](T x, T y) { return static_cast<T>(x - y); });
}
template <class T, int M>
constexpr vec<T, M> operator*(const vec<T, M>& a, const vec<T, M>& b) {
    return detail::map(a, b, [](T x, T y) { return static_cast<T>(x * y); });
}
template <class T, int M>
constexpr vec<T, M> operator/(const vec<T, M>& a, const vec<T, M>& b) {
    return detail::map(a, b, [](T x, T y) { return static_cast<T>(x / y); });
}
template <class T, int M>
constexpr vec<T, M> operator+(const vec<T, M>& a, detail::Scalar<T> s) {
    return a + vec<T, M>(s);
}
template <class T, int M>
constexpr vec<T, M> operator-(const vec<T, M>& a, detail::Scalar<T> s) {
    return a - vec<T, M>(s);
}
template <class T, int M>
constexpr vec<T, M> operator*(const vec<T, M>& a, detail::Scalar<T> s) {
    return a * vec<T, M>(s);
}
template <class T, int M>
constexpr vec<T, M> operator*(detail::Scalar<T> s, const vec<T, M>& a) {
    return vec<T, M>(s) * a;
}
template <class T, int M>
constexpr vec<T, M> operator/(const vec<T, M>& a, detail::Scalar<T> s) {
    return a / vec<T, M>(s);
}
template <class T, int M, class B>
constexpr vec<T, M>& operator+=(vec<T, M>& a, const B& b) {
    return a = a + b;
}
template <class T, int M, class B>
constexpr vec<T, M>& operator-=(vec<T, M>& a, const B& b) {
    return a = a - b;
}
template <class T, int M, class B>
constexpr vec<T, M>& operator*=(vec<T, M>& a, const B& b) {
    return a = a * b;
}
template <class T, int M, class B>
constexpr vec<T, M>& operator/=(vec<T, M>& a, const B& b) {
    return a = a / b;
}

template <class T, int M>
constexpr T dot(const vec<T, M>& a, const vec<T, M>& b) {
    T sum{};
    for (int i = 0; i < M; ++i) sum += a[i] * b[i];
    return sum;
}
template <class T>
constexpr T cross(const vec<T, 2>& a, const vec<T, 2>& b) {
    return a.x * b.y - a.y * b.x;
}
template <class T>
constexpr vec<T, 3> cross(const vec<T, 3>& a, const vec<T, 3>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T, int M>
constexpr T length2(const vec<T, M>& a) {
    return dot(a, a);
}
template <class T, int M>
T length(const vec<T, M>& a) {
    return std::sqrt(length2(a));
}
template <class T, int M>
T distance(const vec<T, M>& a, const vec<T, M>& b) {
    return length(a - b);
}
template <class T, int M>
vec<T, M> normalize(const vec<T, M>& a) {
    return a / length(a);
}
template <class T, int M>
constexpr vec<T, M> lerp(const vec<T, M>& a, const vec<T, M>& b, detail::Scalar<T> t) {
    return a * (1 - t) + b * t;
}
template <class T, int M>
constexpr vec<T, M> min(const vec<T, M>& a, const vec<T, M>& b) {
    return detail::map(a, b, [](T x, T y) { return std::min(x, y); });
}
template <class T, int M>
constexpr vec<T, M> max(const vec<T, M>& a, const vec<T, M>& b) {
    return detail::map(a, b, [](T x, T y) { return std::max(x, y); });
}
template <class T, int M>
constexpr vec<T, M> abs(const vec<T, M>& a) {
    return detail::map(a, [](T x) { return x < 0 ? -x : x; });
}
template <class T, int M>
vec<T, M> sin(const vec<T, M>& a) {
    return detail::map(a, [](T x) { return std::sin(x); });
}
template <class T, int M>
vec<T, M> cos(const vec<T, M>& a) {
    return detail::map(a, [](T x) { return std::cos(x); });
}
template <class T, int M>
T minelem(const vec<T, M>& a) {
    T least = a[0];
    for (int i = 1; i < M; ++i) least = std::min(least, a[i]);
    return least;
}
template <class T, int M>
T maxelem(const vec<T, M>& a) {
    T most = a[0];
    for (int i = 1; i < M; ++i) most = std::max(most, a[i]);
    return most;
}

template <class T, int M>
vec<bool, M> isfinite(const vec<T, M>& a) {
    vec<bool, M> result;
    for (int i = 0; i < M; ++i) result[i] = std::isfinite(a[i]);
    return result;
}
template <int M>
bool all(const vec<bool, M>& a) {
    for (int i = 0; i < M; ++i)
        if (!a[i]) return false;
    return true;
}

struct identity_t {};
inline constexpr identity_t identity{};

/// A matrix of M rows and N columns, stored and indexed by columns.
template <class T, int M, int N>
struct mat {
    using Column = vec<T, M>;
    std::array<Column, N> columns{};

    constexpr mat() = default;
    constexpr mat(identity_t) {  // NOLINT(google-explicit-constructor): as in their programs
        for (int i = 0; i < std::min(M, N); ++i) columns[static_cast<std::size_t>(i)][i] = T(1);
    }
    constexpr mat(const Column& a, const Column& b) requires(N == 2) : columns{a, b} {}
    constexpr mat(const Column& a, const Column& b, const Column& c) requires(N == 3)
        : columns{a, b, c} {}
    constexpr mat(const Column& a, const Column& b, const Column& c,
                  const Column& d) requires(N == 4)
        : columns{a, b, c, d} {}
    /// The elements, column after column.
    constexpr explicit mat(const T* elements) {
        for (int j = 0; j < N; ++j)
            for (int i = 0; i < M; ++i) (*this)[j][i] = elements[j * M + i];
    }
    template <class U>
    constexpr explicit mat(const mat<U, M, N>& other) {
        for (int j = 0; j < N; ++j) (*this)[j] = Column(other[j]);
    }
    /// The first N columns of a wider matrix.
    /// The upper rows of a taller matrix.
    template <int Taller>
    requires(Taller > M) constexpr explicit mat(const mat<T, Taller, N>& other) {
        for (int k = 0; k < N; ++k)
            for (int i = 0; i < M; ++i) (*this)[k][i] = other[k][i];
    }
    template <int Wider>
    requires(Wider > N) constexpr explicit mat(const mat<T, M, Wider>& other) {
        for (int j = 0; j < N; ++j) (*this)[j] = other[j];
    }
    /// A narrower matrix and the last column.
    constexpr mat(const mat<T, M, N - 1>& left, const Column& last) requires(N > 2) {
        for (int j = 0; j + 1 < N; ++j) (*this)[j] = left[j];
        (*this)[N - 1] = last;
    }
    constexpr Column& operator[](int j) { return columns[static_cast<std::size_t>(j)]; }
    constexpr const Column& operator[](int j) const { return columns[static_cast<std::size_t>(j)]; }
    friend constexpr bool operator==(const mat&, const mat&) = default;
};

template <class T, int M, int N>
constexpr vec<T, M> operator*(const mat<T, M, N>& m, const vec<T, N>& v) {
    vec<T, M> sum;
    for (int j = 0; j < N; ++j) sum += m[j] * v[j];
    return sum;
}
template <class T, int M, int N, int K>
constexpr mat<T, M, K> operator*(const mat<T, M, N>& a, const mat<T, N, K>& b) {
    mat<T, M, K> product;
    for (int j = 0; j < K; ++j) product[j] = a * b[j];
    return product;
}
template <class T, int M, int N>
constexpr mat<T, M, N> operator*(const mat<T, M, N>& m, detail::Scalar<T> s) {
    mat<T, M, N> scaled;
    for (int j = 0; j < N; ++j) scaled[j] = m[j] * s;
    return scaled;
}
template <class T, int M, int N>
constexpr mat<T, N, M> transpose(const mat<T, M, N>& m) {
    mat<T, N, M> t;
    for (int j = 0; j < N; ++j)
        for (int i = 0; i < M; ++i) t[i][j] = m[j][i];
    return t;
}
template <class T>
constexpr T determinant(const mat<T, 2, 2>& m) {
    return cross(m[0], m[1]);
}
template <class T>
constexpr T determinant(const mat<T, 3, 3>& m) {
    return dot(m[0], cross(m[1], m[2]));
}
template <class T>
constexpr mat<T, 3, 3> inverse(const mat<T, 3, 3>& m) {
    const mat<T, 3, 3> rows(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    return transpose(rows) * (T(1) / determinant(m));
}
/// The rotation of a unit quaternion (x, y, z, w).
template <class T>
constexpr mat<T, 3, 3> qmat(const vec<T, 4>& q) {
    const auto column = [&](vec<T, 3> e) {
        const vec<T, 3> u = q.xyz();
        const vec<T, 3> t = cross(u, e) * T(2);
        return e + t * q.w + cross(u, t);
    };
    return {column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})};
}
/// The unit quaternion of a rotation about a unit vector.
template <class T>
vec<T, 4> rotation_quat(const vec<T, 3>& axis, detail::Scalar<T> angle) {
    return {axis * std::sin(angle / 2), std::cos(angle / 2)};
}

/// The one of the shortest turn that takes a direction to another one, which is not opposite.
template <class T>
vec<T, 4> rotation_quat(const vec<T, 3>& from, const vec<T, 3>& to) {
    const vec<T, 3> a = normalize(from);
    const vec<T, 3> b = normalize(to);
    return normalize(vec<T, 4>(cross(a, b), 1 + dot(a, b)));
}
/// Turned counter-clockwise about the origin, or about an axis, by an angle in radians.
template <class T>
vec<T, 2> rot(detail::Scalar<T> angle, const vec<T, 2>& v) {
    const T c = std::cos(angle);
    const T s = std::sin(angle);
    return {v.x * c - v.y * s, v.x * s + v.y * c};
}
template <class T>
vec<T, 3> rotx(detail::Scalar<T> angle, const vec<T, 3>& v) {
    const vec<T, 2> turned = rot(angle, vec<T, 2>(v.y, v.z));
    return {v.x, turned.x, turned.y};
}
template <class T>
vec<T, 3> roty(detail::Scalar<T> angle, const vec<T, 3>& v) {
    const vec<T, 2> turned = rot(angle, vec<T, 2>(v.z, v.x));
    return {turned.y, v.y, turned.x};
}
template <class T>
vec<T, 3> rotz(detail::Scalar<T> angle, const vec<T, 3>& v) {
    return {rot(angle, v.xy()), v.z};
}

// Of single numbers, for programs that qualify all of their arithmetic.
using std::cos;
using std::isfinite;
using std::max;
using std::min;
using std::sin;
using std::sqrt;

}  // namespace linalg
// NOLINTEND(readability-identifier-naming)
