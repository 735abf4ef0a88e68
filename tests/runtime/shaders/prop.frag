#version 460
layout(location = 0) in vec3 inPosition;
layout(location = 0) out vec4 outColor;

void main() {
    vec3 normal = normalize(cross(dFdx(inPosition), dFdy(inPosition)));
    outColor = vec4(0.5 + 0.5 * normal, 1.0);
}
