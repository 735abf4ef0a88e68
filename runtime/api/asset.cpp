// supple.h, asset.
#include "cage/expressions.h"
#include "cage/limits.h"
#include "cage/trim.h"
#include "runtime/api/descriptions.h"
#include "runtime/api/entry.h"
#include "runtime/cooked/file.h"
#include "runtime/material_layers.h"
#include "skinning/packed_clip.h"
#include "skinning/pose.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

static_assert(SUPPLE_WRAP_REPEAT == static_cast<int>(cage::Wrap::repeat) &&
              SUPPLE_WRAP_CLAMP == static_cast<int>(cage::Wrap::clampToEdge) &&
              SUPPLE_WRAP_MIRROR == static_cast<int>(cage::Wrap::mirroredRepeat));
static_assert(SUPPLE_FILTER_ANY == static_cast<int>(cage::Filter::any) &&
              SUPPLE_FILTER_LINEAR_MIPMAP_LINEAR == static_cast<int>(cage::Filter::linearMipmapLinear));
static_assert(SUPPLE_ALPHA_OPAQUE == static_cast<int>(cage::AlphaMode::opaque) &&
              SUPPLE_ALPHA_MASK == static_cast<int>(cage::AlphaMode::mask) &&
              SUPPLE_ALPHA_BLEND == static_cast<int>(cage::AlphaMode::blend));
static_assert(SUPPLE_NO_IMAGE == cage::kNone);
static_assert(SUPPLE_MAX_TRIM_TILES == cage::kMaxTrimTiles);
static_assert(SUPPLE_MAX_COORDINATE == cage::kMaxCoordinate);
// A struct within a struct can never grow, and no field may come to lie where there was padding.
static_assert(sizeof(SuppleTextureInfo) == 12 * sizeof(uint32_t));
static_assert(sizeof(SuppleMaterialLayers) == offsetof(SuppleMaterialLayers, thickness) + sizeof(SuppleTextureInfo));
static_assert(sizeof(SuppleMaterialInfo) == offsetof(SuppleMaterialInfo, trim) + sizeof(SuppleTextureInfo));

SuppleTextureInfo toTextureInfo(const cage::Texture& from) {
    SuppleTextureInfo info{};
    info.image = from.image;
    info.alternateImage = from.alternateImage;
    info.uvSet = from.uvSet;
    info.wrap[0] = static_cast<SuppleWrap>(from.wrapU);
    info.wrap[1] = static_cast<SuppleWrap>(from.wrapV);
    info.magFilter = static_cast<SuppleFilter>(from.magFilter);
    info.minFilter = static_cast<SuppleFilter>(from.minFilter);
    for (int axis = 0; axis < 2; ++axis) {
        info.offset[axis] = from.offset[axis];
        info.scale[axis] = from.scale[axis];
    }
    info.rotation = from.rotation;
    return info;
}

void tellTrim(const cage::Material& from, SuppleMaterialInfo& info) {
    const std::optional<cage::Trim> trim = cage::trimOf(from);
    info.trim = toTextureInfo(trim ? trim->texture : cage::Texture{});
    if (!trim) {
        return;
    }
    info.trimDomain = trim->domain == cage::TrimDomain::face ? SUPPLE_TRIM_FACE : SUPPLE_TRIM_UV;
    info.trimChannel = trim->channel;
    info.trimCutoff = trim->cutoff;
    info.trimFactor = from.trim ? 1.0f : from.baseColorFactor.a;
    info.trimAlpha = from.trim ? 0 : 1;
    info.trimTiles = trim->tiles;
}

SuppleResult clipBounds(Context& context, const char* function, const Asset& asset, uint32_t clip,
                        const skinning::ClipBoundsDesc& desc, SuppleBounds* out) {
    if (out == nullptr) {
        return refuse(context, ErrorCode::nullPointer, function, "out is null");
    }
    const std::optional<SuppleBounds> found = asset.clipBounds.of(asset.character, clip, desc);
    if (!found) {
        return refuse(context, ErrorCode::range, function,
                      asset.character.name + ": clip " + std::to_string(clip) + " of " +
                          std::to_string(asset.character.clips.size()));
    }
    *out = *found;
    return SUPPLE_OK;
}

/// A cooked file that has tables for the context's mapping. What was said of the character when it was cooked is said
/// again.
Result<std::shared_ptr<const runtime::Prepared>> readCookedFor(const Context& context, const SuppleAssetDesc& desc) {
    const Result<std::shared_ptr<runtime::Prepared>> cooked = readCookedAsset(desc);
    if (!cooked) {
        return cooked.error();
    }
    if (const Status fits = runtime::checkMapping(**cooked, context.isWide()); !fits) {
        return fits.error();
    }
    context.tellWarnings((*cooked)->character);
    return std::shared_ptr<const runtime::Prepared>(*cooked);
}

