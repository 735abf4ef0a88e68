// The studio: a warm key, a cool rim from behind, a soft sky, light from the floor. Each light is one direction of a
// sampled environment and has its own small shadow map, so that shadows soften with distance and corners darken. What is
// mirrored are the soft boxes of these lights, walls and floor (host/environment.h).
#extension GL_EXT_samplerless_texture_functions : require
#ifdef TRACED
#extension GL_EXT_ray_query : require
#endif
#include "pbr.glsl"

layout(set = 0, binding = kShadowBinding) uniform sampler2DArrayShadow shadowMaps;
layout(set = 0, binding = kEnvironmentBinding) uniform sampler2D environmentMap;
layout(set = 0, binding = kShadowDepthBinding) uniform texture2DArray shadowDepths;

const float kPi = 3.14159265;
/// In radii of the scene: parts of a figure hide light from each other from about so far.
const float kNearby = 0.25;
/// Rays start off a surface by more than its triangles lie beside it.
const float kRayOffset = 1.5e-3;

// Radiance of what is mirrored besides key and rim. Walls and floor are lightest where they meet.
const vec3 kOverhead = vec3(0.92, 0.95, 1.0);
const vec3 kWalls = vec3(0.42, 0.45, 0.50);
const vec3 kFloor = vec3(0.26, 0.25, 0.24);

/// 0 where the light is hidden from the position, 1 where it is seen.
float lightVisibility(uint light, vec3 position) {
    vec4 at = frame.lights[light].shadow * vec4(position, 1.0);
    vec2 uv = at.xy * 0.5 + 0.5;
    float depth = min(at.z, 1.0);
    if (frame.softShadows == 0.0)
        return texture(shadowMaps, vec4(uv, float(light), depth));
    // Few directions: four looks spread over the neighboring texels round off the steps of the map.
    float sum = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
        vec2 corner = vec2(i & 1u, i >> 1) * 2.0 - 1.0;
        vec2 turned = vec2(corner.x * 0.89 - corner.y * 0.45, corner.x * 0.45 + corner.y * 0.89);
        sum += texture(shadowMaps, vec4(uv + turned * frame.softShadows, float(light), depth));
    }
    return sum * 0.25;
}

/// Noise needs passes that take it away, and many directions.
bool areCones() { return frame.pass != 0u && frame.softShadows == 0.0; }

/// What differs from neighbor to neighbor and from pass to pass: interleaved gradient noise (Jimenez, SIGGRAPH 2014) and the
/// plane's most even sequence (Roberts, 2018). xy: a direction; z: from 0 to 1.
vec3 pixelNoise(vec2 pixel) {
    vec2 at = floor(pixel) + 5.588238 * float(frame.pass);
    vec2 noise = fract(vec2(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715))), dot(at, vec2(0.75487767, 0.56984029))));
    return vec3(cos(2.0 * kPi * noise.x), sin(2.0 * kPi * noise.x), noise.y);
}
/// The noise for the next light: a golden angle on.
vec3 nextNoise(vec3 noise) {
    return vec3(mat2(-0.737369, 0.675490, -0.675490, -0.737369) * noise.xy, fract(noise.z + 0.754878));
}

/// at: -1 to 1 in the map.
float shadowDepthAt(uint light, vec2 at) {
    float texels = 2.0 * frame.shadowWorld / frame.shadowTexel;
    vec2 texel = clamp((at * 0.5 + 0.5) * texels, vec2(0.0), vec2(texels - 1.0));
    return texelFetch(shadowDepths, ivec3(texel, light), 0).x;
}

/// Soft shadows from few directions: each is a cone, of which a pixel sees one ray. The farther away what hides the light is, the
/// farther the ray has come from the cone's axis; so shadows are sharp where things touch. nl: of the plane that takes the
/// shadow. nearby: about how far away what hides the light may be.
float coneVisibility(uint light, vec3 position, vec3 n, float nl, vec3 noise, float nearby) {
    mat4 shadow = frame.lights[light].shadow;
    vec3 at = (shadow * vec4(position, 1.0)).xyz;
    if (max(abs(at.x), abs(at.y)) > 1.0)
        return 1.0;
    vec2 ray = noise.xy * (sqrt(noise.z) * frame.lights[light].direction.w / frame.shadowWorld);
    // How depth changes along the plane, for a step in the map.
    float steep = frame.shadowWorld * frame.shadowWorld / (max(nl, 0.2) * frame.shadowDepth);
    float slope = steep * dot(vec2(dot(vec3(shadow[0].x, shadow[1].x, shadow[2].x), n),
                                   dot(vec3(shadow[0].y, shadow[1].y, shadow[2].y), n)), ray);
    float away = (at.z + slope * nearby - shadowDepthAt(light, at.xy + ray * nearby)) * frame.shadowDepth;
    float met = clamp(away, 0.15 * nearby, 2.0 * nearby);
    vec2 within = noise.yx * (0.5 * frame.shadowTexel / frame.shadowWorld); // hides the steps of the map
    return min(at.z + slope * met, 1.0) > shadowDepthAt(light, at.xy + ray * met + within) ? 0.0 : 1.0;
}

