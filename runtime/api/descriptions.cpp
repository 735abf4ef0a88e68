#include "runtime/api/descriptions.h"

#include "cage/formats/reader.h"
#include "cage/message.h"
#include "cage/repair.h"
#include "runtime/api/entry.h"
#include "runtime/arrays/character_arrays.h"
#include "runtime/cooked/file.h"
#include "runtime/sized.h"
#include "runtime/vertex_streams.h"
#include "skinning/retarget.h"
#include "surface/schemes.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace supple::api {

namespace {

static_assert(std::has_unique_object_representations_v<SuppleAssetDesc>); // it can be compared byte by byte
constexpr uint32_t kGroupFlags = runtime::streamFlags(&runtime::StreamRow::groupFlag) | SUPPLE_GROUP_PATCHES |
                                 SUPPLE_GROUP_INDEXED_MESH | SUPPLE_GROUP_ONE_LEVEL | SUPPLE_GROUP_BOUNDS |
                                 SUPPLE_GROUP_WINDOWS | SUPPLE_GROUP_POSE_UNSEEN | SUPPLE_GROUP_MODIFIERS |
                                 SUPPLE_GROUP_TRANSITIONS | SUPPLE_GROUP_UPDATE_RATES | SUPPLE_GROUP_SPRINGS |
                                 SUPPLE_GROUP_SOFT | SUPPLE_GROUP_RAY_TRACING | SUPPLE_GROUP_DIRECT;
constexpr uint32_t kFlagsInViews = SUPPLE_GROUP_ONE_LEVEL | SUPPLE_GROUP_BOUNDS | SUPPLE_GROUP_POSE_UNSEEN |
                                   SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS | SUPPLE_GROUP_UPDATE_RATES |
                                   SUPPLE_GROUP_SPRINGS | SUPPLE_GROUP_SOFT;

Result<std::vector<std::byte>> readThrough(const SuppleFiles& files, const std::string& path) {
    SuppleFileBytes found{};
    if (files.read(path.c_str(), &found, files.user) == 0) {
        return Error{ErrorCode::io, "the host has no such file"};
    }
    // Given back even if there is no memory to copy it to.
    const auto release = [&files](SuppleFileBytes* bytes) {
        if (files.release != nullptr) {
            files.release(bytes, files.user);
        }
    };
    const std::unique_ptr<SuppleFileBytes, decltype(release)> held(&found, release);
    const auto* first = static_cast<const std::byte*>(found.bytes);
    return std::vector<std::byte>(first, first + (first != nullptr ? found.byteCount : 0));
}

cage::FileReader reader(const SuppleFiles* files) {
    if (files == nullptr) {
        return nullptr;
    }
    return [files = *files](const std::string& path) { return readThrough(files, path); };
}

std::string orEmpty(const char* text) {
    return text != nullptr ? text : "";
}

std::string nameOf(const SuppleAssetDesc& desc) {
    return desc.name != nullptr ? desc.name : "asset";
}

std::string nameOf(const SuppleClipFile& file, size_t index) {
    return file.name != nullptr ? file.name : "clip file " + std::to_string(index);
}

std::optional<Error> faultOfFlags(uint32_t flags) {
    constexpr uint32_t kPairing = SUPPLE_ASSET_PAIR_QUADS | SUPPLE_ASSET_KEEP_TRIANGLES;
    constexpr uint32_t kKnown = kPairing | SUPPLE_ASSET_STRICT | SUPPLE_ASSET_PARTS_APART |
                                SUPPLE_ASSET_CREASES_FROM_NORMALS | SUPPLE_ASSET_VERTICES_APART | SUPPLE_ASSET_SMOOTH;
    constexpr uint32_t kCreases = SUPPLE_ASSET_CREASES_FROM_NORMALS | SUPPLE_ASSET_SMOOTH;
    if ((flags & ~kKnown) != 0) {
        return Error{ErrorCode::range, "unknown flags"};
    }
    if ((flags & kPairing) == kPairing) {
        return Error{ErrorCode::argument, "both SUPPLE_ASSET_PAIR_QUADS and SUPPLE_ASSET_KEEP_TRIANGLES"};
    }
    if ((flags & kCreases) == kCreases) {
        return Error{ErrorCode::argument, "both SUPPLE_ASSET_CREASES_FROM_NORMALS and SUPPLE_ASSET_SMOOTH"};
    }
    return std::nullopt;
}

std::optional<Error> faultOfJointPairs(const SuppleAssetDesc& desc) {
    if (desc.jointPairCount > 0 && desc.jointPairs == nullptr) {
        return Error{ErrorCode::nullPointer, "jointPairs is null"};
    }
    if (desc.jointPairCount > 0 && runtime::rawValue(desc.retargeting) == SUPPLE_RETARGET_NEVER) {
        return Error{ErrorCode::argument, "both jointPairs and SUPPLE_RETARGET_NEVER"};
    }
    for (uint32_t i = 0; i < desc.jointPairCount; ++i) {
        const SuppleJointPair& pair = desc.jointPairs[i];
        const std::string name = "jointPairs[" + std::to_string(i) + "]: ";
        if (pair.role != nullptr && !skinning::roleNamed(pair.role)) {
            return Error{ErrorCode::argument, name + "no role is called " + cage::quoted(pair.role)};
        }
        const bool isWhole = pair.from != nullptr && pair.to != nullptr;
        if (!isWhole && (pair.role == nullptr || (pair.from == nullptr && pair.to == nullptr))) {
            return Error{ErrorCode::nullPointer, name + (pair.from == nullptr ? "from is null" : "to is null")};
        }
    }
    return std::nullopt;
}

/// Why the description's clip files cannot be read, if they cannot.
std::optional<Error> faultOfClipFiles(const SuppleAssetDesc& desc) {
    if (desc.clipFileCount > 0 && desc.clipFiles == nullptr) {
        return Error{ErrorCode::nullPointer, "clipFiles is null"};
    }
    if (desc.clipFileCount > 0 && desc.bytes == nullptr) {
        return Error{ErrorCode::argument, nameOf(desc) + ": both arrays and clipFiles"};
    }
    if (runtime::rawValue(desc.retargeting) > SUPPLE_RETARGET_FREE_FEET) {
        return Error{ErrorCode::range, "no such retargeting"};
    }
    if (std::optional<Error> fault = faultOfJointPairs(desc)) {
        return fault;
    }
    for (uint32_t i = 0; i < desc.clipFileCount; ++i) {
        const SuppleClipFile& file = desc.clipFiles[i];
        if (file.bytes == nullptr) {
            return Error{ErrorCode::nullPointer, nameOf(file, i) + ": bytes is null"};
        }
        if (file.files != nullptr && file.files->read == nullptr) {
            return Error{ErrorCode::nullPointer, nameOf(file, i) + ": files->read is null"};
        }
    }
    return std::nullopt;
}

/// A character of a struct of arrays, which messages call `what`.
template <class Desc, class... Options>
Result<cage::Character> readArrays(const char* function, const char* what, const Desc& given, const std::string& name,
                                   const Options&... options) {
    Desc desc{};
    if (!runtime::readSized(given, desc)) {
        return Error{ErrorCode::structSize, std::string(function) + ": " + faultOfSize<Desc>(what, given.structSize)};
    }
    return runtime::characterFromArrays(desc, name, options...);
}

/// Null if all are schemes of surfaces.
std::optional<Error> faultOfPartSchemes(const SuppleGroupDesc& desc) {
    if (desc.partSchemeCount > 0 && desc.partSchemes == nullptr) {
        return Error{ErrorCode::nullPointer, "partSchemes is null"};
    }
    if (desc.partSchemeCount > 0 && desc.scheme == SUPPLE_SCHEME_CAGE) {
        return Error{ErrorCode::argument, "a cage has no surfaces of parts"};
    }
    for (uint32_t part = 0; part < desc.partSchemeCount; ++part) {
        if (runtime::rawValue(desc.partSchemes[part]) > surface::schemes().size()) {
            return Error{ErrorCode::range, "partSchemes[" + std::to_string(part) + "]: no such scheme of a surface"};
        }
    }
    return std::nullopt;
}

/// Null if nothing is asked of surface vertices that the group does not store.
std::optional<Error> faultOfDirect(const SuppleGroupDesc& desc) {
    constexpr uint32_t kOfVertices =
        SUPPLE_GROUP_MOTION | SUPPLE_GROUP_TANGENTS | SUPPLE_GROUP_INDEXED_MESH | SUPPLE_GROUP_RAY_TRACING;
    if ((desc.flags & SUPPLE_GROUP_DIRECT) == 0) {
        return std::nullopt;
    }
    if (desc.scheme == SUPPLE_SCHEME_CAGE) {
        return Error{ErrorCode::argument, "SUPPLE_GROUP_DIRECT: a cage has no patches"};
    }
    if ((desc.flags & kOfVertices) != 0) {
        return Error{ErrorCode::argument, "SUPPLE_GROUP_DIRECT goes with neither MOTION, TANGENTS, INDEXED_MESH nor "
                                          "RAY_TRACING, which need stored vertices"};
    }
    return std::nullopt;
}

/// Null if the flags go with each other and with the rest.
std::optional<Error> faultOfFlags(const SuppleGroupDesc& desc) {
    const auto has = [&](uint32_t flag) { return (desc.flags & flag) != 0; };
    if (has(~kGroupFlags)) {
        return Error{ErrorCode::range, "unknown flags"};
    }
    if (desc.view.id != 0 && has(~kFlagsInViews)) {
        return Error{ErrorCode::argument,
                     "a group of a view takes the flags ONE_LEVEL, BOUNDS, POSE_UNSEEN, MODIFIERS, TRANSITIONS, "
                     "UPDATE_RATES, SPRINGS and SOFT alone: the view has the others"};
    }
    if (desc.view.id == 0 && has(SUPPLE_GROUP_ONE_LEVEL | SUPPLE_GROUP_POSE_UNSEEN)) {
        return Error{ErrorCode::argument, "SUPPLE_GROUP_ONE_LEVEL or SUPPLE_GROUP_POSE_UNSEEN without a view"};
    }
    if (has(SUPPLE_GROUP_INDEXED_MESH) && desc.scheme == SUPPLE_SCHEME_CAGE) {
        return Error{ErrorCode::argument, "a cage has no samples to share"};
    }
    if (has(SUPPLE_GROUP_MODIFIERS) && (desc.instancesOf.id != 0 || (desc.poseSource != SUPPLE_POSES_SET &&
                                                                     desc.poseSource != SUPPLE_POSES_PLAYBACK))) {
        return Error{ErrorCode::argument,
                     "SUPPLE_GROUP_MODIFIERS goes with instances of its own, and with SUPPLE_POSES_SET or _PLAYBACK"};
    }
    if (has(SUPPLE_GROUP_TRANSITIONS) && (desc.instancesOf.id != 0 || desc.poseSource != SUPPLE_POSES_PLAYBACK)) {
        return Error{ErrorCode::argument,
                     "SUPPLE_GROUP_TRANSITIONS goes with instances of its own, and with SUPPLE_POSES_PLAYBACK"};
    }
    if (has(SUPPLE_GROUP_UPDATE_RATES) && (desc.instancesOf.id != 0 || desc.poseSource != SUPPLE_POSES_PLAYBACK)) {
        return Error{ErrorCode::argument,
                     "SUPPLE_GROUP_UPDATE_RATES goes with instances of its own, and with SUPPLE_POSES_PLAYBACK"};
    }
    if (has(SUPPLE_GROUP_SPRINGS) && (desc.instancesOf.id != 0 || (desc.poseSource != SUPPLE_POSES_SET &&
                                                                   desc.poseSource != SUPPLE_POSES_PLAYBACK))) {
        return Error{ErrorCode::argument,
                     "SUPPLE_GROUP_SPRINGS goes with instances of its own, and with SUPPLE_POSES_SET or _PLAYBACK"};
    }
    if (has(SUPPLE_GROUP_SPRINGS) && has(SUPPLE_GROUP_UPDATE_RATES)) {
        return Error{ErrorCode::argument, "SUPPLE_GROUP_SPRINGS does not go with SUPPLE_GROUP_UPDATE_RATES: springs "
                                          "swing by poses of every step"};
    }
    if (has(SUPPLE_GROUP_SOFT) && (desc.instancesOf.id != 0 ||
                                   (desc.poseSource != SUPPLE_POSES_SET && desc.poseSource != SUPPLE_POSES_PLAYBACK))) {
        return Error{ErrorCode::argument,
                     "SUPPLE_GROUP_SOFT goes with instances of its own, and with SUPPLE_POSES_SET or _PLAYBACK"};
    }
    if (has(SUPPLE_GROUP_SOFT) && has(SUPPLE_GROUP_UPDATE_RATES)) {
        return Error{ErrorCode::argument, "SUPPLE_GROUP_SOFT does not go with SUPPLE_GROUP_UPDATE_RATES: vertices "
                                          "jiggle by poses of every step"};
    }
    if (has(SUPPLE_GROUP_TANGENTS) && !has(SUPPLE_GROUP_ATTRIBUTES)) {
        return Error{ErrorCode::argument, "TANGENTS go with ATTRIBUTES"};
    }
    if (has(SUPPLE_GROUP_TANGENTS) && desc.vertexFormat == SUPPLE_VERTEX_12) {
        return Error{ErrorCode::argument, "TANGENTS go with normals, which SUPPLE_VERTEX_12 has none of"};
    }
    if (has(SUPPLE_GROUP_RAY_TRACING) && desc.scheme == SUPPLE_SCHEME_CAGE) {
        return Error{ErrorCode::argument, "SUPPLE_GROUP_RAY_TRACING: a cage has no triangles of a surface"};
    }
    return faultOfDirect(desc);
}

/// Null if it says whose instances they are, and how many.
std::optional<Error> faultOfInstances(const SuppleGroupDesc& desc) {
    if (desc.instancesOf.id != 0 &&
        (desc.capacity != 0 || runtime::rawValue(desc.skinning) != 0 || runtime::rawValue(desc.poseSource) != 0)) {
        return Error{ErrorCode::argument, "capacity, skinning and poseSource are those of instancesOf: they must be 0"};
    }
    if (desc.capacity == 0 && desc.instancesOf.id == 0) {
        return Error{ErrorCode::range, "capacity is 0"};
    }
    return std::nullopt;
}

/// Null if all of them are values of their enumerations, or numbers in their range.
std::optional<Error> faultOfValues(const SuppleGroupDesc& desc) {
    if (desc.rate > SUPPLE_MAX_RATE) {
        return Error{ErrorCode::range, "rate must be 1..64"};
    }
    if (runtime::rawValue(desc.scheme) > surface::schemes().size() &&
        runtime::rawValue(desc.scheme) != SUPPLE_SCHEME_CAGE) {
        return Error{ErrorCode::range, "no such scheme"};
    }
    if (!within(desc.vertexFormat, SUPPLE_VERTEX_12) || !within(desc.skinning, SUPPLE_SKINNING_FROM_FILE) ||
        !within(desc.poseSource, SUPPLE_POSES_PLAYBACK)) {
        return Error{ErrorCode::range, "no such vertexFormat, skinning or poseSource"};
    }
    if (!within(desc.uvInterpolation, SUPPLE_UV_LINEAR_ALL)) {
        return Error{ErrorCode::range, "no such uvInterpolation"};
    }
    return std::nullopt;
}

} // namespace

