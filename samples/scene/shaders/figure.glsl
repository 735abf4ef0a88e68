// What figures look like: looks.h.
struct Material {
    vec4 baseColor;
    float metallic, roughness;
    uint tint; // of Look::tints; 4: none
    uint unused;
};
struct Look {
    vec4 tints[4];
    uint firstMaterial, lastMaterial;
    uint unused0, unused1;
};
layout(set = 1, binding = 7, std430) readonly buffer Looks { Look looks[]; }; // by figure
