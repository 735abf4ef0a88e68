// The members of a character in the order of a cooked file (cooked/archive.h).
#pragma once

#include "cage/character.h"
#include "cage/material_layers.h"
#include "runtime/cooked/archive.h"

namespace supple::runtime {

template <>
inline constexpr auto kLast<cage::Interpolation> = cage::Interpolation::cubicSpline;
template <>
inline constexpr auto kLast<cage::ChannelPath> = cage::ChannelPath::weights;
template <>
inline constexpr auto kLast<cage::AlphaMode> = cage::AlphaMode::blend;
template <>
inline constexpr auto kLast<cage::Wrap> = cage::Wrap::mirroredRepeat;
template <>
inline constexpr auto kLast<cage::Filter> = cage::Filter::linearMipmapLinear;
template <>
inline constexpr auto kLast<cage::TrimDomain> = cage::TrimDomain::face;
template <>
inline constexpr auto kLast<cage::PolygonSource> = cage::PolygonSource::arrays;
template <>
inline constexpr auto kLast<cage::WeldSource> = cage::WeldSource::given;
template <>
inline constexpr auto kLast<cage::UvMode> = cage::UvMode::all;
template <>
inline constexpr auto kLast<cage::MadeFor> = cage::MadeFor::none;
template <>
inline constexpr auto kLast<cage::SkinningMode> = cage::SkinningMode::deltaMushLight;
template <>
inline constexpr auto kLast<cage::ExpressionKind> = cage::ExpressionKind::mouth;
template <>
inline constexpr auto kLast<cage::ExpressionHold> = cage::ExpressionHold::block;
template <>
inline constexpr auto kLast<cage::TurnPart> = cage::TurnPart::twist;
template <>
inline constexpr auto kLast<cage::ColliderShape> = cage::ColliderShape::plane;

} // namespace supple::runtime