std::optional<Error> takeAsset(const char* name, const SuppleAssetDesc* from, SuppleAssetDesc& out) {
    if (std::optional<Error> fault = takeIn(name, from, out)) {
        return fault;
    }
    if (out.prepared != nullptr) {
        SuppleAssetDesc alone{};
        alone.structSize = out.structSize;
        alone.prepared = out.prepared;
        alone.clipPoolBytes = out.clipPoolBytes;
        const bool isAlone = std::memcmp(&alone, &out, sizeof(out)) == 0;
        return isAlone ? std::nullopt
                       : std::optional(Error{ErrorCode::argument,
                                             "with `prepared`, all other members but clipPoolBytes must be 0"});
    }
    const int given =
        (out.bytes != nullptr ? 1 : 0) + (out.cage != nullptr ? 1 : 0) + (out.character != nullptr ? 1 : 0);
    if (given != 1) {
        return Error{ErrorCode::argument, nameOf(out) + (given == 0 ? ": neither bytes nor cage nor character"
                                                                    : ": more than one of bytes, cage and character")};
    }
    if (std::optional<Error> fault = faultOfFlags(out.flags)) {
        return fault;
    }
    if (out.files != nullptr && out.files->read == nullptr) {
        return Error{ErrorCode::nullPointer, "files->read is null"};
    }
    return faultOfClipFiles(out);
}

