// Drawing for hosts: how a vertex shader finds its surface vertex among what Supple wrote. Self-contained: copy it, or include
// it from where it lies.
//
// One draw a SuppleDrawRange: bind SuppleGridOutput.indices as uint16 indices at the byte
// indices.offset, no vertex buffers, and
//
//     vkCmdDrawIndexedIndirect(commands, grid.indirect.buffer, grid.indirect.offset + range * grid.indirect.stride, 1, 0);
//
// gl_InstanceIndex counts from the command's firstInstance, which is not 0 where an instance hides a part: the range then has a
// list of its own in the buffer of instances.
//
// The first half of this file has no bindings: the shader hands in what it knows of the range, as push constants or from a
// buffer. The second half, for shaders that define SUPPLE_SURFACE_SET, declares what a group hands out as storage
// buffers of that descriptor set and reads them:
//
//     #define SUPPLE_SURFACE_SET 1
//     #include "supple_surface.glsl"
//     layout(push_constant) uniform Push { SuppleRange range; };
//
//     void main() {
//         SuppleVertex at = suppleVertex(range, gl_InstanceIndex, gl_VertexIndex);
//         vec3 position = supplePosition(at), normal = suppleNormal(at);
//         vec3 before = supplePreviousPosition(at); // with SUPPLE_GROUP_MOTION
//         vec2 uv = suppleUv(at);                   // with SUPPLE_GROUP_ATTRIBUTES
//         vec4 color = suppleColor(at);
//         vec4 tangent = suppleTangent(at);         // if SUPPLE_TANGENTS_BINDING is defined: SUPPLE_GROUP_TANGENTS
//         vec4 mine = suppleUserData(at);           // if SUPPLE_USER_DATA_BINDING is defined: see suppleSetUserData
//     }
//
// SUPPLE_GROUP_WINDOWS: for each window, bind its part of the vertices and of the previous positions, from the byte
// firstSlot * verticesPerInstance * stride on, and draw command window * drawRangeCount + range. firstSlot is
// window * SuppleGroupInfo.windowSize.
//
// A buffer that a shader does not read needs no descriptor: a shadow pass binds the first two.
//
// All ranges by one call, without push constants: keep a SuppleRange for every draw range in a storage buffer, in the order of
// SuppleGridOutput.drawRanges, and look it up by the number of the draw:
//
//     layout(set = 2, binding = 0, std430) readonly buffer Ranges { SuppleRange ranges[]; }; // uints without padding
//     SuppleVertex at = suppleVertex(ranges[gl_DrawID], gl_InstanceIndex, gl_VertexIndex);
//
//     vkCmdDrawIndexedIndirect(commands, grid.indirect.buffer, grid.indirect.offset, grid.drawRangeCount, grid.indirect.stride);
//
// The device features for this are multiDrawIndirect and shaderDrawParameters; drawIndirectFirstInstance only if parts are hidden.
// gl_DrawID counts from 0 in every call: if a call begins with another command than the first, as for each SuppleRate, add its
// number. docs/integration.md has more.
//
// Groups with SUPPLE_GROUP_INDEXED_MESH: the same shader; bind the indices as uint32.
//
// Groups of a view (level of detail): one draw a SuppleLevelDraw, bound and drawn alike. With SUPPLE_SURFACE_LOD defined there
// is suppleLodVertex(draw, gl_InstanceIndex, gl_VertexIndex) instead, and the buffer of instances is not needed:
//
//     layout(push_constant) uniform Push { SuppleDraw draw; };
//
// Its vertex is the same index everywhere, for attributes of a view are written with the vertices, every frame.
// SuppleLevelOutput.draws never change: a host with multiDrawIndirect and shaderDrawParameters keeps a SuppleDraw for each of them
// in a buffer (four uints without padding), draws all that share a pipeline by one vkCmdDrawIndexedIndirect, as their commands
// follow each other with the stride levels.indirect.stride, and looks SuppleDraw up by gl_DrawID.
#ifndef SUPPLE_SURFACE_GLSL
#define SUPPLE_SURFACE_GLSL

/// What a draw must be told, from SuppleGridOutput and its SuppleDrawRange.
struct SuppleRange {
    uint patchCount;          // SuppleDrawRange
    uint firstVertex;         // SuppleDrawRange
    uint samplesPerPatch;     // SuppleDrawRange
    uint verticesPerInstance; // SuppleGridOutput
    uint firstSlot;           // SUPPLE_GROUP_WINDOWS: of the window that is drawn and bound; else 0
    uint previousWords;       // floats from one previous position to the next; 0: 3. See supplePreviousPosition
};

/// The same for a SuppleLevelDraw.
struct SuppleDraw {
    uint index;               // of the draw: SuppleLevelOutput.draws[index]
    uint verticesPerInstance; // SuppleLevelDraw
    uint samplesPerPatch;     // SuppleLevelDraw
    uint previousWords;       // as SuppleRange has it
};

