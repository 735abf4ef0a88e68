#include "host/patches.h"

#include <algorithm>

namespace supple::host {

Result<std::vector<uint32_t>> patchesByPart(Context& context, SuppleGroup group, uint32_t surface,
                                            std::span<const uint32_t> faceParts, size_t partCount) {
    uint32_t count = 0;
    Status status =
        context.check(suppleGetPatches(context.handle(), group, surface, nullptr, &count), "suppleGetPatches");
    std::vector<SupplePatchInfo> patches(count);
    if (status)
        status = context.check(suppleGetPatches(context.handle(), group, surface, patches.data(), &count),
                               "suppleGetPatches");
    if (!status)
        return status.error();
    std::vector<uint32_t> byPart(std::max<size_t>(partCount, 1));
    for (const SupplePatchInfo& patch : patches)
        ++byPart[faceParts.empty() ? 0 : faceParts[patch.face]];
    return byPart;
}

} // namespace supple::host