bool isCooked(const SuppleAssetDesc& desc) {
    return desc.bytes != nullptr && runtime::isCooked({static_cast<const std::byte*>(desc.bytes), desc.byteCount});
}

Result<std::shared_ptr<runtime::Prepared>> readCookedAsset(const SuppleAssetDesc& desc) {
    const std::string name = nameOf(desc);
    if ((desc.flags & ~uint32_t{SUPPLE_ASSET_STRICT}) != 0 || desc.scene != 0 || desc.clipFileCount != 0 ||
        !orEmpty(desc.materialVariant).empty()) {
        return Error{ErrorCode::argument,
                     name + ": it is cooked, and flags other than SUPPLE_ASSET_STRICT, a scene, a material variant and "
                            "clip files are for the file that it is cooked from"};
    }
    Result<std::shared_ptr<runtime::Prepared>> prepared =
        runtime::readCooked({static_cast<const std::byte*>(desc.bytes), desc.byteCount}, name);
    if (!prepared || (desc.flags & SUPPLE_ASSET_STRICT) == 0) {
        return prepared;
    }
    if (const Status sound = cage::refuseDamages((*prepared)->character); !sound) {
        return sound.error();
    }
    return prepared;
}

static_assert(static_cast<int>(SUPPLE_RETARGET_NEVER) == static_cast<int>(skinning::Retargeting::never) &&
              static_cast<int>(SUPPLE_RETARGET_FREE_FEET) == static_cast<int>(skinning::Retargeting::freeFeet));
