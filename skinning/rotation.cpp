#include "skinning/rotation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace supple::skinning {
namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

/// The symmetric matrix whose quadratic form is trace(R(q)^T m) of unit quaternions q = (w, x, y, z): Davenport's
/// q-method. Of a rotation matrix it is 4 q q^T - 1.
Matrix4 rotationForm(const glm::dmat3& m) {
    const double xx = m[0][0], yy = m[1][1], zz = m[2][2];
    const double wx = m[1][2] - m[2][1], wy = m[2][0] - m[0][2], wz = m[0][1] - m[1][0];
    const double xy = m[1][0] + m[0][1], xz = m[2][0] + m[0][2], yz = m[2][1] + m[1][2];
    return {{{xx + yy + zz, wx, wy, wz},
             {wx, xx - yy - zz, xy, xz},
             {wy, xy, yy - xx - zz, yz},
             {wz, xz, yz, zz - xx - yy}}};
}

glm::dquat fromColumn(const Matrix4& m, size_t column) {
    return unit(glm::dquat(m[0][column], m[1][column], m[2][column], m[3][column]));
}

size_t largestDiagonal(const Matrix4& m) {
    size_t largest = 0;
    for (size_t i = 1; i < 4; ++i) {
        largest = m[i][i] > m[largest][largest] ? i : largest;
    }
    return largest;
}

/// The eigenvector of the largest eigenvalue, by cyclic Jacobi rotations.
glm::dquat largestEigenvector(Matrix4 m) {
    constexpr int kSweeps = 12; // convergence is quadratic; five do for all but clustered eigenvalues
    Matrix4 vectors{};
    for (size_t i = 0; i < 4; ++i) {
        vectors[i][i] = 1.0;
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        bool rotated = false;
        for (size_t p = 0; p < 3; ++p) {
            for (size_t q = p + 1; q < 4; ++q) {
                if (std::abs(m[p][q]) <= 1e-17 * (std::abs(m[p][p]) + std::abs(m[q][q]))) {
                    continue;
                }
                rotated = true;
                const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
                const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
                const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
                for (size_t k = 0; k < 4; ++k) {
                    const double a = m[k][p], b = m[k][q];
                    m[k][p] = c * a - s * b;
                    m[k][q] = s * a + c * b;
                }
                for (size_t k = 0; k < 4; ++k) {
                    const double a = m[p][k], b = m[q][k];
                    m[p][k] = c * a - s * b;
                    m[q][k] = s * a + c * b;
                    const double x = vectors[k][p], y = vectors[k][q];
                    vectors[k][p] = c * x - s * y;
                    vectors[k][q] = s * x + c * y;
                }
            }
        }
        if (!rotated) {
            break;
        }
    }
    return fromColumn(vectors, largestDiagonal(m));
}

} // namespace

glm::dquat unit(const glm::dquat& q) {
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return length > 0.0 ? q / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

glm::dquat slerp(const glm::dquat& a, const glm::dquat& b, double t) {
    const double d = glm::dot(a, b);
    const double sign = d < 0.0 ? -1.0 : 1.0;
    const double cosine = std::min(std::abs(d), 1.0);
    const double angle = std::acos(cosine);
    const double sine = std::sin(angle);
    if (sine < 1e-6) {
        return a * (1.0 - t) + b * (sign * t);
    }
    return a * (std::sin((1.0 - t) * angle) / sine) + b * (sign * std::sin(t * angle) / sine);
}

glm::dquat nearestRotation(const glm::dmat3& matrix) {
    double size = 0.0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            size = std::max(size, std::abs(matrix[column][row]));
        }
    }
    if (!(size > 0.0)) {
        return {1.0, 0.0, 0.0, 0.0};
    }
    glm::dmat3 m = matrix * (1.0 / size);
    const double determinant = glm::determinant(m);
    if (determinant < 0.0) {
        m = -m;
    }
    // Joints of most rigs only turn, move and scale evenly: then the matrix is its rotation but for a factor.
    constexpr double kEven = 1e-6;
    const double xx = glm::dot(m[0], m[0]), yy = glm::dot(m[1], m[1]), zz = glm::dot(m[2], m[2]);
    const double skew = std::max({std::abs(glm::dot(m[0], m[1])), std::abs(glm::dot(m[0], m[2])),
                                  std::abs(glm::dot(m[1], m[2])), std::abs(yy - xx), std::abs(zz - xx)});
    if (determinant != 0.0 && skew <= kEven * xx) {
        Matrix4 form = rotationForm(m * (1.0 / std::cbrt(std::abs(determinant))));
        for (size_t i = 0; i < 4; ++i) {
            form[i][i] += 1.0;
        }
        return fromColumn(form, largestDiagonal(form));
    }
    return largestEigenvector(rotationForm(m));
}

} // namespace supple::skinning
