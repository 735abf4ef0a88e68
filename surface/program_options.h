// What a group wants of the surface passes.
#pragma once

#include "shaders/shared/surface.h"

#include <cstdint>

namespace supple::surface {

/// What a group needs from the passes. It does not change after the group is created.
struct ProgramOptions {
    uint32_t vertexFormat = shared::kVertex16;
    bool vertices = true; ///< else the host's shaders evaluate patches, and none is written
    bool motion = false;  ///< also writes the positions of the frame before
    bool patches = false;
    bool tangents = false; ///< also writes tangents, from the directions that `attributes` writes
    bool attributes = false;
    /// What `attributes` writes beside the first UV set and the color, if the tables have it.
    uint32_t attributeOutputs = ~shared::kOutputDirections;
    bool view = false;        ///< the group belongs to a view. Its motion sets bind the coefficients of this frame in
                              ///< the place of the cage, for instances without a past
    bool lod = false;         ///< the view draws patches at levels, not at a rate
    uint32_t viewRuns = 0;    ///< with lod: runs of patches that the view has room for (shaders/shared/lod.h)
    bool backFaces = false;   ///< with lod: leaves out patches that show their backs
    uint32_t levelOffset = 0; ///< with lod: an instance has one level, which is so many entries behind its own in the
                              ///< list of instances. 0: every edge has its own level
    uint32_t firstMask = 0;   ///< with lod: where masks of parts begin in the list of instances, in words
    uint32_t maskWords = 0;   ///< with lod: words of an instance's mask (shaders/shared/bounds.h)
    bool countsHidden = true; ///< with lod: the surface counts the patches that instances of the group hide
    uint32_t instances = 0;   ///< at most; 0: not known yet, so that kernels for few and for many are made
    uint32_t rate = 0;        ///< the rate that the group is created with. Only this one gets pipelines of its own
};

} // namespace supple::surface
