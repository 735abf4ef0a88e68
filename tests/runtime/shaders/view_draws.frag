#version 460
layout(location = 0) in vec3 inPosition;
layout(location = 1) flat in uvec4 inDraw;
layout(location = 0) out vec4 outColor;

// Which draw it is, in bands of its normal.
void main() {
    vec3 normal = normalize(cross(dFdx(inPosition), dFdy(inPosition)));
    outColor = vec4(0.25 * vec3(inDraw.xyz & 3u) + 0.2 * abs(normal), 1.0);
}