/// Notes that the asset has been loaded.
template <class C>
SuppleResult notedAsset(Context& context, SuppleAsset asset) {
    context.noteLoad<C>(asset);
    context.flushRecording();
    return SUPPLE_OK;
}

void tell(const cage::Material& from, SuppleMaterialInfo& info) {
    info.name = from.name.c_str();
    info.alphaMode = static_cast<SuppleAlphaMode>(from.alphaMode);
    info.alphaCutoff = from.alphaCutoff;
    info.doubleSided = from.doubleSided ? 1 : 0;
    info.unlit = from.unlit ? 1 : 0;
    for (int channel = 0; channel < 4; ++channel) {
        info.baseColorFactor[channel] = from.baseColorFactor[channel];
    }
    for (int channel = 0; channel < 3; ++channel) {
        info.emissiveFactor[channel] = from.emissiveFactor[channel];
    }
    info.emissiveStrength = from.emissiveStrength;
    info.metallicFactor = from.metallicFactor;
    info.roughnessFactor = from.roughnessFactor;
    info.normalScale = from.normalScale;
    info.occlusionStrength = from.occlusionStrength;
    info.baseColor = toTextureInfo(from.baseColorTexture);
    info.metallicRoughness = toTextureInfo(from.metallicRoughnessTexture);
    info.normal = toTextureInfo(from.normalTexture);
    info.occlusion = toTextureInfo(from.occlusionTexture);
    info.emissive = toTextureInfo(from.emissiveTexture);
    tellTrim(from, info);
}

void tell(const cage::MaterialLayers& from, SuppleMaterialLayers& layers) {
    for (size_t i = 0; i < cage::kLayerNumbers.size(); ++i) {
        layers.*runtime::kLayerNumberMembers[i] = from.*cage::kLayerNumbers[i].member;
    }
    for (size_t i = 0; i < cage::kLayerColors.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            (layers.*runtime::kLayerColorMembers[i])[channel] = (from.*cage::kLayerColors[i].member)[channel];
        }
    }
    for (size_t i = 0; i < cage::kLayerTextures.size(); ++i) {
        layers.*runtime::kLayerTextureMembers[i] = toTextureInfo(from.*cage::kLayerTextures[i].member);
    }
    layers.clearcoatNormalScale = from.clearcoatNormalScale;
}

/// Names that the asset has, into the room that there is for them.
SuppleResult tellNames(const std::vector<std::string>& names, const char** out, uint32_t& count) {
    const auto total = static_cast<uint32_t>(names.size());
    const uint32_t n = out == nullptr ? 0 : std::min(count, total);
    for (uint32_t i = 0; i < n; ++i) {
        out[i] = names[i].c_str();
    }
    count = total;
    return out != nullptr && n < total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
}

} // namespace

SuppleResult suppleCreateAsset(SuppleContext handle, const SuppleAssetDesc* given, SuppleAsset* out) {
    constexpr const char* kHere = "suppleCreateAsset";
    return onDevice(handle, kHere, [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        out->id = 0;
        SuppleAssetDesc desc{};
        if (const std::optional<Error> fault = takeAsset("desc", given, desc)) {
            return refuse(context, fault->code, kHere, fault->message);
        }
        const auto made = [&](const Result<uint64_t>& id) {
            out->id = id ? *id : 0;
            return id ? notedAsset<calls::CreateAsset>(context, *out) : report(context, id.error());
        };
        if (desc.prepared != nullptr) {
            return made(context.createAsset(desc.prepared->prepared, desc.clipPoolBytes));
        }
        if (isCooked(desc)) {
            const auto cooked = readCookedFor(context, desc);
            return cooked ? made(context.createAsset(*cooked, desc.clipPoolBytes)) : report(context, cooked.error());
        }
        Result<cage::Character> character = readAsset(kHere, desc);
        return character ? made(context.createAsset(std::move(*character), desc.clipPoolBytes))
                         : report(context, character.error());
    });
}

