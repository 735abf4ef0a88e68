// The binary side of a GLB that is being written: arrays become bufferViews and accessors. Private to tools/gltf/.
#pragma once

#include "tools/gltf/written_json.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// The components of a list of vectors, one after the other.
template <class Vec>
[[nodiscard]] std::span<const float> floatsOf(const std::vector<Vec>& values) {
    return values.empty() ? std::span<const float>()
                          : std::span(&values.front()[0], values.size() * static_cast<size_t>(Vec::length()));
}

class Packer {
public:
    /// What a bufferView is bound as; the values are glTF's.
    enum class Target : int { none = 0, vertices = 34962, indices = 34963 };
    /// The values are glTF's.
    enum class Component : int { u8 = 5121, u16 = 5123, u32 = 5125 };

    /// The smallest of u16 and u32 that holds all values up to `largest` and none as a restart value.
    [[nodiscard]] static Component indexComponent(uint32_t largest) {
        return largest < 0xFFFFu ? Component::u16 : Component::u32;
    }

    // All return the new accessor's index. Types are glTF's: "SCALAR", "VEC2", "VEC3", "VEC4", "MAT4".

    /// With bounds: min and max, which glTF requires of positions and key times.
    size_t addFloats(const char* type, std::span<const float> values, Target target, bool bounds = false);
    size_t addIntegers(const char* type, std::span<const uint32_t> values, Component component, Target target,
                       bool normalized = false);
    /// `count` elements that are zero but for those at `indices`, strictly rising; with bounds.
    size_t addSparseFloats(const char* type, size_t count, std::span<const uint32_t> indices,
                           std::span<const float> values);

    /// Returns the new bufferView's index.
    size_t addBytes(std::span<const std::byte> bytes, Target target = Target::none);

    /// The GLB of `root` with buffers, bufferViews and accessors put in. Throws Refusal when it would exceed 4 GiB.
    [[nodiscard]] std::vector<std::byte> finish(json root) &&;

private:
    size_t addAccessor(json accessor);

    json accessors_ = json::array();
    json views_ = json::array();
    std::vector<std::byte> binary_;
};

} // namespace supple::cage::gltf
