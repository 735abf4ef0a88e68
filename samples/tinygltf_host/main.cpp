// A host that reads glTF with tinygltf, as many do, and hands the character over as arrays: ten frames of its first
// clip, without a window.
#include "host/context.h"
#include "host/device.h"
#include "host/must.h"

#define TINYGLTF_NO_STB_IMAGE // images stay encoded, so nothing here decodes them
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <supple/supple_tinygltf.hpp>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

namespace {

using namespace supple::host;

tinygltf::Model load(const std::string& path) {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(supple::keepTinygltfImage, nullptr);
    tinygltf::Model model;
    std::string errors;
    std::string warnings;
    if (!loader.LoadBinaryFromFile(&model, &errors, &warnings, path)) {
        std::fprintf(stderr, "%s: %s\n", path.c_str(), errors.c_str());
        std::exit(1);
    }
    return model;
}

SuppleAsset createAsset(Context& context, const std::string& path) {
    const tinygltf::Model model = load(path);
    supple::TinygltfCharacter character;
    const bool sound = character.read(model);
    for (const std::string& line : character.messages()) {
        std::fprintf(stderr, "%s: %s\n", path.c_str(), line.c_str());
    }
    if (!sound) {
        std::exit(1);
    }
    auto desc = supple::sized<SuppleAssetDesc>();
    desc.name = path.c_str();
    desc.character = &character.desc();
    SuppleAsset asset{};
    must(context.check(suppleCreateAsset(context.handle(), &desc, &asset), "suppleCreateAsset"));
    return asset; // everything is copied: model and character may go
}

void run(Device& device, const std::string& path, const std::string& record) {
    const std::unique_ptr<Context> context = must(Context::create(device, {.record = record}));
    const SuppleAsset asset = createAsset(*context, path);
    auto info = supple::sized<SuppleAssetInfo>();
    must(context->check(suppleGetAssetInfo(context->handle(), asset, &info), "suppleGetAssetInfo"));
    std::printf(
        "%u parts, %u cage vertices, %u faces, %u joints, %u morph targets, %u clips, %u materials, %u images\n",
        info.partCount, info.cageVertexCount, info.faceCount, info.jointCount, info.morphTargetCount, info.clipCount,
        info.materialCount, info.imageCount);

    auto groupDesc = supple::sized<SuppleGroupDesc>();
    groupDesc.asset = asset;
    groupDesc.capacity = 1;
    groupDesc.rate = 4;
    SuppleGroup group{};
    must(context->check(suppleCreateGroup(context->handle(), &groupDesc, &group), "suppleCreateGroup"));
    std::vector<SuppleInstance> instances;
    must(context->createInstances(group, 1, instances));
    const uint32_t clip = info.clipCount > 0 ? 0 : SUPPLE_BIND_POSE;
    for (int frame = 0; frame < 10; ++frame) {
        must(
            context->check(suppleSetClipPose(context->handle(), instances[0], clip, 0.1 * frame), "suppleSetClipPose"));
        must(context->evaluate({&group, 1}));
    }
    uint32_t vertices = 0;
    auto groupInfo = supple::sized<SuppleGroupInfo>();
    must(context->check(suppleGetGroupInfo(context->handle(), group, &groupInfo), "suppleGetGroupInfo"));
    for (uint32_t surface = 0; surface < groupInfo.surfaceCount; ++surface) {
        auto grid = supple::sized<SuppleGridOutput>();
        must(context->check(suppleGetGridOutput(context->handle(), group, surface, &grid), "suppleGetGridOutput"));
        vertices += grid.vertexCount;
    }
    std::printf("10 frames of %s: %u surfaces, %u surface vertices\n", clip == 0 ? "clip 0" : "the bind pose",
                groupInfo.surfaceCount, vertices);
}

} // namespace

int main(int argc, char** argv) {
    const bool records = argc == 4 && std::strcmp(argv[1], "--record") == 0;
    if (!records && (argc != 2 || argv[1][0] == '-')) {
        std::puts("usage: supple_tinygltf_host [--record FILE] CHARACTER.glb");
        return argc == 2 && std::strcmp(argv[1], "--help") == 0 ? 0 : 2;
    }
    std::unique_ptr<Device> device = mustCreateDevice();
    const std::shared_ptr<const ValidationLog> validation = device->validation();
    run(*device, argv[argc - 1], records ? argv[2] : "");
    device.reset();
    mustBeSilent(*validation);
    return 0;
}