SuppleResult suppleReloadAsset(SuppleContext handle, SuppleAsset asset, const SuppleAssetDesc* given) {
    constexpr const char* kHere = "suppleReloadAsset";
    return onDevice(handle, kHere, [&](Context& context) {
        if (context.assets.find(asset.id) == nullptr) {
            return refuse(context, ErrorCode::staleHandle, kHere, "stale or foreign asset handle");
        }
        SuppleAssetDesc desc{};
        if (const std::optional<Error> fault = takeAsset("desc", given, desc)) {
            return refuse(context, fault->code, kHere, fault->message);
        }
        const auto loaded = [&](const Status& status) {
            return status ? notedAsset<calls::ReloadAsset>(context, asset) : report(context, status.error());
        };
        if (desc.prepared != nullptr) {
            return loaded(context.reloadAsset(asset.id, desc.prepared->prepared, desc.clipPoolBytes));
        }
        if (isCooked(desc)) {
            const auto cooked = readCookedFor(context, desc);
            return loaded(cooked ? context.reloadAsset(asset.id, *cooked, desc.clipPoolBytes) : Status(cooked.error()));
        }
        Result<cage::Character> character = readAsset(kHere, desc);
        return loaded(character ? context.reloadAsset(asset.id, std::move(*character), desc.clipPoolBytes)
                                : Status(character.error()));
    });
}

SuppleResult suppleDestroyAsset(SuppleContext handle, SuppleAsset asset) {
    return guarded(handle, "suppleDestroyAsset", [&](Context& context) {
        if (context.assets.remove(asset.id) == nullptr) {
            return refuse(context, ErrorCode::staleHandle, "suppleDestroyAsset", "stale or foreign asset handle");
        }
        return noted(context, calls::DestroyAsset{asset});
    });
}

SuppleResult suppleGetAssetInfo(SuppleContext handle, SuppleAsset asset, SuppleAssetInfo* out) {
    return withAsset(handle, asset, "suppleGetAssetInfo", [&](Context& context, const Asset& found) {
        return describe(context, "suppleGetAssetInfo", out, [&](SuppleAssetInfo& info) {
            const cage::Character& character = found.character;
            info.cageVertexCount = character.cage.vertexCount();
            info.faceCount = character.cage.faceCount();
            info.jointCount = static_cast<uint32_t>(character.skin.joints.size());
            info.clipCount = static_cast<uint32_t>(character.clips.size());
            info.materialCount = static_cast<uint32_t>(character.materials.size());
            info.morphTargetCount = static_cast<uint32_t>(character.morphs.targets.size());
            info.expressionCount = static_cast<uint32_t>(character.expressions.size());
            info.imageCount = static_cast<uint32_t>(character.images.size());
            info.partCount = static_cast<uint32_t>(character.parts.size());
            info.sourceVertices = character.cage.sourceVertices.data();
            glm::vec3 low = character.cage.positions.front(), high = low;
            for (const glm::vec3& p : character.cage.positions) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            for (int axis = 0; axis < 3; ++axis) {
                info.boundsMin[axis] = low[axis];
                info.boundsMax[axis] = high[axis];
            }
        });
    });
}

SuppleResult suppleGetPartInfo(SuppleContext handle, SuppleAsset asset, uint32_t part, SupplePartInfo* out) {
    return withAsset(handle, asset, "suppleGetPartInfo", [&](Context& context, const Asset& found) {
        return describePart(context, "suppleGetPartInfo", "part", part, found.parts.size(), out,
                            [&](SupplePartInfo& info) {
                                const cage::Part& from = found.character.parts[part];
                                const runtime::PartSummary& summary = found.parts[part];
                                info.name = from.name.c_str();
                                info.node = from.node;
                                info.joint = summary.joint;
                                info.firstFace = from.firstFace;
                                info.faceCount = cage::endFace(found.character, part) - from.firstFace;
                                info.firstMorphTarget = from.firstTarget;
                                info.morphTargetCount = from.targetCount;
                                info.materialCount = static_cast<uint32_t>(summary.materials.size());
                                info.materials = summary.materials.data();
                                for (int axis = 0; axis < 3; ++axis) {
                                    info.boundsMin[axis] = summary.low[axis];
                                    info.boundsMax[axis] = summary.high[axis];
                                }
                                info.scheme = static_cast<SuppleScheme>(found.choices[part].scheme);
                                info.schemeReason = found.choices[part].reason.c_str();
                            });
    });
}

SuppleResult suppleGetClipInfo(SuppleContext handle, SuppleAsset asset, uint32_t clip, SuppleClipInfo* out) {
    return withAsset(handle, asset, "suppleGetClipInfo", [&](Context& context, const Asset& found) {
        const auto& clips = found.character.clips;
        return describePart(context, "suppleGetClipInfo", "clip", clip, clips.size(), out, [&](SuppleClipInfo& info) {
            info.name = clips[clip].name.c_str();
            info.duration = clips[clip].duration;
            info.byteCount = skinning::clipBytes(skinning::nodeOrder(found.character), clips[clip]);
            info.packedError = clips[clip].packed.words.empty() ? 0.0 : clips[clip].packed.error;
            if (!clips[clip].packed.coarseWords.empty()) {
                info.coarseError = clips[clip].packed.coarseError;
                info.segmentBytes = skinning::segmentWords(clips[clip].packed.words) * sizeof(uint32_t);
                info.residentBytes = found.stream != nullptr ? found.stream->bytesOf(clip).there : info.segmentBytes;
            }
        });
    });
}

