// Light on figures, where it went wrong: a small body that stands in a large one had black teeth round it, because
// vertices of the large one that lie inside of the small one are dark, and their darkness was spread over whole
// triangles.
#include "host/picture.h"
#include "tests/tools/command_runner.h"
#include "tests/tools/looked_at_pictures.h"
#include "tools/common/procedural.h"

#include <glm/glm.hpp>
#include <sstream>

namespace supple::test {
namespace {

/// Adds a ball of quads to an OBJ that has `before` vertices. Returns how many it has then.
uint32_t addBall(std::ostream& obj, uint32_t segments, float radius, glm::vec3 centre, uint32_t before) {
    const cage::Cage ball = cage::makeCubeSphere(segments);
    for (const glm::vec3& position : ball.positions) {
        const glm::vec3 p = radius * position + centre;
        obj << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
    for (uint32_t face = 0; face < ball.faceCount(); ++face) {
        obj << 'f';
        for (uint32_t corner = ball.faceStarts[face]; corner < ball.faceStarts[face + 1]; ++corner) {
            obj << ' ' << before + ball.faceVertices[corner] + 1;
        }
        obj << '\n';
    }
    return before + ball.vertexCount();
}

class LightTest : public CommandTest {};

TEST_F(LightTest, BodiesThatMeetHaveNoTeeth) {
    std::ostringstream obj;
    const uint32_t vertices = addBall(obj, 4, 1.25f, {0.0f, 0.0f, 0.0f}, 0);
    addBall(obj, 3, 0.35f, {0.25f, 0.35f, 0.95f}, vertices);
    writeText(file("bodies.obj"), obj.str());
    const auto picture = [&](const std::string& rate) {
        const Outcome drawn =
            runOnDevice("render bodies.obj --size 480x480 --rate " + rate + " -o at_" + rate + ".png");
        EXPECT_EQ(drawn.exitCode, 0) << drawn.err;
        Result<host::Picture> read = host::readPng(file("at_" + rate + ".png").string());
        EXPECT_TRUE(read.ok());
        return read ? *read : host::Picture::blank(480, 480);
    };
    // Where triangles are as small as pixels, nothing is spread. With teeth, 0.003 of the pixels were of another color;
    // now it is 0.00002.
    const PictureDifference apart = differenceOf(picture("4"), picture("48"));
    std::printf("%.5f of the pixels are of another color, %.3f steps apart\n", apart.changed, apart.mean);
    EXPECT_LT(apart.changed, 0.001);
}

} // namespace
} // namespace supple::test
