#include "camera.h"

#include <QMatrix4x4>
#include <QtMath>

#include <algorithm>
#include <cmath>

namespace qt_quick {

namespace {

/// Qt's projections are OpenGL's: here y points down and depth goes from 0 to 1.
QMatrix4x4 toVulkan() {
    return {1.0f, 0.0f, 0.0f, 0.0f, 0.0f, -1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.5f, 0.5f, 0.0f, 0.0f, 0.0f, 1.0f};
}

std::array<float, 16> columns(const QMatrix4x4& matrix) {
    std::array<float, 16> out;
    std::copy(matrix.constData(), matrix.constData() + 16, out.begin());
    return out;
}

std::array<float, 4> four(const QVector3D& v) {
    return {v.x(), v.y(), v.z(), 0.0f};
}

} // namespace

FrameUniforms frameUniforms(const Settings& settings, uint32_t width, uint32_t height,
                            const std::vector<std::array<float, 4>>& feet) {
    const auto yaw = static_cast<float>(qDegreesToRadians(settings.yaw));
    const auto pitch = static_cast<float>(qDegreesToRadians(settings.pitch));
    const auto distance = static_cast<float>(settings.distance);
    const QVector3D middle(0.0f, 0.72f, 0.0f);
    const QVector3D eye = middle + distance * QVector3D(std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                                                        std::cos(yaw) * std::cos(pitch));
    QMatrix4x4 camera = toVulkan();
    camera.translate(static_cast<float>(-settings.covered), 0.0f); // to the middle of what is left
    camera.perspective(30.0f, static_cast<float>(width) / static_cast<float>(height), 0.1f, 60.0f);
    camera.lookAt(eye, middle, {0.0f, 1.0f, 0.0f});

    // The sun's box holds whoever stands there, with arms and tails.
    float reach = 1.6f;
    for (const auto& foot : feet)
        reach = std::max(reach, std::hypot(foot[0], foot[2]) + 1.6f);
    const QVector3D sun = QVector3D(0.45f, 0.95f, 0.55f).normalized();
    QMatrix4x4 light = toVulkan();
    light.ortho(-reach, reach, -reach, reach, 0.0f, 20.0f);
    light.lookAt(middle + 10.0f * sun, middle, {0.0f, 1.0f, 0.0f});

    FrameUniforms out{};
    out.viewProjection = columns(camera);
    out.sunViewProjection = columns(light);
    out.eye = four(eye);
    out.sun = four(sun);
    out.viewport = {1.0f / static_cast<float>(width), 1.0f / static_cast<float>(height),
                    static_cast<float>(feet.size()), static_cast<float>(0.5 - 0.5 * settings.covered)};
    std::copy(feet.begin(), feet.end(), out.feet);
    return out;
}

} // namespace qt_quick