#ifdef TRACED
layout(set = 0, binding = kRayBinding) uniform accelerationStructureEXT raysMeet;

/// The same by a ray into the light's cone. Glass lets it through.
float tracedVisibility(uint light, vec3 position, vec3 noise) {
    vec4 cone = frame.lights[light].direction;
    vec3 x = normalize(abs(cone.x) > 0.5 ? vec3(cone.y, -cone.x, 0.0) : vec3(0.0, cone.z, -cone.y)), y = cross(cone.xyz, x);
    vec2 aside = noise.xy * (sqrt(noise.z) * cone.w);
    vec3 direction = normalize(cone.xyz + aside.x * x + aside.y * y);
    rayQueryEXT query;
    rayQueryInitializeEXT(query, raysMeet, gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsCullNoOpaqueEXT, 0xFF, position, 0.0,
                          direction, 8.0 * frame.target.w);
    while (rayQueryProceedEXT(query)) {
    }
    return rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT ? 1.0 : 0.0;
}
#endif

/// What the rig sends to a place: a few numbers that vary slowly, so that dense vertices may carry them.
struct Incident {
    vec3 sky;   // irradiance
    float key;  // visible share of the key
    float rim;  // and of the rim
    float open; // visible share of the sky
};

// What of a light a place looks at.
const uint kLookAlongAxes = 0u; // of the cones: what there is for vertices
const uint kLookIntoCones = 1u; // with noise
const uint kLookAsFits = 2u;    // into cones if areCones()

/// look: a constant, so that drivers compile only what is needed. noise: of the pixel.
Incident gatherLight(vec3 position, vec3 n, uint look, vec3 noise) {
    vec3 sky = vec3(0.0);
    // What faces away from a light is not called hidden from it: it may mirror its edge.
    float seen[3] = float[3](0.02, 0.02, 0.02), all[3] = float[3](0.02, 0.02, 0.02);
    // Receivers step off the surface: along the normal by a good texel, so that a map's own steps cast no shadow.
#ifdef TRACED
    vec3 receiver = position + n * (kRayOffset * frame.target.w);
#else
    vec3 receiver = position + n * (frame.shadowTexel * 1.6);
#endif
    for (uint i = 0u; i < frame.lightCount; ++i) {
        noise = nextNoise(noise);
        float nl = dot(n, frame.lights[i].direction.xyz);
        if (nl <= 0.0)
            continue;
        vec4 color = frame.lights[i].color;
        uint part = uint(color.w);
#ifdef TRACED
        float seenShare = tracedVisibility(i, receiver, noise);
#else
        float seenShare = look == kLookIntoCones || (look == kLookAsFits && areCones())
                              ? coneVisibility(i, receiver, n, nl, noise, kNearby * frame.target.w)
                              : lightVisibility(i, receiver);
#endif
        float visible = seenShare * nl;
        seen[part] += visible;
        all[part] += nl;
        if (part == kLightSky)
            sky += color.rgb * visible;
    }
    if (frame.openSky.w != 0.0) { // nothing hides it; what a figure hides on the whole is taken off
        const float kMostlyOpen = 0.75;
        return Incident(frame.openSky.rgb * (kMostlyOpen * (0.5 + 0.5 * n.y)), seen[kLightKey] / all[kLightKey],
                        seen[kLightRim] / all[kLightRim], kMostlyOpen);
    }
    return Incident(sky, seen[kLightKey] / all[kLightKey], seen[kLightRim] / all[kLightRim],
                    seen[kLightSky] / all[kLightSky]);
}

/// Lambert's law for a soft box: the light sinks behind the horizon bit by bit.
float softLambert(float nl) {
    const float soft = 0.18;
    return nl < soft ? (max(nl + soft, 0.0) * max(nl + soft, 0.0)) / (4.0 * soft) : nl;
}

/// The masks of the studio in one level of their map: of about one roughness.
vec4 environmentLevel(vec3 r, float level) {
    vec2 at = r.xz / (abs(r.x) + abs(r.y) + abs(r.z));
    if (r.y < 0.0)
        at = (1.0 - abs(at.yx)) * vec2(at.x >= 0.0 ? 1.0 : -1.0, at.y >= 0.0 ? 1.0 : -1.0);
    // The outermost texels lie on the border.
    float size = exp2(-level) * float(kEnvironmentSize);
    return textureLod(environmentMap, 0.5 + at * ((size - 1.0) / size * 0.5), level);
}

