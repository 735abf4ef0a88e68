// What sits on the points of a figure's surface: props and decals. Set 1 is its own.
#define PUSH AttachmentPush
#include "frame.glsl"

layout(set = 1, binding = kAttachmentFrameBinding, std430) readonly buffer Frames { vec4 frames[]; };
layout(set = 1, binding = kAttachmentVertexBinding, std430) readonly buffer Vertices { AttachmentVertex vertices[]; };
layout(set = 1, binding = kAttachmentInstanceBinding, std430) readonly buffer Slots { uint attachmentSlots[]; };

/// The frame of a point (SUPPLE_POINT_FRAME_48): tangent, bitangent, normal and position.
mat4x3 frameOf(uint point) {
    uint element = 3u * (attachmentSlots[gl_InstanceIndex] * push.pointCount + point);
    return transpose(mat3x4(frames[element], frames[element + 1u], frames[element + 2u]));
}
