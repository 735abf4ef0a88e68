// Deform pass: morph targets, then skinning of the control cage. One invocation a cage vertex and instance.
// Whatever feeds the position is `precise`: both mappings must give the same cage, bit for bit.
// w is the vertex's side: -1 if the joint that moves it most mirrors, with the instance's transform, else 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/deform.h"
#include "shaders/shared/mapping.glsl"

layout(constant_id = kMorphsConstant) const bool kMorphs = false;
layout(constant_id = kDualQuaternionsConstant) const bool kDualQuaternions = false; // else linear blending

layout(set = 0, binding = kDeformedCageBinding, std430) writeonly buffer DeformedCage { vec4 deformedCage[]; };

layout(push_constant) uniform Push { DeformPush push; };
#define INSTANCE_PUSH push
#include "shaders/shared/instances.glsl"

LOADED_BUFFER(uvec4, table, Table, kDeformTableBinding, usamplerBuffer, kDeformTableTexelBinding, xyzw)
LOADED_BUFFER(vec4, pose, Poses, kPoseBinding, samplerBuffer, kPoseTexelBinding, xyzw)

// The affine matrix whose rows begin at pose element `i`, applied to a point.
vec3 transformed(uint i, vec3 p) {
    vec4 a = pose(i), b = pose(i + 1u), c = pose(i + 2u);
    precise vec3 q = vec3((a.x * p.x + a.y * p.y) + (a.z * p.z + a.w), (b.x * p.x + b.y * p.y) + (b.z * p.z + b.w),
                          (c.x * p.x + c.y * p.y) + (c.z * p.z + c.w));
    return q;
}

vec3 weighted(uint i, float weight, vec3 p) {
    precise vec3 q = transformed(i, p);
    precise vec3 r = weight * q;
    return r;
}

// The rest position with the displacements of elements [first, end); `weights`: first element of the instance's weights.
// Weights of zero leave the bits but for the sign of a zero, which no sum of skinning keeps.
vec3 morphed(vec3 rest, uint first, uint end, uint weights) {
    precise vec3 p = rest;
    for (uint element = first; element < end; ++element) {
        uvec4 displacement = table(element);
        vec4 four = pose(weights + displacement.x / 4u);
        vec2 two = (displacement.x & 2u) == 0u ? four.xy : four.zw;
        float weight = (displacement.x & 1u) == 0u ? two.x : two.y;
        p = p + weight * uintBitsToFloat(displacement.yzw);
    }
    return p;
}

// sum_j weight_j * matrix_j * rest
vec3 blendedLinearly(vec3 rest, uint first, uint end, uint joints) {
    precise vec3 p = vec3(0.0);
    // Tested at the top: in a do-while, Mesa 22.3's lavapipe goes on adding for lanes that have finished.
    for (uint element = first; element < end; ++element) {
        uvec4 pair = table(element);
        precise vec3 a = weighted(joints + kLinearElements * pair.x, uintBitsToFloat(pair.y), rest);
        precise vec3 b = weighted(joints + kLinearElements * pair.z, uintBitsToFloat(pair.w), rest);
        p = p + (a + b);
    }
    return p;
}

float sum4(vec4 v) {
    precise float s = (v.x + v.y) + (v.z + v.w);
    return s;
}

vec3 crossed(vec3 a, vec3 b) {
    precise vec3 c = a.yzx * b.zxy - a.zxy * b.yzx;
    return c;
}

// What a joint adds: its rotation, and what it moves the vertex by from the anchor, times its rotation.
struct Influence {
    vec4 rotation;
    vec4 moved;
};
Influence influence(uint joint, float weight, vec3 rest, vec3 anchor, vec4 hemisphere) {
    vec4 rotation = pose(joint + 3u);
    // q and -q are one rotation; the one on the heaviest joint's side goes the short way.
    precise vec4 aligned = rotation * hemisphere;
    precise float signedWeight = sum4(aligned) < 0.0 ? -weight : weight;
    precise vec3 d = transformed(joint, rest) - anchor;
    precise vec3 across = crossed(d, rotation.xyz);
    precise vec3 products = d * rotation.xyz;
    precise vec4 moved = vec4(rotation.w * d + across, -((products.x + products.y) + products.z));
    precise Influence result;
    result.rotation = signedWeight * rotation;
    result.moved = signedWeight * moved;
    return result;
}