SuppleResult suppleGetClipBounds(SuppleContext handle, SuppleAsset asset, uint32_t clip, SuppleBounds* out) {
    return withAsset(handle, asset, "suppleGetClipBounds", [&](Context& context, const Asset& found) {
        return clipBounds(context, "suppleGetClipBounds", found, clip, {}, out);
    });
}

SuppleResult suppleGetGroupClipBounds(SuppleContext handle, SuppleGroup group, uint32_t clip, SuppleBounds* out) {
    constexpr const char* kHere = "suppleGetGroupClipBounds";
    return withGroup(handle, group, kHere, [&](Context& context, const Group& found) {
        if (found.instances().source() == SUPPLE_POSES_CAGE_BUFFER) {
            return refuse(context, ErrorCode::argument, kHere, "the host deforms the cages of the group");
        }
        return clipBounds(
            context, kHere, found.asset(), clip,
            {found.asset().skinning(found.instances().skinning()), static_cast<double>(found.boundsMargin())}, out);
    });
}

SuppleResult suppleGetJointInfo(SuppleContext handle, SuppleAsset asset, uint32_t joint, SuppleJointInfo* out) {
    return withAsset(handle, asset, "suppleGetJointInfo", [&](Context& context, const Asset& found) {
        const auto& joints = found.character.skin.joints;
        return describePart(context, "suppleGetJointInfo", "joint", joint, joints.size(), out,
                            [&](SuppleJointInfo& info) {
                                info.name = found.character.skeleton.nodes[joints[joint]].name.c_str();
                                info.parent = found.rig.jointParents[joint];
                                const skinning::JointFrames& frames = found.jointFrames;
                                info.bindIsSingular = frames.bindIsSingular[joint];
                                std::memcpy(info.restTransform, &frames.rest[joint], sizeof(info.restTransform));
                                std::memcpy(info.bindTransform, &frames.bind[joint], sizeof(info.bindTransform));
                            });
    });
}

SuppleResult suppleGetCreaseSets(SuppleContext handle, SuppleAsset asset, const char** out, uint32_t* count) {
    constexpr const char* kHere = "suppleGetCreaseSets";
    return withAsset(handle, asset, kHere, [&](Context& context, const Asset& found) {
        if (count == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "count is null");
        }
        return tellNames(found.character.cage.creaseSets, out, *count);
    });
}

SuppleResult suppleGetClipSharpness(SuppleContext handle, SuppleAsset asset, uint32_t clip, uint32_t set, double time,
                                    float* out) {
    constexpr const char* kHere = "suppleGetClipSharpness";
    return withAsset(handle, asset, kHere, [&](Context& context, const Asset& found) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "out is null");
        }
        const cage::Character& character = found.character;
        const auto check = [&](const char* what, uint32_t index, size_t count) {
            return index < count ? std::nullopt
                                 : std::optional(refuse(context, ErrorCode::range, kHere,
                                                        character.name + ": " + what + " " + std::to_string(index) +
                                                            " of " + std::to_string(count)));
        };
        if (const auto fault = check("clip", clip, character.clips.size())) {
            return *fault;
        }
        if (const auto fault = check("crease set", set, character.cage.creaseSets.size())) {
            return *fault;
        }
        if (!std::isfinite(time)) {
            return refuse(context, ErrorCode::notFinite, kHere, "time is not finite");
        }
        *out = SUPPLE_FILE_SHARPNESS;
        for (const cage::SharpnessCurve& curve : character.clips[clip].sharpness) {
            if (curve.set == character.cage.creaseSets[set]) {
                *out = std::max(static_cast<float>(skinning::sampleSharpness(curve, time)), SUPPLE_LEAST_SHARPNESS);
            }
        }
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetMorphTargetInfo(SuppleContext handle, SuppleAsset asset, uint32_t target,
                                      SuppleMorphTargetInfo* out) {
    return withAsset(handle, asset, "suppleGetMorphTargetInfo", [&](Context& context, const Asset& found) {
        const cage::Morphs& morphs = found.character.morphs;
        return describePart(context, "suppleGetMorphTargetInfo", "morph target", target, morphs.targets.size(), out,
                            [&](SuppleMorphTargetInfo& info) {
                                info.name = morphs.targets[target].name.c_str();
                                info.weight = morphs.weights[target];
                                info.vertexCount = static_cast<uint32_t>(morphs.targets[target].vertices.size());
                            });
    });
}

