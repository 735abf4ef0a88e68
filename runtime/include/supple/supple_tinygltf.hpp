// supple_tinygltf.hpp - a SuppleCharacterDesc of a parsed tinygltf::Model, for hosts that read glTF with tinygltf
// already. Header only, C++17; not part of the library, which needs no tinygltf. Include <tiny_gltf.h> before it, with
// the macros that you build tinygltf with. No exceptions.
//
//     tinygltf::TinyGLTF loader;
//     loader.SetImageLoader(supple::keepTinygltfImage, nullptr);  // images stay encoded
//     loader.LoadBinaryFromFile(&model, &errors, &warnings, "hero.glb");
//     supple::TinygltfCharacter character;
//     if (character.read(model)) { assetDesc.character = &character.desc(); ... }
//     for (const std::string& line : character.messages()) ...
//
// Carried over: the choice of the scene, nodes, skins, meshes with all their primitives (strips and fans too), morph
// targets, sparse accessors, KHR_mesh_quantization, clips and markers, materials with their textures, transforms,
// samplers, trims and layers (clearcoat and the like), encoded images, names, copyright, SUPPLE_mesh_cage,
// FB_ngon_encoding, _CAGE_VERTEX, extras.creases and extras.corners. Welding and pairing happen in Supple, so the
// character is the one that suppleCreateAsset makes of the file.
//
// Not carried over, each with a message: EXT_mesh_polygon, EXT_mesh_primitive_edge_visibility and EXT_mesh_manifold
// (their meshes are welded and paired as plain ones), primitive restart, images that tinygltf has decoded. Of
// KHR_materials_variants nothing is read: primitives have the material that the model gives them. A file is
// refused if tinygltf cannot decompress it: EXT_meshopt_compression, and KHR_draco_mesh_compression without
// TINYGLTF_ENABLE_DRACO.
#pragma once

#include <supple/supple.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace supple {

/// For tinygltf::TinyGLTF::SetImageLoader: keeps the bytes of an image as the file has them.
inline bool keepTinygltfImage(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                              const unsigned char* bytes, int size, void*) {
    image->as_is = true;
    image->image.assign(bytes, bytes + size);
    return true;
}

/// Owns what a SuppleCharacterDesc points to, but for names and images: these it points to in the model.
class TinygltfCharacter {
public:
    TinygltfCharacter() = default;
    TinygltfCharacter(const TinygltfCharacter&) = delete;
    TinygltfCharacter& operator=(const TinygltfCharacter&) = delete;

