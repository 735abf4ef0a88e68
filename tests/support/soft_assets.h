// Samples of what is soft.
#pragma once

#include "cage/gltf/reader.h"
#include "tests/support/spring_files.h"

#include <gtest/gtest.h>
#include <span>
#include <string>
#include <utility>

namespace supple::test {

/// A round figure that hops (tests/support/belly.py).
inline const std::string kBellyFile = std::string(SUPPLE_TEST_DATA) + "/jiggle/belly.glb";
/// The same with a cape (tests/support/cape.py).
inline const std::string kCapedFile = std::string(SUPPLE_TEST_DATA) + "/cloth/caped.glb";

/// Wren, her middle painted to jiggle softly, her head to jiggle fast. `extensions`: of the file.
inline cage::Character jigglingWren(const std::string& extensions = "\"X\":{}") {
    Result<cage::Character> read = cage::readGltf(withExtensions(kWren, extensions), "wren", "");
    EXPECT_TRUE(read.ok());
    cage::Character wren = read ? std::move(*read) : cage::Character();
    wren.jiggles = {{3.0f, 0.1f, 0.06f}, {9.0f, 0.3f, 0.02f}};
    for (const glm::vec3& p : wren.cage.positions) {
        const bool middle = p.y > 0.8f && p.y < 1.2f;
        const bool head = p.y > 1.5f;
        wren.weights.jiggles.push_back(middle ? cage::PaintedWeight{0, (p.y - 0.8f) / 0.4f}
                                       : head ? cage::PaintedWeight{1, 1.0f}
                                              : cage::PaintedWeight{});
    }
    return wren;
}

} // namespace supple::test
