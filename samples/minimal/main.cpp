// The shortest tour of Supple: a device, a character, an instance, a few frames of a clip, and what they took. It draws
// nothing, and does one frame at a time; samples/c_host keeps two in flight and reads the surface, samples/sdl_engine
// draws.
#include <supple/supple.hpp>

#include <vulkan/vulkan.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

namespace {

// VkResult or SuppleResult. A sample may stop at the first failure: the process ends and takes everything with it.
template <class Result>
void check(Result result, const char* what) {
    if (result != Result{}) {
        std::fprintf(stderr, "%s: result %d\n", what, static_cast<int>(result));
        std::exit(1);
    }
}

void onLog(SuppleSeverity severity, SuppleMessage message, const char* text, void*) {
    if (severity != SUPPLE_SEVERITY_INFO)
        std::fprintf(stderr, "supple %d: %s\n", static_cast<int>(message), text);
}

int validationMessages = 0;

VKAPI_ATTR VkBool32 VKAPI_CALL onValidation(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
    ++validationMessages;
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    return VK_FALSE;
}

// With SUPPLE_VALIDATION=1 the validation layer runs along and reports to onValidation.
VkInstance createInstance(VkDebugUtilsMessengerEXT& messenger) {
    const char* wish = std::getenv("SUPPLE_VALIDATION");
    const bool validate = wish != nullptr && std::strcmp(wish, "1") == 0;
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const char* extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    const auto synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT features{
        VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, nullptr, 1, &synchronization, 0, {}};
    const VkApplicationInfo application{
        VK_STRUCTURE_TYPE_APPLICATION_INFO, nullptr, "minimal", 0, nullptr, 0, VK_API_VERSION_1_1};
    const VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    validate ? &features : nullptr,
                                    0,
                                    &application,
                                    validate ? 1u : 0u,
                                    &layer,
                                    validate ? 2u : 0u,
                                    extensions};
    VkInstance instance = VK_NULL_HANDLE;
    check(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
    if (validate) {
        VkDebugUtilsMessengerCreateInfoEXT messengerInfo{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
        messengerInfo.messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
        messengerInfo.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
        messengerInfo.pfnUserCallback = onValidation;
        const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
        check(create(instance, &messengerInfo, nullptr, &messenger), "vkCreateDebugUtilsMessengerEXT");
    }
    return instance;
}

// An asset is a control cage with what animates it: of a file, or of a host's own arrays, as this cube.
supple::Asset createAsset(const supple::Context& context, const char* path) {
    const float positions[] = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1};
    const uint32_t counts[] = {4, 4, 4, 4, 4, 4};
    const uint32_t corners[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 2, 3, 7, 6, 0, 4, 7, 3, 1, 2, 6, 5};
    const SuppleCageDesc cage{sizeof cage, 8, 6, positions, counts, corners};
    auto desc = supple::sized<SuppleAssetDesc>();
    desc.name = path != nullptr ? path : "cube";
    std::ifstream stream(path != nullptr ? path : "", std::ios::binary);
    const std::vector<char> file(std::istreambuf_iterator<char>(stream), {});
    check(path == nullptr || stream.is_open() ? SUPPLE_OK : SUPPLE_ERROR_ASSET, desc.name);
    desc.bytes = file.data();
    desc.byteCount = file.size();
    desc.cage = path != nullptr ? nullptr : &cage;
    supple::Asset asset;
    check(supple::Asset::create(context, desc, asset), "supple::Asset::create");
    return asset;
}

// All calls from now on, with hashes of what they bring about: supple replay makes them again. The stream must outlive
// the context.
void startRecording(const supple::Context& context, std::ofstream& stream) {
    auto desc = supple::sized<SuppleRecordingDesc>();
    desc.flags = SUPPLE_RECORDING_HASHES;
    desc.user = &stream;
    desc.write = [](const void* bytes, size_t count, void* user) {
        auto& out = *static_cast<std::ofstream*>(user);
        return out.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count)) ? 1 : 0;
    };
    check(context.startRecording(desc), "startRecording");
}

// What the command line says.
struct Options {
    const char* character = nullptr;
    const char* recording = nullptr;
};