skinning::RetargetOptions retargetOptions(const SuppleAssetDesc& desc) {
    skinning::RetargetOptions options;
    options.retargeting = static_cast<skinning::Retargeting>(desc.retargeting);
    options.strict = (desc.flags & SUPPLE_ASSET_STRICT) != 0;
    for (uint32_t i = 0; i < desc.jointPairCount; ++i) {
        const SuppleJointPair& pair = desc.jointPairs[i];
        options.pairs.push_back({pair.role != nullptr ? skinning::roleNamed(pair.role) : std::nullopt,
                                 orEmpty(pair.from), orEmpty(pair.to)});
    }
    return options;
}

Result<cage::Character> readAsset(const char* function, const SuppleAssetDesc& desc) {
    const std::string name = nameOf(desc);
    const auto has = [&](uint32_t flag) { return (desc.flags & flag) != 0; };
    const cage::NormalCreases creases = has(SUPPLE_ASSET_CREASES_FROM_NORMALS) ? cage::NormalCreases::all
                                        : has(SUPPLE_ASSET_SMOOTH)             ? cage::NormalCreases::never
                                                                               : cage::NormalCreases::wherePartly;
    const cage::FinishOptions finish{!has(SUPPLE_ASSET_PARTS_APART), creases, has(SUPPLE_ASSET_STRICT)};
    if ((desc.cage != nullptr || desc.character != nullptr) && !orEmpty(desc.materialVariant).empty()) {
        return Error{ErrorCode::argument, name + ": arrays have no material variants"};
    }
    if (desc.cage != nullptr) {
        return readArrays(function, "desc.cage", *desc.cage, name, finish);
    }
    const cage::Pairing pairing = has(SUPPLE_ASSET_PAIR_QUADS)       ? cage::Pairing::always
                                  : has(SUPPLE_ASSET_KEEP_TRIANGLES) ? cage::Pairing::never
                                                                     : cage::Pairing::whereClean;
    if (desc.character != nullptr) {
        return readArrays(function, "desc.character", *desc.character, name, finish, pairing);
    }
    cage::GltfOptions options;
    options.pairing = pairing;
    options.strict = finish.strict;
    options.normalCreases = finish.normalCreases;
    options.sewParts = finish.sewParts;
    options.weldObj = !has(SUPPLE_ASSET_VERTICES_APART);
    if (desc.scene != 0) {
        options.scene = desc.scene - 1;
    }
    options.variant = orEmpty(desc.materialVariant);
    options.memoryLimit = desc.memoryLimit;
    options.readFile = reader(desc.files);
    for (uint32_t i = 0; i < desc.clipFileCount; ++i) {
        const SuppleClipFile& file = desc.clipFiles[i];
        options.clipFiles.push_back({nameOf(file, i),
                                     {static_cast<const std::byte*>(file.bytes), file.byteCount},
                                     orEmpty(file.baseDirectory),
                                     reader(file.files)});
    }
    options.fitClips = [retarget = retargetOptions(desc)](cage::ClipSet& set, const cage::Skeleton& skeleton) {
        skinning::fitClips(retarget, skeleton, set);
    };
    return cage::readCharacter({static_cast<const std::byte*>(desc.bytes), desc.byteCount}, name,
                               orEmpty(desc.baseDirectory), options);
}

