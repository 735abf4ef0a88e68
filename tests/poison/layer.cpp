// A Vulkan layer that fills all device memory when it is allocated, as an engine hands over memory that others have
// used: what reads before it writes comes to light. It serves every program that runs under it, tests, commands and
// samples alike.
//
// SUPPLE_POISON says with what: ff, 3f, 01 (bytes), nan (floats), random, zero, or each: one of the first five, by the
// arguments of the program and the number of the allocation, so that it changes by test and is the same every time.
// Without the variable nothing is filled. Memory that the host cannot map never is.
//
// SUPPLE_POISON_GPU=1 makes the layer call every device a GPU. So lavapipe takes the path of one wherever nobody
// chooses a mapping.
//
// Tests let `operator new` fail and count its calls, also those of a library. So nothing here calls it, but for what
// makes a device.
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <map>
#include <mutex>
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

namespace {

struct Instance {
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    PFN_vkDestroyInstance destroyInstance = nullptr;
    PFN_vkGetPhysicalDeviceMemoryProperties getMemoryProperties = nullptr;
    PFN_vkGetPhysicalDeviceProperties getProperties = nullptr;
    PFN_vkGetPhysicalDeviceProperties2 getProperties2 = nullptr;
};
struct Device {
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr;
    PFN_vkDestroyDevice destroyDevice = nullptr;
    PFN_vkAllocateMemory allocateMemory = nullptr;
    PFN_vkMapMemory mapMemory = nullptr;
    PFN_vkUnmapMemory unmapMemory = nullptr;
    VkPhysicalDeviceMemoryProperties memory{};
};

/// What belongs to an object and those made of it: the loader's first word of a dispatchable handle tells which.
template <class T>
class Table {
public:
    template <class Handle>
    void add(Handle handle, const T& entry) {
        const std::lock_guard lock(mutex_);
        entries_[keyOf(handle)] = entry;
    }
    template <class Handle>
    T find(Handle handle) {
        const std::lock_guard lock(mutex_);
        const auto found = entries_.find(keyOf(handle));
        return found != entries_.end() ? found->second : T{};
    }
    template <class Handle>
    T take(Handle handle) {
        const T entry = find(handle);
        const std::lock_guard lock(mutex_);
        entries_.erase(keyOf(handle));
        return entry;
    }

private:
    template <class Handle>
    static const void* keyOf(Handle handle) {
        const void* key = nullptr;
        std::memcpy(&key, reinterpret_cast<const void*>(handle), sizeof key);
        return key;
    }

