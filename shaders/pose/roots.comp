// Pose pass, second part, for groups with root motion. What the first layer's root has travelled goes into the instance's
// transform. What any layer's root has travelled is taken out of the root's local matrix. One invocation per instance. It is a
// pass of its own: in locals.comp all nodes would step through its code.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/pose/tables.glsl"

const bool kAdds = true, kRoots = true;
#include "shaders/pose/layers.glsl"
#include "shaders/pose/local.glsl"

// The instance's transform, after what the first layer's root has moved by since its clip began.
Affine travelled(uint first, uvec4 header, Motion sinceBegin) {
    Layer layer = layerAt(first + kStateElements);
    vec4 before = stateFloats(first + 4u), turns = stateFloats(first + 5u), center = stateFloats(first + 6u);
    precise float loops = 0.0;
    if ((layer.flags & kLayerLoops) != 0u) loops = loopTime(layer.time, clipDuration(layer.clip)).loops;
    precise Motion motion = combinedMotion(loopsMotion(loops, turns.zw, center), sinceBegin);
    motion = combinedMotion(Motion(before.xyz, turns.xy), motion);
    vec3 x = turnedAboutY(motion.halfTurn, vec3(1.0, 0.0, 0.0)), z = turnedAboutY(motion.halfTurn, vec3(0.0, 0.0, 1.0));
    return combined(transformOf(first), Affine(vec4(x.x, 0.0, z.x, motion.translation.x),
                                               vec4(0.0, 1.0, 0.0, motion.translation.y),
                                               vec4(x.z, 0.0, z.z, motion.translation.z)));
}

void main() {
    uint instance = instanceSlot(min(invocationIndex(), push.instanceCount - 1u));
    uint first = instance * push.stateStride, matrices = instance * push.scratchStride;
    uvec4 header = state(first);
    if (header.w != 0u) {
        precise Motion sinceBegin = standing();
        Transform root = posedTransform(first, header.z, sinceBegin);
        storeLocal(matrices + kAffineElements * header.z, localMatrix(header.z, root));
        if ((header.y & kStateTravels) != 0u) {
            storeLocal(matrices + kAffineElements * push.nodeCount, travelled(first, header, sinceBegin));
        }
    }
}