// Everything that has to do with Supple. What it owns goes with the scope, before the device does.
void run(const SuppleContextDesc& contextDesc, VkQueue queue, VkCommandBuffer commands, const Options& options) {
    std::ofstream recording;
    supple::Context context;
    check(supple::Context::create(contextDesc, context), "supple::Context::create");
    if (options.recording != nullptr) {
        recording.open(options.recording, std::ios::binary);
        startRecording(context, recording);
    }
    const supple::Asset asset = createAsset(context, options.character);
    auto groupDesc = supple::sized<SuppleGroupDesc>(); // instances of one asset, evaluated together
    groupDesc.asset = asset.handle();
    groupDesc.capacity = 1;
    groupDesc.rate = 8; // segments along the edge of a patch
    supple::Group group;
    // Makes the pipelines, so that recording never does.
    check(supple::Group::create(context, groupDesc, group), "supple::Group::create");
    supple::Instance character;
    check(supple::Instance::create(group, character), "supple::Instance::create");

    SuppleAssetInfo info;
    check(asset.info(info), "info");
    SuppleGroupInfo groupInfo;
    check(group.info(groupInfo), "info");
    // What a host draws, surface by surface; suppleGetVertexStreams has the buffers of the vertices.
    std::vector<SuppleGridOutput> grids(groupInfo.surfaceCount);
    uint32_t vertexCount = 0;
    for (uint32_t surface = 0; surface < groupInfo.surfaceCount; ++surface) {
        check(group.gridOutput(grids[surface], surface), "gridOutput");
        vertexCount += grids[surface].vertexCount;
    }
    std::printf("%u faces, %u clips, %u surface vertices\n", info.faceCount, info.clipCount, vertexCount);

    uint64_t frame = 1;
    for (; frame <= 10; ++frame) {
        check(context.beginFrame(frame, frame - 1), "beginFrame"); // the frame before is complete
        check(character.setClipPose(info.clipCount > 0 ? 0 : SUPPLE_BIND_POSE, 0.1 * double(frame)), "setClipPose");
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
        // Who reads the output, before and after: the host's draws. The barriers between are Supple's.
        const SuppleSyncScope draws{VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT, VK_ACCESS_2_MEMORY_READ_BIT};
        const SuppleGroup groups[] = {group.handle()};
        check(context.record(commands, groups, draws, draws, SUPPLE_RECORD_TIMINGS), "record");
        // Here a host draws: one vkCmdDrawIndexedIndirect for each of the grids' drawRanges.
        check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
        const VkSubmitInfo submit{
            VK_STRUCTURE_TYPE_SUBMIT_INFO, nullptr, 0, nullptr, nullptr, 1, &commands, 0, nullptr};
        check(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
        check(vkQueueWaitIdle(queue), "vkQueueWaitIdle");
    }

    check(context.beginFrame(frame, frame - 1), "beginFrame"); // reads the last frame's timestamps
    std::vector<SuppleTiming> timings;
    check(context.timings(timings), "timings");
    for (const SuppleTiming& timing : timings)
        std::printf("%-10s %8.3f ms %9llu points\n", suppleGetPassName(timing.pass),
                    (timing.gpuEnd - timing.gpuBegin) * 1e-6, static_cast<unsigned long long>(timing.points));
}

} // namespace

int main(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--record") == 0 && i + 1 < argc) {
            options.recording = argv[++i];
        } else if (options.character == nullptr && argv[i][0] != '-') {
            options.character = argv[i];
        } else {
            std::puts("usage: supple_minimal [--record FILE] [CHARACTER.glb]   without a character: a cube");
            return std::strcmp(argv[i], "--help") == 0 ? 0 : 2;
        }
    }
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    const VkInstance instance = createInstance(messenger);
    auto contextDesc = supple::sized<SuppleContextDesc>();
    contextDesc.instance = instance;
    contextDesc.getInstanceProcAddr = vkGetInstanceProcAddr;
    contextDesc.log = onLog;

    // The first device that Supple can use. No feature need be enabled.
    auto requirements = supple::sized<SuppleRequirements>();
    requirements.instanceVersion = VK_API_VERSION_1_1;
    VkPhysicalDevice gpus[16];
    uint32_t gpuCount = 16, chosen = 0;
    vkEnumeratePhysicalDevices(instance, &gpuCount, gpus);
    while (chosen < gpuCount &&
           suppleQueryRequirements(instance, gpus[chosen], vkGetInstanceProcAddr, &requirements) != SUPPLE_OK)
        std::fprintf(stderr, "device %u will not do: %s\n", chosen++, requirements.reason);
    if (chosen == gpuCount)
        return 3;
    contextDesc.physicalDevice = gpus[chosen];

    VkQueueFamilyProperties families[16];
    uint32_t familyCount = 16;
    vkGetPhysicalDeviceQueueFamilyProperties(contextDesc.physicalDevice, &familyCount, families);
    while ((families[contextDesc.queueFamily].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0)
        ++contextDesc.queueFamily;
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queueInfo{
        VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, contextDesc.queueFamily, 1, &priority};
    const VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, nullptr, 0, 1, &queueInfo};
    check(vkCreateDevice(contextDesc.physicalDevice, &deviceInfo, nullptr, &contextDesc.device), "vkCreateDevice");
    VkQueue queue = VK_NULL_HANDLE;
    vkGetDeviceQueue(contextDesc.device, contextDesc.queueFamily, 0, &queue);
    const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr,
                                           VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT, contextDesc.queueFamily};
    VkCommandPool pool = VK_NULL_HANDLE;
    check(vkCreateCommandPool(contextDesc.device, &poolInfo, nullptr, &pool), "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo commandInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool,
                                                  VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(contextDesc.device, &commandInfo, &commands), "vkAllocateCommandBuffers");

    run(contextDesc, queue, commands, options);

    vkDestroyCommandPool(contextDesc.device, pool, nullptr);
    vkDestroyDevice(contextDesc.device, nullptr);
    if (messenger != VK_NULL_HANDLE)
        reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"))(instance, messenger, nullptr);
    vkDestroyInstance(instance, nullptr);
    return validationMessages == 0 ? 0 : 1;
}