/// The surface vertex: an index into vertices, previousPositions, attributes, uvs1 and faceUvs.
uint suppleLodSurfaceVertex(SuppleDraw draw, uint instanceIndex, uint vertexIndex) {
    return vertexIndex + instanceIndex * draw.verticesPerInstance;
}

/// Which entry of SuppleGroupInfo.instances (SuppleRate.instances) this is, where its slot stands.
uint suppleDrawnInstance(SuppleRange range, uint instanceIndex) {
    return range.firstSlot + instanceIndex / range.patchCount;
}

/// The patch within the instance, if the range's first one is known: an index of suppleGetPatches.
uint suppleDrawnPatch(SuppleRange range, uint firstPatch, uint instanceIndex) {
    return firstPatch + instanceIndex % range.patchCount;
}

/// The surface vertex within an instance: an index into attributes, uvs1 and faceUvs, which all instances share.
uint suppleSharedVertex(SuppleRange range, uint instanceIndex, uint vertexIndex) {
    return range.firstVertex + (instanceIndex % range.patchCount) * range.samplesPerPatch + vertexIndex;
}

/// The surface vertex: an index into what is bound of vertices and previousPositions.
uint suppleSurfaceVertex(SuppleRange range, uint slot, uint sharedVertex) {
    return (slot - range.firstSlot) * range.verticesPerInstance + sharedVertex;
}

/// Where its previous position begins, in floats.
uint supplePreviousWord(uint previousWords, uint vertex) { return (previousWords == 0u ? 3u : previousWords) * vertex; }

/// The unit vector of octahedral coordinates.
vec3 suppleOctahedral(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0)
        n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    return normalize(n);
}

/// The normal of SUPPLE_VERTEX_16: octahedral, two snorm16.
vec3 suppleOctahedralNormal(uint word) { return suppleOctahedral(unpackSnorm2x16(word)); }

/// A tangent of SuppleVertexStreams.tangents, as glTF's TANGENT: the direction, and the sign of the frame. In the fragment shader,
/// B = tangent.w * cross(normal, tangent.xyz) is the bitangent; take it before you normalize, as other programs do.
vec4 suppleDecodeTangent(uint word) {
    vec2 p = vec2(float(int(word << 16u) >> 16u) / 32767.0, float(int(word << 1u) >> 17u) / 16383.0);
    return vec4(suppleOctahedral(p), (word & 0x80000000u) != 0u ? -1.0 : 1.0);
}

/// The color of SuppleVertexStreams.attributes: linear, four unorm16.
vec4 suppleUnpackColor(uvec2 words) { return vec4(unpackUnorm2x16(words.x), unpackUnorm2x16(words.y)); }

#ifdef SUPPLE_SURFACE_SET

#ifndef SUPPLE_INSTANCES_BINDING
#define SUPPLE_INSTANCES_BINDING 0
#endif
#ifndef SUPPLE_VERTICES_BINDING
#define SUPPLE_VERTICES_BINDING 1
#endif
#ifndef SUPPLE_PREVIOUS_BINDING
#define SUPPLE_PREVIOUS_BINDING 2
#endif
#ifndef SUPPLE_ATTRIBUTES_BINDING
#define SUPPLE_ATTRIBUTES_BINDING 3
#endif

#ifdef SUPPLE_SURFACE_LOD
#ifndef SUPPLE_BUCKETS_BINDING
#define SUPPLE_BUCKETS_BINDING 4
#endif
#ifndef SUPPLE_PATCHES_BINDING
#define SUPPLE_PATCHES_BINDING 5
#endif
layout(set = SUPPLE_SURFACE_SET, binding = SUPPLE_BUCKETS_BINDING, std430) readonly buffer SuppleBuckets {
    uvec4 suppleBuckets[]; // SuppleLevelOutput.buckets
};
layout(set = SUPPLE_SURFACE_SET, binding = SUPPLE_PATCHES_BINDING, std430) readonly buffer SupplePatches {
    uvec4 supplePatches[]; // SuppleLevelOutput.patches, four a patch
};
#else
layout(set = SUPPLE_SURFACE_SET, binding = SUPPLE_INSTANCES_BINDING, std430) readonly buffer SuppleInstances {
    uint suppleInstances[];
};
#endif
// SUPPLE_VERTEX_24: three floats of position, three of normal; SUPPLE_VERTEX_12: three of position, and there is no suppleNormal
#if defined(SUPPLE_SURFACE_VERTEX_24) || defined(SUPPLE_SURFACE_VERTEX_12)
layout(set = SUPPLE_SURFACE_SET, binding = SUPPLE_VERTICES_BINDING, std430) readonly buffer SuppleVertices {
    float suppleVertices[];
};
#else // SUPPLE_VERTEX_16: three floats of position, a word of normal
layout(set = SUPPLE_SURFACE_SET, binding = SUPPLE_VERTICES_BINDING, std430) readonly buffer SuppleVertices {
    uvec4 suppleVertices[];
};
#endif
layout(set = SUPPLE_SURFACE_SET, binding = SUPPLE_PREVIOUS_BINDING, std430) readonly buffer SupplePrevious {
    float supplePrevious[];
};
layout(set = SUPPLE_SURFACE_SET, binding = SUPPLE_ATTRIBUTES_BINDING, std430) readonly buffer SuppleAttributes {
    uvec4 suppleAttributes[]; // float2 uv, RGBA in 4 x unorm16
};

