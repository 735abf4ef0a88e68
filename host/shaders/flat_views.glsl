// Views that paint a figure without the studio's light: what its textures, texture coordinates and values are. See
// material_textures.glsl.

bool isFlatView(uint view) { return view >= kViewTangents; }

/// Thirty-two by thirty-two squares in each unit of texture coordinates, redder where u grows and bluer where v does; the units' borders
/// are dark.
vec3 uvChecker(vec2 uv) {
    vec2 tile = fract(uv), width = max(fwidth(uv), vec2(1e-6));
    vec2 square = abs(fract(uv * 16.0) - 0.5) - 0.25; // changes sign from square to square
    vec2 side = clamp(square / (width * 16.0), -1.0, 1.0);
    float fade = 1.0 - smoothstep(0.015, 0.05, max(width.x, width.y)); // squares as small as pixels run together
    vec3 color = vec3(0.25 + 0.65 * tile.x, 0.35, 0.25 + 0.65 * tile.y) * (1.0 + 0.4 * side.x * side.y * fade);
    vec2 border = min(tile, 1.0 - tile) / width;
    return mix(vec3(0.02), color, clamp(min(border.x, border.y), 0.0, 1.0));
}

/// 0 to 1, from dark blue over green to yellow; monotonic in brightness, so that gray prints tell as much (a short viridis).
vec3 heat(float value) {
    const vec3 kSteps[5] = vec3[5](vec3(0x44, 0x01, 0x54), vec3(0x3B, 0x52, 0x8B), vec3(0x21, 0x91, 0x8C),
                                   vec3(0x5E, 0xC9, 0x62), vec3(0xFD, 0xE7, 0x25));
    float at = clamp(value, 0.0, 1.0) * 4.0;
    uint low = min(uint(at), 3u);
    return fromSrgb(mix(kSteps[low], kSteps[low + 1u], at - float(low)) / 255.0);
}

/// In the colors that the view has; values of maps are shown as files store them.
vec3 flatColor(uint view, vec4 base, Material material, vec4 uvs, vec3 tangent, vec3 vertexColor, float value) {
    switch (view) {
    case kViewTangents: return fromSrgb(tangent * 0.5 + 0.5);
    case kViewUv: return uvChecker(uvs.xy);
    case kViewUv1: return uvChecker(uvs.zw);
    case kViewVertexColor: return vertexColor;
    case kViewBaseColor: return base.rgb;
    case kViewMetallic: return fromSrgb(vec3(material.metallic));
    case kViewRoughness: return fromSrgb(vec3(material.roughness));
    case kViewNormalMap:
        return fromSrgb(hasTexture(kNormal) ? texture(normalTexture, placed(kNormal, uvs)).xyz : vec3(0.5, 0.5, 1.0));
    case kViewOcclusion: return fromSrgb(vec3(material.occlusion));
    case kViewEmissive: return material.emission;
    default: return heat(value);
    }
}

/// Enough shading to read a form by, from the eye.
float formShade(vec3 n, vec3 v) { return 0.72 + 0.28 * clamp(dot(n, v), 0.0, 1.0); }

/// Pictures keep their own colors; what stands for something is shaded a little.
bool isShadedFlat(uint view) { return view == kViewUv || view == kViewUv1 || view == kViewHeat; }
