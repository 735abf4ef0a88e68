#include "tools/common/tuned_file.h"

#include "cage/soft.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace supple::host {

namespace {

using FileJson = nlohmann::ordered_json;

constexpr size_t kGlbHeader = 12, kGlbChunk = 8;

uint32_t glbWord(const std::vector<std::byte>& bytes, size_t at) {
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

bool isGlb(const std::vector<std::byte>& bytes) {
    return bytes.size() >= kGlbHeader + kGlbChunk && glbWord(bytes, 0) == 0x46546C67u &&
           glbWord(bytes, kGlbHeader) <= bytes.size() - kGlbHeader - kGlbChunk;
}

/// Multiplies a number that an object has, or would have by itself.
void multiply(FileJson& object, const char* key, double usual, double factor, double least, double most) {
    const auto found = object.find(key);
    const double value = found != object.end() && found->is_number() ? found->get<double>() : usual;
    object[key] = std::clamp(value * factor, least, most);
}

template <class Use>
void eachIn(FileJson& object, const char* key, const Use& use) {
    const auto list = object.find(key);
    if (list == object.end() || !list->is_array())
        return;
    for (FileJson& entry : *list) {
        if (entry.is_object())
            use(entry);
    }
}

FileJson* objectIn(FileJson& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    return found != object.end() && found->is_object() ? &*found : nullptr;
}

void tuneJoint(FileJson& joint, const char* stiffness, const Tuning& tuning) {
    constexpr double kMost = 1e9;
    const cage::SpringJoint usual;
    multiply(joint, stiffness, double{usual.stiffness}, double{tuning.stiffness}, 0.0, kMost);
    multiply(joint, "dragForce", double{usual.drag}, double{tuning.damping}, 0.0, 1.0);
    multiply(joint, "gravityPower", double{usual.gravityPower}, double{tuning.gravity}, -kMost, kMost);
}

void tuneSprings(FileJson& extensions, const Tuning& tuning) {
    if (FileJson* own = objectIn(extensions, "VRMC_springBone"); own != nullptr) {
        eachIn(*own, "springs", [&](FileJson& spring) {
            eachIn(spring, "joints", [&](FileJson& joint) { tuneJoint(joint, "stiffness", tuning); });
        });
    }
    FileJson* vrm = objectIn(extensions, "VRM");
    if (FileJson* old = vrm != nullptr ? objectIn(*vrm, "secondaryAnimation") : nullptr; old != nullptr)
        eachIn(*old, "boneGroups", [&](FileJson& group) { tuneJoint(group, "stiffiness", tuning); });
}

void tuneMesh(FileJson& deformers, const Tuning& tuning) {
    const cage::Jiggle jiggle;
    eachIn(deformers, "jiggle", [&](FileJson& entry) {
        multiply(entry, "frequency", double{jiggle.frequency}, std::sqrt(double{tuning.stiffness}),
                 double{cage::kMinJiggleFrequency}, double{cage::kMaxJiggleFrequency});
        multiply(entry, "damping", double{jiggle.damping}, double{tuning.damping}, 0.0,
                 double{cage::kMaxJiggleDamping});
    });
    const cage::Cloth cloth;
    eachIn(deformers, "cloth", [&](FileJson& entry) {
        const double softer = 1.0 / std::max(double{tuning.stiffness}, 1e-6), most{cage::kMaxClothCompliance};
        if (entry.contains("shear")) // else it follows stretch
            multiply(entry, "shear", double{cloth.shear}, softer, 0.0, most);
        multiply(entry, "stretch", double{cloth.stretch}, softer, 0.0, most);
        multiply(entry, "bend", double{cloth.bend}, softer, 0.0, most);
        multiply(entry, "drag", double{cloth.drag}, double{tuning.damping}, 0.0, 1.0);
        multiply(entry, "air", double{cloth.air}, double{tuning.damping}, 0.0, 1.0);
        multiply(entry, "gravity", double{cloth.gravity}, double{tuning.gravity}, 0.0, double{cage::kMaxClothGravity});
    });
}

std::vector<std::byte> withJson(const std::vector<std::byte>& glb, std::string json) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const size_t behind = kGlbHeader + kGlbChunk + glbWord(glb, kGlbHeader);
    std::vector<std::byte> made(glb.begin(), glb.begin() + kGlbHeader + kGlbChunk);
    const auto* text = reinterpret_cast<const std::byte*>(json.data());
    made.insert(made.end(), text, text + json.size());
    made.insert(made.end(), glb.begin() + static_cast<std::ptrdiff_t>(behind), glb.end());
    const auto put = [&](size_t at, size_t value) {
        const auto word = static_cast<uint32_t>(value);
        std::memcpy(made.data() + at, &word, sizeof word);
    };
    put(8, made.size());
    put(kGlbHeader, json.size());
    return made;
}

} // namespace

Result<CharacterFile> tunedFile(const CharacterFile& file, const Tuning& tuning) {
    const bool glb = isGlb(file.bytes);
    const auto* text = reinterpret_cast<const char*>(file.bytes.data()) + (glb ? kGlbHeader + kGlbChunk : 0);
    FileJson root =
        FileJson::parse(text, text + (glb ? glbWord(file.bytes, kGlbHeader) : file.bytes.size()), nullptr, false);
    if (!root.is_object())
        return Error{ErrorCode::argument, file.path + ": only the numbers of glTF files can be changed"};
    if (FileJson* extensions = objectIn(root, "extensions"); extensions != nullptr)
        tuneSprings(*extensions, tuning);
    eachIn(root, "meshes", [&](FileJson& mesh) {
        FileJson* extensions = objectIn(mesh, "extensions");
        if (FileJson* own = extensions != nullptr ? objectIn(*extensions, "SUPPLE_deformers") : nullptr; own != nullptr)
            tuneMesh(*own, tuning);
    });
    CharacterFile tuned = file;
    const std::string json = root.dump(-1, ' ', false, FileJson::error_handler_t::replace);
    if (glb) {
        tuned.bytes = withJson(file.bytes, json);
    } else {
        const auto* bytes = reinterpret_cast<const std::byte*>(json.data());
        tuned.bytes.assign(bytes, bytes + json.size());
    }
    return tuned;
}

} // namespace supple::host