    /// Reads a model; call it once. The model must stay as it is until desc() has been handed over. `scene`: which
    /// scene is taken; -1: the one that the file names, else the first. False: something cannot be read, see
    /// messages(). What is wrong with the character itself Supple says when it is handed over.
    [[nodiscard]] bool read(const tinygltf::Model& model, int scene = -1) {
        model_ = &model;
        refuseCompression();
        readNodes();
        readImages();
        readMaterials();
        readParts(scene);
        readClips();
        nameWhatIsLeftOut();
        desc_ = sized<SuppleCharacterDesc>();
        desc_.nodeCount = countOf(nodes_);
        desc_.nodes = nodes_.data();
        desc_.partCount = countOf(parts_);
        desc_.parts = parts_.data();
        desc_.clipCount = countOf(clips_);
        desc_.clips = clips_.data();
        desc_.materialCount = countOf(materials_);
        desc_.materials = materials_.data();
        desc_.materialLayers = layers_.empty() ? nullptr : layers_.data();
        desc_.imageCount = countOf(images_);
        desc_.images = images_.data();
        desc_.copyright = model.asset.copyright.c_str();
        return sound_;
    }
    /// Valid as long as this object and the model.
    [[nodiscard]] const SuppleCharacterDesc& desc() const { return desc_; }
    /// What is not carried over, and what cannot be read: "mesh 0 primitive 1: ...".
    [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

private:
    using Value = tinygltf::Value;
    using Floats = std::vector<float>;
    using Integers = std::vector<uint32_t>;

    template <class List>
    static uint32_t countOf(const List& list) {
        return static_cast<uint32_t>(list.size());
    }
    static std::string at(const char* what, std::size_t index) { return what + (" " + std::to_string(index)); }

    void warn(const std::string& element, const std::string& reason) { messages_.push_back(element + ": " + reason); }
    void fail(const std::string& element, const std::string& reason) {
        warn(element, reason);
        sound_ = false;
    }
    /// What moves by itself has no place in a description.
    void nameWhatIsLeftOut() {
        for (const char* extension : {"SUPPLE_deformers", "VRMC_springBone"}) {
            const std::vector<std::string>& used = model_->extensionsUsed;
            if (std::find(used.begin(), used.end(), extension) != used.end()) {
                warn(extension, "it is left out; SuppleAssetDesc.bytes takes the file with it");
            }
        }
        const auto vrm = model_->extensions.find("VRM");
        if (vrm != model_->extensions.end() && vrm->second.Has("secondaryAnimation")) {
            warn("VRM", "its secondaryAnimation is left out; SuppleAssetDesc.bytes takes the file with it");
        }
    }
    /// Lists whose addresses are handed over. Moving a list keeps its address.
    const float* keep(Floats values) {
        return values.empty() ? nullptr : floats_.emplace_back(std::move(values)).data();
    }
    const uint32_t* keep(Integers values) {
        return values.empty() ? nullptr : integers_.emplace_back(std::move(values)).data();
    }
    const SuppleCreaseScalar* keep(std::vector<SuppleCreaseScalar> values) {
        return values.empty() ? nullptr : scalars_.emplace_back(std::move(values)).data();
    }
    const char* const* keep(std::vector<const char*> values) {
        return values.empty() ? nullptr : names_.emplace_back(std::move(values)).data();
    }

    // ---- accessors

    /// The bytes of an accessor's elements, packed; empty if something is wrong with it.
    bool bytesOf(int index, int components, std::vector<unsigned char>& out, const std::string& element) {
        if (index < 0 || static_cast<std::size_t>(index) >= model_->accessors.size()) {
            fail(element, "accessor " + std::to_string(index) + " of " + std::to_string(model_->accessors.size()));
            return false;
        }
        const tinygltf::Accessor& accessor = model_->accessors[static_cast<std::size_t>(index)];
        const int componentSize = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType));
        if (tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)) != components ||
            componentSize <= 0) {
            fail(element, at("accessor", static_cast<std::size_t>(index)) + " is of another type");
            return false;
        }
        const auto size = static_cast<std::size_t>(components) * static_cast<std::size_t>(componentSize);
        if (accessor.count > (std::size_t{1} << 31) / size) {
            fail(element, std::to_string(accessor.count) + " elements are too many");
            return false;
        }
        out.assign(accessor.count * size, 0);
        if (accessor.bufferView >= 0 && accessor.count > 0 &&
            !copyView(accessor.bufferView, accessor.byteOffset, accessor.count, size, false, out.data(), element)) {
            return false;
        }
        return !accessor.sparse.isSparse || substitute(accessor, size, out, element);
    }

    bool copyView(int index, std::size_t offset, std::size_t count, std::size_t size, bool packed, unsigned char* to,
                  const std::string& element) {
        if (index < 0 || static_cast<std::size_t>(index) >= model_->bufferViews.size()) {
            fail(element, "bufferView " + std::to_string(index) + " of " + std::to_string(model_->bufferViews.size()));
            return false;
        }
        const tinygltf::BufferView& view = model_->bufferViews[static_cast<std::size_t>(index)];
        const std::size_t stride = packed || view.byteStride == 0 ? size : view.byteStride;
        const bool known = view.buffer >= 0 && static_cast<std::size_t>(view.buffer) < model_->buffers.size();
        const std::size_t bytes = known ? model_->buffers[static_cast<std::size_t>(view.buffer)].data.size() : 0;
        if (!known || view.byteOffset > bytes || view.byteLength > bytes - view.byteOffset ||
            offset > view.byteLength || view.byteLength - offset < size || stride < size ||
            count - 1 > (view.byteLength - offset - size) / stride) {
            fail(element, std::to_string(count) + " elements are out of range of bufferView " + std::to_string(index));
            return false;
        }
        const unsigned char* from =
            model_->buffers[static_cast<std::size_t>(view.buffer)].data.data() + view.byteOffset + offset;
        for (std::size_t i = 0; i < count; ++i) {
            std::memcpy(to + i * size, from + i * stride, size);
        }
        return true;
    }

    bool substitute(const tinygltf::Accessor& accessor, std::size_t size, std::vector<unsigned char>& out,
                    const std::string& element) {
        const auto& sparse = accessor.sparse;
        const auto count = static_cast<std::size_t>(std::max(sparse.count, 0));
        const int indexSize = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(sparse.indices.componentType));
        if (count > accessor.count || indexSize <= 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
            fail(element, "its sparse part is malformed");
            return false;
        }
        std::vector<unsigned char> indices(count * static_cast<std::size_t>(indexSize)), values(count * size);
        if (count == 0 ||
            !copyView(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
                      static_cast<std::size_t>(indexSize), true, indices.data(), element) ||
            !copyView(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count, size, true,
                      values.data(), element)) {
            return count == 0;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const uint32_t target = integerAt(indices.data(), i, indexSize);
            if (target >= accessor.count) {
                fail(element, "its sparse indices are out of range");
                return false;
            }
            std::memcpy(out.data() + target * size, values.data() + i * size, size);
        }
        return true;
    }

    static uint32_t integerAt(const unsigned char* bytes, std::size_t index, int size) {
        uint32_t value = 0; // little-endian, as every machine that this runs on
        std::memcpy(&value, bytes + index * static_cast<std::size_t>(size), static_cast<std::size_t>(size));
        return value;
    }

    Floats floatsOf(int index, int components, const std::string& element) {
        std::vector<unsigned char> bytes;
        Floats values;
        if (!bytesOf(index, components, bytes, element)) {
            return values;
        }
        const tinygltf::Accessor& accessor = model_->accessors[static_cast<std::size_t>(index)];
        values.resize(accessor.count * static_cast<std::size_t>(components));
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = floatAt(bytes.data(), i, accessor);
        }
        return values;
    }

    template <class T>
    static T load(const unsigned char* bytes, std::size_t index) {
        T value;
        std::memcpy(&value, bytes + index * sizeof(T), sizeof(T));
        return value;
    }

    static float floatAt(const unsigned char* bytes, std::size_t i, const tinygltf::Accessor& accessor) {
        float value = 0.0f;
        float largest = 1.0f;
        switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            value = load<int8_t>(bytes, i);
            largest = 127.0f;
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            value = load<uint8_t>(bytes, i);
            largest = 255.0f;
            break;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            value = load<int16_t>(bytes, i);
            largest = 32767.0f;
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            value = load<uint16_t>(bytes, i);
            largest = 65535.0f;
            break;
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return load<float>(bytes, i);
        default:
            return static_cast<float>(load<uint32_t>(bytes, i));
        }
        return accessor.normalized ? std::max(value / largest, -1.0f) : value;
    }

    Integers integersOf(int index, int components, const std::string& element) {
        std::vector<unsigned char> bytes;
        Integers values;
        if (!bytesOf(index, components, bytes, element)) {
            return values;
        }
        const tinygltf::Accessor& accessor = model_->accessors[static_cast<std::size_t>(index)];
        const int size = tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(accessor.componentType));
        if (size > 4) {
            fail(element, "no integers");
            return values;
        }
        values.resize(accessor.count * static_cast<std::size_t>(components));
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ? numberOf(load<float>(bytes.data(), i))
                                                                                : integerAt(bytes.data(), i, size);
        }
        return values;
    }
    /// Exporters that have no integers write floats. What is no number of anything becomes 0xFFFFFFFF.
    static uint32_t numberOf(float value) {
        return value >= 0.0f && value <= 16777216.0f ? static_cast<uint32_t>(value) : 0xFFFFFFFFu;
    }

    // ---- JSON

    static const Value* member(const Value& object, const char* key) {
        return object.IsObject() && object.Has(key) ? &object.Get(key) : nullptr;
    }
    static const Value* extensionOf(const tinygltf::ExtensionMap& extensions, const char* name) {
        const auto found = extensions.find(name);
        return found != extensions.end() ? &found->second : nullptr;
    }
    static int indexIn(const Value& object, const char* key) {
        const Value* value = member(object, key);
        return value != nullptr && value->IsNumber() ? value->GetNumberAsInt() : -1;
    }
    static std::string textIn(const Value& object, const char* key) {
        const Value* value = member(object, key);
        return value != nullptr && value->IsString() ? value->Get<std::string>() : std::string();
    }
    static float numberIn(const Value& object, const char* key, float fallback) {
        const Value* value = member(object, key);
        return value != nullptr && value->IsNumber() ? static_cast<float>(value->GetNumberAsDouble()) : fallback;
    }

    // ---- nodes, images, materials

    void refuseCompression() {
        for (const std::string& name : model_->extensionsRequired) {
            if (name == "EXT_meshopt_compression") {
                fail("file", name + ": tinygltf does not decompress it");
            }
#ifndef TINYGLTF_ENABLE_DRACO
            if (name == "KHR_draco_mesh_compression") {
                fail("file", name + ": tinygltf is built without TINYGLTF_ENABLE_DRACO");
            }
#endif
        }
    }

    const float* keepNumbers(const std::vector<double>& numbers) {
        return keep(Floats(numbers.begin(), numbers.end()));
    }

    void readNodes() {
        for (const tinygltf::Node& from : model_->nodes) {
            SuppleNodeDesc node = sized<SuppleNodeDesc>();
            node.parent = SUPPLE_NO_NODE;
            node.name = from.name.c_str();
            if (!from.matrix.empty()) {
                node.matrix = keepNumbers(from.matrix);
            } else {
                node.translation = keepNumbers(from.translation);
                node.rotation = keepNumbers(unitRotation(from.rotation));
                node.scale = keepNumbers(from.scale);
            }
            nodes_.push_back(node);
        }
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            for (const int child : model_->nodes[n].children) {
                if (child < 0 || static_cast<std::size_t>(child) >= nodes_.size() ||
                    nodes_[static_cast<std::size_t>(child)].parent != SUPPLE_NO_NODE) {
                    fail(at("node", n), "child " + std::to_string(child) + " is no node, or has two parents");
                } else {
                    nodes_[static_cast<std::size_t>(child)].parent = static_cast<uint32_t>(n);
                }
            }
        }
    }
    /// Before it is rounded to floats.
    static std::vector<double> unitRotation(std::vector<double> q) {
        if (q.size() == 4) {
            const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
            for (double& number : q) {
                number *= length > 1e-6 && std::abs(length - 1.0) > 1e-5 ? 1.0 / length : 1.0;
            }
        }
        return q;
    }

    void readImages() {
        for (std::size_t i = 0; i < model_->images.size(); ++i) {
            const tinygltf::Image& from = model_->images[i];
            SuppleImageInfo image = sized<SuppleImageInfo>();
            const bool named = !from.name.empty() || from.uri.compare(0, 5, "data:") == 0;
            image.name = named ? from.name.c_str() : from.uri.c_str();
            image.mimeType = from.mimeType.c_str();
            if (from.as_is) {
                image.bytes = from.image.data();
                image.byteCount = from.image.size();
            } else if (!from.image.empty()) {
                warn(at("image", i), "decoded by tinygltf, so it is left out; load with keepTinygltfImage");
            }
            images_.push_back(image);
        }
    }

    static SuppleWrap wrapOf(int wrap) {
        return wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? SUPPLE_WRAP_CLAMP
               : wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? SUPPLE_WRAP_MIRROR
                                                               : SUPPLE_WRAP_REPEAT;
    }
    static SuppleFilter filterOf(int filter) {
        if (filter == TINYGLTF_TEXTURE_FILTER_NEAREST || filter == TINYGLTF_TEXTURE_FILTER_LINEAR) {
            return filter == TINYGLTF_TEXTURE_FILTER_NEAREST ? SUPPLE_FILTER_NEAREST : SUPPLE_FILTER_LINEAR;
        }
        const int mip = filter - TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST;
        return mip >= 0 && mip < 4 ? static_cast<SuppleFilter>(SUPPLE_FILTER_NEAREST_MIPMAP_NEAREST + mip)
                                   : SUPPLE_FILTER_ANY;
    }

    SuppleTextureInfo textureOf(int index, int texCoord, const Value* transform, const std::string& element) {
        SuppleTextureInfo info = defaultMaterial().baseColor;
        if (index < 0) {
            return info;
        }
        if (static_cast<std::size_t>(index) >= model_->textures.size()) {
            fail(element, "texture " + std::to_string(index) + " of " + std::to_string(model_->textures.size()));
            return info;
        }
        const tinygltf::Texture& from = model_->textures[static_cast<std::size_t>(index)];
        info.image = from.source < 0 ? SUPPLE_NO_IMAGE : static_cast<uint32_t>(from.source);
        const auto other = [&](const char* name) {
            const Value* extension = extensionOf(from.extensions, name);
            return extension == nullptr ? SUPPLE_NO_IMAGE : static_cast<uint32_t>(indexIn(*extension, "source"));
        };
        const uint32_t basis = other("KHR_texture_basisu"), webp = other("EXT_texture_webp");
        if (info.image == SUPPLE_NO_IMAGE && basis != SUPPLE_NO_IMAGE) {
            info.image = webp;
        }
        info.alternateImage = basis != SUPPLE_NO_IMAGE ? basis : webp;
        if (from.sampler >= 0 && static_cast<std::size_t>(from.sampler) < model_->samplers.size()) {
            const tinygltf::Sampler& sampler = model_->samplers[static_cast<std::size_t>(from.sampler)];
            info.wrap[0] = wrapOf(sampler.wrapS);
            info.wrap[1] = wrapOf(sampler.wrapT);
            info.magFilter = filterOf(sampler.magFilter);
            info.minFilter = filterOf(sampler.minFilter);
        }
        if (transform != nullptr) {
            readTransform(*transform, info);
            texCoord = member(*transform, "texCoord") != nullptr ? indexIn(*transform, "texCoord") : texCoord;
        }
        if (texCoord > 1) {
            warn(element,
                 "texCoord " + std::to_string(texCoord) + ": only TEXCOORD_0 and TEXCOORD_1 are read; left out");
            return defaultMaterial().baseColor;
        }
        info.uvSet = static_cast<uint32_t>(texCoord);
        return info;
    }
    template <class Info>
    SuppleTextureInfo textureOf(const Info& info, const std::string& element) {
        return textureOf(info.index, info.texCoord, extensionOf(info.extensions, "KHR_texture_transform"), element);
    }
    static void readTransform(const Value& transform, SuppleTextureInfo& info) {
        const auto pair = [&](const char* key, float(&to)[2]) {
            const Value* values = member(transform, key);
            for (int k = 0; values != nullptr && values->ArrayLen() == 2 && k < 2; ++k) {
                to[k] = static_cast<float>(values->Get(k).GetNumberAsDouble());
            }
        };
        pair("offset", info.offset);
        pair("scale", info.scale);
        info.rotation = numberIn(transform, "rotation", 0.0f);
    }

    void readMaterials() {
        for (std::size_t m = 0; m < model_->materials.size(); ++m) {
            const tinygltf::Material& from = model_->materials[m];
            const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
            const std::string element = at("material", m);
            SuppleMaterialInfo material = defaultMaterial();
            material.name = from.name.c_str();
            material.alphaMode = from.alphaMode == "MASK"    ? SUPPLE_ALPHA_MASK
                                 : from.alphaMode == "BLEND" ? SUPPLE_ALPHA_BLEND
                                                             : SUPPLE_ALPHA_OPAQUE;
            material.alphaCutoff = static_cast<float>(from.alphaCutoff);
            material.doubleSided = from.doubleSided ? 1 : 0;
            material.unlit = extensionOf(from.extensions, "KHR_materials_unlit") != nullptr ? 1 : 0;
            for (std::size_t c = 0; c < std::min<std::size_t>(pbr.baseColorFactor.size(), 4); ++c) {
                material.baseColorFactor[c] = static_cast<float>(pbr.baseColorFactor[c]);
            }
            for (std::size_t c = 0; c < std::min<std::size_t>(from.emissiveFactor.size(), 3); ++c) {
                material.emissiveFactor[c] = static_cast<float>(from.emissiveFactor[c]);
            }
            material.metallicFactor = static_cast<float>(pbr.metallicFactor);
            material.roughnessFactor = static_cast<float>(pbr.roughnessFactor);
            material.normalScale = static_cast<float>(from.normalTexture.scale);
            material.occlusionStrength = static_cast<float>(from.occlusionTexture.strength);
            if (const Value* strength = extensionOf(from.extensions, "KHR_materials_emissive_strength")) {
                material.emissiveStrength = numberIn(*strength, "emissiveStrength", 1.0f);
            }
            material.baseColor = textureOf(pbr.baseColorTexture, element + " baseColorTexture");
            material.metallicRoughness = textureOf(pbr.metallicRoughnessTexture, element + " metallicRoughnessTexture");
            material.normal = textureOf(from.normalTexture, element + " normalTexture");
            material.occlusion = textureOf(from.occlusionTexture, element + " occlusionTexture");
            material.emissive = textureOf(from.emissiveTexture, element + " emissiveTexture");
            if (const Value* trim = member(from.extras, "trim")) {
                readTrim(*trim, element + " extras.trim", material);
            }
            materials_.push_back(material);
            layers_.push_back(layersOf(from, element));
        }
    }

    static void readNumbers(const Value* extension, std::initializer_list<std::pair<const char*, float*>> all) {
        for (const auto& [name, number] : all) {
            *number = extension == nullptr ? *number : numberIn(*extension, name, *number);
        }
    }

    static void readColor(const Value* extension, const char* name, float (&to)[3]) {
        const Value* list = extension == nullptr ? nullptr : member(*extension, name);
        for (int c = 0; list != nullptr && list->ArrayLen() == 3 && c < 3; ++c) {
            to[c] = static_cast<float>(list->Get(c).GetNumberAsDouble());
        }
    }

    void readTextures(const Value* extension, const std::string& element,
                      std::initializer_list<std::pair<const char*, SuppleTextureInfo*>> all) {
        for (const auto& [name, texture] : all) {
            const Value* info = extension == nullptr ? nullptr : member(*extension, name);
            if (info != nullptr && info->IsObject()) {
                const Value* extensions = member(*info, "extensions");
                *texture = textureOf(indexIn(*info, "index"), std::max(indexIn(*info, "texCoord"), 0),
                                     extensions == nullptr ? nullptr : member(*extensions, "KHR_texture_transform"),
                                     element + " " + name);
            }
        }
    }

    /// What the extensions of a material say.
    SuppleMaterialLayers layersOf(const tinygltf::Material& from, const std::string& element) {
        SuppleMaterialLayers layers = defaultMaterialLayers();
        const auto in = [&](const char* name) { return extensionOf(from.extensions, name); };
        readNumbers(in("KHR_materials_clearcoat"), {{"clearcoatFactor", &layers.clearcoatFactor},
                                                    {"clearcoatRoughnessFactor", &layers.clearcoatRoughnessFactor}});
        readTextures(in("KHR_materials_clearcoat"), element,
                     {{"clearcoatTexture", &layers.clearcoat},
                      {"clearcoatRoughnessTexture", &layers.clearcoatRoughness},
                      {"clearcoatNormalTexture", &layers.clearcoatNormal}});
        if (const Value* coat = in("KHR_materials_clearcoat")) {
            const Value* normal = member(*coat, "clearcoatNormalTexture");
            layers.clearcoatNormalScale = normal == nullptr ? 1.0f : numberIn(*normal, "scale", 1.0f);
        }
        readNumbers(in("KHR_materials_sheen"), {{"sheenRoughnessFactor", &layers.sheenRoughnessFactor}});
        readColor(in("KHR_materials_sheen"), "sheenColorFactor", layers.sheenColorFactor);
        readTextures(in("KHR_materials_sheen"), element,
                     {{"sheenColorTexture", &layers.sheenColor}, {"sheenRoughnessTexture", &layers.sheenRoughness}});
        readNumbers(in("KHR_materials_transmission"), {{"transmissionFactor", &layers.transmissionFactor}});
        readTextures(in("KHR_materials_transmission"), element, {{"transmissionTexture", &layers.transmission}});
        readNumbers(in("KHR_materials_ior"), {{"ior", &layers.ior}});
        readNumbers(in("KHR_materials_specular"), {{"specularFactor", &layers.specularFactor}});
        readColor(in("KHR_materials_specular"), "specularColorFactor", layers.specularColorFactor);
        readTextures(in("KHR_materials_specular"), element,
                     {{"specularTexture", &layers.specular}, {"specularColorTexture", &layers.specularColor}});
        readNumbers(in("KHR_materials_iridescence"),
                    {{"iridescenceFactor", &layers.iridescenceFactor},
                     {"iridescenceIor", &layers.iridescenceIor},
                     {"iridescenceThicknessMinimum", &layers.iridescenceThicknessMinimum},
                     {"iridescenceThicknessMaximum", &layers.iridescenceThicknessMaximum}});
        readTextures(in("KHR_materials_iridescence"), element,
                     {{"iridescenceTexture", &layers.iridescence},
                      {"iridescenceThicknessTexture", &layers.iridescenceThickness}});
        readNumbers(in("KHR_materials_anisotropy"), {{"anisotropyStrength", &layers.anisotropyStrength},
                                                     {"anisotropyRotation", &layers.anisotropyRotation}});
        readTextures(in("KHR_materials_anisotropy"), element, {{"anisotropyTexture", &layers.anisotropy}});
        readNumbers(in("KHR_materials_diffuse_transmission"),
                    {{"diffuseTransmissionFactor", &layers.diffuseTransmissionFactor}});
        readColor(in("KHR_materials_diffuse_transmission"), "diffuseTransmissionColorFactor",
                  layers.diffuseTransmissionColorFactor);
        readTextures(in("KHR_materials_diffuse_transmission"), element,
                     {{"diffuseTransmissionTexture", &layers.diffuseTransmission},
                      {"diffuseTransmissionColorTexture", &layers.diffuseTransmissionColor}});
        readNumbers(in("KHR_materials_volume"), {{"thicknessFactor", &layers.thicknessFactor},
                                                 {"attenuationDistance", &layers.attenuationDistance}});
        readColor(in("KHR_materials_volume"), "attenuationColor", layers.attenuationColor);
        readTextures(in("KHR_materials_volume"), element, {{"thicknessTexture", &layers.thickness}});
        return layers;
    }

    void readTrim(const Value& trim, const std::string& element, SuppleMaterialInfo& material) {
        const Value* texture = member(trim, "texture");
        if (texture == nullptr || !texture->IsObject()) {
            fail(element, "no texture");
            return;
        }
        const bool ofFaces = textIn(trim, "domain") == "face";
        const std::string channel = textIn(trim, "channel");
        const std::size_t place = std::string("rgba").find(channel.empty() ? "r" : channel);
        material.trimDomain = ofFaces ? SUPPLE_TRIM_FACE : SUPPLE_TRIM_UV;
        material.trimChannel = place > 3 || channel.size() > 1 ? 4 : static_cast<uint32_t>(place); // 4 is refused
        material.trimCutoff = numberIn(trim, "cutoff", 0.5f);
        const Value* extensions = member(*texture, "extensions");
        const Value* transform = extensions != nullptr ? member(*extensions, "KHR_texture_transform") : nullptr;
        material.trim = textureOf(indexIn(*texture, "index"), std::max(indexIn(*texture, "texCoord"), 0), transform,
                                  element + " texture");
        if (ofFaces) {
            const int tiles = indexIn(trim, "tiles");
            material.trimTiles = tiles > 0 ? static_cast<uint32_t>(tiles) : squareTiles(material.trim.image);
            if (material.trimTiles == 0) {
                fail(element, "neither tiles nor a PNG that is a strip of square tiles");
            }
        }
    }
    /// As many as a PNG is wide, in heights; 0: it does not say.
    [[nodiscard]] uint32_t squareTiles(uint32_t image) const {
        if (image >= images_.size() || images_[image].byteCount < 24) {
            return 0;
        }
        const auto* header = static_cast<const unsigned char*>(images_[image].bytes);
        const auto number = [&](int at) {
            return uint32_t{header[at]} << 24 | uint32_t{header[at + 1]} << 16 | uint32_t{header[at + 2]} << 8 |
                   uint32_t{header[at + 3]};
        };
        const bool isPng = std::memcmp(header, "\x89PNG", 4) == 0;
        const uint32_t width = isPng ? number(16) : 0, height = isPng ? number(20) : 0;
        return height > 0 && width % height == 0 ? width / height : 0;
    }

    // ---- parts

    /// The nodes with meshes of the scene, by number.
    std::vector<std::size_t> meshNodes(int scene) {
        std::vector<std::size_t> all;
        for (std::size_t n = 0; n < model_->nodes.size(); ++n) {
            const int mesh = model_->nodes[n].mesh;
            if (mesh >= 0 && static_cast<std::size_t>(mesh) < model_->meshes.size()) {
                all.push_back(n);
            }
        }
        if (scene >= 0 && static_cast<std::size_t>(scene) >= model_->scenes.size()) {
            fail("scene " + std::to_string(scene), "the file has " + std::to_string(model_->scenes.size()));
            return {};
        }
        if (model_->scenes.empty()) {
            return all;
        }
        const int chosen = scene >= 0 ? scene : std::max(model_->defaultScene, 0);
        const std::size_t index = std::min(static_cast<std::size_t>(chosen), model_->scenes.size() - 1);
        std::vector<char> reached(model_->nodes.size(), 0);
        std::vector<int> stack = model_->scenes[index].nodes;
        while (!stack.empty()) {
            const int node = stack.back();
            stack.pop_back();
            if (node < 0 || static_cast<std::size_t>(node) >= reached.size() ||
                reached[static_cast<std::size_t>(node)]) {
                continue;
            }
            reached[static_cast<std::size_t>(node)] = 1;
            const std::vector<int>& children = model_->nodes[static_cast<std::size_t>(node)].children;
            stack.insert(stack.end(), children.begin(), children.end());
        }
        std::vector<std::size_t> nodes;
        std::copy_if(all.begin(), all.end(), std::back_inserter(nodes), [&](std::size_t n) { return reached[n] != 0; });
        if (nodes.empty() && scene < 0) {
            warn(at("scene", index), "no mesh; all nodes of the file with meshes are read");
            return all;
        }
        if (nodes.size() < all.size()) {
            warn(at("scene", index),
                 std::to_string(all.size() - nodes.size()) + " nodes with meshes are not in it; left out");
        }
        return nodes;
    }

    static bool hasTriangles(const tinygltf::Primitive& primitive) {
        return primitive.mode == -1 ||
               (primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN);
    }

    void readParts(int scene) {
        for (const std::size_t n : meshNodes(scene)) {
            const tinygltf::Node& node = model_->nodes[n];
            const tinygltf::Mesh& mesh = model_->meshes[static_cast<std::size_t>(node.mesh)];
            mesh_ = at("mesh", static_cast<std::size_t>(node.mesh));
            std::vector<const tinygltf::Primitive*> taken;
            for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
                if (hasTriangles(mesh.primitives[p])) {
                    taken.push_back(&mesh.primitives[p]);
                } else {
                    warn(mesh_ + " " + at("primitive", p), "no triangles; left out");
                }
            }
            if (taken.empty()) {
                warn(mesh_, "no primitive of triangles; left out");
                continue;
            }
            SupplePartDesc part = sized<SupplePartDesc>();
            part.node = static_cast<uint32_t>(n);
            part.name = (node.name.empty() ? mesh.name : node.name).c_str();
            part.skin = skinOf(node);
            readTargets(node, mesh, taken[0]->targets.size(), part);
            readPrimitives(mesh, taken, part);
            parts_.push_back(part);
        }
    }

    const SuppleSkinDesc* skinOf(const tinygltf::Node& node) {
        if (node.skin < 0 || static_cast<std::size_t>(node.skin) >= model_->skins.size()) {
            return nullptr;
        }
        const tinygltf::Skin& from = model_->skins[static_cast<std::size_t>(node.skin)];
        SuppleSkinDesc skin = sized<SuppleSkinDesc>();
        skin.jointCount = countOf(from.joints);
        skin.joints = keep(Integers(from.joints.begin(), from.joints.end()));
        if (from.inverseBindMatrices >= 0) {
            const std::string element = at("skin", static_cast<std::size_t>(node.skin)) + " inverseBindMatrices";
            Floats matrices = floatsOf(from.inverseBindMatrices, 16, element);
            if (matrices.size() < 16 * from.joints.size()) {
                fail(element, "fewer matrices than joints");
            } else {
                skin.inverseBinds = keep(std::move(matrices));
            }
        }
        return &skins_.emplace_back(skin);
    }

    void readTargets(const tinygltf::Node& node, const tinygltf::Mesh& mesh, std::size_t count, SupplePartDesc& part) {
        const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
        if (!weights.empty() && weights.size() != count) {
            (count > 0 ? fail(mesh_ + " weights",
                              std::to_string(weights.size()) + " for " + std::to_string(count) + " morph targets")
                       : warn(mesh_ + " weights", "there are no morph targets; ignored"));
        }
        const Value* names = member(mesh.extras, "targetNames");
        std::vector<SuppleMorphTargetDesc>& targets = targets_.emplace_back();
        for (std::size_t t = 0; t < count; ++t) {
            SuppleMorphTargetDesc target = sized<SuppleMorphTargetDesc>();
            target.weight = t < weights.size() ? static_cast<float>(weights[t]) : 0.0f;
            if (names != nullptr && t < names->ArrayLen() && names->Get(static_cast<int>(t)).IsString()) {
                target.name = names->Get(static_cast<int>(t)).Get<std::string>().c_str();
            }
            targets.push_back(target);
        }
        part.targetCount = countOf(targets);
        part.targets = targets.data();
    }

    /// Accessors of position, cage numbers, joints, weights and morph targets: what makes a vertex.
    using Stream = std::tuple<int, int, std::vector<int>, std::vector<int>, std::vector<int>>;

    static int attributeOf(const tinygltf::Primitive& primitive, const std::string& name) {
        const auto found = primitive.attributes.find(name);
        return found != primitive.attributes.end() ? found->second : -1;
    }

    /// The accessors that number the vertices of the cage: all primitives' or none.
    std::vector<int> cageNumbers(const std::vector<const tinygltf::Primitive*>& taken) {
        std::vector<int> ofExtension, ofAttribute;
        for (const tinygltf::Primitive* primitive : taken) {
            const Value* cage = extensionOf(primitive->extensions, "SUPPLE_mesh_cage");
            ofExtension.push_back(cage != nullptr ? indexIn(*cage, "cageVertices") : -1);
            ofAttribute.push_back(attributeOf(*primitive, "_CAGE_VERTEX"));
        }
        const auto missing = [](const std::vector<int>& list) { return std::count(list.begin(), list.end(), -1); };
        const auto count = static_cast<std::ptrdiff_t>(taken.size());
        numbersOfExtension_ = missing(ofExtension) == 0;
        if (missing(ofExtension) == 0) {
            return ofExtension;
        }
        if (missing(ofExtension) < count) {
            fail(mesh_, "cageVertices of SUPPLE_mesh_cage is not on all primitives");
        }
        if (missing(ofAttribute) > 0 && missing(ofAttribute) < count) {
            warn(mesh_, "_CAGE_VERTEX is not on all primitives; not used");
        }
        return missing(ofAttribute) == 0 ? ofAttribute : std::vector<int>(taken.size(), -1);
    }

    void readPrimitives(const tinygltf::Mesh& mesh, const std::vector<const tinygltf::Primitive*>& taken,
                        SupplePartDesc& part) {
        warnOfExtensions(mesh, taken);
        const std::vector<int> numbers = cageNumbers(taken);
        std::map<Stream, uint32_t> streams;
        std::vector<SupplePrimitiveDesc>& primitives = primitives_.emplace_back();
        for (std::size_t p = 0; p < taken.size(); ++p) {
            const tinygltf::Primitive& from = *taken[p];
            const std::string element = mesh_ + " " + at("primitive", p);
            SupplePrimitiveDesc to = sized<SupplePrimitiveDesc>();
            const int position = attributeOf(from, "POSITION");
            if (position < 0 || static_cast<std::size_t>(position) >= model_->accessors.size()) {
                fail(element, "no POSITION");
                continue;
            }
            Floats positions = floatsOf(position, 3, element + " POSITION");
            if (positions.empty()) {
                fail(element, "no vertices");
                continue;
            }
            to.vertexCount = static_cast<uint32_t>(positions.size() / 3);
            Stream stream{position, numbers[p], setsOf(from, "JOINTS_"), setsOf(from, "WEIGHTS_"), targetsOf(from)};
            const auto [known, isNew] = streams.emplace(stream, countOf(primitives) + 1);
            to.sharedVertices = isNew ? 0 : known->second;
            if (isNew) {
                to.positions = keep(std::move(positions));
                readVertices(stream, part, element, to);
            }
            to.material = from.material < 0 ? SUPPLE_NO_MATERIAL : static_cast<uint32_t>(from.material);
            Integers triangles = trianglesOf(from, to.vertexCount, element);
            to.triangleCount = static_cast<uint32_t>(triangles.size() / 3);
            to.triangles = keep(std::move(triangles));
            readAttributes(from, to, element);
            readPolygons(from, to, part, element);
            primitives.push_back(to);
        }
        readExtrasCreases(mesh, primitives);
        part.primitiveCount = countOf(primitives);
        part.primitives = primitives.data();
    }

    void warnOfExtensions(const tinygltf::Mesh& mesh, const std::vector<const tinygltf::Primitive*>& taken) {
        if (extensionOf(mesh.extensions, "EXT_mesh_manifold") != nullptr) {
            warn(mesh_, "EXT_mesh_manifold is not carried over; welded by equality");
        }
        for (const char* name : {"EXT_mesh_polygon", "EXT_mesh_primitive_edge_visibility"}) {
            const bool any = std::any_of(taken.begin(), taken.end(), [&](const tinygltf::Primitive* primitive) {
                return extensionOf(primitive->extensions, name) != nullptr;
            });
            if (any) {
                warn(mesh_, std::string(name) + " is not carried over; its triangles are");
            }
        }
    }

    static std::vector<int> setsOf(const tinygltf::Primitive& primitive, const std::string& prefix) {
        std::vector<int> sets;
        for (int n = 0; attributeOf(primitive, prefix + std::to_string(n)) >= 0; ++n) {
            sets.push_back(attributeOf(primitive, prefix + std::to_string(n)));
        }
        return sets;
    }
    static std::vector<int> targetsOf(const tinygltf::Primitive& primitive) {
        std::vector<int> targets;
        for (const auto& target : primitive.targets) {
            const auto position = target.find("POSITION");
            targets.push_back(position != target.end() ? position->second : -1);
        }
        return targets;
    }

    void readVertices(const Stream& stream, const SupplePartDesc& part, const std::string& element,
                      SupplePrimitiveDesc& to) {
        const auto& [position, number, joints, weights, targets] = stream;
        (void)position;
        if (number >= 0) {
            to.cageVertices = keepFor(to.vertexCount, integersOf(number, 1, element + " cage vertices"), 1, element);
        }
        if (part.skin != nullptr) {
            readInfluences(joints, weights, element, to);
        }
        if (targets.size() != part.targetCount) {
            fail(element,
                 std::to_string(targets.size()) + " morph targets, others have " + std::to_string(part.targetCount));
            return;
        }
        std::vector<SuppleDisplacements>& displacements = displacements_.emplace_back(targets.size());
        for (std::size_t t = 0; t < targets.size(); ++t) {
            if (targets[t] >= 0) {
                displacements[t].deltas =
                    keepFor(to.vertexCount, floatsOf(targets[t], 3, element + " " + at("target", t)), 3,
                            element + " " + at("target", t));
            }
        }
        to.displacements = displacements.data();
    }

    /// An attribute must have as many elements as there are vertices.
    template <class List>
    auto keepFor(uint32_t vertexCount, List values, std::size_t width, const std::string& element)
        -> decltype(keep(std::move(values))) {
        if (values.size() != width * vertexCount) {
            fail(element,
                 std::to_string(values.size() / width) + " elements for " + std::to_string(vertexCount) + " vertices");
            return nullptr;
        }
        return keep(std::move(values));
    }

    void readInfluences(const std::vector<int>& joints, const std::vector<int>& weights, const std::string& element,
                        SupplePrimitiveDesc& to) {
        if (joints.empty() || joints.size() != weights.size()) {
            fail(element, "its node has a skin, but there are not as many JOINTS_n as WEIGHTS_n");
            return;
        }
        const std::size_t sets = joints.size(), count = to.vertexCount;
        Integers allJoints(4 * sets * count);
        Floats allWeights(4 * sets * count);
        for (std::size_t n = 0; n < sets; ++n) {
            const Integers ownJoints = integersOf(joints[n], 4, element + " JOINTS");
            const Floats ownWeights = floatsOf(weights[n], 4, element + " WEIGHTS");
            if (ownJoints.size() != 4 * count || ownWeights.size() != 4 * count) {
                fail(element, "not as many joints or weights as vertices");
                return;
            }
            for (std::size_t v = 0; v < count; ++v) {
                std::copy_n(&ownJoints[4 * v], 4, &allJoints[4 * (v * sets + n)]);
                std::copy_n(&ownWeights[4 * v], 4, &allWeights[4 * (v * sets + n)]);
            }
        }
        to.influences.perVertex = static_cast<uint32_t>(4 * sets);
        to.influences.joints = keep(std::move(allJoints));
        to.influences.weights = keep(std::move(allWeights));
    }

    Integers trianglesOf(const tinygltf::Primitive& primitive, uint32_t vertexCount, const std::string& element) {
        Integers indices;
        if (primitive.indices >= 0) {
            indices = integersOf(primitive.indices, 1, element + " indices");
        } else {
            for (uint32_t v = 0; v < vertexCount; ++v) {
                indices.push_back(v);
            }
        }
        const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        if (!strip && primitive.mode != TINYGLTF_MODE_TRIANGLE_FAN) {
            if (indices.size() % 3 != 0) {
                fail(element + " indices", std::to_string(indices.size()) + ", not a multiple of 3");
            }
            return indices;
        }
        Integers triangles;
        for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
            const uint32_t a = strip ? indices[i] : indices[i + 1], b = strip ? indices[i + 1 + i % 2] : indices[i + 2],
                           c = strip ? indices[i + 2 - i % 2] : indices[0];
            if (!strip || (a != b && b != c && c != a)) {
                triangles.insert(triangles.end(), {a, b, c});
            }
        }
        return triangles;
    }

    /// What is not finite becomes 0: it spoils a texture, not the shape.
    const float* attribute(const tinygltf::Primitive& from, const char* name, int width, uint32_t vertexCount,
                           const std::string& element) {
        const int accessor = attributeOf(from, name);
        if (accessor < 0) {
            return nullptr;
        }
        Floats values = floatsOf(accessor, width, element + " " + name);
        std::size_t repaired = 0;
        for (float& value : values) {
            repaired += std::isfinite(value) ? 0 : 1;
            value = std::isfinite(value) ? value : 0.0f;
        }
        if (repaired > 0) {
            warn(element + " " + name, std::to_string(repaired) + " values are not finite; 0 instead");
        }
        return keepFor(vertexCount, std::move(values), static_cast<std::size_t>(width), element + " " + name);
    }

    void readAttributes(const tinygltf::Primitive& from, SupplePrimitiveDesc& to, const std::string& element) {
        const uint32_t count = to.vertexCount;
        to.uvs = attribute(from, "TEXCOORD_0", 2, count, element);
        to.uvs1 = attribute(from, "TEXCOORD_1", 2, count, element);
        to.normals = attribute(from, "NORMAL", 3, count, element);
        to.tangents = to.normals != nullptr ? attribute(from, "TANGENT", 4, count, element) : nullptr;
        const int color = attributeOf(from, "COLOR_0");
        if (color >= 0 && static_cast<std::size_t>(color) < model_->accessors.size() &&
            model_->accessors[static_cast<std::size_t>(color)].type == TINYGLTF_TYPE_VEC3) {
            const float* rgb = attribute(from, "COLOR_0", 3, count, element);
            Floats colors(rgb != nullptr ? std::size_t{4} * count : 0, 1.0f);
            for (std::size_t i = 0; i < colors.size() / 4 * 3; ++i) {
                colors[i / 3 * 4 + i % 3] = rgb[i];
            }
            to.colors = keep(std::move(colors));
        } else {
            to.colors = attribute(from, "COLOR_0", 4, count, element);
        }
        const bool trimmed = to.material < materials_.size() && materials_[to.material].trimDomain == SUPPLE_TRIM_FACE;
        if (trimmed && attributeOf(from, "_TRIM_TILE") < 0) {
            fail(element, "no _TRIM_TILE, which names the tiles of its material's trim");
        } else if (trimmed) {
            Integers tiles;
            for (const float tile : floatsOf(attributeOf(from, "_TRIM_TILE"), 1, element + " _TRIM_TILE")) {
                tiles.push_back(tile == -1.0f ? SUPPLE_NO_TRIM_TILE : std::min(numberOf(tile), 0xFFFFFFFEu));
            }
            to.trimTiles = keepFor(count, std::move(tiles), 1, element + " _TRIM_TILE");
        }
    }

    // ---- polygons and creases

    void readPolygons(const tinygltf::Primitive& from, SupplePrimitiveDesc& to, SupplePartDesc& part,
                      const std::string& element) {
        const Value* cage = extensionOf(from.extensions, "SUPPLE_mesh_cage");
        if (cage != nullptr) {
            readCageExtension(*cage, to, part, element + " SUPPLE_mesh_cage");
        }
        const bool runs = from.mode == TINYGLTF_MODE_TRIANGLE_STRIP || from.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        if (to.polygons == SUPPLE_POLYGONS_UNKNOWN && !runs &&
            extensionOf(from.extensions, "FB_ngon_encoding") != nullptr) {
            to.polygons = SUPPLE_POLYGONS_FANS;
        }
    }

    void readCageExtension(const Value& cage, SupplePrimitiveDesc& to, SupplePartDesc& part,
                           const std::string& element) {
        const auto integers = [&](const char* key, uint32_t& count, std::size_t width) -> const uint32_t* {
            Integers values = integersOf(indexIn(cage, key), 1, element + " " + key);
            count = static_cast<uint32_t>(values.size() / width);
            return keep(std::move(values));
        };
        const auto sharpnesses = [&](const char* key, uint32_t count) -> const float* {
            return keepFor(count, floatsOf(indexIn(cage, key), 1, element + " " + key), 1, element + " " + key);
        };
        if (member(cage, "faceVertexCounts") != nullptr) {
            uint32_t corners = 0, wanted = 0;
            to.polygons = SUPPLE_POLYGONS_LISTED;
            to.faceVertexCounts = integers("faceVertexCounts", to.faceCount, 1);
            to.faceVertexIndices = integers("faceVertexIndices", corners, 1);
            for (uint32_t f = 0; f < to.faceCount; ++f) {
                wanted += to.faceVertexCounts[f];
            }
            if (wanted != corners) {
                fail(element, std::to_string(corners) + " faceVertexIndices for faces of " + std::to_string(wanted) +
                                  " corners");
                to.faceCount = 0;
            }
        }
        if (member(cage, "holeIndices") != nullptr) {
            to.holes = integers("holeIndices", to.holeCount, 1);
        }
        if (member(cage, "creaseIndices") != nullptr) {
            to.creaseVertices = integers("creaseIndices", to.creaseCount, 2);
            to.creaseSharpnesses = sharpnesses("creaseSharpnesses", to.creaseCount);
        }
        if (member(cage, "cornerIndices") != nullptr) {
            to.cornerVertices = integers("cornerIndices", to.cornerCount, 1);
            to.cornerSharpnesses = sharpnesses("cornerSharpnesses", to.cornerCount);
        }
        readCreaseSets(cage, to, element);
        readCreaseScalars(cage, to, element);
        numberLists(to);
        part.roundCorners = part.roundCorners != 0 || textIn(cage, "interpolateBoundary") == "edgeOnly" ? 1 : 0;
        const char* const modes[] = {"none", "cornersOnly", "cornersPlus1", "cornersPlus2", "boundaries", "all"};
        const char* const schemes[] = {"catmullClark", "loop", "bilinear", "none"};
        const auto place = [&](const char* key, const char* const* names, int count) {
            const std::string text = textIn(cage, key);
            return static_cast<int>(std::find(names, names + count, text) - names);
        };
        const int mode = place("faceVaryingLinearInterpolation", modes, 6), scheme = place("scheme", schemes, 4);
        if (part.uvInterpolation == SUPPLE_UV_FROM_FILE && mode < 6) {
            part.uvInterpolation = static_cast<SuppleUvInterpolation>(mode + 1);
        }
        if (part.madeFor == SUPPLE_MADE_FOR_UNKNOWN && scheme < 4) {
            part.madeFor = static_cast<SuppleMadeFor>(scheme + 1);
        }
    }

    void readCreaseSets(const Value& cage, SupplePrimitiveDesc& to, const std::string& element) {
        const Value* sets = member(cage, "creaseSets");
        if (sets == nullptr || !sets->IsArray()) {
            return;
        }
        Integers ofCrease(to.creaseCount, SUPPLE_NO_CREASE_SET);
        std::vector<const char*> names;
        for (std::size_t s = 0; s < sets->ArrayLen(); ++s) {
            const Value& set = sets->Get(static_cast<int>(s));
            const std::string at = element + " creaseSets[" + std::to_string(s) + "]";
            for (const uint32_t crease : integersOf(indexIn(set, "creases"), 1, at + " creases")) {
                if (crease >= ofCrease.size() || ofCrease[crease] != SUPPLE_NO_CREASE_SET) {
                    fail(at, "crease " + std::to_string(crease) + " is none, or in a set already");
                    return;
                }
                ofCrease[crease] = static_cast<uint32_t>(s);
            }
            names.push_back(texts_.emplace_back(textIn(set, "name")).c_str());
        }
        to.creaseSetCount = countOf(names);
        to.creaseSetNames = keep(std::move(names));
        to.creaseSets = keep(std::move(ofCrease));
    }

    void readCreaseScalars(const Value& cage, SupplePrimitiveDesc& to, const std::string& element) {
        if (member(cage, "creaseScalarIndices") == nullptr) {
            return;
        }
        const Integers ends = integersOf(indexIn(cage, "creaseScalarIndices"), 1, element + " creaseScalarIndices");
        const Floats alphas = floatsOf(indexIn(cage, "creaseScalars"), 1, element + " creaseScalars");
        if (ends.size() != 2 * alphas.size()) {
            fail(element, std::to_string(alphas.size()) + " creaseScalars for " + std::to_string(ends.size()) +
                              " creaseScalarIndices");
            return;
        }
        std::vector<SuppleCreaseScalar> scalars;
        for (std::size_t i = 0; i < alphas.size(); ++i) {
            scalars.push_back({ends[2 * i], ends[2 * i + 1], alphas[i]});
        }
        to.creaseScalarCount = countOf(scalars);
        to.creaseScalars = keep(std::move(scalars));
    }

    /// Lists name vertices of the primitive, unless the extension numbers vertices; Supple takes the numbers, if there
    /// are any.
    void numberLists(SupplePrimitiveDesc& to) {
        if (to.cageVertices == nullptr || numbersOfExtension_) {
            return;
        }
        const auto number = [&](const uint32_t* vertices, uint32_t count) {
            Integers numbers;
            for (uint32_t i = 0; i < count; ++i) {
                numbers.push_back(vertices[i] < to.vertexCount ? to.cageVertices[vertices[i]] : 0xFFFFFFFFu);
            }
            return keep(std::move(numbers));
        };
        to.creaseVertices = number(to.creaseVertices, 2 * to.creaseCount);
        to.cornerVertices = number(to.cornerVertices, to.cornerCount);
        std::vector<SuppleCreaseScalar> scalars(to.creaseScalars, to.creaseScalars + to.creaseScalarCount);
        for (SuppleCreaseScalar& scalar : scalars) {
            scalar.vertex = number(&scalar.vertex, 1)[0];
            scalar.toward = number(&scalar.toward, 1)[0];
        }
        to.creaseScalars = keep(std::move(scalars));
    }

    /// extras.creases, [vertex, vertex, sharpness], and extras.corners, [vertex, sharpness]: vertices of the mesh.
    void readExtrasCreases(const tinygltf::Mesh& mesh, std::vector<SupplePrimitiveDesc>& primitives) {
        const auto any = [&](auto has) { return std::any_of(primitives.begin(), primitives.end(), has); };
        const Value* creases = member(mesh.extras, "creases");
        const Value* corners = member(mesh.extras, "corners");
        if (creases != nullptr && !any([](const SupplePrimitiveDesc& p) { return p.creaseCount > 0; })) {
            readLoose(*creases, 2, primitives, &SupplePrimitiveDesc::creaseCount, &SupplePrimitiveDesc::creaseVertices,
                      &SupplePrimitiveDesc::creaseSharpnesses);
        }
        if (corners != nullptr && !any([](const SupplePrimitiveDesc& p) { return p.cornerCount > 0; })) {
            readLoose(*corners, 1, primitives, &SupplePrimitiveDesc::cornerCount, &SupplePrimitiveDesc::cornerVertices,
                      &SupplePrimitiveDesc::cornerSharpnesses);
        }
    }

    void readLoose(const Value& list, int width, std::vector<SupplePrimitiveDesc>& primitives,
                   uint32_t SupplePrimitiveDesc::*count, const uint32_t* SupplePrimitiveDesc::*vertices,
                   const float* SupplePrimitiveDesc::*sharpnesses) {
        const std::size_t entries = list.ArrayLen();
        std::size_t left = entries; // out
        uint32_t first = 0;
        for (SupplePrimitiveDesc& primitive : primitives) {
            if (primitive.sharedVertices != 0) {
                continue; // they count once
            }
            Integers own;
            Floats sharp;
            for (std::size_t i = 0; i < entries; ++i) {
                const Value& entry = list.Get(static_cast<int>(i));
                if (entry.ArrayLen() != static_cast<std::size_t>(width + 1)) {
                    continue;
                }
                Integers ends;
                for (int k = 0; k < width; ++k) {
                    const int v = entry.Get(k).IsNumber() ? entry.Get(k).GetNumberAsInt() : -1;
                    if (v >= 0 && static_cast<uint32_t>(v) >= first &&
                        static_cast<uint32_t>(v) - first < primitive.vertexCount) {
                        ends.push_back(static_cast<uint32_t>(v) - first);
                    }
                }
                const float sharpness =
                    static_cast<float>(entry.Get(width).IsNumber() ? entry.Get(width).GetNumberAsDouble() : -1.0);
                if (ends.size() == static_cast<std::size_t>(width) && std::isfinite(sharpness) && sharpness >= 0.0f) {
                    own.insert(own.end(), ends.begin(), ends.end());
                    sharp.push_back(sharpness);
                    --left;
                }
            }
            primitive.*count = countOf(sharp);
            primitive.*vertices = keep(std::move(own));
            primitive.*sharpnesses = keep(std::move(sharp));
            const bool number = primitive.cageVertices != nullptr && primitive.*count > 0;
            if (number) {
                Integers numbers;
                for (std::size_t i = 0; i < static_cast<std::size_t>(width) * (primitive.*count); ++i) {
                    numbers.push_back(primitive.cageVertices[(primitive.*vertices)[i]]);
                }
                primitive.*vertices = keep(std::move(numbers));
            }
            first += primitive.vertexCount;
        }
        if (left > 0) {
            warn(mesh_ + " extras",
                 std::to_string(left) + " creases or corners are malformed, or join two primitives; left out");
        }
    }

    // ---- clips

    void readClips() {
        for (std::size_t a = 0; a < model_->animations.size(); ++a) {
            const tinygltf::Animation& from = model_->animations[a];
            std::vector<SuppleChannelDesc>& channels = channels_.emplace_back();
            for (std::size_t c = 0; c < from.channels.size(); ++c) {
                readChannel(from, c, at("animation", a) + " " + at("channel", c), channels);
            }
            SuppleClipDesc clip = sized<SuppleClipDesc>();
            clip.name = from.name.c_str();
            clip.channelCount = countOf(channels);
            clip.channels = channels.data();
            readMarkers(from, at("animation", a) + " extras markers", clip);
            readCurves(from, at("animation", a) + " extras sharpness", clip);
            clips_.push_back(clip);
        }
    }

    void readChannel(const tinygltf::Animation& animation, std::size_t index, const std::string& element,
                     std::vector<SuppleChannelDesc>& channels) {
        const tinygltf::AnimationChannel& from = animation.channels[index];
        const char* const paths[] = {"translation", "rotation", "scale", "weights"};
        const int widths[] = {3, 4, 3, 1};
        const auto path = static_cast<std::size_t>(std::find(paths, paths + 4, from.target_path) - paths);
        if (path > 3 || from.target_node < 0) {
            warn(element, "moves no node's translation, rotation, scale or weights; ignored");
            return;
        }
        if (from.sampler < 0 || static_cast<std::size_t>(from.sampler) >= animation.samplers.size()) {
            fail(element, "no such sampler");
            return;
        }
        const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(from.sampler)];
        Floats times = floatsOf(sampler.input, 1, element + " input");
        Floats values = floatsOf(sampler.output, widths[path], element + " output");
        SuppleChannelDesc channel = sized<SuppleChannelDesc>();
        channel.node = static_cast<uint32_t>(from.target_node);
        channel.path = static_cast<SuppleChannelPath>(path);
        channel.interpolation = interpolationOf(sampler);
        channel.keyCount = countOf(times);
        channel.valueCount = countOf(values);
        channel.times = keep(std::move(times));
        channel.values = keep(std::move(values));
        channels.push_back(channel);
    }

    void readMarkers(const tinygltf::Animation& animation, const std::string& element, SuppleClipDesc& clip) {
        const Value* list = member(animation.extras, "markers");
        if (list == nullptr) {
            return;
        }
        std::vector<SuppleMarkerDesc>& markers = markers_.emplace_back();
        for (std::size_t m = 0; m < list->ArrayLen(); ++m) {
            const Value& entry = list->Get(static_cast<int>(m));
            const Value* name = member(entry, "name");
            const Value* time = member(entry, "time");
            if (name == nullptr || !name->IsString() || time == nullptr || !time->IsNumber()) {
                warn(element, "entry " + std::to_string(m) + " has no name or no time; left out");
            } else {
                markers.push_back({name->Get<std::string>().c_str(), time->GetNumberAsDouble()});
            }
        }
        clip.markerCount = countOf(markers);
        clip.markers = markers.data();
    }

    void readCurves(const tinygltf::Animation& animation, const std::string& element, SuppleClipDesc& clip) {
        const Value* list = member(animation.extras, "sharpness");
        if (list == nullptr) {
            return;
        }
        std::vector<SuppleSharpnessCurveDesc>& curves = curves_.emplace_back();
        for (std::size_t c = 0; c < list->ArrayLen(); ++c) {
            const Value& entry = list->Get(static_cast<int>(c));
            const std::string set = textIn(entry, "set");
            const Value* number = member(entry, "sampler");
            const int at = number != nullptr && number->IsNumber() ? number->GetNumberAsInt() : -1;
            if (set.empty() || at < 0 || static_cast<std::size_t>(at) >= animation.samplers.size()) {
                warn(element, "entry " + std::to_string(c) + " has no set or no sampler; left out");
                continue;
            }
            const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(at)];
            const std::string entryName = element + " " + std::to_string(c);
            Floats times = floatsOf(sampler.input, 1, entryName), values = floatsOf(sampler.output, 1, entryName);
            SuppleSharpnessCurveDesc curve{};
            curve.set = texts_.emplace_back(set).c_str();
            curve.interpolation = interpolationOf(sampler);
            curve.keyCount = countOf(times);
            if (values.size() != times.size() * (curve.interpolation == SUPPLE_KEYS_CUBICSPLINE ? 3 : 1)) {
                fail(entryName,
                     std::to_string(values.size()) + " values for " + std::to_string(times.size()) + " keys");
                continue;
            }
            curve.times = keep(std::move(times));
            curve.values = keep(std::move(values));
            curves.push_back(curve);
        }
        clip.sharpnessCurveCount = countOf(curves);
        clip.sharpnessCurves = curves.data();
    }

    static SuppleKeyInterpolation interpolationOf(const tinygltf::AnimationSampler& sampler) {
        return sampler.interpolation == "STEP"          ? SUPPLE_KEYS_STEP
               : sampler.interpolation == "CUBICSPLINE" ? SUPPLE_KEYS_CUBICSPLINE
                                                        : SUPPLE_KEYS_LINEAR;
    }

    const tinygltf::Model* model_ = nullptr;
    std::string mesh_; ///< at work
    bool sound_ = true;
    bool numbersOfExtension_ = false; ///< of the mesh at work: SUPPLE_mesh_cage numbers the cage's vertices
    std::vector<std::string> messages_;
    std::deque<Floats> floats_;
    std::deque<Integers> integers_;
    std::deque<std::vector<SuppleCreaseScalar>> scalars_;
    std::deque<std::vector<const char*>> names_;
    std::deque<std::string> texts_;
    std::vector<SuppleNodeDesc> nodes_;
    std::vector<SuppleImageInfo> images_;
    std::vector<SuppleMaterialInfo> materials_;
    std::vector<SuppleMaterialLayers> layers_; // one per material
    std::deque<SuppleSkinDesc> skins_;
    std::deque<std::vector<SuppleMorphTargetDesc>> targets_;
    std::deque<std::vector<SuppleDisplacements>> displacements_;
    std::deque<std::vector<SupplePrimitiveDesc>> primitives_;
    std::vector<SupplePartDesc> parts_;
    std::deque<std::vector<SuppleChannelDesc>> channels_;
    std::deque<std::vector<SuppleMarkerDesc>> markers_;
    std::deque<std::vector<SuppleSharpnessCurveDesc>> curves_;
    std::vector<SuppleClipDesc> clips_;
    SuppleCharacterDesc desc_{};
};

} // namespace supple
