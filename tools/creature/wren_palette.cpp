#include "wren_palette.h"

#include "cage/materials.h"

#include <cmath>

namespace supple::creature::wren {

namespace {

Vec3 srgb(unsigned hex) {
    Vec3 colour;
    for (int i = 0; i < 3; ++i) {
        const double c = static_cast<double>((hex >> (16 - 8 * i)) & 0xff) / 255.0;
        colour[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    return colour;
}

enum Kind : uint32_t { Skin, Eyes, Hair, Cloth, Leather, Steel, Brass, Wet };

} // namespace

Swatch swatch(Part part) {
    switch (part) {
    case Part::Lip:
        return {Skin, srgb(0xd07a6a)};
    case Part::Mouth:
        return {Wet, srgb(0x5a1a20)};
    case Part::Nostril:
        return {Skin, srgb(0x6a2a22)};
    case Part::Tooth:
        return {Wet, srgb(0xf4efe4)};
    case Part::Lash:
        return {Hair, srgb(0x24120c)};
    case Part::Brow:
        return {Hair, srgb(0x6e2c14)};
    case Part::Hair:
        return {Hair, srgb(0xa8431c), 12};
    case Part::Ribbon:
        return {Cloth, srgb(0x1f5a66), 10};
    case Part::Eye:
        return {Eyes, {1, 1, 1}};
    case Part::Jacket:
        return {Cloth, srgb(0x2b4a78), 10};
    case Part::JacketTrim:
    case Part::Collar:
        return {Cloth, srgb(0xe8d3a0), 10};
    case Part::Scarf:
        return {Cloth, srgb(0xd9962a), 8};
    case Part::ScarfFringe:
        return {Cloth, srgb(0xa8481f), 8};
    case Part::Trousers:
        return {Cloth, srgb(0x55493f), 12};
    case Part::KneePatch:
        return {Leather, srgb(0x6b4428), 10};
    case Part::Boot:
        return {Leather, srgb(0x5c3520), 9};
    case Part::BootCuff:
        return {Leather, srgb(0x8a5a34), 9};
    case Part::Sole:
        return {Leather, srgb(0x2a1d18), 9};
    case Part::Strap:
        return {Leather, srgb(0x4e2c1a), 12};
    case Part::Pouch:
        return {Leather, srgb(0x7a4a28), 12};
    case Part::Bracer:
    case Part::Pauldron:
        return {Leather, srgb(0x6e3f22), 10};
    case Part::Scabbard:
        return {Leather, srgb(0x3a2a2c), 10};
    case Part::Buckle:
    case Part::Guard:
        return {Brass, srgb(0xd8a24a), 8};
    case Part::Blade:
        return {Steel, srgb(0xc9ced6), 6};
    case Part::Grip:
        return {Leather, srgb(0x3c2016), 16};
    default:
        return {Skin, srgb(0xf0b594), 1};
    }
}

std::vector<cage::Material> materials() {
    std::vector<cage::Material> list;
    const auto add = [&](const char* name, float metallic, float roughness) {
        list.push_back(cage::namedMaterial(name));
        list.back().metallicFactor = metallic;
        list.back().roughnessFactor = roughness;
    };
    add("skin", 0, 0.52f);
    add("eyes", 0, 0.06f);
    add("hair", 0, 0.42f);
    add("cloth", 0, 0.85f);
    add("leather", 0, 0.55f);
    add("steel", 1, 0.28f);
    add("brass", 1, 0.32f);
    add("wet", 0, 0.25f);
    return list;
}

std::vector<cage::Image> images() {
    return {};
}

} // namespace supple::creature::wren
