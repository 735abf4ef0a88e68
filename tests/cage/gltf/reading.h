// How the tests of the glTF reader read the files they make: as "t.glb", from memory alone.
#pragma once

#include "cage/gltf/reader.h"
#include "tests/cage/gltf/builder.h"

#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace supple::test {

using Strings = std::vector<std::string>;

/// Triangles as the file has them: most tests count these.
inline const cage::GltfOptions kKeepTriangles{.pairing = cage::Pairing::never};

/// What a right file reads as.
inline cage::Character readWell(const std::vector<std::byte>& bytes,
                                const cage::GltfOptions& options = kKeepTriangles) {
    Result<cage::Character> result = cage::readGltf(bytes, "t.glb", "", options);
    EXPECT_TRUE(result.ok()) << result.error().message;
    return result.ok() ? std::move(result.value()) : cage::Character{};
}
inline cage::Character readWell(const GltfBuilder& b, const cage::GltfOptions& options = kKeepTriangles) {
    return readWell(b.glb(), options);
}

/// A strict reading: it refuses what another one mends or leaves out.
inline const cage::GltfOptions kStrict{.pairing = cage::Pairing::never, .strict = true};

/// For limits that are there however much memory a file may take.
inline const cage::GltfOptions kMuchMemory = [] {
    cage::GltfOptions options = kStrict;
    options.memoryLimit = uint64_t{1} << 40;
    return options;
}();

/// Why a strict reading refuses a wrong file; "accepted" where it does not.
inline std::string messageOf(const std::vector<std::byte>& bytes, ErrorCode code = ErrorCode::asset,
                             const cage::GltfOptions& options = kStrict) {
    const Result<cage::Character> result = cage::readGltf(bytes, "t.glb", "", options);
    if (result.ok()) {
        return "accepted";
    }
    EXPECT_EQ(result.error().code, code) << result.error().message;
    return result.error().message;
}
inline std::string messageOf(const GltfBuilder& b) {
    return messageOf(b.glb());
}

/// What a reading says that is not strict: a line for each warning, or why even that one refuses the file.
inline std::string saidOf(const std::vector<std::byte>& bytes) {
    const Result<cage::Character> result = cage::readGltf(bytes, "t.glb", "", kKeepTriangles);
    if (!result.ok()) {
        return "refused: " + result.error().message;
    }
    std::string said;
    for (const std::string& warning : result->warnings) {
        said += (said.empty() ? "" : "\n") + warning;
    }
    return said;
}

/// Replaces the only occurrence of `from`.
inline std::string replaced(const std::string& text, const std::string& from, const std::string& to) {
    const size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    if (place == std::string::npos) {
        return text;
    }
    EXPECT_EQ(text.find(from, place + 1), std::string::npos) << "not unique: " << from;
    return text.substr(0, place) + to + text.substr(place + from.size());
}

inline std::vector<uint32_t> face(const cage::Cage& cage, uint32_t f) {
    return {cage.faceVertices.begin() + cage.faceStarts[f], cage.faceVertices.begin() + cage.faceStarts[f + 1]};
}

} // namespace supple::test