SuppleResult suppleGetExpressionInfo(SuppleContext handle, SuppleAsset asset, uint32_t expression,
                                     SuppleExpressionInfo* out) {
    return withAsset(handle, asset, "suppleGetExpressionInfo", [&](Context& context, const Asset& found) {
        const auto& expressions = found.character.expressions;
        return describePart(context, "suppleGetExpressionInfo", "expression", expression, expressions.size(), out,
                            [&](SuppleExpressionInfo& info) {
                                const cage::Expression& from = expressions[expression];
                                info.name = from.name.c_str();
                                info.isBinary = from.isBinary ? 1 : 0;
                                info.targetCount = static_cast<uint32_t>(from.targets.size());
                                info.targets = from.targets.data();
                                info.weights = from.weights.data();
                            });
    });
}

SuppleResult suppleFillExpressionWeights(SuppleContext handle, SuppleAsset asset, const float* weights,
                                         uint32_t expressionCount, float* out, uint32_t morphTargetCount) {
    constexpr const char* kHere = "suppleFillExpressionWeights";
    return withAsset(handle, asset, kHere, [&](Context& context, const Asset& found) {
        const size_t expressions = found.character.expressions.size(), targets = found.character.morphs.targets.size();
        if ((weights == nullptr && expressions > 0) || (out == nullptr && targets > 0)) {
            return refuse(context, ErrorCode::nullPointer, kHere,
                          weights == nullptr && expressions > 0 ? "weights is null" : "out is null");
        }
        if (expressionCount != expressions || morphTargetCount != targets) {
            return refuse(context, ErrorCode::range, kHere,
                          "expressionCount " + std::to_string(expressionCount) + ", morphTargetCount " +
                              std::to_string(morphTargetCount) + ": the asset has " + std::to_string(expressions) +
                              " and " + std::to_string(targets));
        }
        if (std::any_of(weights, weights + expressionCount, [](float weight) { return std::isnan(weight); })) {
            return refuse(context, ErrorCode::notFinite, kHere, "a weight is not a number");
        }
        const std::vector<float> filled = cage::expressionWeights(found.character, {weights, expressionCount});
        std::copy(filled.begin(), filled.end(), out);
        return SUPPLE_OK;
    });
}

SuppleResult suppleGetMaterialInfo(SuppleContext handle, SuppleAsset asset, uint32_t material,
                                   SuppleMaterialInfo* out) {
    return withAsset(handle, asset, "suppleGetMaterialInfo", [&](Context& context, const Asset& found) {
        const auto& materials = found.character.materials;
        return describePart(context, "suppleGetMaterialInfo", "material", material, materials.size(), out,
                            [&](SuppleMaterialInfo& info) { tell(materials[material], info); });
    });
}

SuppleResult suppleGetMaterialLayers(SuppleContext handle, SuppleAsset asset, uint32_t material,
                                     SuppleMaterialLayers* out) {
    return withAsset(handle, asset, "suppleGetMaterialLayers", [&](Context& context, const Asset& found) {
        const auto& materials = found.character.materials;
        return describePart(context, "suppleGetMaterialLayers", "material", material, materials.size(), out,
                            [&](SuppleMaterialLayers& layers) { tell(materials[material].layers, layers); });
    });
}

SuppleResult suppleGetMaterialVariants(SuppleContext handle, SuppleAsset asset, const char** out, uint32_t* count) {
    constexpr const char* kHere = "suppleGetMaterialVariants";
    return withAsset(handle, asset, kHere, [&](Context& context, const Asset& found) {
        if (count == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "count is null");
        }
        return tellNames(found.character.materialVariants, out, *count);
    });
}

SuppleResult suppleGetImageInfo(SuppleContext handle, SuppleAsset asset, uint32_t image, SuppleImageInfo* out) {
    return withAsset(handle, asset, "suppleGetImageInfo", [&](Context& context, const Asset& found) {
        const auto& images = found.character.images;
        return describePart(context, "suppleGetImageInfo", "image", image, images.size(), out,
                            [&](SuppleImageInfo& info) {
                                const cage::Image& from = images[image];
                                info.name = from.name.c_str();
                                info.mimeType = from.mimeType.c_str();
                                info.bytes = from.bytes.empty() ? nullptr : from.bytes.data();
                                info.byteCount = from.bytes.size();
                            });
    });
}
