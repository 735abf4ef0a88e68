// Cameras that stand somewhere: their axes, and what supple render says of bad ones.
#include "host/camera.h"
#include "tests/tools/command_runner.h"

#include <glm/gtc/matrix_transform.hpp>

namespace {

using supple::host::Camera;
using supple::test::kCubeObj;
using supple::test::writeText;

void expectSame(const glm::mat4& a, const glm::mat4& b) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            EXPECT_NEAR(a[column][row], b[column][row], 2e-5f) << column << ", " << row;
        }
    }
}

TEST(LookAt, IsTheUsualMatrix) {
    const glm::vec3 eyes[] = {{3, 2, 6}, {-4, -1, 0.5f}, {0, 0, 5}};
    const glm::vec3 ups[] = {{0, 1, 0}, {1, 0.2f, 0}, {0.3f, -1, 0.4f}};
    for (const glm::vec3& eye : eyes) {
        for (const glm::vec3& up : ups) {
            const glm::vec3 target(0.5f, 0.25f, -0.5f);
            const Camera camera = supple::host::lookAt(eye, target, up);
            expectSame(camera.view(), glm::lookAtRH(eye, target, up));
            expectSame(glm::mat4(glm::vec4(camera.eye(), 0), {}, {}, {}), glm::mat4(glm::vec4(eye, 0), {}, {}, {}));
        }
    }
}

TEST(LookAt, StraightDownAndUp) {
    for (const float height : {4.0f, -4.0f}) {
        const glm::vec3 eye(1, height, 2), target(1, 0, 2), up(0.6f, 0, -0.8f);
        expectSame(supple::host::lookAt(eye, target, up).view(), glm::lookAtRH(eye, target, up));
    }
}

TEST(LookAt, WithoutRollIsAsBefore) {
    Camera camera;
    camera.yaw = 0.7f;
    camera.pitch = 0.3f;
    camera.distance = 5.0f;
    const Camera same = supple::host::lookAt(camera.eye(), camera.target, {0, 1, 0});
    EXPECT_NEAR(same.roll, 0.0f, 1e-6f);
    expectSame(camera.view(), same.view());
}

class PlacedCamera : public supple::test::CommandTest {};

TEST_F(PlacedCamera, BadUsageIsTwo) {
    writeText(file("cube.obj"), kCubeObj);
    const std::string render = "render cube.obj -o cube.png --eye 0,0,9 ";
    expectFailure(run("render cube.obj -o cube.png --eye 0,0,9"), 2, "--look-at");
    expectFailure(run(render + "--look-at 0,0,9"), 2, "same point");
    expectFailure(run(render + "--look-at 0,0,0 --up 0,0,1"), 2, "--up");
    expectFailure(run(render + "--look-at 0,0,nan"), 2, "finite");
    expectFailure(run(render + "--look-at 0,0,0 --yaw 3"), 2, "--yaw");
    expectFailure(run("render cube.obj -o cube.png --fov 30"), 2, "--eye");
}

} // namespace