// Dual quaternion linear blending (Kavan, Collins, Zara, O'Sullivan: Geometric Skinning with Approximate Dual Quaternion
// Blending, ACM TOG 27(4), 2008), whose result does not depend on where the origin of the rest space lies: here it lies at
// the vertex, so that joint j takes the origin to y_j = matrix_j * rest and the blend's translation is the result,
// vec(sum_j w_j y_j q_j conj(q)) / |q|^2 with q = sum_j w_j q_j. Scale and shear move y_j and leave the rotation q_j alone:
// the paper's scaling phase with the vertex as the fixed point of every joint's scaling, as in Blender (issues 32022, 43188,
// 100373); scaled about any other point, neighbors of different scale and rotation pull the vertices between them away.
// Points are taken from an anchor, the heaviest joint's y: one joint alone gives its matrix times the vertex.
vec3 blendedAsDualQuaternions(vec3 rest, uint first, uint end, uint joints) {
    uint heaviest = joints + kDualQuaternionElements * table(first).x;
    precise vec3 anchor = transformed(heaviest, rest);
    vec4 hemisphere = pose(heaviest + 3u);
    precise vec4 q = vec4(0.0);
    precise vec4 moved = vec4(0.0);
    for (uint element = first; element < end; ++element) {
        uvec4 pair = table(element);
        precise Influence a =
            influence(joints + kDualQuaternionElements * pair.x, uintBitsToFloat(pair.y), rest, anchor, hemisphere);
        precise Influence b =
            influence(joints + kDualQuaternionElements * pair.z, uintBitsToFloat(pair.w), rest, anchor, hemisphere);
        q = q + (a.rotation + b.rotation);
        moved = moved + (a.moved + b.moved);
    }
    precise vec3 across = crossed(q.xyz, moved.xyz);
    precise vec3 turned = (q.w * moved.xyz - moved.w * q.xyz) + across;
    precise vec4 squares = q * q;
    precise vec3 p = anchor + turned / sum4(squares);
    return p;
}

// Whether the matrix whose rows begin at pose element `i` mirrors: -1 if it does, else 1. A matrix that flattens does not.
float sideOf(uint i) {
    vec3 a = pose(i).xyz, b = pose(i + 1u).xyz, c = pose(i + 2u).xyz;
    vec3 sizes = max(max(abs(a), abs(b)), abs(c));
    float size = max(max(sizes.x, sizes.y), sizes.z); // of one scale, so that tiny figures have a determinant
    precise vec3 across = crossed(a / size, b / size);
    precise vec3 products = across * (c / size);
    precise float determinant = (products.x + products.y) + products.z;
    return determinant < 0.0 ? -1.0 : 1.0;
}

void main() {
    // Clamped, not returned early: a divergent return makes every later load slow on CPU devices.
    uint id = min(invocationIndex(), push.vertexCount * push.instanceCount - 1u);
    uint entry = id / push.vertexCount, instance = instanceSlot(entry);
    uint index = id - entry * push.vertexCount;
    uvec4 vertex = table(index);
    vec3 rest = uintBitsToFloat(vertex.xyz);
    uint first = vertex.w, end = table(index + 1u).w;
    uint joints = instance * push.poseStride;

    if (kMorphs) {
        uint influences = table(push.firstInfluences + index / 4u)[index & 3u];
        rest = morphed(rest, first, influences, joints + push.morphWeights);
        first = influences;
    }
    uint heaviest = table(first).x;
    precise vec3 p;
    float side;
    if (kDualQuaternions) {
        side = sideOf(joints) * sideOf(joints + kDualQuaternionTransform + kDualQuaternionElements * heaviest);
        p = blendedAsDualQuaternions(rest, first, end, joints + kDualQuaternionTransform);
        p = transformed(joints, p);
    } else {
        side = sideOf(joints + kLinearElements * heaviest);
        p = blendedLinearly(rest, first, end, joints);
    }
    deformedCage[instance * push.cageStride + index] = vec4(p, side);
}
