#include "cage/solved_driver.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <string>

namespace supple::cage {

namespace {

constexpr double kSameDegrees = 1.0;
constexpr double kSameValue = 1e-6;
/// Floats then miss the values by about 1e-3.
constexpr double kWorstCondition = 1e4;
constexpr double kHalfTurn = 180.0;

/// The part of a rotation, as shaders/pose/drivers.h finds it.
glm::dquat partOf(const glm::dquat& q, const DriverInput& input) {
    const glm::dvec3 axis(input.axis);
    const double along = glm::dot(glm::dvec3(q.x, q.y, q.z), axis), squares = q.w * q.w + along * along;
    glm::dquat twist(1.0, 0.0, 0.0, 0.0);
    if (squares >= 1e-12) {
        const double scale = 1.0 / std::sqrt(squares);
        twist = {q.w * scale, axis * (along * scale)};
    }
    switch (input.part) {
    case TurnPart::rotation:
        return q;
    case TurnPart::swing:
        return q * glm::conjugate(twist);
    case TurnPart::twist:
        return twist;
    }
    return q;
}

/// The square of the sine of half the angle between two rotations.
double squaredSine(const glm::vec4& a, const glm::vec4& b) {
    const glm::dvec4 from(a), to = glm::dvec4(b) * (glm::dot(from, glm::dvec4(b)) < 0.0 ? -1.0 : 1.0);
    const double e = glm::dot(from - to, from - to);
    return e * (1.0 - 0.25 * e);
}

/// A symmetric matrix as the product of a lower triangle and its transpose.
class Factors {
public:
    explicit Factors(std::vector<double> matrix, size_t size) : lower_(std::move(matrix)), size_(size) {
        for (size_t i = 0; i < size_; ++i) {
            for (size_t k = 0; k <= i; ++k) {
                double sum = at(i, k);
                for (size_t j = 0; j < k; ++j) {
                    sum -= at(i, j) * at(k, j);
                }
                isSound_ = isSound_ && (i != k || sum > 0.0);
                at(i, k) = i == k ? std::sqrt(std::max(sum, 0.0)) : sum / at(k, k);
            }
        }
    }
    [[nodiscard]] bool isSound() const { return isSound_; }

    void solve(std::vector<double>& x) const {
        for (size_t i = 0; i < size_; ++i) {
            for (size_t k = 0; k < i; ++k) {
                x[i] -= at(i, k) * x[k];
            }
            x[i] /= at(i, i);
        }
        for (size_t i = size_; i-- > 0;) {
            for (size_t k = i + 1; k < size_; ++k) {
                x[i] -= at(k, i) * x[k];
            }
            x[i] /= at(i, i);
        }
    }

private:
    double& at(size_t row, size_t column) { return lower_[row * size_ + column]; }
    [[nodiscard]] const double& at(size_t row, size_t column) const { return lower_[row * size_ + column]; }

    std::vector<double> lower_;
    size_t size_;
    bool isSound_ = true;
};

/// The largest eigenvalue of a symmetric, positive definite map.
template <class Map>
double largestEigenvalue(size_t size, Map&& map) {
    constexpr int kRounds = 100;
    std::vector<double> x(size);
    for (size_t i = 0; i < size; ++i) { // no vector that symmetric poses are blind to
        x[i] = 1.0 + 0.5 * std::sin(static_cast<double>(3 * i + 1));
    }
    double found = 0.0;
    for (int round = 0; round < kRounds; ++round) {
        double squares = 0.0;
        for (const double value : x) {
            squares += value * value;
        }
        const double length = std::sqrt(squares);
        for (double& value : x) {
            value /= length;
        }
        found = length;
        map(x);
    }
    return found;
}

class Solver {
public:
    explicit Solver(const PoseDriver& driver) : driver_(driver), inputs_(driver.inputs.size()) {}

    Result<SolvedDriver> solve() && {
        for (size_t pose = 0; pose <= driver_.poseCount(); ++pose) {
            if (Status taken = takePose(pose); !taken) {
                return taken.error();
            }
        }
        if (poses_.size() < 2) {
            return Error{ErrorCode::asset, "it has no pose but the rest pose"};
        }
        measure();
        std::vector<double> kernel(poses_.size() * poses_.size());
        for (size_t a = 0; a < poses_.size(); ++a) {
            for (size_t b = 0; b < poses_.size(); ++b) {
                const double k = 1.0 / (1.0 + distance(a, b) * static_cast<double>(solved_.inverseSigma2));
                kernel[a * poses_.size() + b] = k * k;
            }
        }
        const Factors factors(kernel, poses_.size());
        solved_.condition = factors.isSound() ? conditionOf(kernel, factors) : kWorstCondition;
        if (!(solved_.condition < kWorstCondition)) {
            return Error{ErrorCode::asset, "its poses are too close to each other to be told apart"};
        }
        findCoefficients(factors);
        return std::move(solved_);
    }

private:
    [[nodiscard]] const glm::vec4& sample(size_t kept, size_t input) const {
        return solved_.samples[kept * inputs_ + input];
    }
    [[nodiscard]] double value(size_t pose, size_t target) const {
        return pose == 0 ? 0.0 : static_cast<double>(driver_.values[(pose - 1) * driver_.targets.size() + target]);
    }
    static std::string nameOf(size_t pose) {
        return pose == 0 ? "the rest pose, in which all weights are 0," : "pose " + std::to_string(pose - 1);
    }
    [[nodiscard]] double distance(size_t a, size_t b) const {
        double sum = 0.0;
        for (size_t i = 0; i < inputs_; ++i) {
            sum += static_cast<double>(driver_.inputs[i].weight) * squaredSine(sample(a, i), sample(b, i));
        }
        return sum;
    }
    /// In the input in which they are farthest apart.
    [[nodiscard]] double degreesBetween(size_t a, size_t b) const {
        double most = 0.0;
        for (size_t i = 0; i < inputs_; ++i) {
            most = std::max(most, squaredSine(sample(a, i), sample(b, i)));
        }
        return 2.0 * std::asin(std::sqrt(std::min(most, 1.0))) * kHalfTurn / 3.141592653589793;
    }
    [[nodiscard]] bool haveSameValues(size_t a, size_t b) const {
        for (size_t t = 0; t < driver_.targets.size(); ++t) {
            if (!(std::abs(value(a, t) - value(b, t)) <= kSameValue)) {
                return false;
            }
        }
        return true;
    }

