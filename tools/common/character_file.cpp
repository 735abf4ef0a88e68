#include "tools/common/character_file.h"

#include "base/utf8_path.h"
#include "cage/formats/reader.h"
#include "cage/repair.h"
#include "runtime/cooked/file.h"
#include "skinning/retarget.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace supple::host {
namespace {

Result<std::vector<std::byte>> readFile(const std::string& path) {
    std::error_code error;
    if (std::filesystem::is_directory(utf8Path(path), error)) {
        return Error{ErrorCode::io, path + ": is a folder"};
    }
    std::ifstream stream(utf8Path(path), std::ios::binary);
    if (!stream) {
        return Error{ErrorCode::io, path + ": cannot be opened"};
    }
    std::vector<std::byte> bytes;
    char block[1 << 16];
    while (stream.read(block, sizeof block), stream.gcount() > 0) {
        const auto* first = reinterpret_cast<const std::byte*>(block);
        bytes.insert(bytes.end(), first, first + stream.gcount());
    }
    if (stream.bad()) {
        return Error{ErrorCode::io, path + ": cannot be read"};
    }
    return bytes;
}

Result<FileInMemory> load(const std::string& path) {
    Result<std::vector<std::byte>> bytes = readFile(path);
    if (!bytes) {
        return bytes.error();
    }
    const std::filesystem::path parent = utf8Path(path).parent_path();
    return FileInMemory{path, parent.empty() ? "." : utf8Text(parent), std::move(*bytes)};
}

/// The character of a cooked file.
Result<CharacterFile> readCookedFile(FileInMemory file, const ReadOptions& flags) {
    if (flags.pairQuads || flags.keepTriangles || flags.creasesFromNormals || flags.smooth || flags.partsApart ||
        flags.verticesApart || flags.scene || !flags.variant.empty() || !flags.clipFiles.empty()) {
        return Error{ErrorCode::argument,
                     file.path + ": it is cooked: its polygons, parts, scene, variant and clips were chosen then"};
    }
    // Its tables are read with the asset.
    Result<cage::Character> character = runtime::readCookedCharacter(file.bytes, file.path);
    if (!character) {
        return character.error();
    }
    if (const Status sound = cage::refuseDamages(*character); flags.strict && !sound) {
        return sound.error();
    }
    return CharacterFile{std::move(file), {}, {}, flags, std::move(*character)};
}

Result<std::vector<JointPairSetting>> readRetargetMap(const std::string& path) {
    if (path.empty()) {
        return std::vector<JointPairSetting>{};
    }
    const Result<std::vector<std::byte>> bytes = readFile(path);
    if (!bytes) {
        return bytes.error();
    }
    return parseRetargetMap({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path);
}

skinning::RetargetOptions retargetOptions(const ReadOptions& flags, const std::vector<JointPairSetting>& pairs) {
    skinning::RetargetOptions options{
        static_cast<skinning::Retargeting>(retargetingOf(flags.retargeting)), {}, flags.strict};
    for (const JointPairSetting& pair : pairs) {
        options.pairs.push_back({skinning::roleNamed(pair.role), pair.from, pair.to});
    }
    return options;
}

uint64_t memoryLimit(const ReadOptions& flags) {
    return uint64_t{flags.memoryLimit} << 20;
}

} // namespace

SuppleRetargeting retargetingOf(const std::string& name) {
    const auto found = std::find(std::begin(kRetargetings), std::end(kRetargetings), name);
    return static_cast<SuppleRetargeting>(found - std::begin(kRetargetings));
}

Result<CharacterFile> readCharacterFile(const std::string& path, const ReadOptions& flags) {
    Result<FileInMemory> file = load(path);
    if (!file) {
        return file.error();
    }
    cage::GltfOptions options{.scene = flags.scene,
                              .variant = flags.variant,
                              .sewParts = !flags.partsApart,
                              .weldObj = !flags.verticesApart,
                              .pairing = flags.pairQuads       ? cage::Pairing::always
                                         : flags.keepTriangles ? cage::Pairing::never
                                                               : cage::Pairing::whereClean,
                              .normalCreases = flags.creasesFromNormals ? cage::NormalCreases::all
                                               : flags.smooth           ? cage::NormalCreases::never
                                                                        : cage::NormalCreases::wherePartly,
                              .strict = flags.strict,
                              .memoryLimit = memoryLimit(flags)};
    std::vector<FileInMemory> clipFiles;
    for (const std::string& clipPath : flags.clipFiles) {
        Result<FileInMemory> clips = load(clipPath);
        if (!clips) {
            return clips.error();
        }
        clipFiles.push_back(std::move(*clips));
        options.clipFiles.push_back({clipPath, clipFiles.back().bytes, clipFiles.back().directory, nullptr});
    }
    Result<std::vector<JointPairSetting>> pairs = readRetargetMap(flags.retargetMap);
    if (!pairs) {
        return pairs.error();
    }
    options.fitClips = [retarget = retargetOptions(flags, *pairs)](cage::ClipSet& set, const cage::Skeleton& skeleton) {
        skinning::fitClips(retarget, skeleton, set);
    };
    if (runtime::isCooked(file->bytes)) {
        return readCookedFile(std::move(*file), flags);
    }
    Result<cage::Character> character = cage::readCharacter(file->bytes, path, file->directory, options);
    if (!character) {
        return character.error();
    }
    return CharacterFile{std::move(*file), std::move(clipFiles), std::move(*pairs), flags, std::move(*character)};
}

AssetDescription::AssetDescription(const CharacterFile& file) {
    desc_.structSize = sizeof desc_;
    const auto flag = [&](bool wanted, SuppleAssetFlags value) { desc_.flags |= wanted ? uint32_t{value} : 0u; };
    flag(file.flags.pairQuads, SUPPLE_ASSET_PAIR_QUADS);
    flag(file.flags.keepTriangles, SUPPLE_ASSET_KEEP_TRIANGLES);
    flag(file.flags.creasesFromNormals, SUPPLE_ASSET_CREASES_FROM_NORMALS);
    flag(file.flags.smooth, SUPPLE_ASSET_SMOOTH);
    flag(file.flags.strict, SUPPLE_ASSET_STRICT);
    flag(file.flags.partsApart, SUPPLE_ASSET_PARTS_APART);
    flag(file.flags.verticesApart, SUPPLE_ASSET_VERTICES_APART);
    desc_.memoryLimit = memoryLimit(file.flags);
    desc_.scene = file.flags.scene ? *file.flags.scene + 1 : 0;
    desc_.name = file.path.c_str();
    desc_.materialVariant = file.bytes.empty() ? nullptr : file.flags.variant.c_str();
    if (file.bytes.empty()) {
        cage_ = std::make_unique<const CageArrays>(file.character.cage);
        desc_.cage = &cage_->desc;
        return;
    }
    desc_.bytes = file.bytes.data();
    desc_.byteCount = file.bytes.size();
    desc_.baseDirectory = file.directory.c_str();
    for (const FileInMemory& clips : file.clipFiles) {
        clipFiles_.push_back(
            {clips.path.c_str(), clips.bytes.data(), clips.bytes.size(), clips.directory.c_str(), nullptr});
    }
    desc_.clipFiles = clipFiles_.data();
    desc_.clipFileCount = static_cast<uint32_t>(clipFiles_.size());
    jointPairs_ = jointPairsOf(file.jointPairs);
    desc_.retargeting = retargetingOf(file.flags.retargeting);
    desc_.jointPairs = jointPairs_.data();
    desc_.jointPairCount = static_cast<uint32_t>(jointPairs_.size());
}

Result<SuppleAsset> createAsset(Context& context, const CharacterFile& file) {
    const AssetDescription description(file);
    SuppleAsset asset{};
    Status status =
        context.check(suppleCreateAsset(context.handle(), &description.desc(), &asset), "suppleCreateAsset");
    if (!status) {
        return status.error();
    }
    return asset;
}

Result<uint32_t> findClip(const cage::Character& character, const std::string& nameOrIndex) {
    std::vector<std::string> names;
    for (const cage::Clip& clip : character.clips) {
        names.push_back(clip.name);
    }
    return findClip(character.name, names, nameOrIndex);
}

Result<uint32_t> findClip(const std::string& owner, const std::vector<std::string>& clips,
                          const std::string& nameOrIndex) {
    if (nameOrIndex.empty()) {
        return SUPPLE_BIND_POSE;
    }
    return findNamed(owner, "clip", clips, nameOrIndex);
}

Result<uint32_t> findNamed(const std::string& owner, const char* what, const std::vector<std::string>& names,
                           const std::string& nameOrIndex) {
    std::string all;
    for (uint32_t i = 0; i < names.size(); ++i) {
        if (names[i] == nameOrIndex) {
            return i;
        }
        all += (i == 0 ? "" : ", ") + std::to_string(i) + " " + names[i];
    }
    uint32_t index = 0;
    const char* const last = nameOrIndex.data() + nameOrIndex.size();
    const auto [end, error] = std::from_chars(nameOrIndex.data(), last, index);
    if (error == std::errc() && end == last && index < names.size()) {
        return index;
    }
    return Error{ErrorCode::argument,
                 owner + ": no " + what + " \"" + nameOrIndex + "\"; it has " + (all.empty() ? "none" : all)};
}

} // namespace supple::host