/// The masks in a direction, blurred by a roughness.
vec4 environmentAt(vec3 r, float roughness) {
    vec2 turn = frame.environment.xy;
    r = vec3(r.x * turn.y - r.z * turn.x, r.y, r.z * turn.y + r.x * turn.x);
    float level = pow(roughness, 2.0 / 3.0) * float(kEnvironmentLevels - 1u);
    float sharper = min(floor(level), float(kEnvironmentLevels - 2u));
    return mix(environmentLevel(r, sharper), environmentLevel(r, sharper + 1.0), level - sharper);
}

/// How much of what a surface mirrors is open, if so much of all directions is (Lagarde, "Moving Frostbite to PBR", 2014): a
/// smooth surface that is looked at straight mirrors little of a corner.
float mirrorsOpen(float open, float nv, float roughness) {
    return clamp(pow(nv + open, exp2(-16.0 * roughness - 1.0)) - 1.0 + open, 0.0, 1.0);
}

/// Light from all round. n: the normal that is shaded; surface: that of the surface itself, for which the light was
/// gathered. Both face the viewer's side.
vec3 studioAmbient(Incident light, vec3 n, vec3 surface) {
    // The sky above a normal map's bumps: an even half sphere, turned.
    vec3 sky = light.sky * ((1.2 + n.y) / (1.2 + surface.y));
    return sky + frame.bounce.rgb * ((0.5 - 0.5 * n.y) * mix(0.35, 1.0, light.open));
}

/// What a white surface scatters.
vec3 studioScattered(float occlusion, Incident light, vec3 n, vec3 surface) {
    return frame.keyColor.rgb * light.key * softLambert(dot(n, frame.keyDirection.xyz)) +
           frame.rimColor.rgb * light.rim * softLambert(dot(n, frame.rimDirection.xyz)) +
           studioAmbient(light, n, surface) * occlusion;
}

/// How far light has come through the figure, from where it went in. A map knows where it last went in: the air between two
/// parts counts as if it were the figure.
float wayInside(uint light, vec3 position, vec3 n, vec3 noise) {
#ifdef TRACED
    float far = 2.0 * frame.target.w;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, raysMeet, gl_RayFlagsCullNoOpaqueEXT, 0xFF, position - n * (kRayOffset * frame.target.w), 0.0,
                          frame.lights[light].direction.xyz, far);
    while (rayQueryProceedEXT(query)) {
    }
    bool met = rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT;
    return met && dot(n, frame.lights[light].direction.xyz) < 0.0 ? rayQueryGetIntersectionTEXT(query, true) : 0.0;
#else
    vec3 at = (frame.lights[light].shadow * vec4(position, 1.0)).xyz;
    vec2 within = areCones() ? noise.xy * (0.75 * frame.shadowTexel / frame.shadowWorld) : vec2(0.0);
    return max(at.z - shadowDepthAt(light, at.xy + within), 0.0) * frame.shadowDepth;
#endif
}

/// Irradiance of light that has gone through, as a white surface would have it. In a volume it spreads, and most
/// comes out near where it went in: a ball sends out as much as it takes in. So light reaches behind the edge of shadows, red
/// farther through skin than blue. extinction: MaterialUniforms::extinction.
vec3 studioInside(Incident light, vec4 extinction, vec3 position, vec3 n, vec3 noise) {
    bool thin = extinction.w == 0.0;
    vec3 inside = studioAmbient(light, thin ? -n : n, n);
    for (uint i = 0u; i < frame.lightCount; ++i) {
        vec4 color = frame.lights[i].color;
        if (uint(color.w) == kLightSky)
            continue;
        noise = nextNoise(noise);
        float nl = dot(n, frame.lights[i].direction.xyz);
        if (thin && nl < 0.0)
            inside += color.rgb * (-nl * lightVisibility(i, position - n * (frame.shadowTexel * 1.6)));
        else if (!thin)
            inside += color.rgb * exp(-extinction.rgb * wayInside(i, position, n, noise)) * (0.1875 * (1.0 + nl) * (1.0 + nl));
    }
    return inside;
}

/// Radiance of the studio itself, besides key and rim; seen: environmentAt().
vec3 studioWalls(vec3 r, vec4 seen) {
    return kOverhead * seen.z + mix(kFloor * (1.2 + 0.5 * min(r.y, 0.0)), kWalls * (1.15 - 0.35 * max(r.y, 0.0)), seen.w);
}

