// Every instance has a tint of its own (crowd.cpp): turned round the grey axis by x, then lighter or darker by y.
vec3 tinted(vec3 color, vec2 tint) {
    float angle = tint.x;
    vec3 turned = cos(angle) * color + sin(angle) * cross(vec3(0.57735), color) + (1.0 - cos(angle)) * dot(vec3(1.0 / 3.0), color);
    return max(turned, vec3(0.0)) * tint.y;
}