#ifdef SUPPLE_TANGENTS_BINDING
layout(set = SUPPLE_SURFACE_SET, binding = SUPPLE_TANGENTS_BINDING, std430) readonly buffer SuppleTangents {
    uint suppleTangents[];
};
#endif

#ifdef SUPPLE_USER_DATA_BINDING
layout(set = SUPPLE_SURFACE_SET, binding = SUPPLE_USER_DATA_BINDING, std430) readonly buffer SuppleUserData {
    vec4 suppleUserDatas[]; // SuppleGroupInfo.userData
};
#endif

struct SuppleVertex {
    uint slot;     // of the instance: where a host keeps what it knows of its instances
    uint own;      // within the instance: index into attributes, uvs1, faceUvs
    uint index;    // index into vertices
    uint previous; // index into previousPositions, in floats
};

#ifdef SUPPLE_SURFACE_LOD
/// The patch of a surface vertex: (patch in the order of suppleGetPatches, slot, first surface vertex, -).
uvec4 suppleLodPatch(SuppleDraw draw, uint vertex) {
    uvec4 bucket = suppleBuckets[draw.index];
    uvec4 found = supplePatches[4u * (bucket.x + (vertex - bucket.y) / draw.samplesPerPatch)];
    return uvec4(found.x, found.y & 0x0FFFFFFFu, found.zw);
}

SuppleVertex suppleLodVertex(SuppleDraw draw, uint instanceIndex, uint vertexIndex) {
    SuppleVertex at;
    at.index = suppleLodSurfaceVertex(draw, instanceIndex, vertexIndex);
    at.own = at.index;
    at.slot = suppleLodPatch(draw, at.index).y;
    at.previous = supplePreviousWord(draw.previousWords, at.index);
    return at;
}
#else
SuppleVertex suppleVertex(SuppleRange range, uint instanceIndex, uint vertexIndex) {
    SuppleVertex at;
    at.slot = suppleInstances[suppleDrawnInstance(range, instanceIndex)];
    at.own = suppleSharedVertex(range, instanceIndex, vertexIndex);
    at.index = suppleSurfaceVertex(range, at.slot, at.own);
    at.previous = supplePreviousWord(range.previousWords, at.index);
    return at;
}
#endif

#ifdef SUPPLE_SURFACE_VERTEX_24
vec3 supplePosition(SuppleVertex at) {
    uint i = 6u * at.index;
    return vec3(suppleVertices[i], suppleVertices[i + 1u], suppleVertices[i + 2u]);
}

vec3 suppleNormal(SuppleVertex at) {
    uint i = 6u * at.index;
    return vec3(suppleVertices[i + 3u], suppleVertices[i + 4u], suppleVertices[i + 5u]);
}
#elif defined(SUPPLE_SURFACE_VERTEX_12)
vec3 supplePosition(SuppleVertex at) {
    uint i = 3u * at.index;
    return vec3(suppleVertices[i], suppleVertices[i + 1u], suppleVertices[i + 2u]);
}
#else
vec3 supplePosition(SuppleVertex at) { return uintBitsToFloat(suppleVertices[at.index].xyz); }

vec3 suppleNormal(SuppleVertex at) { return suppleOctahedralNormal(suppleVertices[at.index].w); }
#endif

/// Where the vertex was in the frame before. For motion vectors: project both without jitter, each with its frame's camera.
/// A frame that does not record the group shows it as it was. Then bind the vertices in the place of the previous positions,
/// and let previousWords be 4 (SUPPLE_VERTEX_16) or 6 (SUPPLE_VERTEX_24): the same shader finds no motion.
vec3 supplePreviousPosition(SuppleVertex at) {
    uint i = at.previous;
    return vec3(supplePrevious[i], supplePrevious[i + 1u], supplePrevious[i + 2u]);
}

vec2 suppleUv(SuppleVertex at) { return uintBitsToFloat(suppleAttributes[at.own].xy); }

vec4 suppleColor(SuppleVertex at) { return suppleUnpackColor(suppleAttributes[at.own].zw); }

#ifdef SUPPLE_TANGENTS_BINDING
vec4 suppleTangent(SuppleVertex at) { return suppleDecodeTangent(suppleTangents[at.index]); }
#endif

#ifdef SUPPLE_USER_DATA_BINDING
/// What suppleSetUserData gave the instance.
vec4 suppleUserData(SuppleVertex at) { return suppleUserDatas[at.slot]; }
#endif

#endif // SUPPLE_SURFACE_SET
#endif
