// p-rep over animated characters: every all-quad character, in its bind pose and at three times of each of its clips.
#include "cage/gltf/reader.h"
#include "skinning/pose.h"
#include "tests/support/meshes.h"
#include "tests/support/prep_borders.h"
#include "tests/support/shared_assets.h"
#include "tests/support/worst.h"

#include <cstdio>
#include <filesystem>

namespace supple::surface::prep {
namespace {

using test::Posed;
using test::raise;

/// The deformed cage: `clip` at `time`.
std::vector<glm::dvec3> deformed(const cage::Character& character, const cage::Clip& clip, double time) {
    std::vector<glm::mat4> nodes(character.skeleton.nodes.size());
    skinning::sampleClip(character.skeleton, clip, time, nodes);
    skinning::globalTransforms(character.skeleton, nodes, nodes);
    std::vector<skinning::Affine> palette(character.skin.joints.size());
    skinning::jointPalette(character.skin, nodes, glm::mat4(1.0f), palette);
    return skinning::deformOnCpu(character.cage, character.weights, palette);
}

void checkPose(const Posed& posed, test::FloatNormals& worst) {
    test::expectG1(posed, 8);
    const std::vector<glm::vec3> positions(posed.positions.begin(), posed.positions.end());
    const test::BitResult r = test::measureBits(posed.cage, positions, posed.options, {5, 8});
    EXPECT_EQ(r.different, 0u) << posed.name << ": of " << r.samples << " shared samples";
    const test::FloatNormals n = test::measureFloatNormals(posed.cage, positions, posed.options, 8);
    worst.samples += n.samples;
    worst.above += n.above;
    raise(worst.worst, n.worst);
}

TEST(PrepCharacters, everyAllQuadCharacter) {
    const std::vector<std::string> paths = test::allCharacters();
    uint32_t tested = 0;
    for (const std::string& path : paths) {
        const std::string name = std::filesystem::path(path).filename().string();
        const Result<cage::Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        const cage::Cage& cage = character->cage;
        if (!test::allQuads(cage)) {
            std::printf("left out: %s has other polygons than quads\n", name.c_str());
            continue;
        }
        const Result<cage::Topology> topology = cage::buildTopology(cage);
        if (!topology.ok()) {
            std::printf("left out: %s: %s\n", name.c_str(), topology.error().message.c_str());
            continue;
        }
        ++tested;
        test::FloatNormals normals;
        checkPose({name + ", bind", cage, test::doublePositions(cage), {}}, normals);
        for (const cage::Clip& clip : character->clips) {
            for (const double fraction : {0.1, 0.45, 0.8}) {
                const double time = fraction * clip.duration;
                char label[64];
                std::snprintf(label, sizeof label, " %.3f s", time);
                checkPose({name + ", " + clip.name + label, cage, deformed(*character, clip, time), {}}, normals);
            }
        }
        // What is left is the rounding of the coefficients themselves, which shows where a patch is small or thin.
        std::printf("%-46s %8llu samples, max %.3f degrees in float, %llu above 0.05\n", name.c_str(),
                    static_cast<unsigned long long>(normals.samples), normals.worst,
                    static_cast<unsigned long long>(normals.above));
        EXPECT_LE(normals.worst, 0.25) << name;
        EXPECT_LE(normals.above, normals.samples / 10000) << name;
    }
    std::printf("%u all-quad characters of %zu files\n", tested, paths.size());
    EXPECT_GT(tested, 0u) << "the demo character is always here";
}

} // namespace
} // namespace supple::surface::prep
