#include "host/patches.h"

#include <algorithm>
#include <utility>

namespace supple::host {

Result<std::vector<SupplePatchInfo>> patchesOf(Context& context, SuppleGroup group, uint32_t surface) {
    uint32_t count = 0;
    Status status =
        context.check(suppleGetPatches(context.handle(), group, surface, nullptr, &count), "suppleGetPatches");
    std::vector<SupplePatchInfo> patches(count);
    if (status)
        status = context.check(suppleGetPatches(context.handle(), group, surface, patches.data(), &count),
                               "suppleGetPatches");
    return status ? Result<std::vector<SupplePatchInfo>>(std::move(patches)) : status.error();
}

Result<std::vector<uint32_t>> patchesByPart(Context& context, SuppleGroup group, uint32_t surface,
                                            std::span<const uint32_t> faceParts, size_t partCount) {
    const Result<std::vector<SupplePatchInfo>> patches = patchesOf(context, group, surface);
    if (!patches)
        return patches.error();
    std::vector<uint32_t> byPart(std::max<size_t>(partCount, 1));
    for (const SupplePatchInfo& patch : *patches)
        ++byPart[faceParts.empty() ? 0 : faceParts[patch.face]];
    return byPart;
}

} // namespace supple::host
