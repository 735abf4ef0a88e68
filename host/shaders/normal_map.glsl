// Normals of a normal map, as glTF has them: +X is where the first texture coordinate grows, +Y is up in the picture.

/// n: the unit normal of the front. tangent: glTF's TANGENT. normal: of the vertices, interpolated and of any length.
vec3 mappedNormal(vec3 n, vec3 normal, vec4 tangent, vec3 texel) {
    return normalize(texel.x * tangent.xyz + texel.y * tangent.w * cross(normal, tangent.xyz) + texel.z * n);
}

/// Without tangents: from what position and texture coordinates change by from pixel to pixel. So the frame is one for each
/// triangle, and jumps a little from one to the next.
vec3 mappedNormalHere(vec3 n, vec3 position, vec2 uv, vec3 texel) {
    vec3 px = dFdx(position), py = dFdy(position);
    vec2 ux = dFdx(uv), uy = dFdy(uv);
    float side = ux.x * uy.y - uy.x * ux.y < 0.0 ? -1.0 : 1.0;
    vec3 right = side * (px * uy.y - py * ux.y); // where s grows and t stands still
    vec3 up = side * (px * uy.x - py * ux.x);    // where t falls and s stands still
    right -= n * dot(n, right);
    float size = dot(right, right);
    if (size < 1e-30)
        return n; // texture coordinates that stand still
    right *= inversesqrt(size);
    vec3 across = cross(n, right);
    return normalize(texel.x * right + (dot(across, up) < 0.0 ? -texel.y : texel.y) * across + texel.z * n);
}
