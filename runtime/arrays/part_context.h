// What the parts of a character in arrays have in common. Private to runtime/arrays/.
#pragma once

#include "cage/character.h"
#include "cage/message.h"
#include "cage/split/cage.h"

#include <cstdint>
#include <span>

namespace supple::runtime {

struct PartContext {
    uint32_t nodeCount = 0;
    std::span<const cage::Material> materials;
    cage::Pairing pairing = cage::Pairing::whereClean;
    cage::Warnings* warnings = nullptr;
};

} // namespace supple::runtime
