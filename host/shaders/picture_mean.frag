// One more picture for a mean, which blending by alpha keeps: see host/picture_mean.h.
#version 460

layout(set = 0, binding = 0) uniform sampler2D picture;
layout(push_constant) uniform Push { float share; };
layout(location = 0) out vec4 outColor;

void main() { outColor = vec4(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb, share); }