    std::mutex mutex_;
    std::map<const void*, T> entries_;
};

Table<Instance>& instances() {
    static Table<Instance> table;
    return table;
}
Table<Device>& devices() {
    static Table<Device> table;
    return table;
}

/// Numbers that look like nothing.
uint64_t scrambled(uint64_t x) {
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
    x = (x ^ x >> 27) * 0x94D049BB133111EBu;
    return x ^ x >> 31;
}

/// Without the program's own path: checkouts lie anywhere.
uint64_t hashOfArguments() {
    uint64_t hash = 0xCBF29CE484222325u;
    std::FILE* const file = std::fopen("/proc/self/cmdline", "rb");
    bool counts = false;
    for (int c = 0; file != nullptr && (c = std::fgetc(file)) != EOF;) {
        counts = counts || c == 0;
        hash = counts ? (hash ^ static_cast<uint64_t>(c)) * 0x100000001B3u : hash;
    }
    if (file != nullptr) {
        std::fclose(file);
    }
    return hash;
}

bool is(const char* name, const char* other) {
    return std::strcmp(name, other) == 0;
}

void fill(void* bytes, VkDeviceSize size, const char* kind) {
    static const uint64_t kProgram = hashOfArguments();
    static std::atomic<uint64_t> allocations = 0;
    constexpr const char* kKinds[] = {"ff", "3f", "01", "nan", "random"};
    const uint64_t number = scrambled(kProgram + ++allocations);
    if (is(kind, "each")) {
        kind = kKinds[number % std::size(kKinds)];
    }
    if (is(kind, "nan") || is(kind, "random")) {
        auto* words = static_cast<uint64_t*>(bytes);
        const bool random = is(kind, "random");
        for (VkDeviceSize i = 0; i < size / sizeof(uint64_t); ++i) {
            words[i] = random ? scrambled(number + i) : 0x7FC000007FC00000u;
        }
        return;
    }
    std::memset(bytes, is(kind, "ff") ? 0xFF : is(kind, "3f") ? 0x3F : is(kind, "01") ? 0x01 : 0, size);
}

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice handle, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
    const Device device = devices().find(handle);
    const VkResult result = device.allocateMemory(handle, info, allocator, memory);
    const char* const kind = std::getenv("SUPPLE_POISON");
    // What comes from elsewhere has its content.
    bool imported = false;
    for (auto* next = static_cast<const VkBaseInStructure*>(info->pNext); next != nullptr; next = next->pNext) {
        imported = imported || (next->sType != VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO &&
                                next->sType != VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO &&
                                next->sType != VK_STRUCTURE_TYPE_EXPORT_MEMORY_ALLOCATE_INFO);
    }
    const VkMemoryPropertyFlags flags = device.memory.memoryTypes[info->memoryTypeIndex].propertyFlags;
    if (result != VK_SUCCESS || kind == nullptr || imported || (flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0) {
        return result;
    }
    void* bytes = nullptr;
    if (device.mapMemory(handle, *memory, 0, VK_WHOLE_SIZE, 0, &bytes) == VK_SUCCESS) {
        fill(bytes, info->allocationSize, kind);
        device.unmapMemory(handle, *memory);
    }
    return result;
}

/// The link of the loader's chain that leads to the next layer.
template <class Link>
Link* nextLink(const void* chain, VkStructureType type) {
    for (auto* next = static_cast<const VkBaseInStructure*>(chain); next != nullptr; next = next->pNext) {
        auto* link = reinterpret_cast<Link*>(const_cast<VkBaseInStructure*>(next));
        if (next->sType == type && link->function == VK_LAYER_LINK_INFO) {
            return link;
        }
    }
    return nullptr;
}

template <class Function>
Function as(PFN_vkVoidFunction function) {
    return reinterpret_cast<Function>(function);
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                              VkInstance* handle) {
    auto* link = nextLink<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (link == nullptr) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    Instance next;
    next.getInstanceProcAddr = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = as<PFN_vkCreateInstance>(next.getInstanceProcAddr(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, allocator, handle);
    if (result != VK_SUCCESS) {
        return result;
    }
    next.destroyInstance = as<PFN_vkDestroyInstance>(next.getInstanceProcAddr(*handle, "vkDestroyInstance"));
    next.getMemoryProperties = as<PFN_vkGetPhysicalDeviceMemoryProperties>(
        next.getInstanceProcAddr(*handle, "vkGetPhysicalDeviceMemoryProperties"));
    next.getProperties =
        as<PFN_vkGetPhysicalDeviceProperties>(next.getInstanceProcAddr(*handle, "vkGetPhysicalDeviceProperties"));
    next.getProperties2 =
        as<PFN_vkGetPhysicalDeviceProperties2>(next.getInstanceProcAddr(*handle, "vkGetPhysicalDeviceProperties2"));
    instances().add(*handle, next);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyInstance(VkInstance handle, const VkAllocationCallbacks* allocator) {
    if (handle != VK_NULL_HANDLE) {
        instances().take(handle).destroyInstance(handle, allocator);
    }
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* handle) {
    auto* link = nextLink<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (link == nullptr) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    const Instance instance = instances().find(physical);
    Device next;
    next.getDeviceProcAddr = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    const PFN_vkGetInstanceProcAddr getInstanceProcAddr = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = as<PFN_vkCreateDevice>(getInstanceProcAddr(VK_NULL_HANDLE, "vkCreateDevice"));
    const VkResult result = create(physical, info, allocator, handle);
    if (result != VK_SUCCESS) {
        return result;
    }
    const auto function = [&](const char* name) { return next.getDeviceProcAddr(*handle, name); };
    next.destroyDevice = as<PFN_vkDestroyDevice>(function("vkDestroyDevice"));
    next.allocateMemory = as<PFN_vkAllocateMemory>(function("vkAllocateMemory"));
    next.mapMemory = as<PFN_vkMapMemory>(function("vkMapMemory"));
    next.unmapMemory = as<PFN_vkUnmapMemory>(function("vkUnmapMemory"));
    instance.getMemoryProperties(physical, &next.memory);
    devices().add(*handle, next);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroyDevice(VkDevice handle, const VkAllocationCallbacks* allocator) {
    if (handle != VK_NULL_HANDLE) {
        devices().take(handle).destroyDevice(handle, allocator);
    }
}

void pretend(VkPhysicalDeviceProperties& properties) {
    const char* const wish = std::getenv("SUPPLE_POISON_GPU");
    if (wish != nullptr && is(wish, "1")) {
        properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    }
}

VKAPI_ATTR void VKAPI_CALL getProperties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* properties) {
    instances().find(physical).getProperties(physical, properties);
    pretend(*properties);
}

VKAPI_ATTR void VKAPI_CALL getProperties2(VkPhysicalDevice physical, VkPhysicalDeviceProperties2* properties) {
    instances().find(physical).getProperties2(physical, properties);
    pretend(properties->properties);
}

template <class Function>
PFN_vkVoidFunction asVoid(Function function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

} // namespace

extern "C" {

VK_LAYER_EXPORT VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL supplePoisonGetDeviceProcAddr(VkDevice handle,
                                                                                       const char* name) {
    if (is(name, "vkGetDeviceProcAddr")) {
        return asVoid(&supplePoisonGetDeviceProcAddr);
    }
    if (is(name, "vkDestroyDevice")) {
        return asVoid(&destroyDevice);
    }
    if (is(name, "vkAllocateMemory")) {
        return asVoid(&allocateMemory);
    }
    return devices().find(handle).getDeviceProcAddr(handle, name);
}

VK_LAYER_EXPORT VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL supplePoisonGetInstanceProcAddr(VkInstance handle,
                                                                                         const char* name) {
    if (is(name, "vkGetInstanceProcAddr")) {
        return asVoid(&supplePoisonGetInstanceProcAddr);
    }
    if (is(name, "vkCreateInstance")) {
        return asVoid(&createInstance);
    }
    if (is(name, "vkDestroyInstance")) {
        return asVoid(&destroyInstance);
    }
    if (is(name, "vkGetPhysicalDeviceProperties")) {
        return asVoid(&getProperties);
    }
    if (is(name, "vkGetPhysicalDeviceProperties2")) {
        return asVoid(&getProperties2);
    }
    if (is(name, "vkCreateDevice")) {
        return asVoid(&createDevice);
    }
    if (is(name, "vkGetDeviceProcAddr")) {
        return asVoid(&supplePoisonGetDeviceProcAddr);
    }
    if (is(name, "vkAllocateMemory")) {
        return asVoid(&allocateMemory);
    }
    if (is(name, "vkDestroyDevice")) {
        return asVoid(&destroyDevice);
    }
    return handle == VK_NULL_HANDLE ? nullptr : instances().find(handle).getInstanceProcAddr(handle, name);
}

} // extern "C"
