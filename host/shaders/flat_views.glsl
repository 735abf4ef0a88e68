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

bool isCurvature(uint view) { return view == kViewMeanCurvature || view == kViewGaussianCurvature; }

/// The color of a value on the view's scale. Below 0 there is no value.
vec3 scaleColor(uint view, float value) {
    if (value < 0.0) return vec3(0.30, 0.29, 0.28);
    const uint kColors[5] = uint[5](SUPPLE_SCALE_COLORS), kSigned[5] = uint[5](SUPPLE_SIGNED_COLORS);
    float at = min(value, 1.0) * 4.0;
    uint low = min(uint(at), 3u);
    uint from = isCurvature(view) ? kSigned[low] : kColors[low];
    uint to = isCurvature(view) ? kSigned[low + 1u] : kColors[low + 1u];
    return fromSrgb(mix(unpackUnorm4x8(from), unpackUnorm4x8(to), at - float(low)).bgr);
}

/// What is left on contour lines of the scale, which lie between its steps: no line has the value zero, so that planes have none.
/// `width`: what the value changes by from pixel to pixel.
float contourShade(float value, float width) {
    float at = value * kContours + 0.5, pixel = max(width * kContours, 1e-6);
    float line = 1.0 - clamp(abs(at - round(at)) / pixel, 0.0, 1.0);
    bool drawn = value >= 0.0 && pixel > 1e-4; // where all has one value there are no lines
    return drawn ? 1.0 - 0.55 * line * (1.0 - smoothstep(0.25, 0.6, pixel)) : 1.0; // lines as close as pixels run together
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
    default: return scaleColor(view, value) * (isCurvature(view) ? contourShade(value, fwidth(value)) : 1.0);
    }
}

/// Enough shading to read a form by, from the eye. One color may cover most of a figure that shows values.
float formShade(uint view, vec3 n, vec3 v) {
    return 1.0 - (view >= kViewWeights ? 0.45 : 0.28) * (1.0 - clamp(dot(n, v), 0.0, 1.0));
}

/// Pictures keep their own colors; what stands for something is shaded a little.
bool isShadedFlat(uint view) { return view == kViewUv || view == kViewUv1 || view >= kViewWeights; }