    /// `pose`: counted from 1; 0 is the rest pose.
    Status takePose(size_t pose) {
        for (size_t i = 0; i < inputs_; ++i) {
            glm::dquat q(1.0, 0.0, 0.0, 0.0);
            if (pose > 0) {
                const glm::dvec4 given = glm::normalize(glm::dvec4(driver_.poses[(pose - 1) * inputs_ + i]));
                q = partOf({given.w, given.x, given.y, given.z}, driver_.inputs[i]);
            }
            solved_.samples.emplace_back(glm::dvec4(q.x, q.y, q.z, q.w));
        }
        const size_t own = poses_.size();
        for (size_t other = 0; other < own; ++other) {
            if (degreesBetween(own, other) >= kSameDegrees) {
                continue;
            }
            if (!haveSameValues(pose, poses_[other])) {
                return Error{ErrorCode::asset, nameOf(pose) + " and " + nameOf(poses_[other]) +
                                                   " are one pose, but for a degree, and have different values"};
            }
            solved_.samples.resize(own * inputs_);
            return success();
        }
        poses_.push_back(pose);
        return success();
    }

    void measure() {
        double sum = 0.0;
        solved_.closestDegrees = std::numeric_limits<double>::infinity();
        for (size_t a = 0; a < poses_.size(); ++a) {
            double nearest = std::numeric_limits<double>::infinity();
            for (size_t b = 0; b < poses_.size(); ++b) {
                if (a == b) {
                    continue;
                }
                nearest = std::min(nearest, distance(a, b));
                if (const double degrees = degreesBetween(a, b); a < b && degrees < solved_.closestDegrees) {
                    solved_.closestDegrees = degrees;
                    solved_.closest[0] = poses_[a];
                    solved_.closest[1] = poses_[b];
                }
            }
            sum += nearest;
        }
        const double mean = sum / static_cast<double>(poses_.size());
        solved_.inverseSigma2 = static_cast<float>(1.0 / (static_cast<double>(driver_.width) * mean));
    }

    [[nodiscard]] static double conditionOf(const std::vector<double>& kernel, const Factors& factors) {
        const auto size = static_cast<size_t>(std::sqrt(static_cast<double>(kernel.size())) + 0.5);
        std::vector<double> product(size);
        const double most = largestEigenvalue(size, [&](std::vector<double>& x) {
            for (size_t i = 0; i < size; ++i) {
                product[i] = 0.0;
                for (size_t k = 0; k < size; ++k) {
                    product[i] += kernel[i * size + k] * x[k];
                }
            }
            x = product;
        });
        return most * largestEigenvalue(size, [&](std::vector<double>& x) { factors.solve(x); });
    }

    void findCoefficients(const Factors& factors) {
        const size_t targets = driver_.targets.size();
        solved_.coefficients.resize(poses_.size() * targets);
        std::vector<double> x(poses_.size());
        for (size_t t = 0; t < targets; ++t) {
            for (size_t p = 0; p < poses_.size(); ++p) {
                x[p] = value(poses_[p], t);
            }
            factors.solve(x);
            for (size_t p = 0; p < poses_.size(); ++p) {
                solved_.coefficients[p * targets + t] = static_cast<float>(x[p]);
            }
        }
    }

    const PoseDriver& driver_;
    size_t inputs_;
    SolvedDriver solved_;
    std::vector<size_t> poses_; ///< those that are kept
};

} // namespace

size_t driverWork(const PoseDriver& driver) {
    // Two rounds more of each loop: before it, and of its last test.
    return driver.targets.size() * (driver.inputs.size() + 2) * (driver.poseCount() + 2);
}

std::string tooMuchDriverWork() {
    return "drivers have more than " + std::to_string(kMaxDriverWork) +
           " together of targets * (inputs + 2) * (poses + 2)";
}

Result<SolvedDriver> solveDriver(const PoseDriver& driver) {
    return Solver(driver).solve();
}

} // namespace supple::cage
