// A prop that a character holds, placed in four ways. Without a macro and with DUAL_QUATERNIONS: as docs/integration.md shows
// it. With PLACED: by the matrix that the CPU gives. With SKINNED: no prop, but the cage's own vertices.
#version 460

layout(set = 0, binding = 0, std430) readonly buffer Poses { vec4 poses[]; };       // SuppleGroupInfo.poses
layout(set = 0, binding = 1, std430) readonly buffer Prop { vec4 prop[]; };         // position in the joint's space
layout(set = 0, binding = 2, std430) readonly buffer Cage { vec4 deformedCage[]; }; // SuppleGroupInfo.deformedCage
layout(set = 0, binding = 3, std430) readonly buffer Corners { uint corners[]; };   // of the prop, in the cage

layout(push_constant) uniform Push {
    mat4 bind;      // bindTransform of SuppleJointInfo; PLACED: what suppleGetJointTransform gives
    vec4 window;    // of the picture: middle, half its height
    uint stride;    // poses.stride / 16
    uint slot;      // of SuppleInstance
    uint joint;
    uint firstCage; // slot * cageVerticesPerInstance
};
layout(location = 0) out vec3 outPosition;

// A point of the bind pose, moved by the joint alone.
vec3 moved(uint row, vec4 p) { return vec3(dot(poses[row], p), dot(poses[row + 1u], p), dot(poses[row + 2u], p)); }

vec3 place(vec3 position) {
    vec4 p = bind * vec4(position, 1.0);
#if defined(PLACED)
    return p.xyz;
#elif defined(DUAL_QUATERNIONS)
    uint first = slot * stride;
    return moved(first, vec4(moved(first + 3u + 4u * joint, p), 1.0));
#else
    return moved(slot * stride + 3u * joint, p);
#endif
}

void main() {
#ifdef SKINNED
    vec3 position = deformedCage[firstCage + corners[gl_VertexIndex]].xyz;
#else
    vec3 position = place(prop[gl_VertexIndex].xyz);
#endif
    outPosition = position;
    gl_Position = vec4((position.xy - window.xy) / window.z, 0.5 + 0.01 * position.z, 1.0);
}
