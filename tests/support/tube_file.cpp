#include "tests/support/tube_file.h"

#include "cage/materials.h"
#include "tests/support/rigged_tube.h"
#include "tools/gltf/writer.h"

#include <gtest/gtest.h>
#include <span>

namespace supple::test {

std::vector<std::byte> tubeFileOf(uint32_t segments, uint32_t sides) {
    cage::Character tube = riggedTube({.segments = segments, .sides = sides, .morphTargets = 4});
    tube.morphs.weights = {0.25f, 0.0f, 1.0f, -0.5f};
    tube.clips.push_back(
        clipOf({channel(1, cage::ChannelPath::translation, {0, 1, 2}, {0, 0, 0, -1, 0.5f, 0, -2, 0, 0}),
                channel(tube.parts[0].node, cage::ChannelPath::weights, {0, 2}, {0, 0, 0, 0, 1, -1, 2, 0.5f})}));
    tube.clips[0].name = "walk";
    constexpr uint8_t kPng[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n', 0, 0, 0, 13, 'I',  'H',  'D',  'R', 0,
                                0,    0,   1,   0,   0,    0,    1,    8,    6, 0, 0, 0,  0x1F, 0x15, 0xC4, 0x89};
    cage::Image image;
    image.name = "pixel";
    image.mimeType = "image/png";
    const auto png = std::as_bytes(std::span(kPng));
    image.bytes = std::vector<std::byte>(png.begin(), png.end());
    tube.images.push_back(image);
    cage::Material material = cage::namedMaterial("skin");
    material.baseColorTexture.image = 0;
    tube.materials.push_back(material);
    tube.cage.faceMaterials.assign(tube.cage.faceCount(), 0);
    const Result<cage::GlbFile> file = cage::writeGlb(tube);
    EXPECT_TRUE(file.ok());
    return file.ok() ? file->bytes : std::vector<std::byte>();
}

} // namespace supple::test