/// What a mirror of that roughness shows.
vec3 studioMirrored(float roughness, float occlusion, Incident light, vec3 n, vec3 surface, vec3 v) {
    vec3 r = reflect(-v, n);
    vec4 seen = environmentAt(r, roughness);
    // What looks into the surface, or out of a corner that sees little of the sky, mirrors the figure itself.
    float outwards = clamp(1.0 + dot(r, surface), 0.0, 1.0);
    float open = mirrorsOpen(mix(0.15, 1.0, light.open) * occlusion, max(dot(n, v), 0.0), roughness) * outwards * outwards;
    // The boxes rise above the surface's own horizon. What is below, the figure hides, however blurred it is mirrored: without
    // this, dark materials had a milky veil where they are looked at from aside.
    vec2 risen = smoothstep(-0.2, 0.2, vec2(dot(surface, frame.keyDirection.xyz), dot(surface, frame.rimDirection.xyz)));
    seen.xy *= risen * frame.environment.zw;
    return frame.keyColor.rgb * light.key * seen.x + frame.rimColor.rgb * light.rim * seen.y + studioWalls(r, seen) * open;
}

/// The same if the mirror is rougher along a direction: the mean of mirrors that are turned that way, by the slopes that GGX has
/// there. stretch: that unit vector; w: glTF's strength.
vec3 studioMirroredAlong(vec4 stretch, float roughness, float occlusion, Incident light, vec3 n, vec3 surface, vec3 v, vec3 noise) {
    const uint kTurns = 6u;
    float along = mix(roughness * roughness, 1.0, stretch.w * stretch.w); // alpha of GGX
    float within = areCones() ? fract(noise.z + 0.5) : 0.5;
    vec3 sum = vec3(0.0);
    float all = 1e-4;
    for (uint i = 0u; i < kTurns; ++i) {
        float share = 2.0 * (float(i) + within) / float(kTurns) - 1.0;
        vec3 turned = normalize(n + stretch.xyz * (along * share * inversesqrt(max(1.0 - share * share, 0.02))));
        float seen = max(dot(turned, v), 0.0);
        sum += seen * studioMirrored(roughness, occlusion, light, turned, surface, v);
        all += seen;
    }
    return sum / all;
}

/// What ground glass sends on of the light behind it: of the studio there about half, as the other half goes back.
vec3 studioBehind(Incident light, vec3 surface, vec3 v) {
    vec3 ahead = -v;
    return studioWalls(ahead, environmentAt(ahead, 1.0)) * (0.5 * mix(0.35, 1.0, light.open)) +
           frame.keyColor.rgb * light.key * softLambert(-dot(surface, frame.keyDirection.xyz)) +
           frame.rimColor.rgb * light.rim * softLambert(-dot(surface, frame.rimDirection.xyz));
}

/// Radiance towards the eye, before the exposure and without emission.
vec3 studioShade(Material material, Incident light, vec3 n, vec3 surface, vec3 v) {
    vec3 diffuse = studioScattered(material.occlusion, light, n, surface);
    vec3 mirrored = studioMirrored(material.roughness, material.occlusion, light, n, surface, v);
    vec3 share = mirroredShare(mirrorColor(material), material.roughness, clamp(dot(n, v), 1e-3, 1.0));
    return material.albedo * (1.0 - material.metallic) * (1.0 - share) * diffuse + share * mirrored;
}

/// What is shown. Emission is not exposed: 1 is white.
vec3 studioTone(Material material, vec3 lit) { return neutralTone(lit * frame.exposure + material.emission); }

vec3 fromSrgb(vec3 x) { return mix(pow((x + 0.055) / 1.055, vec3(2.4)), x / 12.92, lessThan(x, vec3(0.04045))); }

/// The backdrop as it is shown: brighter behind the figure, so that dark and light figures both stand out from it.
vec3 backdrop(vec2 pixel) {
    if (frame.backdrop.w != 0.0)
        return frame.backdrop.rgb;
    vec2 at = pixel * frame.viewport.zw;
    vec2 off = (at - vec2(0.5, 0.46)) * vec2(1.0, 1.1);
    float glow = exp(-dot(off, off) * 3.4);
    vec3 color = mix(vec3(0.050, 0.058, 0.072), vec3(0.36, 0.385, 0.42), glow);
    color *= mix(vec3(1.0), vec3(0.86, 0.83, 0.80), smoothstep(0.5, 1.0, at.y));
    return color;
}

/// Breaks the steps of 8 bits in slow gradients: interleaved gradient noise (Jimenez, SIGGRAPH 2014) of one step, whose size
/// in linear light goes about with the root.
vec3 dither(vec3 color, vec2 pixel) {
    if (frame.backdrop.w != 0.0)
        return color; // it is measured, not looked at
    float noise = fract(52.9829189 * fract(dot(floor(pixel), vec2(0.06711056, 0.00583715)))) - 0.5;
    return max(color + sqrt(color) * (noise * (2.0 / 255.0)), 0.0);
}
