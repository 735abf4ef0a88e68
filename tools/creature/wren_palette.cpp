#include "wren_palette.h"

#include "mixing.h"
#include "texture.h"
#include "wren.h"
#include "wren_textures.h"

#include "cage/materials.h"

#include <cmath>

namespace supple::creature::wren {

namespace {

// Light goes into skin and comes out beside where it went in, red the farthest. Down lightens its edge.
void makeSkin(cage::Material& material, glm::vec3 inside) {
    cage::MaterialLayers& layers = material.layers;
    layers.diffuseTransmissionFactor = 0.45f;
    layers.diffuseTransmissionColorFactor = inside;
    layers.thicknessFactor = 0.05f;
    layers.attenuationDistance = 0.005f;
    layers.attenuationColor = {0.54f, 0.19f, 0.055f};
    layers.sheenColorFactor = {0.12f, 0.085f, 0.07f};
    layers.sheenRoughnessFactor = 0.5f;
}

enum Kind : uint32_t { Face, Skin, Eyes, Hair, Cloth, Band, Leather, StrapLeather, Steel, Brass, Wet, Wool };

} // namespace

Swatch swatch(Part part) {
    switch (part) {
    case Part::Mouth:
        return {Wet, srgb(0x5a1a20)};
    case Part::Nostril:
        return {Face, {0.40, 0.24, 0.22}};
    case Part::Tooth:
        return {Wet, srgb(0xf4efe4)};
    case Part::Lash:
        return {Hair, srgb(0x24120c), 12};
    case Part::Brow:
        return {Hair, srgb(0x8a4424), 26};
    case Part::Hair:
        return {Hair, srgb(0xae4a22), 12};
    case Part::Ribbon:
        return {Cloth, srgb(0x1f5a66), 10};
    case Part::Eye:
        return {Eyes, {1, 1, 1}};
    case Part::Jacket:
        return {Cloth, srgb(0x375576), 22};
    case Part::JacketTrim:
    case Part::Collar:
        return {Band, srgb(0xe8d3a0), 14};
    case Part::Scarf:
        return {Wool, srgb(0xd9952f), 15};
    case Part::ScarfFringe:
        return {Wool, srgb(0xa0451f), 15};
    case Part::Trousers:
        return {Cloth, srgb(0x5a5047), 26};
    case Part::KneePatch:
        return {Leather, srgb(0x4a3022), 10};
    case Part::Boot:
        return {Leather, srgb(0x523322), 9};
    case Part::BootCuff:
        return {Leather, srgb(0x7a5238), 9};
    case Part::Sole:
        return {Leather, srgb(0x2a1d18), 9};
    case Part::Strap:
        return {StrapLeather, srgb(0x55301c), 20};
    case Part::Pouch:
        return {Leather, srgb(0x6e4630), 12};
    case Part::Bracer:
    case Part::Pauldron:
        return {Leather, srgb(0x5f3a26), 10};
    case Part::Scabbard:
        return {Leather, srgb(0x3a2a2c), 10};
    case Part::Buckle:
    case Part::Guard:
        return {Brass, srgb(0xd8a24a), 8};
    case Part::Blade:
        return {Steel, srgb(0xc9ced6), 6};
    case Part::Grip:
        return {Leather, srgb(0x3c2016), 16};
    case Part::Nail:
        return {Skin, srgb(0xf7c4ae)};
    case Part::Hand:
    case Part::Thumb:
    case Part::Finger1:
    case Part::Finger2:
    case Part::Finger3:
    case Part::Finger4:
        return {Skin, srgb(0xf0b796)};
    default:
        return {Face, {1, 1, 1}};
    }
}

std::vector<cage::Material> materials() {
    std::vector<cage::Material> list;
    const auto texture = [](Picture picture) { return cage::Texture{.image = static_cast<uint32_t>(picture)}; };
    const auto add = [&](const char* name, float metallic, float roughness) -> cage::Material& {
        list.push_back(cage::namedMaterial(name));
        list.back().metallicFactor = metallic;
        list.back().roughnessFactor = roughness;
        return list.back();
    };
    const auto wear = [&](cage::Material& material, Picture normal, float scale) {
        material.normalTexture = texture(normal);
        material.normalScale = scale;
    };
    cage::Material& face = add("face", 0, 1.0f);
    face.baseColorTexture = texture(Picture::Face);
    face.metallicRoughnessTexture = texture(Picture::FaceRoughness);
    wear(face, Picture::SkinNormal, 0.30f);
    face.normalTexture.scale = {18, 23};
    makeSkin(face, {1.0f, 0.92f, 0.92f});
    face.layers.diffuseTransmissionColorTexture = texture(Picture::Face);
    cage::Material& skin = add("skin", 0, 0.54f);
    wear(skin, Picture::SkinNormal, 0.35f);
    skin.normalTexture.scale = {50, 50};
    makeSkin(skin, {0.92f, 0.47f, 0.31f});
    cage::Material& eyes = add("eyes", 0, 0.45f);
    eyes.baseColorTexture = texture(Picture::Eye);
    wear(eyes, Picture::IrisNormal, 1.0f);
    eyes.layers.clearcoatFactor = 1.0f; // the cornea
    eyes.layers.clearcoatRoughnessFactor = 0.03f;
    eyes.layers.clearcoatNormalTexture = texture(Picture::CorneaNormal);
    cage::Material& hair = add("hair", 0, 0.42f);
    hair.baseColorTexture = texture(Picture::Strands);
    wear(hair, Picture::StrandsNormal, 0.6f);
    hair.layers.anisotropyStrength = 0.75f; // across the strands, where their texture's first coordinate grows
    cage::Material& cloth = add("cloth", 0, 0.86f);
    cloth.baseColorTexture = texture(Picture::Weave);
    wear(cloth, Picture::WeaveNormal, 0.7f);
    cage::Material& band = add("band", 0, 0.70f);
    band.baseColorTexture = texture(Picture::Band);
    wear(band, Picture::BandNormal, 1.0f);
    cage::Material& leather = add("leather", 1, 1.0f);
    leather.metallicRoughnessTexture = texture(Picture::Grain);
    wear(leather, Picture::GrainNormal, 0.8f);
    cage::Material& strap = add("strap", 0, 0.55f);
    strap.baseColorTexture = texture(Picture::Strap);
    wear(strap, Picture::StrapNormal, 1.0f);
    for (const char* name : {"steel", "brass"}) {
        cage::Material& metal = add(name, 1, 1.0f);
        metal.metallicRoughnessTexture = texture(Picture::Worn);
        wear(metal, Picture::WornNormal, 0.6f);
    }
    add("wet", 0, 0.25f);
    cage::Material& wool = add("wool", 0, 0.9f);
    wool.baseColorTexture = texture(Picture::Weave);
    wear(wool, Picture::WeaveNormal, 0.9f);
    wool.layers.sheenColorFactor = {0.30f, 0.24f, 0.14f};
    wool.layers.sheenRoughnessFactor = 0.55f;
    return list;
}

Vec3 tint(const creature::Face& face, const Point& point, const Vec2& uv) {
    if (face.part != Part::Hair) {
        return Vec3(1);
    }
    // No lock is quite the color of the next. Roots are darker, tips have seen the sun.
    const double own = tiledNoise(point.shell * 1.7 + 0.4, 0.3, 512, 91);
    const Vec3 lock = own > 0 ? mix(Vec3(1), Vec3(1.30, 1.42, 1.30), own) : mix(Vec3(1), Vec3(0.66, 0.58, 0.60), -own);
    return lock * mix(0.62, 1.0, ramp(0.0, 0.07, uv.y)) * mix(Vec3(1), Vec3(1.18, 1.28, 1.2), ramp(0.14, 0.30, uv.y));
}

Vec2 facePlace(const Vec3& point) {
    return {0.5 + point.x / 0.36, (1.72 - point.y) / 0.46};
}

Vec3 facePoint(const Vec2& place) {
    const Vec3 worn{(place.x - 0.5) * 0.36, 1.72 - place.y * 0.46, 0.08};
    // Back to the size at which it was modelled.
    Vec3 p = worn;
    for (int round = 0; round < 12; ++round) {
        p += (worn - grown(p)) * Vec3{0.85, 0.85, 0};
    }
    return p;
}

} // namespace supple::creature::wren
