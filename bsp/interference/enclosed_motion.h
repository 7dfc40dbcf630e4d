// SPDX-License-Identifier: Apache-2.0
//
// EnclosedMotion: a motion enclosed by rational motions with proved error.
// It serves motions that no rational formula describes.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <trisect/bsp/interference/motion.h>
#include <trisect/kernel/point3d.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// A rational motion near another one over a range of time.
struct MotionEnclosure {
    /// One piece. Its parameter, 0 to 1, stands for the range of time, linearly.
    Motion motion;
    /// At no time of the range is any point x, in the user's units before the motion, farther than
    /// by_length · |x| + constant from where `motion` puts it. Infinite: nothing is known.
    double by_length = 0;
    double constant = 0;
};

/// A motion as a source of enclosures. It must be continuous, and implementations right: every
/// answer about the motion is proved from them.
class MotionLaw {
public:
    virtual ~MotionLaw() = default;
    /// \pre 0 <= from <= to <= duration, and no break strictly between them. Bounds may be infinite
    /// where the range is long; they must tend to zero with it, up to rounding, or questions stay
    /// undecided. Called from the querying thread.
    [[nodiscard]] virtual MotionEnclosure enclose(double from, double to) const = 0;
};

/// Where a solid is at some time: turned by a quaternion of any length, (w, x, y, z), then moved.
struct KeyFrame {
    double time = 0;
    std::array<double, 4> rotation{1, 0, 0, 0};
    Point3d position{};
};

/// A turn of constant angular speed with a straight shift of constant speed: a screw if the shift
/// is along the axis.
struct ConstantTurn {
    Point3d axis{0, 0, 1};  ///< of any length
    double angle = 0;       ///< radians over the whole duration, any number of turns
    Point3d center{};       ///< a point of the axis
    Point3d shift{};        ///< over the whole duration
};

/// A motion given by a function. Its twelve numbers (the 3x4 matrix, row by row) must be
/// continuous, and twice differentiable between breaks.
struct SmoothMotion {
    std::function<std::array<double, 12>(double)> pose;
    /// Every number that `pose` returns is within this of the motion's.
    double error = 0;
    /// A bound on the magnitude of the second derivative of each of the twelve numbers between two
    /// times.
    std::function<double(double, double)> bend;
};

/// A motion over the time from 0 to duration().
///
/// The motion is the real one: a turn by 2 radians at constant speed is that, not a polygon and not
/// the rational motion next to it. Enclosures of `through` and `turning` are rational screws whose
/// deviation falls with the third power of the range of time, down to about 2^-57 of the distance
/// from the axis. Angles, sines and cosines come from proved series, not from the C library.
///
/// Immutable value; copying shares. Safe to use from many threads where the law is. A motion that
/// was moved from stands still where it was modelled, from 0 to 1.
class EnclosedMotion {
public:
    /// Stands still where it was modelled.
    EnclosedMotion();
    /// A rational motion, exactly. The parameter is the time.
    explicit EnclosedMotion(const Motion& motion);
    /// Any motion. `breaks` are the times at which it may have a kink: from 0, ascending, to the
    /// duration. \throw UsageError when they are not.
    EnclosedMotion(std::shared_ptr<const MotionLaw> law, std::vector<double> breaks);

    /// From key frame to key frame, the first at time 0: constant angular speed about an axis that
    /// does not change (slerp, the shorter way round; for a half turn exactly the way of the
    /// quaternions as given), positions on straight lines.
    /// \throw UsageError for less than two frames, times that do not ascend from 0, numbers that
    /// are not finite, a quaternion 0.
    [[nodiscard]] static EnclosedMotion through(std::span<const KeyFrame> frames);
    /// From a pose. \throw UsageError for an axis 0, a duration that is not positive, an angle
    /// beyond 2^20, numbers that are not finite.
    [[nodiscard]] static EnclosedMotion turning(const Pose& start, const ConstantTurn& turn,
                                                double duration = 1);
    /// Enclosures are straight lines between two poses; they deviate by the square of the range of
    /// time. \throw UsageError as above.
    [[nodiscard]] static EnclosedMotion smooth(SmoothMotion motion, std::vector<double> breaks);

    [[nodiscard]] double duration() const { return breaks().back(); }
    [[nodiscard]] std::span<const double> breaks() const {
        return law_ != nullptr ? std::span<const double>(breaks_) : still_breaks;
    }
    /// Whether the pose certainly never changes; then any range of time may be queried.
    [[nodiscard]] bool is_still() const { return is_still_ || law_ == nullptr; }
    /// \pre as MotionLaw::enclose.
    [[nodiscard]] MotionEnclosure enclose(double from, double to) const {
        return law_ != nullptr ? law_->enclose(from, to) : MotionEnclosure();
    }

private:
    static constexpr std::array<double, 2> still_breaks{0, 1};

    std::shared_ptr<const MotionLaw> law_;
    std::vector<double> breaks_{0, 1};
    bool is_still_ = false;
};

}  // namespace trisect
