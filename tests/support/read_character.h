// A character file, or a failure and an empty character.
#pragma once

#include "cage/gltf/reader.h"

#include <gtest/gtest.h>
#include <string>

namespace supple::test {

inline cage::Character readCharacter(const std::string& file) {
    Result<cage::Character> character = cage::readGltfFile(file);
    EXPECT_TRUE(character.ok()) << file;
    return character ? std::move(*character) : cage::Character();
}

} // namespace supple::test