std::optional<Error> GivenGroup::take(const SuppleGroupDesc* given) {
    if (std::optional<Error> fault = takeIn("desc", given, desc)) {
        return fault;
    }
    return check();
}

std::optional<Error> GivenGroup::takePlanned(const SuppleGroupDesc* given, bool inView) {
    if (std::optional<Error> fault = takeIn("desc", given, desc)) {
        return fault;
    }
    desc.asset = {};
    desc.instancesOf = {};
    desc.capacity = 1;
    desc.view.id = inView ? 1 : 0;
    return check();
}

std::optional<Error> GivenGroup::takeOptions() {
    if (desc.prep != nullptr) {
        if (std::optional<Error> fault = takeIn("prep", desc.prep, prep)) {
            return fault;
        }
        desc.prep = &prep;
    }
    if (desc.blend != nullptr) {
        if (std::optional<Error> fault = takeIn("blend", desc.blend, blend)) {
            return fault;
        }
        desc.blend = &blend;
    }
    if (desc.fragments != nullptr) {
        if (std::optional<Error> fault = takeIn("fragments", desc.fragments, fragments)) {
            return fault;
        }
        desc.fragments = &fragments;
    }
    if (!within(prep.tangentMode, SUPPLE_TANGENTS_PRINTED) || !within(prep.cornerRule, SUPPLE_CORNERS_SMOOTH) ||
        !within(blend.creaseMode, SUPPLE_CREASES_CURVE) || !within(fragments.rules, SUPPLE_RULES_LOOP)) {
        return Error{ErrorCode::range, "no such tangentMode, cornerRule, creaseMode or rules"};
    }
    if (std::isnan(blend.sharpThreshold)) {
        return Error{ErrorCode::notFinite, "sharpThreshold is NaN"};
    }
    if (blend.sharpThreshold < 0.0f) {
        return Error{ErrorCode::range, "sharpThreshold is negative"};
    }
    return std::nullopt;
}

std::optional<Error> GivenGroup::check() {
    std::optional<Error> fault = faultOfInstances(desc);
    fault = fault ? fault : faultOfValues(desc);
    fault = fault ? fault : faultOfFlags(desc);
    fault = fault ? fault : takeOptions();
    if (fault) {
        return fault;
    }
    if (desc.poseSource == SUPPLE_POSES_PALETTE_BUFFER && desc.skinning != SUPPLE_SKINNING_LINEAR) {
        return Error{ErrorCode::argument, "a palette buffer goes with linear skinning only"};
    }
    if (std::optional<Error> ofParts = faultOfPartSchemes(desc)) {
        return ofParts;
    }
    if (desc.view.id != 0 && desc.scheme == SUPPLE_SCHEME_CAGE) {
        return Error{ErrorCode::argument, "a cage has no levels of detail"};
    }
    return std::nullopt;
}

} // namespace supple::api
