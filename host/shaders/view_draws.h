// Read by C++ and by shaders: what is known of a draw whose command host/view_draws.h has gathered.
#ifndef SUPPLE_HOST_VIEW_DRAWS_H
#define SUPPLE_HOST_VIEW_DRAWS_H

#ifdef __cplusplus
#include <cstdint>
namespace supple::host::shared {
using uint = uint32_t;
#endif

struct ViewDraw {
    uint index;               // the first four are a SuppleDraw, whose buckets are ViewDraws::buckets()
    uint verticesPerInstance;
    uint samplesPerPatch;
    uint previousWords;
    uint surface;  // in the order in which ViewDraws was given them
    uint material; // SuppleLevelDraw
    uint capacity; // SuppleLevelDraw
    uint command;  // where it begins among all commands of the view, in words
};

// Words of a VkDrawIndexedIndirectCommand, and which of them is instanceCount.
#ifdef __cplusplus
inline constexpr uint kCommandWords = 5;
#else
const uint kCommandWords = 5u;
const uint kInstanceCountWord = 1u;
#endif

#ifdef __cplusplus
} // namespace supple::host::shared
#endif

#endif