namespace supple::cage {

using runtime::Is;

template <class A, Is<Cage> T>
void fields(A& a, T& cage) {
    a(cage.positions, cage.faceStarts, cage.faceVertices, cage.cornerUvs, cage.cornerUvs1, cage.cornerColors,
      cage.cornerNormals, cage.cornerTangents, cage.faceTriangles, cage.faceMaterials, cage.faceParts,
      cage.faceTrimTiles, cage.cornerFaceUvs, cage.sourceVertices, cage.creases, cage.creaseSets, cage.sharpVertices,
      cage.creaseScalars, cage.roundCorners, cage.holes);
}
template <class A, Is<Node> T>
void fields(A& a, T& node) {
    a(node.name, node.parent, node.translation, node.rotation, node.scale, node.hasMatrix, node.matrix);
}
template <class A, Is<Channel> T>
void fields(A& a, T& channel) {
    a(channel.node, channel.path, channel.interpolation, channel.times, channel.values, channel.firstTarget);
}
template <class A, Is<Marker> T>
void fields(A& a, T& marker) {
    a(marker.name, marker.time);
}
template <class A, Is<Clip> T>
void fields(A& a, T& clip) {
    a(clip.name, clip.duration, clip.markers, clip.sharpness, clip.packed.words, clip.packed.error,
      clip.packed.unpackedBytes, clip.packed.coarseWords, clip.packed.coarseError);
    // What is packed is there already.
    a.rest(clip.channels, clip.packed.channelCount);
}
template <class A, Is<SharpnessCurve> T>
void fields(A& a, T& curve) {
    a(curve.set, curve.keys);
}
template <class A, Is<MorphTarget> T>
void fields(A& a, T& target) {
    a(target.name, target.vertices, target.deltas);
}
template <class A, Is<Expression> T>
void fields(A& a, T& expression) {
    a(expression.name, expression.kind, expression.isBinary, expression.targets, expression.weights,
      expression.holds[0], expression.holds[1], expression.holds[2], expression.holds[3]);
}
template <class A, Is<DriverInput> T>
void fields(A& a, T& input) {
    a(input.node, input.part, input.axis, input.weight);
}
template <class A, Is<PoseDriver> T>
void fields(A& a, T& driver) {
    a(driver.name, driver.inputs, driver.targets, driver.poses, driver.values, driver.width, driver.low, driver.high);
}
template <class A, Is<Jiggle> T>
void fields(A& a, T& jiggle) {
    a(jiggle.frequency, jiggle.damping, jiggle.limit);
}
template <class A, Is<Cloth> T>
void fields(A& a, T& cloth) {
    a(cloth.stretch, cloth.shear, cloth.bend, cloth.volume, cloth.tether, cloth.drag, cloth.air, cloth.gravity,
      cloth.hitRadius, cloth.substeps, cloth.colliders);
}
template <class A, Is<SpringJoint> T>
void fields(A& a, T& joint) {
    a(joint.node, joint.hitRadius, joint.stiffness, joint.gravityPower, joint.drag, joint.gravityDirection);
}
template <class A, Is<SpringCollider> T>
void fields(A& a, T& collider) {
    a(collider.node, collider.shape, collider.inside, collider.offset, collider.tail, collider.radius);
}
template <class A, Is<Spring> T>
void fields(A& a, T& spring) {
    a(spring.name, spring.center, spring.isTree, spring.joints, spring.colliderGroups);
}
template <class A, Is<Image> T>
void fields(A& a, T& image) {
    a(image.name, image.mimeType, image.bytes);
}
template <class A, Is<Texture> T>
void fields(A& a, T& texture) {
    a(texture.image, texture.alternateImage, texture.uvSet, texture.wrapU, texture.wrapV, texture.magFilter,
      texture.minFilter, texture.offset, texture.rotation, texture.scale);
}
template <class A, Is<Trim> T>
void fields(A& a, T& trim) {
    a(trim.domain, trim.texture, trim.channel, trim.cutoff, trim.tiles);
}
template <class A, Is<MaterialLayers> T>
void fields(A& a, T& layers) {
    const auto each = [&](const auto& table) {
        for (const auto& row : table) {
            a(layers.*row.member);
        }
    };
    each(kLayerNumbers);
    each(kLayerColors);
    each(kLayerTextures);
    a(layers.clearcoatNormalScale);
}
template <class A, Is<Material> T>
void fields(A& a, T& material) {
    a(material.name, material.baseColorFactor, material.baseColorTexture, material.metallicFactor,
      material.roughnessFactor, material.metallicRoughnessTexture, material.normalTexture, material.normalScale,
      material.occlusionTexture, material.occlusionStrength, material.emissiveTexture, material.emissiveFactor,
      material.emissiveStrength, material.unlit, material.alphaMode, material.alphaCutoff, material.doubleSided,
      material.layers, material.trim);
}
template <class A, Is<Smoothing> T>
void fields(A& a, T& smoothing) {
    a(smoothing.lambda, smoothing.iterations);
}
template <class A, Is<Part> T>
void fields(A& a, T& part) {
    a(part.name, part.node, part.rigid, part.joints, part.firstFace, part.firstTarget, part.targetCount,
      part.polygonSource, part.weldSource, part.uvMode, part.madeFor, part.skinning, part.smoothing);
}
template <class A, Is<Damage> T>
void fields(A& a, T& damage) {
    a(damage.found, damage.repair);
}
template <class A, Is<Character> T>
void fields(A& a, T& character) {
    a(character.name, character.copyright, character.cage, character.parts, character.skeleton.nodes,
      character.skeleton.parentsFirst, character.skin.joints, character.skin.inverseBinds, character.weights.starts,
      character.weights.influences, character.morphs.targets, character.morphs.weights, character.expressions,
      character.drivers, character.weights.jiggles, character.weights.mushMask, character.jiggles,
      character.weights.cloths, character.cloths, character.springBones.springs, character.springBones.colliderGroups,
      character.springBones.colliders, character.clips, character.clipRoot, character.materials,
      character.materialVariants, character.images, character.warnings, character.damages, character.sourceVertexCount,
      character.seamVertexCount);
}

} // namespace supple::cage

namespace supple::runtime {

// Vectors and small structs of numbers lie in lists as they do in memory.
template <>
inline constexpr bool kIsPlain<glm::vec2> = true;
template <>
inline constexpr bool kIsPlain<glm::vec3> = true;
template <>
inline constexpr bool kIsPlain<glm::vec4> = true;
template <>
inline constexpr bool kIsPlain<glm::quat> = true;
template <>
inline constexpr bool kIsPlain<glm::mat4> = true;
template <>
inline constexpr bool kIsPlain<cage::Influence> = true;
template <>
inline constexpr bool kIsPlain<cage::PaintedWeight> = true;
template <>
inline constexpr bool kIsPlain<cage::Crease> = true;
template <>
inline constexpr bool kIsPlain<cage::SharpVertex> = true;
template <>
inline constexpr bool kIsPlain<cage::CreaseScalar> = true;
static_assert(sizeof(cage::Influence) == 8 && sizeof(cage::PaintedWeight) == 8 && sizeof(cage::Crease) == 16 &&
              sizeof(cage::SharpVertex) == 8 && sizeof(cage::CreaseScalar) == 12);

} // namespace supple::runtime
